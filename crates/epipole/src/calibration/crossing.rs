//! Chessboard corners to a hundredth of a pixel: fits two crossing blurred edges to the gray
//! values.
//!
//! Gradients use only the strong edges, but every pixel at the squares' borders carries
//! information, which a fit to the gray values weights optimally. On coarse renderings its error is
//! less than half that of gradients alone.

use crate::imaging::GrayImage32;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, PI};
use nalgebra::{Point2, SVector, Vector2};

/// Minimum blur: no image is sharper, and sharper edges all look alike.
const LEAST_BLUR_PX: f64 = 0.2;
/// Minimum sine between the edges: at smaller angles corners are poorly localized along the edges.
const LEAST_SINE: f64 = 0.3;
/// Minimum half-difference of bright and dark, of a range of 1.
const LEAST_CONTRAST: f64 = 0.02;
/// Minimum number of pixels to determine nine parameters well.
const LEAST_PIXELS: usize = 25;

/// Side of an inset along an edge: the inset is where
/// `sign · (distance from the edge) > offset_px + slope · (position along the edge)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct InsetSide {
    /// 1 or -1.
    pub(super) sign: f64,
    /// Distance from the edge beside the crossing, pixels.
    pub(super) offset_px: f64,
    /// Zero unless the board is seen in perspective.
    pub(super) slope: f64,
}

/// Dark squares within the two bright quadrants, such as the markers of a ChArUco board: of each,
/// the two sides that meet nearest to the crossing, one along each edge.
pub(super) type Insets = [[InsetSide; 2]; 2];

/// The gray `m + c·Φ(d₁/σ)·Φ(d₂/σ) + s·x`, where dᵢ is the distance from edge i and
/// `Φ(x) = erf(x/√2)`, minus `2c` within the insets, blurred alike.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    /// Position relative to the middle of the window.
    place: Vector2<f64>,
    /// Directions of the two edges.
    angles_rad: [f64; 2],
    /// σ.
    blur_px: f64,
    /// m.
    middle: f64,
    /// c; negative if the other two quadrants are bright.
    contrast: f64,
    /// s: illumination gradient over the board.
    slope: Vector2<f64>,
    insets: Option<Insets>,
}

/// Derivatives of a term by the signed distances from both edges, by the positions along them, and
/// by the blur, and its value, all for a contrast of 1.
struct Term {
    by_distance: [f64; 2],
    by_position: [f64; 2],
    by_blur: f64,
    value: f64,
}

/// A pixel relative to the middle of the window: position and gray value.
type Sample = [f64; 3];

impl Crossing {
    /// Returns the gray value at a position, and its derivatives by position, angles, blur, middle,
    /// contrast and slope.
    fn gray(&self, x: f64, y: f64) -> (f64, SVector<f64, 9>) {
        let (dx, dy) = (x - self.place.x, y - self.place.y);
        let edge = |angle_rad: f64| {
            let (sine, cosine) = libm::sincos(angle_rad);
            let (across, along) = (cosine * dy - sine * dx, cosine * dx + sine * dy);
            (sine, cosine, across, along)
        };
        let [a, b] = self.angles_rad.map(edge);
        let term = self.term([a.2, b.2], [a.3, b.3]);
        let mut derivatives = SVector::from([
            0.0,
            0.0,
            0.0,
            0.0,
            self.contrast * term.by_blur,
            1.0,
            term.value,
            x,
            y,
        ]);
        for (k, (sine, cosine, across, along)) in [a, b].into_iter().enumerate() {
            let by_distance = self.contrast * term.by_distance[k];
            let by_position = self.contrast * term.by_position[k];
            derivatives[0] += by_distance * sine - by_position * cosine;
            derivatives[1] -= by_distance * cosine + by_position * sine;
            derivatives[2 + k] = by_position * across - by_distance * along;
        }
        let gray = self.middle + self.contrast * term.value + self.slope.x * x + self.slope.y * y;
        (gray, derivatives)
    }

