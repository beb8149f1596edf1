//! Options that apply to a single kind of features.

use super::numbers::{above_0_up_to_1, number};
use crate::matrices::not_negative;
use clap::Args;
use epipole::feature::FeatureOptions;

/// Options of one kind of features.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Features of one kind")]
pub(super) struct KindArguments {
    /// SIFT: also search images of up to N pixels at twice their size, for small features, and
    /// larger ones if they yield fewer than --max-features (0: never).
    #[arg(long, default_value_t = FeatureOptions::default().max_upsampled_pixels, value_name = "N")]
    max_upsampled_pixels: u64,
    /// SIFT: assumed blur of the image, pixels, at most half of --sigma-px.
    #[arg(long, default_value_t = FeatureOptions::default().input_blur_px, value_name = "PX", value_parser = input_blur)]
    input_blur_px: f64,
    /// SIFT: blur of the first layer of an octave, pixels of that octave, 0.8 to 4.
    #[arg(long, default_value_t = FeatureOptions::default().sigma_px, value_name = "PX", value_parser = sigma)]
    sigma_px: f64,
    /// SIFT: number of layers per octave searched for extrema, 1 to 10.
    #[arg(long, default_value_t = FeatureOptions::default().layers_per_octave, value_name = "N", value_parser = count::<1, 10>)]
    layers_per_octave: usize,
    /// SIFT: maximum ratio of the principal curvatures of an extremum, above 1 (edges have large
    /// ratios).
    #[arg(long, default_value_t = FeatureOptions::default().edge_threshold, value_name = "R", value_parser = above_1)]
    edge_threshold: f32,
    /// SIFT: maximum number of orientations at one position, 1 to 36; each is a feature.
    #[arg(long, default_value_t = FeatureOptions::default().max_orientations, value_name = "N", value_parser = count::<1, 36>)]
    max_orientations: usize,
    /// SIFT: minimum weight of a further orientation, relative to the strongest.
    #[arg(long, default_value_t = FeatureOptions::default().orientation_peak_ratio, value_name = "RATIO", value_parser = above_0_up_to_1)]
    orientation_peak_ratio: f32,
    /// ORB: number of pyramid levels, 1 to 16.
    #[arg(long, default_value_t = FeatureOptions::default().num_levels, value_name = "N", value_parser = count::<1, 16>)]
    num_levels: usize,
    /// ORB: scale factor between pyramid levels, above 1 and at most 2.
    #[arg(long, default_value_t = FeatureOptions::default().scale_factor, value_name = "F", value_parser = scale_factor)]
    scale_factor: f64,
    /// Harris: constant k of the corner measure, from 0 to below 0.25.
    #[arg(long, default_value_t = FeatureOptions::default().harris_k, value_name = "K", value_parser = harris_k)]
    harris_k: f32,
    /// Harris: minimum distance of two corners, pixels.
    #[arg(long, default_value_t = FeatureOptions::default().min_distance_px, value_name = "PX", value_parser = not_negative)]
    min_distance_px: f64,
    /// Harris: side of the square over which gradients are summed, pixels, 1 to 255.
    #[arg(long, default_value_t = FeatureOptions::default().tensor_window_px, value_name = "PX", value_parser = count::<1, 255>)]
    tensor_window_px: usize,
    /// Harris: side of the patch that describes a corner, pixels, 2 to 64.
    #[arg(long, default_value_t = FeatureOptions::default().patch_px, value_name = "PX", value_parser = count::<2, 64>)]
    patch_px: usize,
}

impl KindArguments {
    /// Adds the options of single kinds to the common ones.
    pub(super) fn options(&self, common: FeatureOptions) -> FeatureOptions {
        common
            .with_max_upsampled_pixels(self.max_upsampled_pixels)
            .with_input_blur_px(self.input_blur_px)
            .with_sigma_px(self.sigma_px)
            .with_layers_per_octave(self.layers_per_octave)
            .with_edge_threshold(self.edge_threshold)
            .with_max_orientations(self.max_orientations)
            .with_orientation_peak_ratio(self.orientation_peak_ratio)
            .with_num_levels(self.num_levels)
            .with_scale_factor(self.scale_factor)
            .with_harris_k(self.harris_k)
            .with_min_distance_px(self.min_distance_px)
            .with_tensor_window_px(self.tensor_window_px)
            .with_patch_px(self.patch_px)
    }
}

fn number64(text: &str, fits: impl Fn(f64) -> bool, range: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if fits(value) => Ok(value),
        _ => Err(format!("\"{text}\" is not a number {range}")),
    }
}

fn input_blur(text: &str) -> Result<f64, String> {
    number64(text, |x| (0.0..=2.0).contains(&x), "from 0 to 2")
}

fn sigma(text: &str) -> Result<f64, String> {
    number64(text, |x| (0.8..=4.0).contains(&x), "from 0.8 to 4")
}

fn scale_factor(text: &str) -> Result<f64, String> {
    number64(text, |x| x > 1.0 && x <= 2.0, "above 1 and at most 2")
}

fn harris_k(text: &str) -> Result<f32, String> {
    number(text, |x| (0.0..0.25).contains(&x), "from 0 to below 0.25")
}

fn count<const LEAST: usize, const MOST: usize>(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if (LEAST..=MOST).contains(&value) => Ok(value),
        _ => Err(format!(
            "\"{text}\" is not a whole number from {LEAST} to {MOST}"
        )),
    }
}

fn above_1(text: &str) -> Result<f32, String> {
    number(text, |x| x > 1.0, "above 1")
}
