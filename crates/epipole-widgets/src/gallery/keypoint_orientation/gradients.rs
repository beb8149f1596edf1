//! Gradients around a keypoint of the rotated photograph, their histogram and its peaks.

use crate::kit::changed::{Change, MIDDLE};
use crate::kit::patch::Spot;
use epipole::Error;
use epipole::feature::{Keypoint, SiftOptions, sift_directions, sift_orientation_histograms};
use epipole::imaging::{Border, GrayImage32, gaussian_blur, sample_bilinear};
use image::{Rgb, RgbImage};

/// Number of bins of the histogram.
pub(super) const NUM_BINS: usize = 36;
/// Standard deviation of the weights, in units of the keypoint's scale.
pub(super) const SPREAD_SIGMAS: f64 = 1.5;
/// Radius of the window, in units of the keypoint's scale.
pub(super) const RADIUS_SIGMAS: f64 = 3.0 * SPREAD_SIGMAS;
/// Half size of the crop shown, pixels.
pub(super) const SHOWN_PX: u32 = 28;
/// Side of the crop shown, pixels.
const SIDE_PX: u32 = 2 * SHOWN_PX + 1;
/// Side of a normalized patch, pixels.
const PATCH_PX: u32 = 32;

/// Neighborhood of a keypoint after a rotation of the photograph.
pub(super) struct Surroundings {
    piece: GrayImage32,
    /// Crop, blurred to the keypoint's scale.
    smooth: GrayImage32,
    scale_px: f64,
    /// Sum of weighted gradients by direction, from −180°.
    pub(super) histogram: [f32; NUM_BINS],
    /// Directions of the peaks of at least 80% of the highest, strongest first, at most two.
    pub(super) peaks_rad: Vec<f64>,
}

/// A gradient in the window, as it contributes to the histogram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gradient {
    /// Offset from the keypoint, pixels.
    pub(super) offset: (f64, f64),
    /// Gradient times its weight, gray levels per pixel.
    pub(super) weighted: (f64, f64),
}

/// Returns the options: the core's defaults, at the photograph's own size.
pub(super) fn options() -> SiftOptions {
    SiftOptions::default().with_upsample(false)
}

impl Surroundings {
    /// Rotates the photograph about a point, and computes the neighborhood there.
    ///
    /// # Errors
    /// As [`sift_directions`].
    pub(super) fn new(
        gray: &GrayImage32,
        place: (f64, f64),
        turn_rad: f64,
        scale_px: f64,
    ) -> Result<Self, Error> {
        let change = Change {
            turn_rad,
            ..Change::NONE
        };
        let piece = change.piece(gray, place)?;
        let keypoint = Keypoint {
            scale_px: scale_px as f32,
            ..Keypoint::at(MIDDLE, MIDDLE, 1.0)
        };
        let histograms = sift_orientation_histograms(&piece, &[keypoint], &options(), &mut ())?;
        let directions = sift_directions(&piece, &[keypoint], &options(), &mut ())?;
        let directions = directions.into_iter().flatten().map(f64::from);
        Ok(Self {
            smooth: gaussian_blur(&piece, scale_px, Border::Replicate, &mut ())?,
            histogram: histograms.first().copied().unwrap_or([0.0; NUM_BINS]),
            peaks_rad: directions.collect(),
            piece,
            scale_px,
        })
    }

    pub(super) fn scale_px(&self) -> f64 {
        self.scale_px
    }

    /// Returns the keypoint in the crop with one of its orientations.
    pub(super) fn spot(&self, angle_rad: f64) -> Spot {
        Spot {
            place: [f64::from(SHOWN_PX); 2],
            scale_px: self.scale_px,
            angle_rad,
        }
    }

    /// Returns the crop around the keypoint.
    pub(super) fn picture(&self) -> RgbImage {
        let first = MIDDLE as u32 - SHOWN_PX;
        RgbImage::from_fn(SIDE_PX, SIDE_PX, |u, v| {
            let level = 255.0 * self.piece.get_pixel(first + u, first + v).0[0];
            Rgb([level.round() as u8; 3])
        })
    }

    /// Returns the descriptor's window, rotated so that the strongest peak points right.
    pub(super) fn normalized(&self) -> RgbImage {
        let spot = Spot {
            place: [MIDDLE; 2],
            ..self.spot(self.peaks_rad.first().copied().unwrap_or(0.0))
        };
        let share = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(PATCH_PX) - 1.0;
        RgbImage::from_fn(PATCH_PX, PATCH_PX, |i, j| {
            let (u, v) = spot.at(share(i), share(j));
            let level = 255.0 * sample_bilinear(&self.piece, u, v, Border::Replicate);
            Rgb([level.round() as u8; 3])
        })
    }

