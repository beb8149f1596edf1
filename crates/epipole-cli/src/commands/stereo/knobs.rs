//! Command-line options of the two stereo matchers.

use crate::failure::Failure;
use crate::matrices::not_negative;
use clap::{Args, ValueEnum};
use epipole::stereo::{
    DisparityFilter, StereoBm, StereoCost, StereoPaths, StereoPrefilter, StereoSgm,
};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Cost {
    /// Census transform over 5×5 pixels: immune to changes of brightness or contrast.
    Census,
    /// Differences of gray values, insensitive to sampling (Birchfield–Tomasi).
    BirchfieldTomasi,
    /// The sum of both.
    Both,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Prefilter {
    /// Horizontal Sobel derivative.
    XSobel,
    /// Difference from the mean of the surrounding 9×9 pixels.
    LocalMean,
}

/// Filter options of both matchers.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Filters")]
pub(super) struct KeepArguments {
    /// Minimum percentage by which other disparities must be worse, 0 to 99; 0: no test [default: 3
    /// for SGM, 10 for BM].
    #[arg(long, value_name = "PERCENT", value_parser = clap::value_parser!(u32).range(..100))]
    uniqueness_percent: Option<u32>,
    /// Maximum difference between the disparities of the left and the right image, pixels; "any":
    /// no test.
    #[arg(long, default_value = "1", value_name = "PX|any", value_parser = left_right)]
    left_right_max_px: LeftRight,
    /// Minimum size of a connected region, pixels; smaller ones are removed.
    #[arg(long, default_value_t = DisparityFilter::default().speckle_size, value_name = "N")]
    speckle_size: u32,
    /// Maximum difference of disparity between connected neighbors, pixels.
    #[arg(long, default_value_t = f64::from(DisparityFilter::default().speckle_range_px), value_name = "PX", value_parser = not_negative)]
    speckle_range_px: f64,
    /// Maximum length of a gap that is closed if the disparities at its ends would connect, pixels
    /// [default: 16 for SGM, 0 for BM].
    #[arg(long, value_name = "PX")]
    max_gap_px: Option<u32>,
}

impl KeepArguments {
    /// Returns the filter of the core; `usual` is the default of the matcher.
    fn filter(&self, usual: DisparityFilter) -> DisparityFilter {
        DisparityFilter::default()
            .with_uniqueness_percent(self.uniqueness_percent.unwrap_or(usual.uniqueness_percent))
            .with_left_right_max_px(self.left_right_max_px.0)
            .with_speckle_size(self.speckle_size)
            .with_speckle_range_px(self.speckle_range_px as f32)
            .with_max_gap_px(self.max_gap_px.unwrap_or(usual.max_gap_px))
    }
}

/// Maximum difference of left and right disparity; none: any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LeftRight(Option<u32>);

fn left_right(text: &str) -> Result<LeftRight, String> {
    match text {
        "any" => Ok(LeftRight(None)),
        _ => (text.parse().map(|px| LeftRight(Some(px))))
            .map_err(|_| format!("\"{text}\" is neither a number of pixels nor \"any\"")),
    }
}

/// Options of semi-global matching.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Semi-global matching")]
pub(super) struct SgmArguments {
    /// Matching cost [default: both].
    #[arg(long, value_enum)]
    cost: Option<Cost>,
    /// Maximum cost of a difference of gray values, 1 to 63 [default: 30].
    #[arg(long, value_name = "GRAY", value_parser = clap::value_parser!(u8).range(1..=63))]
    gray_cap: Option<u8>,
    /// Number of directions of smoothness: 4, 5 or 8 [default: 8].
    #[arg(long, value_name = "N", value_parser = paths)]
    paths: Option<StereoPaths>,
    /// Penalty for a change of disparity by one between neighbors [default: 20].
    #[arg(long, value_name = "P1")]
    small_step_penalty: Option<u8>,
    /// Penalty for a larger change, at least the small penalty and at most 150 [default: 100].
    #[arg(long, value_name = "P2")]
    large_step_penalty: Option<u8>,
    /// Difference of gray values between neighbors that halves the penalty of a large change; 0:
    /// never [default: 10].
    #[arg(long, value_name = "GRAY")]
    edge_gray: Option<u8>,
}

fn paths(text: &str) -> Result<StereoPaths, String> {
    match text {
        "4" => Ok(StereoPaths::Four),
        "5" => Ok(StereoPaths::Five),
        "8" => Ok(StereoPaths::Eight),
        _ => Err(format!("\"{text}\" is none of 4, 5 and 8")),
    }
}

/// Options of block matching.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Block matching")]
pub(super) struct BmArguments {
    /// Side of the window, pixels, odd [default: 15].
    #[arg(long, value_name = "PX")]
    window_px: Option<u32>,
    /// Prefilter [default: x-sobel].
    #[arg(long, value_enum)]
    prefilter: Option<Prefilter>,
    /// Limit of the prefiltered values, 1 to 63 [default: 31].
    #[arg(long, value_name = "GRAY", value_parser = clap::value_parser!(u8).range(1..=63))]
    prefilter_cap: Option<u8>,
    /// Minimum mean magnitude of prefiltered values over a window of the left image; 0: no test
    /// [default: 0.5].
    #[arg(long, value_name = "GRAY", value_parser = not_negative)]
    min_texture: Option<f64>,
}

impl SgmArguments {
    /// # Errors
    /// Wrong usage, if an option of the other matcher is given.
    pub(super) fn check_unused(&self) -> Result<(), Failure> {
        let flags = [
            ("--cost", self.cost.is_some()),
            ("--gray-cap", self.gray_cap.is_some()),
            ("--paths", self.paths.is_some()),
            ("--small-step-penalty", self.small_step_penalty.is_some()),
            ("--large-step-penalty", self.large_step_penalty.is_some()),
            ("--edge-gray", self.edge_gray.is_some()),
        ];
        check_unset(&flags, "sgm")
    }

    /// Returns the matcher of the core.
    pub(super) fn matcher(&self, keep: &KeepArguments, disparities: (i32, u32)) -> StereoSgm {
        let usual = StereoSgm::default();
        StereoSgm::default()
            .with_min_disparity_px(disparities.0)
            .with_num_disparities(disparities.1)
            .with_cost(self.cost.map_or(usual.cost, |cost| match cost {
                Cost::Census => StereoCost::Census,
                Cost::BirchfieldTomasi => StereoCost::BirchfieldTomasi,
                Cost::Both => StereoCost::Both,
            }))
            .with_gray_cap(self.gray_cap.unwrap_or(usual.gray_cap))
            .with_paths(self.paths.unwrap_or(usual.paths))
            .with_small_step_penalty(self.small_step_penalty.unwrap_or(usual.small_step_penalty))
            .with_large_step_penalty(self.large_step_penalty.unwrap_or(usual.large_step_penalty))
            .with_edge_gray(self.edge_gray.unwrap_or(usual.edge_gray))
            .with_filter(keep.filter(usual.filter))
    }
}

impl BmArguments {
    /// # Errors
    /// Wrong usage, if an option of the other matcher is given.
    pub(super) fn check_unused(&self) -> Result<(), Failure> {
        let flags = [
            ("--window-px", self.window_px.is_some()),
            ("--prefilter", self.prefilter.is_some()),
            ("--prefilter-cap", self.prefilter_cap.is_some()),
            ("--min-texture", self.min_texture.is_some()),
        ];
        check_unset(&flags, "bm")
    }

    /// Returns the matcher of the core.
    pub(super) fn matcher(&self, keep: &KeepArguments, disparities: (i32, u32)) -> StereoBm {
        let usual = StereoBm::default();
        StereoBm::default()
            .with_min_disparity_px(disparities.0)
            .with_num_disparities(disparities.1)
            .with_window_px(self.window_px.unwrap_or(usual.window_px))
            .with_prefilter(
                (self.prefilter).map_or(usual.prefilter, |prefilter| match prefilter {
                    Prefilter::XSobel => StereoPrefilter::XSobel,
                    Prefilter::LocalMean => StereoPrefilter::LocalMean,
                }),
            )
            .with_prefilter_cap(self.prefilter_cap.unwrap_or(usual.prefilter_cap))
            .with_min_texture(
                (self.min_texture).map_or(usual.min_texture, |texture| texture as f32),
            )
            .with_filter(keep.filter(usual.filter))
    }
}

fn check_unset(flags: &[(&str, bool)], method: &str) -> Result<(), Failure> {
    match flags.iter().find(|(_, is_set)| *is_set) {
        None => Ok(()),
        Some((flag, _)) => Err(Failure::usage(format!(
            "{flag} belongs to --method {method}, which is not selected"
        ))),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct All {
        #[command(flatten)]
        keep: KeepArguments,
        #[command(flatten)]
        sgm: SgmArguments,
        #[command(flatten)]
        bm: BmArguments,
    }

    fn parsed(words: &[&str]) -> All {
        All::try_parse_from([&["epipole"], words].concat()).unwrap()
    }

    #[test]
    fn omitted_options_have_the_defaults_of_the_core() {
        let all = parsed(&[]);
        let (sgm, bm) = (StereoSgm::default(), StereoBm::default());
        let of_sgm = (sgm.min_disparity_px, sgm.num_disparities);
        assert_eq!(all.sgm.matcher(&all.keep, of_sgm), sgm);
        let of_bm = (bm.min_disparity_px, bm.num_disparities);
        assert_eq!(all.bm.matcher(&all.keep, of_bm), bm);
    }

    #[test]
    fn every_flag_reaches_its_field() {
        let words = "--uniqueness-percent 7 --left-right-max-px any --speckle-size 9 --speckle-range-px 1.5 \
            --max-gap-px 4 --cost census --gray-cap 21 --paths 5 --small-step-penalty 11 --large-step-penalty 90 \
            --edge-gray 0 --window-px 9 --prefilter local-mean --prefilter-cap 20 --min-texture 2";
        let all = parsed(&words.split_whitespace().collect::<Vec<_>>());
        let filter = DisparityFilter::default()
            .with_uniqueness_percent(7)
            .with_left_right_max_px(None)
            .with_speckle_size(9)
            .with_speckle_range_px(1.5)
            .with_max_gap_px(4);
        assert_eq!(
            all.sgm.matcher(&all.keep, (-3, 20)),
            StereoSgm::default()
                .with_min_disparity_px(-3)
                .with_num_disparities(20)
                .with_cost(StereoCost::Census)
                .with_gray_cap(21)
                .with_paths(StereoPaths::Five)
                .with_small_step_penalty(11)
                .with_large_step_penalty(90)
                .with_edge_gray(0)
                .with_filter(filter)
        );
        assert_eq!(
            all.bm.matcher(&all.keep, (-3, 20)),
            StereoBm::default()
                .with_min_disparity_px(-3)
                .with_num_disparities(20)
                .with_window_px(9)
                .with_prefilter(StereoPrefilter::LocalMean)
                .with_prefilter_cap(20)
                .with_min_texture(2.0)
                .with_filter(filter)
        );
    }

    #[test]
    fn an_option_of_the_other_matcher_is_rejected() {
        assert!(parsed(&[]).sgm.check_unused().is_ok());
        let error = parsed(&["--paths", "4"]).sgm.check_unused().unwrap_err();
        assert!(error.message.contains("--paths"), "{}", error.message);
        assert!(parsed(&["--window-px", "9"]).bm.check_unused().is_err());
    }
}
