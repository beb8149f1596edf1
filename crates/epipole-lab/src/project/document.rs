//! Contents of a project, restored by undo: photographs, settings, measurements.

use super::keys::Key;
use crate::tasks::{
    BoardPattern, CalibrationOptions, DepthOptions, FeatureOptions, LensCamera, MatchOptions,
    PairOptions, Sample, SfmOptions, Source,
};
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
    /// File or sample.
    pub source: Source,
    /// Hash of its bytes: files with equal hashes are the same photograph.
    pub content: Key,
    /// Left out by the reader.
    pub excluded: bool,
    /// A focal length that the reader typed, pixels of the full photograph.
    pub focal_px: Option<f64>,
}

impl Given {
    /// Whether it is of a sample.
    pub fn is_rendered(&self) -> bool {
        matches!(self.source, Source::Rendered(..))
    }
}

/// When focal lengths are refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum RefineFocal {
    /// If a photograph has no focal length of its own.
    WhenGuessed,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// All knobs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Maximum size of downscaled photographs, megapixels.
    pub max_megapixels: f64,
    /// Feature detection.
    pub features: FeatureOptions,
    /// Matching.
    pub matching: MatchOptions,
    /// Two-view verification.
    pub pairs: PairOptions,
    /// Reconstruction; its `refine_focal` follows the field below.
    pub sfm: SfmOptions,
    /// When focal lengths are refined.
    pub refine_focal: RefineFocal,
    /// Dense depth of pairs.
    #[serde(default)]
    pub depth: DepthOptions,
    /// Calibration.
    #[serde(default)]
    pub calibration: CalibrationOptions,
    /// Number of frames to extract from a video.
    #[serde(default = "usual_num_frames")]
    pub num_frames: u32,
}

fn usual_num_frames() -> u32 {
    20
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
            depth: DepthOptions::default(),
            calibration: CalibrationOptions::default(),
            num_frames: usual_num_frames(),
        }
    }
}

/// Maximum disparity, pixels.
pub const MAX_DISPARITY_PX: i32 = 8192;
/// Maximum number of frames from a video.
pub const MAX_FRAMES: u32 = 60;
/// Maximum number of columns and rows of a board.
pub const MAX_MARKS: u32 = 100;
/// The least and the greatest side of a square, meters.
pub const SQUARES_M: [f64; 2] = [1e-4, 100.0];

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
        if let Some([low, high]) = &mut self.depth.range_px {
            *low = (*low).clamp(0, MAX_DISPARITY_PX - 1);
            *high = (*high).clamp(*low + 1, MAX_DISPARITY_PX.min(*low + 4095));
        }
        self.num_frames = self.num_frames.clamp(2, MAX_FRAMES);
        let board = &mut self.calibration.board;
        let fewest = match board.pattern {
            BoardPattern::Chessboard => 3,
            BoardPattern::Circles => 2,
        };
        board.columns = board.columns.clamp(fewest, MAX_MARKS);
        board.rows = board.rows.clamp(3, MAX_MARKS);
        let [least, most] = SQUARES_M;
        self.calibration.square_m = within(self.calibration.square_m, least, most);
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

/// Two points, and their distance if known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// The points.
    pub ends: [Anchor; 2],
    /// The length that sets the scale, meters.
    pub length_m: Option<f64>,
}

/// The state that undo restores.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// The photographs, in order.
    pub photos: Vec<Given>,
    /// All knobs.
    pub settings: Settings,
    /// Measurements.
    pub measures: Vec<Measure>,
    /// Three points of the floor.
    pub floor: Option<[Anchor; 3]>,
    /// Pairs whose depth is part of the cloud.
    pub dense: Vec<(PhotoId, PhotoId)>,
    /// Photographs of a board, in order.
    pub boards: Vec<Given>,
    /// The calibrated camera of those photographs that have its size.
    pub camera: Option<LensCamera>,
}

impl Document {
    /// The photograph of this number.
    pub fn photo(&self, id: PhotoId) -> Option<&Given> {
        self.photos.iter().find(|photo| photo.id == id)
    }

    /// The photograph of a board of this number.
    pub fn board(&self, id: PhotoId) -> Option<&Given> {
        self.boards.iter().find(|photo| photo.id == id)
    }

    /// Whether all photographs are of a sample.
    pub fn is_sample(&self) -> bool {
        self.photos.iter().all(Given::is_rendered)
    }

    /// Whether all photographs of boards are of a sample.
    pub fn has_sample_boards(&self) -> bool {
        self.boards.iter().all(Given::is_rendered)
    }

    /// Both photographs of a pair.
    pub fn pair(&self, (a, b): (PhotoId, PhotoId)) -> Option<(&Given, &Given)> {
        let place = |id| self.photos.iter().position(|photo| photo.id == id);
        let (one, two) = (place(a)?, place(b)?);
        (one != two).then(|| (&self.photos[one.min(two)], &self.photos[one.max(two)]))
    }

    /// Whether the depth of a pair is part of the cloud.
    pub fn is_dense(&self, (a, b): (PhotoId, PhotoId)) -> bool {
        self.dense.contains(&(a, b)) || self.dense.contains(&(b, a))
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
        // A duplicate photograph is the purpose of this sample.
        Source::Rendered(sample @ Sample::Twice, _) => Key::of(&(sample, 0_u8)),
        Source::Rendered(sample, index) => Key::of(&(sample, index)),
    }
}
