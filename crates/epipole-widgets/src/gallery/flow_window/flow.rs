//! Equations of a window, their structure tensor, and Lucas-Kanade iterations.

use epipole::Error;
use epipole::feature::{TrackOptions, WindowTensor, track_lucas_kanade};
use epipole::imaging::{Border, GrayImage32, centered_difference, sample_bicubic, sample_bilinear};
use epipole::math::random::Random;
use nalgebra::{Point2, Vector2};
use std::sync::OnceLock;

/// Half size of the largest window, pixels.
pub(super) const LARGEST_HALF: u32 = 10;
/// Maximum motion along rows and columns, pixels.
pub(super) const REACH: usize = 6;
/// Half size of the cropped part of the photograph, pixels: the largest window on the coarsest
/// level, and its motion.
const PART_HALF: u32 = 52;
/// Number of equations kept, those with the steepest gradients.
const NUM_EQUATIONS: usize = 40;

/// Size and motion of the window, and the settings for tracking it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setup {
    /// Center of the window in frame 1, pixels.
    pub(super) place: (u32, u32),
    /// Half of its side without its center, pixels.
    pub(super) half: u32,
    /// True motion from frame 1 to frame 2, pixels.
    pub(super) motion: Vector2<f64>,
    /// Factor of the gray values of frame 2.
    pub(super) gain: f32,
    /// Standard deviation of the noise in both frames, gray values in [0, 1].
    pub(super) noise: f32,
    pub(super) num_levels: usize,
    pub(super) num_steps: usize,
}

/// `Iᵤ dᵤ + Iᵥ dᵥ + Iₜ = 0` of one pixel, gray values in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Equation {
    pub(super) gradient: Vector2<f64>,
    /// Temporal change from frame 1 to frame 2 at the pixel.
    pub(super) change: f64,
}

/// A window tracked from frame 1 to frame 2.
pub(super) struct Flow {
    /// Equations of the steepest pixels, steepest first.
    pub(super) equations: Vec<Equation>,
    /// Structure tensor per pixel of the window, gray values in [0, 1].
    pub(super) tensor: WindowTensor,
    /// Motion after each step, pixels, starting with zero; shorter if the window was lost.
    pub(super) path: Vec<Vector2<f64>>,
    /// Part of both frames around the window.
    parts: [GrayImage32; 2],
    /// Center of the window within the part.
    center: Point2<f64>,
    half: u32,
}

impl Flow {
    /// Moves the photograph, and tracks the window.
    ///
    /// * `photograph`: frame 1, gray values in [0, 1]
    ///
    /// # Errors
    /// Those of [`track_lucas_kanade`].
    pub(super) fn new(photograph: &GrayImage32, setup: &Setup) -> Result<Self, Error> {
        let (u, v) = setup.place;
        let side = 2 * PART_HALF + 1;
        let corner = |at: u32, size: u32| at.saturating_sub(PART_HALF).min(size - side);
        let (left, top) = (
            corner(u, photograph.width()),
            corner(v, photograph.height()),
        );
        let mut before = image::imageops::crop_imm(photograph, left, top, side, side).to_image();
        let mut after = GrayImage32::from_fn(side, side, |x, y| {
            let (x, y) = (f64::from(left + x), f64::from(top + y));
            let (x, y) = (x - setup.motion.x, y - setup.motion.y);
            let value = match setup.motion.x == 0.0 && setup.motion.y == 0.0 {
                true => sample_bilinear(photograph, x, y, Border::Replicate),
                false => sample_bicubic(photograph, x, y, Border::Replicate),
            };
            image::Luma([setup.gain * value])
        });
        for (grain, frame) in grains().iter().zip([&mut before, &mut after]) {
            for (value, grain) in frame.iter_mut().zip(grain) {
                *value += setup.noise * grain;
            }
        }
        let center = Point2::new(f64::from(u - left), f64::from(v - top));
        let (equations, tensor) = equations(&before, &after, (u - left, v - top), setup.half);
        let options = TrackOptions::default()
            .with_half_window(setup.half as usize)
            .with_num_levels(setup.num_levels)
            .with_max_forward_backward_px(None)
            .with_min_eigenvalue(0.0);
        let mut path = vec![Vector2::zeros()];
        for step in 1..=setup.num_steps {
            let options = options.with_max_iterations(step);
            let tracks = track_lucas_kanade(&before, &after, &[center], &options, &mut ())?;
            match tracks.first() {
                Some(Some(track)) => path.push(track.point - center),
                _ => break,
            }
        }
        Ok(Self {
            equations,
            tensor,
            path,
            parts: [before, after],
            center,
            half: setup.half,
        })
    }
}

impl Flow {
    /// Returns the motion after the last step, pixels; `None` if the window was lost.
    pub(super) fn found(&self, setup: &Setup) -> Option<Vector2<f64>> {
        let last = self.path.last().copied();
        last.filter(|_| self.path.len() == setup.num_steps + 1)
    }

    /// Returns the root mean square difference between the window in frame 1 and that in frame 2 at
    /// a motion, gray values in [0, 1].
    pub(super) fn difference(&self, motion: Vector2<f64>) -> f64 {
        let [before, after] = &self.parts;
        let half = i64::from(self.half);
        let pixels = || (-half..=half).flat_map(|y| (-half..=half).map(move |x| (x, y)));
        let sum: f64 = pixels()
            .map(|(x, y)| {
                let at = self.center + Vector2::new(x as f64, y as f64);
                let there = at + motion;
                let difference = f64::from(before.get_pixel(at.x as u32, at.y as u32).0[0])
                    - f64::from(sample_bilinear(after, there.x, there.y, Border::Replicate));
                difference * difference
            })
            .sum();
        (sum / pixels().count() as f64).sqrt()
    }

