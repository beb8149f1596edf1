//! Selection and size of photographs for the depth of all views.

use super::dense_cloud::DenseCloud;
use super::reconstruction::ReconstructionOfAll;
use super::task::Query;
use crate::project::{Key, PhotoId, Project};

/// Maximum number of pixels of all photographs. At 60 bytes each they take 0.7 GB, of the 4 GB
/// available to a worker.
const MAX_PIXELS: f64 = 12e6;

impl Project {
    /// Returns the registered photographs of the current component.
    pub(super) fn registered(&self) -> Vec<PhotoId> {
        let Some(component) = self.component() else {
            return Vec::new();
        };
        let photos = self.taking_part().into_iter().zip(&component.cameras);
        let registered = photos.filter(|(_, camera)| camera.is_some());
        registered.map(|(photo, _)| photo.id).collect()
    }

    /// Returns the maximum number of pixels of a photograph for the depth of all views: the
    /// setting, or less for many photographs.
    pub(crate) fn max_view_pixels(&self) -> Option<u32> {
        let count = self.component()?.num_registered().max(1);
        let wanted = self.document.settings.all_views.max_megapixels * 1e6;
        Some(wanted.min(MAX_PIXELS / count as f64).round() as u32)
    }

    /// Key of the depth of all views.
    pub(super) fn key_of_views(&self) -> Option<Key> {
        let max_pixels = self.max_view_pixels()?;
        let reconstruction = ReconstructionOfAll.key(self)?.0;
        let component = self.view.component;
        Some(Key::of(&(
            "all views",
            reconstruction,
            component,
            max_pixels,
        )))
    }

    /// Whether the depth of all views is selected, but neither computed nor in a file.
    pub(super) fn awaits_views(&self) -> bool {
        let is_open = |key: Key| {
            self.cache.get::<DenseCloud>(key).is_none()
                && self.cache.failure(key).is_none()
                && !self.imported.contains_key(&key)
        };
        self.document.all_views && self.key_of_views().is_some_and(is_open)
    }
}
