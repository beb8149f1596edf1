//! Straight lines: least squares, and the estimator for RANSAC.

use super::{Data, Estimator, Problem, Unique};
use crate::math::Line2;
use crate::{Error, Result};
use nalgebra::Point2;

/// Fits the line with the smallest sum of squared distances to the points.
///
/// It passes through the centroid along the direction of the largest spread: the normal (a, b)
/// belongs to the smaller eigenvalue of the scatter matrix `Σ (p − p̄)(p − p̄)ᵀ`. Distances are
/// perpendicular to the line, not along v, so vertical lines are no special case. A single outlier
/// biases the line; see [`LineEstimator`] for data with outliers.
///
/// * `points`: at least two, pixels
///
/// # Errors
/// [`Error::TooFew`] for fewer than two points, [`Error::NotFinite`] for NaN and infinities,
/// [`Error::Degenerate`] if all points are equal or spread equally in all directions, as the
/// corners of a square do.
///
/// Source: Pearson 1901, "On lines and planes of closest fit to systems of points in space".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::fit_line_total_least_squares;
/// use nalgebra::Point2;
/// let points = [(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)].map(|(u, v)| Point2::new(u, v));
/// let line = fit_line_total_least_squares(&points)?; // v = 2 u + 1
/// assert!((-line.a / line.b - 2.0).abs() < 1e-12);
/// assert!((-line.c / line.b - 1.0).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn fit_line_total_least_squares(points: &[Point2<f64>]) -> Result<Line2> {
    check_points(points)?;
    fit(points.len(), |i| points[i])
}

const NOT_FINITE: Error = Error::NotFinite {
    what: "a point of a line",
};

fn check_number(num_points: usize) -> Result<()> {
    if num_points < 2 {
        return Err(Error::TooFew {
            what: "a line through points",
            needed: 2,
            got: num_points,
        });
    }
    Ok(())
}

fn check_points(points: &[Point2<f64>]) -> Result<()> {
    check_number(points.len())?;
    if points.iter().all(|p| p.x.is_finite() && p.y.is_finite()) {
        Ok(())
    } else {
        Err(NOT_FINITE)
    }
}

fn fit(num_points: usize, point: impl Fn(usize) -> Point2<f64>) -> Result<Line2> {
    let degenerate = |why| Error::Degenerate {
        what: "a line through points",
        why,
    };
    let weight = 1.0 / num_points as f64;
    let (mut mean_u, mut mean_v) = (0.0, 0.0);
    for i in 0..num_points {
        let p = point(i);
        mean_u += p.x * weight;
        mean_v += p.y * weight;
    }
    // Deviations relative to the largest: squares of huge or tiny coordinates stay finite.
    let reach = (0..num_points).fold(0.0_f64, |reach, i| {
        let p = point(i);
        reach.max((p.x - mean_u).abs()).max((p.y - mean_v).abs())
    });
    if !reach.is_finite() {
        return Err(Error::NotFinite {
            what: "the extent of the points of a line",
        });
    }
    let rounding = 4.0 * f64::EPSILON * (mean_u.abs() + mean_v.abs());
    if reach <= rounding || reach <= f64::MIN_POSITIVE {
        return Err(degenerate("all points are equal"));
    }
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for i in 0..num_points {
        let p = point(i);
        let (du, dv) = ((p.x - mean_u) / reach, (p.y - mean_v) / reach);
        uu += du * du;
        uv += du * dv;
        vv += dv * dv;
    }
    // Eigenvalues are (uu + vv ± gap)/2 with gap = hypot(uu − vv, 2 uv).
    let (difference, mixed) = (uu - vv, 2.0 * uv);
    let gap = (difference * difference + mixed * mixed).sqrt();
    if gap <= 1e-12 * (uu + vv) {
        return Err(degenerate("the points spread equally in all directions"));
    }
    // The eigenvector of the larger eigenvalue, from the row that does not cancel.
    let (along_u, along_v) = if difference >= 0.0 {
        (gap + difference, mixed)
    } else {
        (mixed, gap - difference)
    };
    let length = (along_u * along_u + along_v * along_v).sqrt();
    let (a, b) = (-along_v / length, along_u / length);
    Ok(Line2 {
        a,
        b,
        c: -(a * mean_u + b * mean_v),
    })
}

