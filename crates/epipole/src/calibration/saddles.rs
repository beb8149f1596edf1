//! Saddle points where two dark and two bright quadrants meet.

use crate::feature::non_maximum_suppression;
use crate::imaging::{Border, GrayImage32, from_vec, gaussian_blur, sample_bilinear};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use nalgebra::{Point2, Vector2};

/// A candidate corner of a chessboard.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saddle {
    pub(super) place: Point2<f64>,
    /// Unit vectors along the two edges. The quadrant from the first to the second, clockwise in
    /// the image, is dark.
    pub(super) edges: [Vector2<f64>; 2],
}

/// Initial blur, pixels: noise and JPEG blocks create saddles.
const SIGMA_PX: f64 = 1.4;
/// Radii of the circles on which a corner must show four quadrants, pixels. The first fits into a
/// square of 9 pixels.
const RADII_PX: [f64; 2] = [4.0, 6.0];
const SAMPLES: usize = 48;
/// Minimum difference between bright and dark, of a range of 1.
const LEAST_CONTRAST: f64 = 0.06;
/// Maximum difference of opposite squares, relative to the contrast.
const MOST_UNEVEN: f64 = 0.3;
/// Minimum response, relative to that of a sharp corner of full contrast after the blur.
const MIN_RATIO: f32 = 2e-4;

/// The image in which to find corners.
pub(super) struct SaddleImage {
    blurred: GrayImage32,
}

impl SaddleImage {
    pub(super) fn new(image: &GrayImage32, monitor: &mut dyn Monitor) -> Result<Self> {
        let part = &mut Part::new(monitor, 0.0, 1.0).of_stage(Stage::FeatureDetection);
        Ok(Self {
            blurred: gaussian_blur(image, SIGMA_PX, Border::Replicate, part)?,
        })
    }

    /// Finds all corners.
    pub(super) fn find(&self, monitor: &mut dyn Monitor) -> Result<Vec<Saddle>> {
        let (width, height) = self.blurred.dimensions();
        if width < 5 || height < 5 {
            return Ok(Vec::new());
        }
        let (w, h) = (width as usize, height as usize);
        let values = self.blurred.as_raw();
        // −det of the Hessian: positive only at saddles.
        let mut response = vec![0.0_f32; values.len()];
        for v in 1..h - 1 {
            for u in 1..w - 1 {
                let at = v * w + u;
                let uu = values[at - 1] - 2.0 * values[at] + values[at + 1];
                let vv = values[at - w] - 2.0 * values[at] + values[at + w];
                let uv = 0.25
                    * (values[at - w - 1] - values[at - w + 1] - values[at + w - 1]
                        + values[at + w + 1]);
                response[at] = uv * uv - uu * vv;
            }
        }
        let strongest = response.iter().fold(0.0_f32, |most, r| most.max(*r));
        let response = from_vec(width, height, response);
        let threshold = (0.01 * strongest).max(MIN_RATIO * 0.02);
        let part = &mut Part::new(monitor, 0.0, 0.4);
        let peaks = non_maximum_suppression(&response, 2, threshold, part)?;
        let mut saddles: Vec<Saddle> = Vec::new();
        for (k, peak) in peaks.iter().enumerate() {
            let fraction = 0.4 + 0.6 * k as f32 / peaks.len() as f32;
            report(monitor, Stage::FeatureDetection, fraction)?;
            if let Some(saddle) = self.examine(&peak.point())
                && !saddles
                    .iter()
                    .any(|other| (other.place - saddle.place).norm() < 2.5)
            {
                saddles.push(saddle);
            }
        }
        Ok(saddles)
    }

    /// Returns the corner near a position, if there is one.
    pub(super) fn examine(&self, near: &Point2<f64>) -> Option<Saddle> {
        let place = self.saddle_point(near)?;
        let edges = RADII_PX.map(|radius| self.quadrants(&place, radius));
        // The smaller circle must show a corner; the larger one gives more accurate edges, if the
        // squares are large enough.
        let small = edges[0]?;
        let agree =
            |large: &[Vector2<f64>; 2]| (0..2).all(|i| large[i].dot(&small[i]).abs() > 0.94);
        let edges = edges[1].filter(agree).unwrap_or(small);
        Some(Saddle { place, edges })
    }

    /// Returns whether only the four squares are within a radius: the edge of an object in front of
    /// them would displace the corner.
    pub(super) fn is_clear(&self, place: &Point2<f64>, radius: f64) -> bool {
        let Some([a, b]) = self.quadrants(place, radius) else {
            return false;
        };
        let at = |direction: Vector2<f64>| {
            let p = place + direction.normalize() * radius;
            f64::from(sample_bilinear(&self.blurred, p.x, p.y, Border::Replicate))
        };
        let (dark, bright) = ([at(a + b), at(-a - b)], [at(a - b), at(b - a)]);
        let contrast = 0.5 * (bright[0] + bright[1] - dark[0] - dark[1]);
        let off = (dark[0] - dark[1]).abs().max((bright[0] - bright[1]).abs());
        off < MOST_UNEVEN * contrast
    }

