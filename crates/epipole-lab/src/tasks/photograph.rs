//! Photographs: decoded or rendered, turned upright, undistorted, downscaled.

use super::are_finite;
use super::task::{Destination, Query, Task};
#[cfg(feature = "files")]
use super::task::{Monitor, Run, report};
use super::thumbnail::Thumbnail;
use crate::project::{Blob, InputPhoto, Key, LensCamera, PhotoId, Project, Source, Step};
use serde::{Deserialize, Serialize};

/// Photograph, upright and at working size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Photograph {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Red, green, blue, row by row. Empty if only size and lens are known so far, or if the pixels
    /// were dropped and can be read again.
    pub rgb: Blob,
    /// Thumbnail; empty until pixels arrive, and for boards, which are in no list.
    pub small: Thumbnail,
    /// Focal length from the file, pixels of this size.
    pub focal_px: Option<f64>,
    /// Focal lengths and principal point, pixels of this size, if the photograph was undistorted
    /// with the calibrated camera.
    pub k: Option<[f64; 4]>,
    /// Upright width and height before downscaling.
    pub full_size: (u32, u32),
    /// Width and height in the sensor's orientation.
    pub sensor_size: (u32, u32),
    /// Number of clockwise quarter turns that made it upright; `None` if it was mirrored.
    pub quarters: Option<u8>,
    /// Whether the pixels are those of the file: not downscaled, rotated or undistorted.
    pub as_given: bool,
}

impl Photograph {
    /// Whether its pixels are in memory.
    pub fn has_pixels(&self) -> bool {
        !self.rgb.is_empty()
    }

    /// Whether its pixels are or were in memory, so that at least a thumbnail can be shown.
    pub fn was_read(&self) -> bool {
        self.has_pixels() || !self.small.rgb.is_empty()
    }

    /// Whether sizes and counts agree, with or without pixels.
    fn is_valid(&self) -> bool {
        let num_bytes = u64::from(self.width) * u64::from(self.height) * 3;
        let sizes = [self.full_size, self.sensor_size];
        let small = &self.small;
        let num_small = u64::from(small.width) * u64::from(small.height) * 3;
        num_bytes > 0
            && (num_bytes == self.rgb.len() as u64 || !self.has_pixels())
            && num_small == small.rgb.len() as u64
            && (num_small > 0) == self.has_pixels()
            && sizes
                .iter()
                .all(|(width, height)| *width > 0 && *height > 0)
            && self.focal_px.is_none_or(|f| f.is_finite() && f > 0.0)
            && self
                .k
                .is_none_or(|k| are_finite(&k) && k[0] > 0.0 && k[1] > 0.0)
    }

    /// Returns its pixels as an image.
    ///
    /// # Errors
    /// A message, if their number does not fit its size.
    #[cfg(any(feature = "vision", feature = "files"))]
    pub(super) fn to_image(&self) -> Result<image::RgbImage, String> {
        image::RgbImage::from_raw(self.width, self.height, self.rgb.0.to_vec())
            .ok_or_else(|| "the photograph did not arrive whole".to_owned())
    }

    /// Returns the size of its pixels in bytes, whether in memory or not.
    pub fn num_bytes(&self) -> usize {
        3 * self.width as usize * self.height as usize
    }
}

/// Size and intrinsics of a photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Calibrated {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Focal lengths and principal point, pixels.
    pub k: [f64; 4],
}

impl Calibrated {
    /// Creates intrinsics with square pixels and the principal point in the middle.
    pub fn centered(width: u32, height: u32, focal_px: f64) -> Self {
        let middle = |side: u32| (f64::from(side) - 1.0) / 2.0;
        Self {
            width,
            height,
            k: [focal_px, focal_px, middle(width), middle(height)],
        }
    }

    /// Converts the intrinsics.
    ///
    /// # Errors
    /// A message for invalid numbers.
    #[cfg(feature = "vision")]
    pub(super) fn intrinsics(&self) -> Result<epipole::camera::Intrinsics, String> {
        let [fu, fv, cu, cv] = self.k;
        epipole::camera::Intrinsics::new(fu, fv, cu, cv).map_err(|error| error.to_string())
    }

    /// Returns the focal length if it is [centered](Self::centered).
    pub fn centered_focal_px(&self) -> Option<f64> {
        let centered = Self::centered(self.width, self.height, self.k[0]);
        (*self == centered).then_some(self.k[0])
    }
}