/// Estimator of lines from points with outliers, for [`Ransac`](super::Ransac).
///
/// A sample is two points; refinement is total least squares over the inliers. Equal points
/// count once.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{LineEstimator, RansacOptions, ransac};
/// use nalgebra::Point2;
/// let points: Vec<_> = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (0.0, 30.0)]
///     .map(|(u, v)| Point2::new(u, v)).into();
/// let report = ransac(LineEstimator::new(&points)?, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.inliers, [true, true, true, true, false]);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct LineEstimator {
    /// Unique points.
    points: Vec<Point2<f64>>,
    unique: Unique,
}

impl LineEstimator {
    /// Prepares the estimation from points, pixels.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two points, not counting points at infinity, which are
    /// ignored; [`Error::NotFinite`] for NaN, [`Error::Degenerate`] if all points are equal.
    pub fn new(points: &[Point2<f64>]) -> Result<Self> {
        if points.iter().any(|p| p.x.is_nan() || p.y.is_nan()) {
            return Err(NOT_FINITE);
        }
        let unique = Unique::of_usable(points.len(), |i| {
            let values = [points[i].x, points[i].y];
            values.iter().all(|x| x.is_finite()).then_some(values)
        });
        check_number(points.len() - unique.num_left_out())?;
        if unique.len() < 2 {
            return Err(Error::Degenerate {
                what: "a line through points",
                why: "all points are equal",
            });
        }
        let different = unique.first_occurrences().iter().map(|&i| points[i]);
        Ok(Self {
            points: different.collect(),
            unique,
        })
    }
}