    /// Returns the gradients in the window, one every `step` pixels along rows and columns.
    pub(super) fn gradients(&self, step: u32) -> Vec<Gradient> {
        let radius = RADIUS_SIGMAS * self.scale_px;
        let most = (radius / f64::from(step)) as i32;
        let at = |x: f64, y: f64| {
            let (u, v) = (MIDDLE + x, MIDDLE + y);
            255.0 * f64::from(sample_bilinear(&self.smooth, u, v, Border::Replicate))
        };
        let offsets = (-most..=most).flat_map(|j| (-most..=most).map(move |i| (i, j)));
        offsets
            .map(|(i, j)| {
                (
                    f64::from(i) * f64::from(step),
                    f64::from(j) * f64::from(step),
                )
            })
            .filter(|(x, y)| libm::hypot(*x, *y) <= radius)
            .map(|(x, y)| {
                let spread = SPREAD_SIGMAS * self.scale_px;
                let weight = libm::exp(-0.5 * (x * x + y * y) / (spread * spread));
                Gradient {
                    offset: (x, y),
                    weighted: (
                        0.5 * weight * (at(x + 1.0, y) - at(x - 1.0, y)),
                        0.5 * weight * (at(x, y + 1.0) - at(x, y - 1.0)),
                    ),
                }
            })
            .collect()
    }

    /// Returns the second-highest peak of the histogram relative to the highest; 0 without one.
    pub(super) fn second(&self) -> f64 {
        let at = |k: usize| self.histogram[k % NUM_BINS];
        let is_peak = |k: &usize| at(*k) > at(k + NUM_BINS - 1) && at(*k) >= at(k + 1);
        let mut peaks: Vec<f32> = (0..NUM_BINS).filter(is_peak).map(at).collect();
        peaks.sort_by(|a, b| b.total_cmp(a));
        match peaks[..] {
            [first, second, ..] => f64::from(second / first),
            _ => 0.0,
        }
    }
}

impl Gradient {
    /// Returns the histogram bin of its direction.
    pub(super) fn bin(&self) -> usize {
        let (du, dv) = self.weighted;
        bin_of(libm::atan2(dv, du))
    }

    pub(super) fn length(&self) -> f64 {
        libm::hypot(self.weighted.0, self.weighted.1)
    }
}

/// Returns the bin nearest to an angle in [−π, π].
pub(super) fn bin_of(angle_rad: f64) -> usize {
    let turns = angle_rad / std::f64::consts::TAU + 0.5;
    (turns * NUM_BINS as f64).round() as usize % NUM_BINS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::features::Pair;
    use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
    use std::ops::ControlFlow;

    fn gray() -> GrayImage32 {
        let photograph = Pair::photograph(0, &mut |_| ControlFlow::Continue(())).unwrap();
        rgb_to_gray_f32(photograph, &BT601_WEIGHTS)
    }

    #[test]
    fn the_peak_is_the_orientation_of_detected_features() {
        let gray = gray();
        let features = Pair::features(0, &mut |_| ControlFlow::Continue(())).unwrap();
        let mut compared = 0;
        for keypoint in &features.keypoints {
            let (u, v) = (keypoint.u, keypoint.v);
            let is_inside = (90.0..390.0).contains(&u) && (90.0..270.0).contains(&v);
            if !(is_inside && (2.2..5.0).contains(&keypoint.scale_px)) {
                continue;
            }
            let found = Surroundings::new(&gray, (u, v), 0.0, keypoint.scale_px.into()).unwrap();
            let off = |angle: &f64| {
                let difference = angle - f64::from(keypoint.angle_rad);
                libm::remainder(difference, std::f64::consts::TAU).abs()
            };
            let nearest = found
                .peaks_rad
                .iter()
                .map(off)
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.12, "({u}, {v}): {nearest}");
            compared += 1;
        }
        assert!(compared > 20, "{compared}");
    }

    #[test]
    fn arrows_add_up_to_the_histogram() {
        let gray = gray();
        let found = Surroundings::new(&gray, (348.0, 244.0), 0.5, 3.2).unwrap();
        let mut sums = [0.0; NUM_BINS];
        for gradient in found.gradients(1) {
            sums[gradient.bin()] += gradient.length();
        }
        // The core smooths its histogram, so compare a few bins at a time.
        let around = |values: &[f64; NUM_BINS], k: usize| -> f64 {
            (0..7)
                .map(|i| values[(k + i + NUM_BINS - 3) % NUM_BINS])
                .sum()
        };
        let histogram = found.histogram.map(f64::from);
        let total = |values: &[f64; NUM_BINS]| values.iter().sum::<f64>();
        for k in 0..NUM_BINS {
            let [own, core] = [&sums, &histogram].map(|all| around(all, k) / total(all));
            assert!((own - core).abs() < 0.04, "bin {k}: {own} {core}");
        }
    }

    #[test]
    fn bins_are_counted_from_minus_180() {
        let pi = std::f64::consts::PI;
        assert_eq!([-pi, pi, 0.0, 0.5 * pi].map(bin_of), [0, 0, 18, 27]);
    }
}
