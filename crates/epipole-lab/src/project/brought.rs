//! Precomputed results from a project file or the sample. Each is taken when it is needed, and only
//! if it is valid, as files are untrusted.

use super::document::PhotoId;
use super::keys::Key;
use super::wanted::About;
use super::{Kept, Project};
use crate::tasks::{
    Answer, Blob, CameraFound, Component, Described, Features, Match, Photograph, Reconstructed,
    Source, Thumbnail, TwoViews, ViewModel,
};
use serde::{Deserialize, Serialize};

/// Hash of the code that computes results; results of other code are rejected.
pub const COMPUTED_BY: &str = env!("EPIPOLE_LAB_COMPUTED_BY");

/// Results by key, and the code that computed them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Computed {
    /// [`COMPUTED_BY`] of the build that computed them.
    pub by: String,
    /// Keys, and bytes of answers.
    pub results: Vec<(u64, Blob)>,
}

impl Computed {
    /// The same as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        crate::tasks::to_bytes(self)
    }

    /// Parses the bytes; empty if they are invalid.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        postcard::from_bytes(bytes).unwrap_or_default()
    }
}

impl Project {
    /// Takes precomputed results, replacing unused ones of an earlier call. Invalid results, and
    /// those of another build, are ignored and computed again.
    pub fn bring(&mut self, computed: Computed) {
        self.brought.clear();
        if computed.by == COMPUTED_BY {
            let results = computed.results.into_iter();
            self.brought = results.map(|(key, bytes)| (Key(key), bytes)).collect();
        }
        self.revision += 1;
        self.take_brought();
    }

    /// Takes the results that are needed now, repeatedly, as they enable further ones.
    pub(super) fn take_brought(&mut self) {
        let mut is_new = true;
        while is_new && !self.brought.is_empty() {
            is_new = false;
            for task in self.wanted() {
                let Some(bytes) = self.brought.remove(&task.key) else {
                    continue;
                };
                if let Ok(answer) = Answer::from_bytes(&bytes)
                    && self.fits(task.about, &answer)
                {
                    is_new |= self.results.keep(task.key, answer, bytes.len());
                }
            }
        }
    }

    /// Results worth saving: features, matches, pairs and the reconstruction, but not pixels, which
    /// come from the files.
    pub(super) fn computed(&self) -> Computed {
        self.computed_of(|kept| match kept {
            Kept::Features(found) => Some(Answer::Features((**found).clone())),
            kept => follows(kept),
        })
    }

    /// The same for a sample, in a compact form: with sizes and lenses of its photographs, whose
    /// pixels are quickly rendered, and without descriptors, which only their display and new
    /// matching need. Those are nine bytes of ten.
    pub fn light_computed(&self) -> Computed {
        self.computed_of(|kept| match kept {
            Kept::Photograph(found) => Some(Answer::Photograph(Photograph {
                rgb: Blob::default(),
                small: Thumbnail::default(),
                ..(**found).clone()
            })),
            Kept::Features(found) => Some(Answer::Features(Features {
                list: found.list.clone(),
                described: Described {
                    dimension: 0,
                    values: Blob::default(),
                },
            })),
            kept => follows(kept),
        })
    }

    fn computed_of(&self, answer: impl Fn(&Kept) -> Option<Answer>) -> Computed {
        let needed = self.needed().into_iter();
        let bytes = |key: Key| {
            let answer = answer(self.results.get(key)?)?;
            Some((key.0, answer.to_bytes().into()))
        };
        Computed {
            by: COMPUTED_BY.to_owned(),
            results: needed.filter_map(bytes).collect(),
        }
    }

    /// Whether an answer has the form that a task needs.
    fn fits(&self, about: About, answer: &Answer) -> bool {
        let num_features = |id: PhotoId| {
            let photo = self.document.photo(id)?;
            Some(self.features(photo)?.list.len())
        };
        match (about, answer) {
            (About::Photograph(id), Answer::Photograph(found)) => {
                let source = self.document.photo(id).map(|photo| &photo.source);
                let is_rendered = matches!(source, Some(Source::Rendered(..)));
                is_photograph(found) && (found.has_pixels() || is_rendered)
            }
            (About::Features(_), Answer::Features(found)) => is_features(found),
            (About::Matches(first, second), Answer::Matches(found)) => {
                match (num_features(first), num_features(second)) {
                    (Some(first), Some(second)) => is_matches(found, first, second),
                    _ => false,
                }
            }
            (About::TwoViews(first, second), Answer::TwoViews(found)) => {
                let photos = (self.document.photo(first), self.document.photo(second));
                let (Some(first), Some(second)) = photos else {
                    return false;
                };
                let matches = self.matches(first, second);
                matches.is_some_and(|matches| is_pair(found, matches.len()))
            }
            (About::Reconstruction, Answer::Reconstruction(found)) => {
                let photos = self.taking_part().into_iter();
                let counts: Option<Vec<usize>> =
                    photos.map(|photo| num_features(photo.id)).collect();
                counts.is_some_and(|counts| is_reconstruction(found, &counts))
            }
            _ => false,
        }
    }
}

