//! Points near a hidden line, and outliers; a line with the points that vote for it.

use crate::contract::{Rect, Settings, Slider, round_to_digits};
use crate::kit::samples::inliers_of;
use epipole::math::{Line2, random::Random};
use epipole::robust::fit_line_total_least_squares;
use nalgebra::Point2;

/// Width of the plane of the points, pixels.
pub(crate) const WIDTH_PX: f64 = 640.0;
/// Height of the plane of the points, pixels.
pub(crate) const HEIGHT_PX: f64 = 400.0;
/// Decimals of point coordinates: tenths of a pixel.
pub(crate) const DIGITS: usize = 1;
/// Standard deviation of an inlier's distance from the hidden line, pixels.
const NOISE_PX: f64 = 4.0;

/// Inlier threshold on the distance from the line, pixels.
pub(crate) const EPSILON: Slider = Slider::new("epsilon", "Threshold ε")
    .range(2.0, 40.0, 1.0)
    .at(10.0)
    .unit("px");
/// Number of points, inliers and outliers.
pub(crate) const COUNT: Slider = Slider::new("points", "Number of points")
    .range(8.0, 120.0, 2.0)
    .at(60.0)
    .more();

/// Random points around a hidden line.
pub(crate) struct Scatter {
    pub(crate) truth: Line2,
    /// Points, inliers first.
    pub(crate) points: Vec<Point2<f64>>,
    pub(crate) num_outliers: usize,
    /// Region that contains about half of the outliers.
    pub(crate) region: Rect,
}

impl Scatter {
    /// Draws [`COUNT`] points with a figure's seed and outlier ratio.
    pub(crate) fn by(settings: &Settings, seed: &'static Slider, ratio: &'static Slider) -> Self {
        let (seed, count) = (settings.count(seed) as u64, settings.count(&COUNT));
        scatter(seed, count, settings.number(ratio))
    }
}

/// The region relative to the plane: left and upper edge, width and height.
const REGION: [f64; 4] = [0.55, 0.04, 0.42, 0.3];

/// Draws a hidden line and points. About half of the outliers are anywhere, the others in one
/// region on one side, like a repeated pattern.
///
/// * `outlier_ratio`: outliers among `count` points, 0 to 1
pub(crate) fn scatter(seed: u64, count: usize, outlier_ratio: f64) -> Scatter {
    let mut random = Random::new(seed);
    let num_outliers = (outlier_ratio * count as f64).round() as usize;
    let place = |u: f64, v: f64| {
        let keep = |value: f64, size: f64| round_to_digits(value.clamp(4.0, size - 4.0), DIGITS);
        Point2::new(keep(u, WIDTH_PX), keep(v, HEIGHT_PX))
    };
    let angle = random.uniform(-0.42, 0.42);
    let (cos, sin) = (libm::cos(angle), libm::sin(angle));
    let middle_v = HEIGHT_PX / 2.0 + random.uniform(-50.0, 50.0);
    let middle = Point2::new(WIDTH_PX / 2.0, middle_v);
    let truth = Line2 {
        a: -sin,
        b: cos,
        c: sin * middle.x - cos * middle.y,
    };
    let mut places = Vec::with_capacity(count);
    for _ in num_outliers..count {
        let along = random.uniform(-0.46, 0.46) * WIDTH_PX;
        let across = NOISE_PX * random.normal();
        places.push(place(
            middle.x + along * cos - across * sin,
            middle.y + along * sin + across * cos,
        ));
    }
    let [left, upper, wide, high] = REGION;
    for _ in 0..num_outliers {
        let (u, v) = (random.unit(), random.unit());
        let is_in_region = random.unit() < 0.5;
        let (u, v) = if is_in_region {
            (left + wide * u, upper + high * v)
        } else {
            (u, v)
        };
        let v = if is_in_region && sin < 0.0 {
            1.0 - v
        } else {
            v
        };
        places.push(place(u * WIDTH_PX, v * HEIGHT_PX));
    }
    // Moves the region to the side away from the line.
    let top = if sin < 0.0 { 1.0 - upper - high } else { upper };
    Scatter {
        truth,
        num_outliers,
        points: places,
        region: Rect::new(
            left * WIDTH_PX,
            top * HEIGHT_PX,
            wide * WIDTH_PX,
            high * HEIGHT_PX,
        ),
    }
}

/// A line and the points that vote for it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Consensus {
    pub(crate) line: Line2,
    pub(crate) is_inlier: Vec<bool>,
}

impl Consensus {
    pub(crate) fn of(line: Line2, places: &[Point2<f64>], epsilon_px: f64) -> Self {
        let is_near = |place: &Point2<f64>| line.signed_distance(place).abs() < epsilon_px;
        Self {
            line,
            is_inlier: places.iter().map(is_near).collect(),
        }
    }

    /// Refits the line to its inliers and keeps the votes. Keeps the sample's line if the inliers
    /// do not determine one.
    pub(crate) fn refitted(self, places: &[Point2<f64>]) -> Self {
        let voters = inliers_of(places, &self.is_inlier);
        Self {
            line: fit_line_total_least_squares(&voters).unwrap_or(self.line),
            ..self
        }
    }

    pub(crate) fn num_votes(&self) -> usize {
        self.is_inlier.iter().filter(|is| **is).count()
    }
}

/// Returns the acute angle between two lines, degrees.
pub(crate) fn angle_between_deg(one: &Line2, other: &Line2) -> f64 {
    let cross = one.a * other.b - one.b * other.a;
    let dot = one.a * other.a + one.b * other.b;
    libm::atan2(cross.abs(), dot.abs()).to_degrees()
}