    /// Returns the factor of the contrast at signed distances from the edges and positions along
    /// them.
    fn term(&self, across: [f64; 2], along: [f64; 2]) -> Term {
        let scale = FRAC_1_SQRT_2 / self.blur_px;
        // Φ at a signed distance, and its derivative.
        let step = |across: f64| {
            let t = across * scale;
            (libm::erf(t), FRAC_2_SQRT_PI * scale * libm::exp(-t * t))
        };
        let [(at_a, rise_a), (at_b, rise_b)] = across.map(step);
        let mut term = Term {
            by_distance: [rise_a * at_b, at_a * rise_b],
            by_position: [0.0; 2],
            by_blur: -(rise_a * at_b * across[0] + at_a * rise_b * across[1]) / self.blur_px,
            value: at_a * at_b,
        };
        for sides in self.insets.iter().flatten() {
            let inside = [0, 1].map(|k| {
                let InsetSide {
                    sign,
                    offset_px,
                    slope,
                } = sides[k];
                sign * across[k] - offset_px - slope * along[k]
            });
            let [(at_a, rise_a), (at_b, rise_b)] = inside.map(step);
            // Bright quadrants have the value 1 or -1, and the insets that of the dark ones.
            let depth = -0.5 * sides[0].sign * sides[1].sign;
            let by_inside = [depth * rise_a * (1.0 + at_b), depth * (1.0 + at_a) * rise_b];
            for k in 0..2 {
                term.by_distance[k] += sides[k].sign * by_inside[k];
                term.by_position[k] -= sides[k].slope * by_inside[k];
                term.by_blur -= by_inside[k] * inside[k] / self.blur_px;
            }
            term.value += depth * (1.0 + at_a) * (1.0 + at_b);
        }
        term
    }

    /// Fits middle and contrast by linear least squares, with fixed edges.
    fn with_levels(mut self, samples: &[Sample]) -> Self {
        (self.middle, self.contrast) = (0.0, 1.0);
        let count = samples.len() as f64;
        let [mut f1, mut f2, mut v1, mut fv] = [0.0; 4];
        for [x, y, value] in samples {
            let f = self.gray(*x, *y).0;
            f1 += f;
            f2 += f * f;
            v1 += value;
            fv += f * value;
        }
        let spread = f2 - f1 * f1 / count;
        self.contrast = (fv - f1 * v1 / count) / spread.max(f64::MIN_POSITIVE);
        self.middle = (v1 - self.contrast * f1) / count;
        self
    }
}

struct Problem<'a> {
    samples: &'a [Sample],
}

impl FixedProblem<9> for Problem<'_> {
    type Parameters = Crossing;

    fn accumulate(&self, crossing: &Crossing, normal: &mut NormalEquations<9>) {
        for [x, y, value] in self.samples {
            let (gray, derivatives) = crossing.gray(*x, *y);
            normal.add_scalar(gray - value, &derivatives, &RobustLoss::Trivial);
        }
    }

    fn cost(&self, crossing: &Crossing) -> f64 {
        let residual_sq = |[x, y, value]: &Sample| {
            let residual = crossing.gray(*x, *y).0 - value;
            0.5 * RobustLoss::Trivial.rho(residual * residual)
        };
        self.samples.iter().map(residual_sq).sum()
    }

    fn plus(&self, crossing: &Crossing, step: &SVector<f64, 9>) -> Crossing {
        let [a, b] = crossing.angles_rad;
        Crossing {
            place: crossing.place + Vector2::new(step[0], step[1]),
            angles_rad: [a + step[2], b + step[3]],
            blur_px: (crossing.blur_px + step[4]).max(LEAST_BLUR_PX),
            middle: crossing.middle + step[5],
            contrast: crossing.contrast + step[6],
            slope: crossing.slope + Vector2::new(step[7], step[8]),
            insets: crossing.insets,
        }
    }
}

