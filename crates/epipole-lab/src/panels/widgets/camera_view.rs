//! View through a camera.

use crate::project::PhotoId;
use epipole_canvas::cloud::Orbit;

/// View through a camera.
pub(crate) struct Through {
    /// Its photograph.
    pub(crate) photo: PhotoId,
    /// View to return to.
    pub(super) before: Orbit,
    /// Focal lengths, relative to the width and the height of the photograph.
    pub(super) focals: [f64; 2],
}

impl Through {
    /// Sets the focal length with which the photograph fills a picture of this size.
    pub(super) fn focus(&self, orbit: &mut Orbit, (width, height): (usize, usize)) {
        let [fu, fv] = self.focals;
        let (width, height) = (width.max(1) as f64, height.max(1) as f64);
        orbit.focal = (width * fu).min(height * fv) / width.min(height);
    }
}
