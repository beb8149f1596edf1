//! Settings of all steps.

use super::board_options::{BoardPattern, CalibrationOptions};
use super::options::{
    AllViewsOptions, DepthOptions, FeatureOptions, MatchOptions, PairOptions, SfmOptions,
};
use serde::{Deserialize, Serialize};

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

/// All settings.
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
    /// Reconstruction; its `refine_focal` and `correct_lens` follow the field below.
    pub sfm: SfmOptions,
    /// When focal lengths are refined.
    pub refine_focal: RefineFocal,
    /// Dense depth of pairs.
    #[serde(default)]
    pub depth: DepthOptions,
    /// Depth of all views.
    #[serde(default)]
    pub all_views: AllViewsOptions,
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
            all_views: AllViewsOptions::default(),
            calibration: CalibrationOptions::default(),
            num_frames: usual_num_frames(),
        }
    }
}

/// Maximum disparity, pixels.
pub const MAX_DISPARITY_PX: i32 = 8192;
/// Minimum and maximum size of photographs for the depth of all views, megapixels.
pub const ALL_VIEWS_MEGAPIXELS: [f64; 2] = [0.05, 3.0];
/// Maximum number of frames from a video.
pub const MAX_FRAMES: u32 = 60;
/// Maximum number of columns and rows of a board.
pub const MAX_MARKS: u32 = 100;
/// Minimum and maximum side of a square, meters.
pub const SQUARES_M: [f64; 2] = [1e-4, 100.0];

/// Clamps a value to a range; NaN becomes its lower end.
fn within(value: f64, low: f64, high: f64) -> f64 {
    // With the comparison reversed, NaN would pass.
    if value >= low { value.min(high) } else { low }
}

impl Settings {
    /// Returns the settings with every number clamped to its range.
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
        let [least, most] = ALL_VIEWS_MEGAPIXELS;
        self.all_views.max_megapixels = within(self.all_views.max_megapixels, least, most);
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
