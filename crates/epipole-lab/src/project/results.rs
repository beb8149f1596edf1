//! Numbers of the current reconstruction and of the one before.

use super::anchor::PhotoId;
use super::key::Key;

/// Numbers of a reconstruction.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Found {
    pub(crate) key: Key,
    /// Photographs that took part.
    pub(crate) photos: Vec<PhotoId>,
    pub(crate) num_registered: usize,
    pub(crate) num_points: usize,
    pub(crate) mean_error_px: f64,
}

/// Current reconstruction, and the one before with some of the same photographs.
#[derive(Debug, Default)]
pub(crate) struct Results {
    pub(crate) now: Option<Found>,
    pub(crate) before: Option<Found>,
}

impl Results {
    /// Takes the current reconstruction.
    pub(crate) fn take(&mut self, found: Found) {
        let before = self.now.take();
        if before.as_ref().is_none_or(|before| before.key != found.key) {
            let is_shared = |photo: &PhotoId| found.photos.contains(photo);
            self.before = before.filter(|before| before.photos.iter().any(is_shared));
        }
        self.now = Some(found);
    }
}