fn are_finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}

/// Expensive results that follow from features.
fn follows(kept: &Kept) -> Option<Answer> {
    match kept {
        Kept::Matches(found) => Some(Answer::Matches((**found).clone())),
        Kept::TwoViews(found) => Some(Answer::TwoViews((**found).clone())),
        Kept::Reconstruction(found) => Some(Answer::Reconstruction((**found).clone())),
        _ => None,
    }
}

/// With its pixels, or without.
fn is_photograph(found: &Photograph) -> bool {
    let num_bytes = u64::from(found.width) * u64::from(found.height) * 3;
    let sizes = [found.full_size, found.sensor_size];
    let small = &found.small;
    let num_small = u64::from(small.width) * u64::from(small.height) * 3;
    num_bytes > 0
        && (num_bytes == found.rgb.len() as u64 || !found.has_pixels())
        && num_small == small.rgb.len() as u64
        && (num_small > 0) == found.has_pixels()
        && sizes
            .iter()
            .all(|(width, height)| *width > 0 && *height > 0)
        && found.focal_px.is_none_or(|f| f.is_finite() && f > 0.0)
        && found
            .k
            .is_none_or(|k| are_finite(&k) && k[0] > 0.0 && k[1] > 0.0)
}

/// With their descriptors, or without.
fn is_features(found: &Features) -> bool {
    let dimension = found.described.dimension as usize;
    let fits = found.list.len().checked_mul(dimension) == Some(found.described.values.len());
    (!found.has_descriptors() || (dimension > 0 && fits))
        && (found.list.iter()).all(|feature| {
            are_finite(&[feature.u, feature.v])
                && feature.scale_px.is_finite()
                && feature.angle_rad.is_finite()
        })
}

fn is_matches(found: &[Match], first: usize, second: usize) -> bool {
    found
        .iter()
        .all(|m| (m.first as usize) < first && (m.second as usize) < second && m.ratio.is_finite())
}

fn is_pair(found: &TwoViews, num_matches: usize) -> bool {
    let (ViewModel::Essential(m) | ViewModel::Fundamental(m) | ViewModel::Homography(m)) =
        &found.model;
    let others = [found.turn_deg, found.focal_factor, found.angle_deg];
    found.inliers.len() == num_matches
        && found.inliers.iter().filter(|fits| **fits).count() == found.num_inliers as usize
        && are_finite(m)
        && found.fundamental.is_none_or(|f| are_finite(&f))
        && others.into_iter().flatten().all(f64::is_finite)
}

/// * `counts`: how many features each photograph has
fn is_reconstruction(found: &Reconstructed, counts: &[usize]) -> bool {
    let is_camera = |camera: &CameraFound| {
        are_finite(&camera.intrinsics)
            && are_finite(&camera.rotation)
            && camera.rotation.iter().any(|x| *x != 0.0)
            && are_finite(&camera.translation)
    };
    let is_seen = |component: &Component, (image, keypoint): (u32, u32)| {
        let image = image as usize;
        let has_camera = component.cameras.get(image).is_some_and(Option::is_some);
        has_camera && counts.get(image).is_some_and(|n| (keypoint as usize) < *n)
    };
    let is_component = |component: &Component| {
        component.cameras.len() == counts.len()
            && component.cameras.iter().flatten().all(is_camera)
            && are_finite(&component.lens.coefficients())
            && (component.points.iter()).all(|point| {
                are_finite(&point.position)
                    && point.error_px.is_finite()
                    && point.track.iter().all(|place| is_seen(component, *place))
            })
    };
    found.components.iter().all(is_component)
        && found.mean_error_px.len() == found.components.len()
        && are_finite(&found.mean_error_px)
        && are_finite(&found.costs)
}