    /// Returns the saddle point of the quadratic that best fits the 5 × 5 pixels around a position.
    fn saddle_point(&self, near: &Point2<f64>) -> Option<Point2<f64>> {
        let mut place = *near;
        for _ in 0..4 {
            // The sums of a least-squares quadratic over a square are separable.
            let mut sums = [0.0; 6];
            for j in -2..=2 {
                for i in -2..=2 {
                    let (x, y) = (f64::from(i), f64::from(j));
                    let value = f64::from(sample_bilinear(
                        &self.blurred,
                        place.x + x,
                        place.y + y,
                        Border::Replicate,
                    ));
                    sums[0] += value * x;
                    sums[1] += value * y;
                    sums[2] += value * (x * x - 2.0);
                    sums[3] += value * (y * y - 2.0);
                    sums[4] += value * x * y;
                }
            }
            let (gu, gv) = (sums[0] / 50.0, sums[1] / 50.0);
            let (uu, vv, uv) = (sums[2] / 35.0, sums[3] / 35.0, sums[4] / 100.0);
            let determinant = uu * vv - uv * uv;
            if determinant >= 0.0 {
                return None;
            }
            let step = Vector2::new(uv * gv - vv * gu, uv * gu - uu * gv) / determinant;
            // Also false for NaN.
            let is_near = step.norm() < 3.0;
            if !is_near {
                return None;
            }
            place += step;
            if (place - near).norm() > 4.0 {
                return None;
            }
            if step.norm() < 0.05 {
                break;
            }
        }
        Some(place)
    }

    /// Returns the two edges through a position, if a circle around it crosses four quadrants.
    fn quadrants(&self, place: &Point2<f64>, radius: f64) -> Option<[Vector2<f64>; 2]> {
        let margin = radius + 1.0;
        let (width, height) = self.blurred.dimensions();
        if place.x < margin
            || place.y < margin
            || place.x > f64::from(width) - 1.0 - margin
            || place.y > f64::from(height) - 1.0 - margin
        {
            return None;
        }
        let angle = |i: f64| core::f64::consts::TAU * i / SAMPLES as f64;
        let values: [f64; SAMPLES] = core::array::from_fn(|i| {
            let (sine, cosine) = libm::sincos(angle(i as f64));
            f64::from(sample_bilinear(
                &self.blurred,
                place.x + radius * cosine,
                place.y + radius * sine,
                Border::Replicate,
            ))
        });
        let (least, most) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                (a.min(*v), b.max(*v))
            });
        if most - least < LEAST_CONTRAST {
            return None;
        }
        // The gray value of the corner itself is midway between bright and dark under any
        // illumination.
        let center = f64::from(sample_bilinear(
            &self.blurred,
            place.x,
            place.y,
            Border::Replicate,
        ));
        let level = 0.5 * center + 0.25 * (least + most);
        let mut crossings = Vec::new();
        for i in 0..SAMPLES {
            let (here, next) = (values[i] - level, values[(i + 1) % SAMPLES] - level);
            if (here < 0.0) != (next < 0.0) {
                crossings.push((i as f64 + here / (here - next), here < 0.0));
            }
        }
        if crossings.len() != 4 {
            return None;
        }
        // Opposite edges must be opposite, within some 25°.
        let half = SAMPLES as f64 / 2.0;
        let mut lines = [(0.0, false); 2];
        for (line, i) in lines.iter_mut().zip(0..2) {
            let (a, rises) = crossings[i];
            let off = crossings[i + 2].0 - half - a;
            if off.abs() > SAMPLES as f64 * 0.07 {
                return None;
            }
            *line = (a + 0.5 * off, rises);
        }
        let gap = lines[1].0 - lines[0].0;
        // Quadrants of less than about 22° cannot be measured.
        if !(SAMPLES as f64 * 0.06..=half - SAMPLES as f64 * 0.06).contains(&gap) {
            return None;
        }
        let direction = |line: f64| {
            let (sine, cosine) = libm::sincos(angle(line));
            Vector2::new(cosine, sine)
        };
        let [a, b] = lines.map(|(line, _)| direction(line));
        // The dark quadrant follows a line where the gray value falls; angles grow clockwise, since
        // v points down.
        Some(if lines[0].1 { [b, -a] } else { [a, b] })
    }
}

/// Rejects images outside [0, 1], the range of the threshold on brightness differences.
pub(super) fn check_range(image: &GrayImage32) -> Result<()> {
    match image.as_raw().iter().find(|v| !(-0.5..=1.5).contains(*v)) {
        Some(value) if value.is_finite() => Err(Error::OutOfRange {
            what: "the gray values of a board image",
            requirement: "from 0 to 1",
            value: f64::from(*value),
        }),
        Some(_) => Err(Error::NotFinite {
            what: "every pixel of an image",
        }),
        None => Ok(()),
    }
}