/// Decodes or renders a photograph, turns it upright, and downscales it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReadPhotograph {
    /// File or sample.
    pub source: Source,
    /// Maximum number of pixels.
    pub max_pixels: u32,
    /// Camera whose distortion is removed if it has the photograph's size.
    pub camera: Option<LensCamera>,
}

impl Task for ReadPhotograph {
    type Output = Photograph;
}

/// Query for the photograph with this number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PhotographOf(pub PhotoId);

impl Query for PhotographOf {
    type Task = ReadPhotograph;
    const STEP: Step = Step::Photographs;

    fn all(project: &Project) -> Vec<Self> {
        let photos = project.document.photos.iter();
        photos.map(|photo| Self(photo.id)).collect()
    }

    fn key(self, project: &Project) -> Option<Key> {
        Some(project.key_of_photograph(project.document.photo(self.0)?))
    }

    fn is_ready(self, _project: &Project, _is_imported: bool) -> bool {
        true
    }

    fn priority(self, project: &Project) -> u8 {
        match project.shows_pixels(self.0) {
            true => 10,
            false => 20,
        }
    }

    fn task(self, project: &Project) -> Option<ReadPhotograph> {
        let photo = project.document.photo(self.0)?;
        Some(ReadPhotograph {
            source: photo.source.clone(),
            max_pixels: project.max_pixels(),
            camera: project.lens_camera(photo).cloned(),
        })
    }

    fn label(self, project: &Project) -> String {
        format!("Reading {}", project.document.name_of(self.0))
    }

    /// A photograph whose pixels were never loaded does not count.
    fn is_settled(self, project: &Project) -> bool {
        project.get(self).is_some_and(Photograph::was_read) || project.failure(self).is_some()
    }

    /// The sample is stored without pixels, which are quickly rendered.
    fn stored(output: &Photograph, destination: Destination) -> Option<Photograph> {
        (destination == Destination::Sample).then(|| Photograph {
            rgb: Blob::default(),
            small: Thumbnail::default(),
            ..output.clone()
        })
    }

    fn fits(self, project: &Project, output: &Photograph) -> bool {
        let photo = project.document.photo(self.0);
        let is_rendered = photo.is_some_and(InputPhoto::is_rendered);
        output.is_valid() && (output.has_pixels() || is_rendered)
    }
}

/// Source of a focal length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FocalOrigin {
    /// Typed by the reader.
    Typed,
    /// The calibrated camera, or that of the opened model.
    Calibration,
    /// EXIF data of the file.
    File,
    /// A guess, 1.2 times the longer side.
    Guessed,
}

impl Project {
    /// Maximum number of pixels of a photograph.
    pub(crate) fn max_pixels(&self) -> u32 {
        (self.document.settings.max_megapixels * 1e6).round() as u32
    }

    /// Key of a photograph's pixels.
    pub fn key_of_photograph(&self, photo: &InputPhoto) -> Key {
        let camera = self.lens_camera(photo);
        Key::of(&("photograph", photo.content.0, self.max_pixels(), camera))
    }

    /// Returns a photograph with its pixels, if they are in memory.
    pub fn photograph(&self, photo: &InputPhoto) -> Option<&Photograph> {
        self.get(PhotographOf(photo.id))
            .filter(|found| found.has_pixels())
    }

    /// Returns a photograph that can be shown, at least as a thumbnail: its pixels may have to be
    /// read again.
    pub fn shown(&self, photo: &InputPhoto) -> Option<&Photograph> {
        self.get(PhotographOf(photo.id))
            .filter(|found| found.was_read())
    }

    /// Returns size and intrinsics of a photograph, once they are known.
    pub fn camera(&self, photo: &InputPhoto) -> Option<Calibrated> {
        Some(camera(photo, self.get(PhotographOf(photo.id))?).0)
    }

    /// Returns the photographs that may be by the same camera, including the given one: their
    /// sensors have the same size.
    pub fn alike(&self, photo: &InputPhoto) -> Vec<PhotoId> {
        let size = |photo: &InputPhoto| Some(self.get(PhotographOf(photo.id))?.sensor_size);
        let own = size(photo);
        let photos = self.document.photos.iter();
        photos
            .filter(|other| other.id == photo.id || (own.is_some() && size(other) == own))
            .map(|other| other.id)
            .collect()
    }

    /// Returns the source of its focal length.
    pub fn focal_origin(&self, photo: &InputPhoto) -> Option<FocalOrigin> {
        Some(camera(photo, self.get(PhotographOf(photo.id))?).1)
    }