    /// Returns the window of frame 1, and that of frame 2 at a motion.
    pub(super) fn windows(&self, motion: Vector2<f64>) -> [GrayImage32; 2] {
        let side = 2 * self.half + 1;
        let motions = [Vector2::zeros(), motion];
        [0, 1].map(|frame| {
            let from = self.center + motions[frame];
            GrayImage32::from_fn(side, side, |x, y| {
                let at = |start: f64, index: u32| start + f64::from(index) - f64::from(self.half);
                let (x, y) = (at(from.x, x), at(from.y, y));
                image::Luma([sample_bilinear(&self.parts[frame], x, y, Border::Replicate)])
            })
        })
    }
}

/// Returns the noise of both parts, with standard deviation 1.
fn grains() -> &'static [Vec<f32>; 2] {
    static GRAINS: OnceLock<[Vec<f32>; 2]> = OnceLock::new();
    GRAINS.get_or_init(|| {
        let mut random = Random::new(14);
        let side = 2 * PART_HALF as usize + 1;
        [(); 2].map(|()| (0..side * side).map(|_| random.normal() as f32).collect())
    })
}

/// Returns the steepest equations of a window, and the structure tensor of all, per pixel.
fn equations(
    before: &GrayImage32,
    after: &GrayImage32,
    (u, v): (u32, u32),
    half: u32,
) -> (Vec<Equation>, WindowTensor) {
    let side = 2 * half + 1;
    // Includes one more pixel on each side, for the gradients.
    let around = |image: &GrayImage32| {
        let (left, top) = (u - half - 1, v - half - 1);
        image::imageops::crop_imm(image, left, top, side + 2, side + 2).to_image()
    };
    let (before, after) = (around(before), around(after));
    let gradient = centered_difference(&before, Border::Replicate);
    let mut all: Vec<Equation> = (0..side * side)
        .map(|index| {
            let (x, y) = (index % side + 1, index / side + 1);
            let read = |image: &GrayImage32| f64::from(image.get_pixel(x, y).0[0]);
            Equation {
                gradient: Vector2::new(read(&gradient.du), read(&gradient.dv)),
                change: read(&after) - read(&before),
            }
        })
        .collect();
    let gradients: Vec<_> = all.iter().map(|equation| equation.gradient).collect();
    let WindowTensor { uu, uv, vv } = WindowTensor::from_gradients(&gradients);
    let [uu, uv, vv] = [uu, uv, vv].map(|sum| sum / f64::from(side * side));
    let steepness = |equation: &Equation| equation.gradient.norm_squared();
    all.sort_by(|a, b| steepness(b).total_cmp(&steepness(a)));
    all.truncate(NUM_EQUATIONS);
    (all, WindowTensor { uu, uv, vv })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disk with a smooth rim, centered at (160, 120).
    fn disk() -> GrayImage32 {
        GrayImage32::from_fn(320, 240, |u, v| {
            let (x, y) = (f64::from(u) - 160.0, f64::from(v) - 120.0);
            let beyond = (libm::hypot(x, y) - 30.0) / 3.0;
            image::Luma([(0.2 + 0.6 / (1.0 + libm::exp(beyond))) as f32])
        })
    }

    fn setup(place: (u32, u32)) -> Setup {
        Setup {
            place,
            half: 10,
            motion: Vector2::new(1.2, -0.8),
            gain: 1.0,
            noise: 0.0,
            num_levels: 1,
            num_steps: 8,
        }
    }

    #[test]
    fn equations_hold_for_a_small_motion() {
        let small = Setup {
            motion: Vector2::new(0.1, 0.05),
            ..setup((160, 90))
        };
        let flow = Flow::new(&disk(), &small).unwrap();
        assert_eq!(flow.equations.len(), NUM_EQUATIONS);
        for Equation { gradient, change } in flow.equations {
            assert!((gradient.dot(&small.motion) + change).abs() < 1e-3);
        }
    }

    #[test]
    fn a_rim_tells_its_normal_only() {
        // The upper rim is nearly horizontal, so only the vertical motion is determined.
        let narrow = Setup {
            half: 3,
            ..setup((160, 90))
        };
        let flow = Flow::new(&disk(), &narrow).unwrap();
        let (large, small) = flow.tensor.eigenvalues();
        assert!(small < 0.02 * large, "{large} {small}");
        let found = flow.found(&narrow).unwrap();
        assert!((found.y + 0.8).abs() < 0.15, "{found}");
    }

    #[test]
    fn the_motion_is_where_the_windows_differ_least() {
        let setup = Setup {
            half: 10,
            ..setup((182, 98))
        };
        let flow = Flow::new(&disk(), &setup).unwrap();
        let found = flow.found(&setup).unwrap();
        assert!((found - setup.motion).norm() < 0.1, "{found}");
        let there = flow.difference(found);
        for aside in [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)] {
            assert!(flow.difference(found + aside) > 2.0 * there);
        }
        let [before, after] = flow.windows(found);
        assert!((before.get_pixel(10, 10).0[0] - after.get_pixel(10, 10).0[0]).abs() < 0.02);
    }

    #[test]
    fn windows_at_the_border_are_followed_or_lost() {
        let (left, top) = (LARGEST_HALF + 1, LARGEST_HALF + 1);
        for place in [(left, top), (319 - left, 239 - top)] {
            let flow = Flow::new(&disk(), &setup(place)).unwrap();
            assert!(flow.tensor.trace() < 1e-9 && flow.path[0] == Vector2::zeros());
        }
    }
}