/// Fits the corner near a position to the pixels of a disk around it; `None` if there is no corner.
///
/// * `edges`: approximate directions of the two edges
/// * `radius_px`: radius of the disk, which must show nothing but the four squares and `insets`
///
/// Source: least squares; the profile of an edge is a step blurred by a Gaussian.
pub(super) fn fit_crossing(
    image: &GrayImage32,
    near: &Point2<f64>,
    edges: [Vector2<f64>; 2],
    radius_px: f64,
    insets: Option<Insets>,
) -> Option<Point2<f64>> {
    let (width, height) = (i64::from(image.width()), i64::from(image.height()));
    let (u0, v0) = (near.x.round(), near.y.round());
    let reach = radius_px.ceil() as i64;
    let mut samples: Vec<Sample> = Vec::new();
    for j in -reach..=reach {
        for i in -reach..=reach {
            let (u, v) = (u0 as i64 + i, v0 as i64 + j);
            let (x, y) = (u as f64 - near.x, v as f64 - near.y);
            let inside = u >= 0 && v >= 0 && u < width && v < height;
            if inside && x * x + y * y <= radius_px * radius_px {
                let value = f64::from(image.get_pixel(u as u32, v as u32).0[0]);
                samples.push([x, y, value]);
            }
        }
    }
    if samples.len() < LEAST_PIXELS {
        return None;
    }
    let mut crossing = Crossing {
        place: Vector2::zeros(),
        angles_rad: edges.map(|edge| libm::atan2(edge.y, edge.x)),
        blur_px: 0.7,
        middle: 0.0,
        contrast: 1.0,
        slope: Vector2::zeros(),
        insets,
    }
    .with_levels(&samples);
    let options = LmOptions {
        max_iterations: 30,
        step_tolerance: 1e-5,
        cost_tolerance: 1e-7,
        initial_damping: 1e-3,
        ..LmOptions::default()
    };
    let problem = Problem { samples: &samples };
    minimize_fixed(&problem, &mut crossing, &options).ok()?;
    let sine = libm::sin(crossing.angles_rad[0] - crossing.angles_rad[1]).abs();
    let mean_sq = 2.0 * problem.cost(&crossing) / samples.len() as f64;
    // The residual must be small relative to the corner's contrast. Comparisons are false for NaN.
    let is_corner = crossing.place.norm() <= 0.5 * radius_px
        && crossing.blur_px <= radius_px
        && sine >= LEAST_SINE
        && crossing.contrast.abs() >= LEAST_CONTRAST
        && mean_sq <= 0.1 * crossing.contrast * crossing.contrast;
    is_corner.then(|| near + crossing.place)
}

