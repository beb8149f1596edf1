//! Dependencies of results: the key of each, and the source of a focal length.

use super::Project;
use super::document::{Given, PhotoId, RefineFocal};
use super::keys::Key;
use crate::tasks::{
    Calibrated, Features, Match, Photograph, Reconstructed, SfmOptions, Source, TwoViews,
};
use std::rc::Rc;

/// Source of a focal length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FocalOrigin {
    /// The reader typed it.
    Typed,
    /// The calibrated camera has it.
    Calibration,
    /// EXIF data of the file.
    File,
    /// 1.2 times the longer side.
    Guessed,
}

impl Project {
    pub(super) fn max_pixels(&self) -> u32 {
        (self.document.settings.max_megapixels * 1e6).round() as u32
    }

    /// The name of a photograph's pixels.
    pub(super) fn photograph_key(&self, photo: &Given) -> Key {
        // Rendered photographs have no distortion to remove.
        let camera = match photo.source {
            Source::File(_) => self.document.camera.as_ref(),
            Source::Rendered(..) => None,
        };
        Key::of(&("photograph", photo.content.0, self.max_pixels(), camera))
    }

    pub(super) fn features_key(&self, photo: &Given) -> Key {
        let options = self.document.settings.features;
        Key::of(&("features", self.photograph_key(photo).0, options))
    }

    pub(super) fn matches_key(&self, first: &Given, second: &Given) -> Key {
        let keys = (self.features_key(first).0, self.features_key(second).0);
        Key::of(&("matches", keys, self.document.settings.matching))
    }

    pub(super) fn two_views_key(&self, first: &Given, second: &Given) -> Option<Key> {
        let cameras = (self.camera(first)?.k, self.camera(second)?.k);
        let matches = self.matches_key(first, second).0;
        Some(Key::of(&(
            "two views",
            matches,
            cameras,
            self.document.settings.pairs,
        )))
    }

    /// The name of the reconstruction, once all photographs are there.
    pub(super) fn reconstruction_key(&self) -> Option<Key> {
        let photos = self.taking_part();
        if photos.len() < 2 {
            return None;
        }
        let mut inputs = Vec::new();
        for photo in &photos {
            inputs.push((self.features_key(photo).0, self.camera(photo)?.k));
        }
        let matching = self.document.settings.matching;
        Some(Key::of(&(
            "reconstruction",
            inputs,
            matching,
            self.sfm_options(),
        )))
    }

    /// Key of a photograph's pixels, for caches.
    pub fn key_of_photograph(&self, photo: &Given) -> Key {
        self.photograph_key(photo)
    }

    /// The name of the reconstruction, likewise, once all photographs are there.
    pub fn key_of_reconstruction(&self) -> Option<Key> {
        self.reconstruction_key()
    }

    /// The pixels of a photograph, if they are there.
    pub fn photograph(&self, photo: &Given) -> Option<&Rc<Photograph>> {
        self.results.photograph(self.photograph_key(photo))
    }

    /// A photograph that can be shown, at least as a thumbnail: its pixels may have to be read
    /// again.
    pub fn shown(&self, photo: &Given) -> Option<&Rc<Photograph>> {
        self.frame(photo).filter(|found| found.was_read())
    }

    /// Its size and its lens, if they are known: its pixels may be to come.
    pub(super) fn frame(&self, photo: &Given) -> Option<&Rc<Photograph>> {
        self.results.frame(self.photograph_key(photo))
    }

    /// Its features, if they are there.
    pub fn features(&self, photo: &Given) -> Option<&Rc<Features>> {
        self.results.features(self.features_key(photo))
    }

    /// The matches of a pair, if available; `first` precedes `second` in the list.
    pub fn matches(&self, first: &Given, second: &Given) -> Option<&Rc<Vec<Match>>> {
        self.results.matches(self.matches_key(first, second))
    }

    /// Two-view geometry of a pair, if available.
    pub fn two_views(&self, first: &Given, second: &Given) -> Option<&Rc<TwoViews>> {
        self.results.two_views(self.two_views_key(first, second)?)
    }

    /// Cameras and points, if they are there.
    pub fn reconstruction(&self) -> Option<&Rc<Reconstructed>> {
        self.results.reconstruction(self.reconstruction_key()?)
    }

    /// Size and intrinsics of a photograph, once they are known.
    pub fn camera(&self, photo: &Given) -> Option<Calibrated> {
        Some(camera(photo, self.frame(photo)?).0)
    }

    /// Its focal length times a factor, in pixels of its file, as a reader would type it. 0 until
    /// it is known.
    pub(super) fn focal_px(&self, photo: &Given, factor: f64) -> f64 {
        let known = self.frame(photo).map(|pixels| {
            let reduced = f64::from(pixels.width) / f64::from(pixels.full_size.0.max(1));
            factor * camera(photo, pixels).0.k[0] / reduced
        });
        known.unwrap_or(0.0)
    }

    /// Source of its focal length.
    pub fn focal_origin(&self, photo: &Given) -> Option<FocalOrigin> {
        Some(camera(photo, self.frame(photo)?).1)
    }

    /// The photographs that are neither left out, nor twice in the list, nor unreadable.
    pub fn taking_part(&self) -> Vec<&Given> {
        let readable = |photo: &&Given| {
            let failed = |key| self.results.failure(key).is_some();
            !failed(self.photograph_key(photo)) && !failed(self.features_key(photo))
        };
        (self.document.photos.iter())
            .filter(|photo| !photo.excluded && self.document.twin(photo).is_none())
            .filter(readable)
            .collect()
    }

    /// The place of a photograph among those that take part.
    pub fn place(&self, id: PhotoId) -> Option<usize> {
        self.taking_part().iter().position(|photo| photo.id == id)
    }

    /// The options of the reconstruction, with "when guessed" resolved.
    pub fn sfm_options(&self) -> SfmOptions {
        let guessed = || {
            let mut photos = self.taking_part().into_iter();
            photos.any(|photo| self.focal_origin(photo) == Some(FocalOrigin::Guessed))
        };
        let refine_focal = match self.document.settings.refine_focal {
            RefineFocal::Always => true,
            RefineFocal::Never => false,
            RefineFocal::WhenGuessed => guessed(),
        };
        SfmOptions {
            refine_focal,
            ..self.document.settings.sfm
        }
    }
}

/// The intrinsics of a photograph in its own pixels, and where its focal length comes from.
fn camera(photo: &Given, pixels: &Photograph) -> (Calibrated, FocalOrigin) {
    let (width, height) = (pixels.width, pixels.height);
    let factor = f64::from(width) / f64::from(pixels.full_size.0.max(1));
    let centered = |focal_px| Calibrated::centered(width, height, focal_px);
    let typed_px = photo.focal_px.map(|focal_px| focal_px * factor);
    match (typed_px, pixels.k, pixels.focal_px) {
        (Some(focal_px), Some([_, _, cu, cv]), _) => {
            let k = [focal_px, focal_px, cu, cv];
            (Calibrated { width, height, k }, FocalOrigin::Typed)
        }
        (Some(focal_px), None, _) => (centered(focal_px), FocalOrigin::Typed),
        (None, Some(k), _) => (Calibrated { width, height, k }, FocalOrigin::Calibration),
        (None, None, Some(focal_px)) => (centered(focal_px), FocalOrigin::File),
        (None, None, None) => {
            let longer = f64::from(width.max(height));
            (centered(1.2 * longer), FocalOrigin::Guessed)
        }
    }
}
