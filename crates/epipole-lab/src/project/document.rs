//! Contents of a project, subject to undo: photographs, settings, measurements.

use super::anchor::{Anchor, PhotoId};
use super::board_options::LensCamera;
use super::bytes::Blob;
use super::crop::CropBox;
use super::key::Key;
use super::known_poses::KnownPoses;
use super::point_set::PointSet;
use super::sample::Sample;
use super::settings::Settings;
use super::shape::{ControlPoint, Shape};
use serde::{Deserialize, Serialize};

/// Source of a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Source {
    /// The bytes of an image file.
    File(Blob),
    /// A rendered photograph of a sample.
    Rendered(Sample, u8),
}

/// A photograph as given by the reader.
#[derive(Debug, Clone, PartialEq)]
pub struct InputPhoto {
    /// Its number.
    pub id: PhotoId,
    /// Its unique name.
    pub name: String,
    /// File or sample.
    pub source: Source,
    /// Hash of its bytes: files with equal hashes are the same photograph.
    pub content: Key,
    /// Whether the reader left it out.
    pub excluded: bool,
    /// Focal length typed by the reader, pixels of the full photograph.
    pub focal_px: Option<f64>,
}

impl InputPhoto {
    /// Whether it belongs to a sample.
    pub fn is_rendered(&self) -> bool {
        matches!(self.source, Source::Rendered(..))
    }
}

/// Two points, and their distance if known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// The points.
    pub ends: [Anchor; 2],
    /// Known length that sets the scale, meters.
    pub length_m: Option<f64>,
}

/// State that undo restores.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// The photographs, in order.
    pub photos: Vec<InputPhoto>,
    /// Settings of all steps.
    pub settings: Settings,
    /// Measurements.
    pub measures: Vec<Measure>,
    /// Measured angles, areas and volumes.
    pub shapes: Vec<Shape>,
    /// Points with known coordinates.
    pub control_points: Vec<ControlPoint>,
    /// Three points of the floor.
    pub floor: Option<[Anchor; 3]>,
    /// Pairs whose depth is part of the cloud.
    pub dense: Vec<(PhotoId, PhotoId)>,
    /// Whether the depth of all views is part of the cloud.
    pub all_views: bool,
    /// Photographs of a board, in order.
    pub boards: Vec<InputPhoto>,
    /// Calibrated camera, used for photographs of its size.
    pub camera: Option<LensCamera>,
    /// Cameras and poses of a model of another program.
    pub poses: Option<KnownPoses>,
    /// Box that limits the model.
    pub crop: Option<CropBox>,
    /// Deleted points.
    pub deleted: PointSet,
}

impl Document {
    /// Returns the photograph with this number.
    pub fn photo(&self, id: PhotoId) -> Option<&InputPhoto> {
        self.photos.iter().find(|photo| photo.id == id)
    }

    /// Whether all photographs that an anchor depends on exist.
    pub fn has_all_of(&self, anchor: &Anchor) -> bool {
        anchor.photos().all(|id| self.photo(id).is_some())
    }

    /// Whether there is a length, an angle, an area, a volume or a control point.
    pub fn has_measures(&self) -> bool {
        !(self.measures.is_empty() && self.shapes.is_empty() && self.control_points.is_empty())
    }

    /// Returns the photograph of a board with this number.
    pub fn board(&self, id: PhotoId) -> Option<&InputPhoto> {
        self.boards.iter().find(|photo| photo.id == id)
    }

    /// Returns the name of a photograph, also of a board; empty if there is none.
    pub fn name_of(&self, id: PhotoId) -> &str {
        let photo = self.photo(id).or(self.board(id));
        photo.map_or("", |photo| &photo.name)
    }

    /// Whether all photographs belong to a sample.
    pub fn is_sample(&self) -> bool {
        self.photos.iter().all(InputPhoto::is_rendered)
    }

    /// Whether all photographs of boards belong to a sample.
    pub fn has_sample_boards(&self) -> bool {
        self.boards.iter().all(InputPhoto::is_rendered)
    }

    /// Returns both photographs of a pair.
    pub fn pair(&self, (a, b): (PhotoId, PhotoId)) -> Option<(&InputPhoto, &InputPhoto)> {
        let place = |id| self.photos.iter().position(|photo| photo.id == id);
        let (one, two) = (place(a)?, place(b)?);
        (one != two).then(|| (&self.photos[one.min(two)], &self.photos[one.max(two)]))
    }

    /// Whether the depth of a pair is part of the cloud.
    pub fn is_dense(&self, (a, b): (PhotoId, PhotoId)) -> bool {
        self.dense.contains(&(a, b)) || self.dense.contains(&(b, a))
    }

    /// Returns an earlier copy of a photograph in the list, if any.
    pub fn twin(&self, photo: &InputPhoto) -> Option<&InputPhoto> {
        let before = self.photos.iter().take_while(|other| other.id != photo.id);
        let mut before = before.filter(|other| !other.excluded);
        before.find(|other| other.content == photo.content)
    }
}

/// Returns all pairs of photographs, in the order of the list.
pub fn pairs<'a>(
    photos: &'a [&'a InputPhoto],
) -> impl Iterator<Item = (&'a InputPhoto, &'a InputPhoto)> {
    let after = |(i, first): (usize, &'a &'a InputPhoto)| {
        photos[i + 1..].iter().map(move |second| (*first, *second))
    };
    photos.iter().enumerate().flat_map(after)
}

/// Hash of a source's content.
pub(crate) fn content_of(source: &Source) -> Key {
    match source {
        Source::File(bytes) => Key::of_bytes(bytes),
        // The duplicate photograph is the purpose of this sample.
        Source::Rendered(sample @ Sample::Twice, _) => Key::of(&(sample, 0_u8)),
        Source::Rendered(sample, index) => Key::of(&(sample, index)),
    }
}
