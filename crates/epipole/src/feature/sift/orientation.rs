//! Directions of a keypoint: histogram of the surrounding gradients, and its peaks.

use super::descriptor::Samples;
use super::options::SiftOptions;
use crate::imaging::GrayImage32;
use std::f32::consts::{PI, TAU};

pub(super) const NUM_BINS: usize = 36;

/// Returns the directions of the gradients around a position, strongest first, in (−π, π].
pub(super) fn directions(
    layer: &GrayImage32,
    center: (f32, f32),
    sigma: f32,
    options: &SiftOptions,
    scratch: &mut Samples,
) -> Vec<f32> {
    peaks(&histogram(layer, center, sigma, scratch), options)
}

/// Computes the histogram of the gradients around a position; bin k is at an angle of
/// `k · 10° − 180°`.
///
/// The weights are a Gaussian of 1.5 times the keypoint's blur; each gradient is distributed to the
/// two nearest bins; the histogram is smoothed by `[1 4 6 4 1]/16`.
///
/// Source: Lowe 2004, §5.
pub(super) fn histogram(
    layer: &GrayImage32,
    center: (f32, f32),
    sigma: f32,
    scratch: &mut Samples,
) -> [f32; NUM_BINS] {
    let mut histogram = [0.0f32; NUM_BINS + 1];
    let spread = 1.5 * sigma;
    let radius = 3.0 * spread;
    let falloff = -0.5 / (spread * spread);
    scratch.collect(layer, center, radius, |dy| {
        let half = (radius * radius - dy * dy).max(0.0).sqrt();
        (-half, half)
    });
    scratch.polar(falloff);
    for (angle, weight) in scratch.angle.iter().zip(&scratch.weight) {
        let bin = angle * (NUM_BINS as f32 / TAU) + 0.5 * NUM_BINS as f32;
        let low = (bin as usize).min(NUM_BINS - 1);
        let upper = (bin - low as f32) * weight;
        histogram[low] += weight - upper;
        histogram[low + 1] += upper;
    }
    // Bin 36 equals bin 0: both are at an angle of ±π.
    histogram[0] += histogram[NUM_BINS];
    let h = |k: usize| histogram[k % NUM_BINS];
    std::array::from_fn(|k| {
        let k = k + NUM_BINS;
        ((h(k - 2) + h(k + 2)) + 4.0 * (h(k - 1) + h(k + 1)) + 6.0 * h(k)) / 16.0
    })
}

/// Returns the peaks of a [`histogram`], strongest first, in (−π, π], refined by parabolas.
fn peaks(smooth: &[f32; NUM_BINS], options: &SiftOptions) -> Vec<f32> {
    let strongest = smooth.iter().fold(0.0f32, |m, &v| m.max(v));
    if strongest <= 0.0 {
        // Without a gradient any direction is equally good.
        return vec![0.0];
    }
    let mut peaks: Vec<(f32, f32)> = Vec::new();
    for k in 0..NUM_BINS {
        let (left, here) = (smooth[(k + NUM_BINS - 1) % NUM_BINS], smooth[k]);
        let right = smooth[(k + 1) % NUM_BINS];
        if here > left && here >= right && here >= options.orientation_peak_ratio * strongest {
            let offset = 0.5 * (left - right) / (left - 2.0 * here + right);
            let angle = (k as f32 + offset) * (TAU / NUM_BINS as f32) - PI;
            let angle = if angle <= -PI { angle + TAU } else { angle };
            // Strongest first.
            let is_before = |other: &(f32, f32)| {
                let order = here.total_cmp(&other.0).then(other.1.total_cmp(&angle));
                order.is_lt()
            };
            peaks.insert(peaks.partition_point(is_before), (here, angle));
        }
    }
    peaks.truncate(options.max_orientations);
    peaks.into_iter().map(|(_, angle)| angle).collect()
}
