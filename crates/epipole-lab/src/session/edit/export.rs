//! Results for files, without the points outside the box and deleted ones.

use crate::project::{Key, Project};
use crate::tasks::{Component, Dense, DenseCloud, ImagePoints, Reconstructed};

impl Project {
    /// Returns the reconstruction with the remaining points of the current component, and, if some
    /// are left out, the component with all of them.
    pub(in crate::session) fn kept_reconstruction(
        &self,
        found: &Reconstructed,
        images: &[ImagePoints],
    ) -> (Reconstructed, Option<Component>) {
        let (place, remaining) = (self.view.component, self.remaining());
        let mut found = found.clone();
        let Some(component) = found
            .components
            .get_mut(place)
            .filter(|_| !remaining.is_all())
        else {
            return (found, None);
        };
        let fewer = component.retained(|point| remaining.has_point(point));
        let mean_px = mean_error_px(&fewer, images);
        let all = std::mem::replace(component, fewer);
        if let Some(mean) = found.mean_error_px.get_mut(place) {
            *mean = mean_px;
        }
        (found, Some(all))
    }

    /// Returns the remaining part of the depth of a pair.
    pub(in crate::session) fn kept_pair(&self, key: Key, pair: &Dense) -> Dense {
        let remaining = self.remaining();
        match remaining.is_all() {
            true => pair.clone(),
            false => pair.retained(remaining.of_cloud(key)),
        }
    }

    /// Returns the remaining part of the depth of all views.
    pub(in crate::session) fn kept_views(&self) -> Option<DenseCloud> {
        let (key, cloud) = self.all_views()?;
        let remaining = self.remaining();
        Some(match remaining.is_all() {
            true => cloud.clone(),
            false => cloud.retained(remaining.of_cloud(key)),
        })
    }

    /// Describes what the box and deletions leave out; empty if nothing.
    pub fn edit_words(&self) -> String {
        let has_deleted = self.num_in(&self.document.deleted) > 0;
        match (self.crop().is_some(), has_deleted) {
            (false, false) => String::new(),
            (true, false) => "Points outside the box are left out.".to_owned(),
            (false, true) => "Deleted points are left out.".to_owned(),
            (true, true) => "Points outside the box and deleted points are left out.".to_owned(),
        }
    }
}

/// Returns the mean length of all reprojection errors, pixels; 0 without any.
fn mean_error_px(component: &Component, images: &[ImagePoints]) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u32);
    for point in &component.points {
        for (image, keypoint) in &point.track {
            let (image, keypoint) = (*image as usize, *keypoint as usize);
            let camera = component.cameras.get(image).and_then(Option::as_ref);
            let seen = images
                .get(image)
                .and_then(|image| image.points.get(keypoint));
            let found = camera.and_then(|c| c.project(point.position, &component.lens));
            if let (Some([u, v]), Some([seen_u, seen_v])) = (found, seen) {
                sum += libm::hypot(u - seen_u, v - seen_v);
                count += 1;
            }
        }
    }
    sum / f64::from(count.max(1))
}
