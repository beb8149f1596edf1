//! Features of a photograph.

use super::are_finite;
use super::photograph::{Photograph, PhotographOf};
use super::task::{Destination, Query, Task};
#[cfg(feature = "vision")]
use super::task::{Monitor, Progress, Run};
use crate::project::{Blob, FeatureOptions, InputPhoto, Key, PhotoId, Project, Step};
use serde::{Deserialize, Serialize};

/// A feature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Feature {
    /// Column, pixels.
    pub u: f64,
    /// Row, pixels.
    pub v: f64,
    /// Its scale, pixels.
    pub scale_px: f32,
    /// Its direction, clockwise from the right, as v points down.
    pub angle_rad: f32,
    /// Color at its position.
    pub color: [u8; 3],
}

/// The features of a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Features {
    /// Keypoints, strongest first.
    pub list: Vec<Feature>,
    /// Descriptors, in the same order; empty if they are to be computed on demand.
    pub described: Described,
}

impl Features {
    /// Whether sizes and counts agree, with or without descriptors.
    fn is_valid(&self) -> bool {
        let dimension = self.described.dimension as usize;
        let fits = self.list.len().checked_mul(dimension) == Some(self.described.values.len());
        (!self.has_descriptors() || (dimension > 0 && fits))
            && (self.list.iter()).all(|feature| {
                are_finite(&[feature.u, feature.v])
                    && feature.scale_px.is_finite()
                    && feature.angle_rad.is_finite()
            })
    }

    /// Whether the descriptors are available.
    pub fn has_descriptors(&self) -> bool {
        self.list.is_empty() || !self.described.values.is_empty()
    }
}

/// Descriptors, one after the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Described {
    /// Number of elements of a descriptor.
    pub dimension: u32,
    /// Elements of all descriptors.
    pub values: Blob,
}

/// Finds features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FindFeatures {
    /// Photograph to search.
    pub photograph: Photograph,
    /// Feature settings.
    pub options: FeatureOptions,
}

impl Task for FindFeatures {
    type Output = Features;
}

/// Query for the features of the photograph with this number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeaturesOf(pub PhotoId);

impl Query for FeaturesOf {
    type Task = FindFeatures;
    const STEP: Step = Step::Features;

    fn all(project: &Project) -> Vec<Self> {
        let photos = project.document.photos.iter();
        photos.map(|photo| Self(photo.id)).collect()
    }

    fn key(self, project: &Project) -> Option<Key> {
        let photograph = PhotographOf(self.0).key(project)?;
        let options = project.document.settings.features;
        Some(Key::of(&("features", photograph.0, options)))
    }

    fn is_ready(self, project: &Project, is_imported: bool) -> bool {
        let photo = project.document.photo(self.0);
        photo.is_some_and(|photo| {
            project.takes_part(photo) && (is_imported || project.photograph(photo).is_some())
        })
    }

    fn priority(self, _project: &Project) -> u8 {
        30
    }

    fn task(self, project: &Project) -> Option<FindFeatures> {
        let photo = project.document.photo(self.0)?;
        Some(FindFeatures {
            photograph: project.photograph(photo)?.clone(),
            options: project.document.settings.features,
        })
    }

    fn label(self, project: &Project) -> String {
        format!("Finding features in {}", project.document.name_of(self.0))
    }

    fn stored(output: &Features, destination: Destination) -> Option<Features> {
        let described = match destination {
            Destination::Project => output.described.clone(),
            Destination::Sample => Described {
                dimension: 0,
                values: Blob::default(),
            },
        };
        Some(Features {
            list: output.list.clone(),
            described,
        })
    }

    fn fits(self, _project: &Project, output: &Features) -> bool {
        output.is_valid()
    }
}

impl Project {
    /// Returns the number of features of a photograph, if known.
    pub(super) fn num_features(&self, id: PhotoId) -> Option<usize> {
        Some(self.get(FeaturesOf(id))?.list.len())
    }

    /// Whether a photograph is neither excluded, nor a duplicate, nor unreadable.
    pub fn takes_part(&self, photo: &InputPhoto) -> bool {
        !photo.excluded
            && self.document.twin(photo).is_none()
            && self.failure(PhotographOf(photo.id)).is_none()
            && self.failure(FeaturesOf(photo.id)).is_none()
    }

    /// Returns the photographs that take part, in order.
    pub fn taking_part(&self) -> Vec<&InputPhoto> {
        let photos = self.document.photos.iter();
        photos.filter(|photo| self.takes_part(photo)).collect()
    }

    /// Returns the index of a photograph among those that take part.
    pub fn place(&self, id: PhotoId) -> Option<usize> {
        self.taking_part().iter().position(|photo| photo.id == id)
    }
}

#[cfg(feature = "vision")]
impl Run for FindFeatures {
    /// Finds features just as `epipole sfm` does.
    fn run(self, monitor: Monitor<'_>) -> Result<Features, String> {
        use super::convert::sentence;
        use crate::project::FeatureKind;
        use epipole::feature;
        use epipole::sfm::{Photo, PhotoOptions, photo_features};
        let photo = Photo {
            image: self.photograph.to_image()?,
            ..Photo::default()
        };
        let mut how = PhotoOptions::default();
        how.features.max_features = self.options.max_features as usize;
        how.features.contrast_threshold = Some(self.options.contrast);
        how.features.kind = match self.options.kind {
            FeatureKind::RootSift => feature::FeatureKind::RootSift,
            FeatureKind::Sift => feature::FeatureKind::Sift,
        };
        let mut watch = |_| monitor(Progress::Share(0.0, ""));
        let found = photo_features(&photo, &how, &mut watch).map_err(sentence)?;
        let list = (found.keypoints.iter().zip(&found.image.colors))
            .map(|(keypoint, color)| Feature {
                u: keypoint.u,
                v: keypoint.v,
                scale_px: keypoint.scale_px,
                angle_rad: keypoint.angle_rad,
                color: *color,
            })
            .collect();
        let values = found.descriptors.as_bytes().map(<[u8]>::to_vec);
        Ok(Features {
            list,
            described: Described {
                dimension: found.descriptors.dimension() as u32,
                values: values.unwrap_or_default().into(),
            },
        })
    }
}
