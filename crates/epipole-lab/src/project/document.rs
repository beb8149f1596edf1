//! What a project is made of, and what undo brings back: photographs, knobs, measures.

use super::keys::Key;
use crate::tasks::{FeatureOptions, MatchOptions, PairOptions, Sample, SfmOptions, Source};
use serde::{Deserialize, Serialize};

/// A photograph's permanent number in its project.
pub type PhotoId = u32;

/// A photograph as it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// Its number.
    pub id: PhotoId,
    /// Its name, which no other one has.
    pub name: String,
    /// Where it comes from.
    pub source: Source,
    /// The name of its bytes: two files with the same are the same photograph.
    pub content: Key,
    /// Left out by the reader.
    pub excluded: bool,
    /// A focal length that the reader typed, pixels of the full photograph.
    pub focal_px: Option<f64>,
}

/// When focal lengths are refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum RefineFocal {
    /// If a photograph does not tell its own.
    WhenGuessed,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// All knobs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Photographs are reduced to so many megapixels.
    pub max_megapixels: f64,
    /// How features are found.
    pub features: FeatureOptions,
    /// How they are matched.
    pub matching: MatchOptions,
    /// How pairs are judged.
    pub pairs: PairOptions,
    /// How everything is reconstructed; `refine_focal` in it follows the field below.
    pub sfm: SfmOptions,
    /// When focal lengths are refined.
    pub refine_focal: RefineFocal,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            max_megapixels: 3.0,
            features: FeatureOptions::default(),
            matching: MatchOptions::default(),
            pairs: PairOptions::default(),
            sfm: SfmOptions::default(),
            refine_focal: RefineFocal::WhenGuessed,
        }
    }
}

/// The value within the range, and the lowest for one that is not a number.
fn within(value: f64, low: f64, high: f64) -> f64 {
    // The other way round, NaN would pass.
    if value >= low { value.min(high) } else { low }
}

impl Settings {
    /// The same with every number in its range.
    pub fn checked(mut self) -> Self {
        self.max_megapixels = within(self.max_megapixels, 0.1, 12.0);
        self.features.max_features = self.features.max_features.clamp(100, 20_000);
        self.features.contrast = within(f64::from(self.features.contrast), 0.001, 0.2) as f32;
        self.matching.ratio = within(f64::from(self.matching.ratio), 0.3, 1.0) as f32;
        self.pairs.max_error_px = within(self.pairs.max_error_px, 0.1, 10.0);
        self.sfm.min_num_inliers = self.sfm.min_num_inliers.clamp(6, 200);
        self
    }
}

/// Which place of a photograph a measure holds on to: a keypoint that is part of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Anchor {
    /// The photograph.
    pub photo: PhotoId,
    /// Its keypoint.
    pub keypoint: u32,
}

/// Two points, and the length between them if the reader knows it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// The points.
    pub ends: [Anchor; 2],
    /// The length that sets the scale, meters.
    pub length_m: Option<f64>,
}

/// Everything that undo brings back.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// The photographs, in order.
    pub photos: Vec<Given>,
    /// All knobs.
    pub settings: Settings,
    /// What was measured.
    pub measures: Vec<Measure>,
}

impl Document {
    /// The photograph of this number.
    pub fn photo(&self, id: PhotoId) -> Option<&Given> {
        self.photos.iter().find(|photo| photo.id == id)
    }

    /// The same photograph earlier in the list, if there is one.
    pub fn twin(&self, photo: &Given) -> Option<&Given> {
        let before = self.photos.iter().take_while(|other| other.id != photo.id);
        let mut before = before.filter(|other| !other.excluded);
        before.find(|other| other.content == photo.content)
    }
}

/// A source's name.
pub(super) fn content_of(source: &Source) -> Key {
    match source {
        Source::File(bytes) => Key::of_bytes(bytes),
        // One photograph twice is what this sample is for.
        Source::Rendered(sample @ Sample::Twice, _) => Key::of(&(sample, 0_u8)),
        Source::Rendered(sample, index) => Key::of(&(sample, index)),
    }
}