/// Returns the directions of a chessboard's edges in a mark, from the adjacent marks.
///
/// * `beside`: for each axis the previous and the next mark, if visible
pub(super) fn edges_through(
    mark: &Point2<f64>,
    beside: [[Option<Point2<f64>>; 2]; 2],
) -> Option<[Vector2<f64>; 2]> {
    let edge = |[before, behind]: [Option<Point2<f64>>; 2]| {
        let direction = behind.unwrap_or(*mark) - before.unwrap_or(*mark);
        (direction.norm() > 0.0).then_some(direction)
    };
    let [a, b] = beside.map(edge);
    let (a, b) = (a?, b?);
    let angle_rad = a.angle(&b);
    (libm::sin(angle_rad) >= LEAST_SINE && angle_rad < PI).then_some([a, b])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use image::Luma;
    use nalgebra::{DMatrix, DVector};

    /// Two edges through a position, each pixel the mean of 3 × 3 samples, in 8 bits.
    fn corner(place: &Point2<f64>, angles_rad: [f64; 2]) -> GrayImage32 {
        let sides = angles_rad.map(libm::sincos);
        GrayImage32::from_fn(31, 31, |u, v| {
            let bright = (0..9)
                .filter(|k| {
                    let x = f64::from(u) + f64::from(k % 3 - 1) / 3.0 - place.x;
                    let y = f64::from(v) + f64::from(k / 3 - 1) / 3.0 - place.y;
                    let [a, b] = sides.map(|(sine, cosine)| cosine * y - sine * x > 0.0);
                    a == b
                })
                .count();
            let level = (25.0 + 205.0 * bright as f32 / 9.0).round();
            Luma([level / 255.0])
        })
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let side = |sign: f64, offset_px: f64, slope: f64| InsetSide {
            sign,
            offset_px,
            slope,
        };
        let agreeing = [
            [side(1.0, 1.0, 0.1), side(1.0, 1.3, -0.05)],
            [side(-1.0, 1.1, 0.0), side(-1.0, 1.2, 0.08)],
        ];
        let differing = [
            [side(1.0, 1.0, 0.1), side(-1.0, 1.3, -0.05)],
            [side(-1.0, 1.1, 0.0), side(1.0, 1.2, 0.08)],
        ];
        for insets in [None, Some(agreeing), Some(differing)] {
            check_derivatives(insets);
        }
    }

    fn check_derivatives(insets: Option<Insets>) {
        let crossing = Crossing {
            place: Vector2::new(0.2, -0.3),
            angles_rad: [0.1, 1.9],
            blur_px: 0.8,
            middle: 0.5,
            contrast: -0.4,
            slope: Vector2::new(0.01, -0.02),
            insets,
        };
        let samples: Vec<Sample> = (0..25)
            .map(|k| [f64::from(k % 5) - 2.1, f64::from(k / 5) - 1.8, 0.0])
            .collect();
        let problem = Problem { samples: &samples };
        let analytic = DMatrix::from_fn(25, 9, |row, column| {
            crossing.gray(samples[row][0], samples[row][1]).1[column]
        });
        let residuals = |delta: &DVector<f64>| {
            let moved = problem.plus(&crossing, &SVector::from_column_slice(delta.as_slice()));
            DVector::from_fn(25, |row, _| moved.gray(samples[row][0], samples[row][1]).0)
        };
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
    }

    /// Gradients alone have errors of .08 px on these images.
    #[test]
    fn coarse_corners_are_found_to_a_few_hundredths_of_a_pixel() {
        let mut random = Random::new(1);
        let (mut sum_sq, mut count) = (0.0, 0.0);
        for _ in 0..60 {
            let truth = Point2::new(random.uniform(14.0, 16.0), random.uniform(14.0, 16.0));
            let first = random.uniform(0.0, 3.0);
            let angles = [first, first + random.uniform(1.0, 2.1)];
            let image = corner(&truth, angles);
            let direction = |angle: f64| {
                let (sine, cosine) = libm::sincos(angle + random_off(&truth));
                Vector2::new(cosine, sine)
            };
            let near = truth + Vector2::new(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
            let found = fit_crossing(&image, &near, angles.map(direction), 9.0, None).unwrap();
            sum_sq += (found - truth).norm_squared();
            count += 1.0;
        }
        let rms_px = libm::sqrt(sum_sq / count);
        assert!(rms_px < 0.04, "{rms_px}");
    }

    /// Directions from nearby marks have errors of a few degrees.
    fn random_off(place: &Point2<f64>) -> f64 {
        0.1 * libm::sin(100.0 * (place.x + place.y))
    }

    #[test]
    fn what_is_no_corner_gives_none() {
        let edges = [Vector2::x(), Vector2::y()];
        let middle = Point2::new(15.0, 15.0);
        let flat = GrayImage32::from_pixel(31, 31, Luma([0.5]));
        let edge = GrayImage32::from_fn(31, 31, |u, _| Luma([f32::from(u > 15)]));
        let mut random = Random::new(2);
        let noise = GrayImage32::from_fn(31, 31, |_, _| Luma([random.uniform(0.0, 1.0) as f32]));
        for image in [&flat, &edge, &noise] {
            assert_eq!(fit_crossing(image, &middle, edges, 9.0, None), None);
        }
        let outside = Point2::new(-40.0, 15.0);
        assert_eq!(fit_crossing(&flat, &outside, edges, 9.0, None), None);
    }

    #[test]
    fn edges_follow_the_marks_beside() {
        let at = |x: f64, y: f64| Some(Point2::new(x, y));
        let mark = Point2::new(10.0, 10.0);
        let found = edges_through(
            &mark,
            [[at(0.0, 9.0), at(20.0, 11.0)], [None, at(10.0, 20.0)]],
        );
        assert_eq!(
            found,
            Some([Vector2::new(20.0, 2.0), Vector2::new(0.0, 10.0)])
        );
        assert_eq!(
            edges_through(&mark, [[None, None], [None, at(10.0, 20.0)]]),
            None
        );
        let folded = [[at(0.0, 10.0), None], [None, at(20.0, 11.0)]];
        assert_eq!(edges_through(&mark, folded), None);
    }
}