impl Estimator for LineEstimator {
    type Model = Line2;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a line through points",
            sample_size: 2,
            max_models: 1,
            codimension: 1,
            data: Data::Pixels {
                pixels: &self.points,
                unique: &self.unique,
            },
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Line2>) {
        models.extend(Line2::through(
            &self.points[sample[0]],
            &self.points[sample[1]],
        ));
    }

    fn error_sq(&self, line: &Line2, index: usize) -> f64 {
        let distance = line.signed_distance(&self.points[index]);
        distance * distance
    }

    fn refine(&mut self, _: &Line2, inliers: &[usize], _: f64) -> Option<Line2> {
        fit(inliers.len(), |i| self.points[inliers[i]]).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{RansacOptions, ScoreKind, ransac};
    use super::*;
    use crate::math::random::Random;

    fn points(coordinates: &[(f64, f64)]) -> Vec<Point2<f64>> {
        coordinates
            .iter()
            .map(|&(u, v)| Point2::new(u, v))
            .collect()
    }

    #[test]
    fn least_squares_of_a_vertical_line() {
        let line =
            fit_line_total_least_squares(&points(&[(3.0, 0.0), (3.0, 5.0), (3.0, -2.0)])).unwrap();
        assert!((line.a.abs() - 1.0).abs() < 1e-15 && line.b.abs() < 1e-15);
        assert!((line.c / line.a + 3.0).abs() < 1e-14);
    }

    #[test]
    fn least_squares_minimizes_the_distances() {
        let mut random = Random::new(2);
        let cloud: Vec<_> = (0..50)
            .map(|_| Point2::new(random.uniform(0.0, 90.0), random.uniform(0.0, 40.0)))
            .collect();
        let cost = |line: &Line2| -> f64 {
            cloud
                .iter()
                .map(|p| line.signed_distance(p) * line.signed_distance(p))
                .sum()
        };
        let best = fit_line_total_least_squares(&cloud).unwrap();
        for (angle_rad, shift) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-2), (0.0, -1e-2)] {
            let (sin, cos) = libm::sincos(angle_rad);
            let (a, b) = (best.a * cos - best.b * sin, best.a * sin + best.b * cos);
            let other = Line2 {
                a,
                b,
                c: best.c + shift,
            };
            assert!(cost(&other) > cost(&best));
        }
    }

    #[test]
    fn huge_and_tiny_coordinates_stay_finite() {
        for scale in [1e-150, 1.0, 1e150] {
            let cloud = points(&[(0.0, 0.0), (scale, scale), (2.0 * scale, 2.0 * scale)]);
            let line = fit_line_total_least_squares(&cloud).unwrap();
            assert!((line.angle_rad() - core::f64::consts::FRAC_PI_4).abs() < 1e-12);
        }
        let huge = points(&[(f64::MAX, 0.0), (-f64::MAX, 0.0), (f64::MAX, 1.0)]);
        if let Ok(line) = fit_line_total_least_squares(&huge) {
            assert!(line.a.is_finite() && line.b.is_finite() && line.c.is_finite());
        }
    }

    #[test]
    fn degenerate_points_are_refused() {
        let refused = [
            points(&[]),
            points(&[(1.0, 2.0)]),
            points(&[(0.1, 0.2), (0.1, 0.2), (0.1, 0.2)]),
            points(&[(f64::NAN, 0.0), (1.0, 1.0), (2.0, 2.0)]),
            points(&[(0.0, 0.0), (1.0, f64::INFINITY)]),
        ];
        for cloud in &refused {
            assert!(fit_line_total_least_squares(cloud).is_err(), "{cloud:?}");
            assert!(LineEstimator::new(cloud).is_err(), "{cloud:?}");
        }
        let square = points(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)]);
        assert!(matches!(
            fit_line_total_least_squares(&square),
            Err(Error::Degenerate { .. })
        ));
    }

    /// openMVG's src/openMVG/robust_estimation/robust_estimator_Ransac_test.cpp: five points on a
    /// line and one off it.
    #[test]
    fn one_outlier_is_found_exactly() {
        let cloud = points(&[
            (1.0, 2.0),
            (2.0, 4.0),
            (3.0, 6.0),
            (4.0, 8.0),
            (5.0, 10.0),
            (100.0, -123.0),
        ]);
        for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
            let options = RansacOptions {
                max_error_px: 0.3,
                score,
                ..RansacOptions::default()
            };
            let report = ransac(LineEstimator::new(&cloud).unwrap(), &options, &mut ()).unwrap();
            assert_eq!(report.inliers, [true, true, true, true, true, false]);
            assert!((report.model.angle_rad() - libm::atan(2.0)).abs() < 1e-12);
            assert!((report.score - 5.0).abs() < 1e-12);
        }
    }

    /// The same source: 30 % of the points moved far off; the number of inliers is exact.
    #[test]
    fn thirty_percent_outliers_are_counted_exactly() {
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let cloud: Vec<_> = (0..100)
                .map(|i| {
                    let u = f64::from(i);
                    let off = if i % 10 < 3 {
                        random.uniform(5.0, 100.0) * if i % 2 == 0 { 1.0 } else { -1.0 }
                    } else {
                        0.0
                    };
                    Point2::new(u, 2.0 * u + 6.3 + off)
                })
                .collect();
            let options = RansacOptions {
                max_error_px: 0.3,
                seed,
                ..RansacOptions::default()
            };
            let report = ransac(LineEstimator::new(&cloud).unwrap(), &options, &mut ()).unwrap();
            assert_eq!(report.num_inliers, 70);
            assert!((-report.model.a / report.model.b - 2.0).abs() < 1e-9);
            assert!((-report.model.c / report.model.b - 6.3).abs() < 1e-9);
        }
    }

    #[test]
    fn repeated_points_do_not_outvote_the_line() {
        let mut cloud = points(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]);
        cloud.extend(vec![Point2::new(0.0, 9.0); 50]);
        let report = ransac(
            LineEstimator::new(&cloud).unwrap(),
            &RansacOptions::default(),
            &mut (),
        )
        .unwrap();
        assert_eq!(report.num_inliers, 4);
        assert_eq!(report.num_unique_inliers, 4);
        assert!(report.inliers[..4].iter().all(|&inlier| inlier));
    }
}
