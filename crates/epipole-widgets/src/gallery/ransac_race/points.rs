//! Points near a hidden line, and outliers.

use crate::contract::round_to_digits;
use epipole::math::{Line2, random::Random};
use nalgebra::Point2;

/// The plane that the points lie in, pixels.
pub(super) const WIDTH_PX: f64 = 640.0;
/// The plane that the points lie in, pixels.
pub(super) const HEIGHT_PX: f64 = 400.0;
/// Places of points are kept to a tenth of a pixel.
pub(super) const DIGITS: usize = 1;
/// Standard deviation of a good point's distance from the hidden line.
const NOISE_PX: f64 = 4.0;

/// A point and where it came from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DataPoint {
    /// Number in its name, from 1.
    pub(super) number: usize,
    pub(super) place: Point2<f64>,
    /// Whether the reader has added it.
    pub(super) added: bool,
}

/// A hidden line and points, those near the line first. Half of the outliers lie anywhere, the others
/// in one region on one side, as a repeated pattern gives them.
///
/// * `outlier_ratio`: outliers among `count` points, 0 to 1
pub(super) fn scatter(seed: u64, count: usize, outlier_ratio: f64) -> (Line2, Vec<DataPoint>) {
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
    for _ in 0..num_outliers {
        let (u, v) = (random.unit(), random.unit());
        let is_in_region = random.unit() < 0.5;
        let (u, v) = if is_in_region {
            (0.55 + 0.42 * u, 0.04 + 0.3 * v)
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
    let point = |(index, place)| DataPoint {
        number: index + 1,
        place,
        added: false,
    };
    (truth, places.into_iter().enumerate().map(point).collect())
}