    /// Returns the focal length of a photograph times a factor, in pixels of its file; 0 until it
    /// is known.
    pub(crate) fn focal_px(&self, photo: &InputPhoto, factor: f64) -> f64 {
        let known = self.get(PhotographOf(photo.id)).map(|pixels| {
            let reduced = f64::from(pixels.width) / f64::from(pixels.full_size.0.max(1));
            factor * camera(photo, pixels).0.k[0] / reduced
        });
        known.unwrap_or(0.0)
    }

    /// Whether the current step shows a photograph in full.
    pub(crate) fn shows_pixels(&self, id: PhotoId) -> bool {
        let (a, b) = self.view.pair;
        match self.view.step {
            Step::Features => id == self.view.photo,
            Step::TwoViews => id == a || id == b,
            _ => false,
        }
    }
}

/// Returns the intrinsics of a photograph in its own pixels, and the source of its focal length.
fn camera(photo: &InputPhoto, pixels: &Photograph) -> (Calibrated, FocalOrigin) {
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

#[cfg(feature = "files")]
impl Run for ReadPhotograph {
    fn run(self, monitor: Monitor<'_>) -> Result<Photograph, String> {
        report(monitor, 0.0, "")?;
        match &self.source {
            Source::File(bytes) => file(bytes, self.max_pixels, self.camera.as_ref(), monitor),
            Source::Rendered(sample, index) => {
                let (image, focal_px) = super::rendered::render(*sample, *index)?;
                Ok(rendered(image, focal_px))
            }
        }
    }
}

#[cfg(feature = "files")]
fn rendered(image: image::RgbImage, focal_px: Option<f64>) -> Photograph {
    let (width, height) = image.dimensions();
    Photograph {
        width,
        height,
        small: Thumbnail::new((width, height), &image),
        rgb: image.into_raw().into(),
        focal_px,
        k: None,
        full_size: (width, height),
        sensor_size: (width, height),
        quarters: Some(0),
        as_given: true,
    }
}

/// Decodes a file just as `epipole sfm` does, with `--max-megapixels` and `--camera`.
///
/// # Errors
/// A message for an unreadable file, a field of view too wide for a flat image, or
/// cancellation.
#[cfg(feature = "files")]
fn file(
    bytes: &[u8],
    max_pixels: u32,
    camera: Option<&LensCamera>,
    monitor: Monitor<'_>,
) -> Result<Photograph, String> {
    use super::convert::{core_lens_camera, unreadable};
    use super::task::Progress;
    use epipole::calibration::{Keep, Undistortion};
    use epipole::camera::Intrinsics;
    use epipole::progress::Status;
    use epipole_io::photo::{PrepareOptions, prepare_photo};
    let mut watch = |status: Status| monitor(Progress::Share(0.1 * status.fraction, ""));
    let mut flat = |camera: &LensCamera| {
        Undistortion::new(&core_lens_camera(camera)?, Keep::Valid, &mut watch)
            .map_err(|error| format!("its lens cannot be undone: {error}"))
    };
    let undistortion = camera.map(&mut flat).transpose()?;
    report(monitor, 0.1, "")?;
    let options = PrepareOptions::default()
        .with_max_pixels(max_pixels.into())
        .with_undistortion(undistortion.as_ref());
    let photo = prepare_photo(bytes, &options).map_err(unreadable)?;
    report(monitor, 0.9, "")?;
    let (width, height) = photo.image.dimensions();
    let plain = |k: Intrinsics| {
        let center = k.principal_point();
        [k.fu_px(), k.fv_px(), center.x, center.y]
    };
    Ok(Photograph {
        width,
        height,
        small: Thumbnail::new((width, height), &photo.image),
        rgb: photo.image.into_raw().into(),
        focal_px: photo.focal_px,
        k: photo.intrinsics.map(plain),
        full_size: photo.full_size,
        sensor_size: photo.sensor_size,
        quarters: photo.quarters,
        as_given: photo.is_as_stored,
    })
}

#[cfg(all(test, feature = "files"))]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    #[test]
    fn files_that_are_none_are_refused_in_words() {
        let go_on = &mut |_: super::super::Progress<'_>| ControlFlow::Continue(());
        let refused = file(b"no picture", 1000, None, go_on).expect_err("that is no picture");
        assert_eq!(refused, "it is no PNG, JPEG, WebP, TIFF, BMP or PNM file");
    }
}
