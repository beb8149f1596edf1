//! Look through a registered camera.

use super::camera_view::Through;
use super::cloud::CloudView;
use crate::project::{PhotoId, Project};
use nalgebra::{Point3, Rotation3};

impl CloudView {
    /// Looks through the camera of a photograph; the center of the orbit is at the median depth of
    /// the points.
    pub(crate) fn look_through(&mut self, project: &Project, photo: PhotoId) {
        let photos = project.taking_part();
        let place = photos.iter().position(|other| other.id == photo);
        let found = place.zip(project.component()).zip(self.orbit);
        let Some(((place, component), orbit)) = found else {
            return;
        };
        let size = project.camera(photos[place]);
        let camera = component.cameras.get(place).copied().flatten();
        let (Some(camera), Some(size)) = (camera, size) else {
            return;
        };
        let kept = project.remaining();
        let points = component
            .points
            .iter()
            .filter(|point| kept.has_point(point));
        let mut depths: Vec<f64> = points.map(|point| camera.depth(point.position)).collect();
        depths.retain(|depth| *depth > 0.0);
        let middle = depths.len() / 2;
        let distance = match depths.is_empty() {
            true => orbit.distance,
            false => *depths.select_nth_unstable_by(middle, f64::total_cmp).1,
        };
        let (rotation, _) = camera.transform(&Point3::origin());
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        let [fu, fv, ..] = camera.intrinsics;
        self.orbit = Some(orbit.through(rotation, camera.center(), distance));
        self.through = Some(Through {
            photo,
            before: self.through.take().map_or(orbit, |through| through.before),
            focals: [fu / f64::from(size.width), fv / f64::from(size.height)],
        });
    }

    /// Returns to the view before.
    pub(crate) fn look_back(&mut self) {
        if let Some(through) = self.through.take() {
            self.orbit = Some(through.before);
        }
    }
}
