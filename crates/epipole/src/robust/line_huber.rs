//! Line fit with Huber's loss, which bounds the pull of outliers.

use super::fit_line_total_least_squares;
use crate::Result;
use crate::math::Line2;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Point2, SVector, Vector2};

/// Fits the line that minimizes `½ Σ ρ(e²)` over the points, where e is the distance in pixels and
/// ρ is [`RobustLoss::Huber`].
///
/// The minimum is that of Levenberg–Marquardt from the least-squares line. A point farther off than
/// `width_px` pulls with a constant force, so a single outlier has limited effect; many consistent
/// outliers, or one with a long lever far along the line, can still corrupt the fit.
///
/// * `points`: at least two, pixels
/// * `width_px`: distances up to this count as in least squares; 1.345 times the standard deviation
///   of the noise loses 5 % of its efficiency
///
/// # Errors
/// As [`fit_line_total_least_squares`], and [`Error::OutOfRange`](crate::Error::OutOfRange) for a
/// width that [`RobustLoss::check`] rejects.
///
/// Source: Huber 1964, "Robust estimation of a location parameter"; Zhang 1997, "Parameter
/// estimation techniques: a tutorial with application to conic fitting", §9.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{fit_line_huber, fit_line_total_least_squares};
/// use nalgebra::Point2;
/// // Eleven points of the row v = 0, and one far above the middle.
/// let mut points: Vec<_> = (-5..=5).map(|k| Point2::new(2.0 * f64::from(k), 0.0)).collect();
/// points.push(Point2::new(0.0, 12.0));
/// let offset = |line: epipole::math::Line2| (-line.c / line.b).abs();
/// assert!((offset(fit_line_total_least_squares(&points)?) - 1.0).abs() < 1e-9);
/// // The force of the outlier, 0.5, is spread over eleven points.
/// assert!((offset(fit_line_huber(&points, 0.5)?) - 0.5 / 11.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn fit_line_huber(points: &[Point2<f64>], width_px: f64) -> Result<Line2> {
    let loss = RobustLoss::Huber { width: width_px };
    loss.check()?;
    let start = fit_line_total_least_squares(points)?;
    let weight = 1.0 / points.len() as f64;
    let middle = points
        .iter()
        .map(|p| p.coords * weight)
        .sum::<Vector2<f64>>();
    let problem = HuberLine {
        points,
        middle,
        loss,
    };
    let mut line = start;
    minimize_fixed(&problem, &mut line, &LmOptions::default())?;
    Ok(line)
}

struct HuberLine<'a> {
    points: &'a [Point2<f64>],
    /// The line rotates about its point nearest to this one, so that rotation and shift are nearly
    /// independent.
    middle: Vector2<f64>,
    loss: RobustLoss,
}

impl FixedProblem<2> for HuberLine<'_> {
    type Parameters = Line2;

    fn accumulate(&self, line: &Line2, normal: &mut NormalEquations<2>) {
        for point in self.points {
            let away = point.coords - self.middle;
            let by_angle = line.a * away.y - line.b * away.x;
            let jacobian = SVector::<f64, 2>::new(by_angle, 1.0);
            normal.add_scalar(line.signed_distance(point), &jacobian, &self.loss);
        }
    }

    fn cost(&self, line: &Line2) -> f64 {
        let distances = self.points.iter().map(|point| line.signed_distance(point));
        distances.map(|e| 0.5 * self.loss.rho(e * e)).sum()
    }

    fn plus(&self, line: &Line2, delta: &SVector<f64, 2>) -> Line2 {
        let (sin, cos) = libm::sincos(delta[0]);
        let (a, b) = (line.a * cos - line.b * sin, line.a * sin + line.b * cos);
        let from_middle = line.a * self.middle.x + line.b * self.middle.y + line.c + delta[1];
        Line2 {
            a,
            b,
            c: from_middle - (a * self.middle.x + b * self.middle.y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn cloud(seed: u64, num_outliers: usize) -> Vec<Point2<f64>> {
        let mut random = Random::new(seed);
        (0..40)
            .map(|i| {
                let u = random.uniform(0.0, 600.0);
                let off = match i < num_outliers {
                    true => random.uniform(40.0, 200.0),
                    false => 2.0 * random.normal(),
                };
                Point2::new(u, 0.3 * u + 50.0 + off)
            })
            .collect()
    }

    #[test]
    fn no_line_nearby_costs_less() {
        let loss = RobustLoss::Huber { width: 2.69 };
        for seed in 0..20 {
            let points = cloud(seed, 8);
            let line = fit_line_huber(&points, 2.69).unwrap();
            let problem = HuberLine {
                points: &points,
                middle: Vector2::new(300.0, 140.0),
                loss,
            };
            let best = problem.cost(&line);
            for (angle_rad, shift) in [(1e-4, 0.0), (-1e-4, 0.0), (0.0, 0.03), (0.0, -0.03)] {
                let other = problem.plus(&line, &SVector::<f64, 2>::new(angle_rad, shift));
                assert!(problem.cost(&other) > best, "{seed} {angle_rad} {shift}");
            }
        }
    }

    #[test]
    fn outliers_on_one_side_pull_less_than_in_least_squares() {
        let angle = libm::atan(0.3);
        for seed in 0..20 {
            let points = cloud(seed, 8);
            let middle = |line: &Line2| line.signed_distance(&Point2::new(300.0, 140.0)).abs();
            let huber = fit_line_huber(&points, 2.69).unwrap();
            let squares = fit_line_total_least_squares(&points).unwrap();
            assert!(middle(&huber) < 0.3 * middle(&squares), "{seed}");
            assert!((huber.angle_rad() - angle).abs() < 0.03, "{seed}");
        }
    }

    #[test]
    fn without_outliers_it_is_least_squares() {
        let points = cloud(3, 0);
        let (huber, squares) = (
            fit_line_huber(&points, 1e3).unwrap(),
            fit_line_total_least_squares(&points).unwrap(),
        );
        let same = huber.homogeneous() - squares.homogeneous();
        assert!(same.norm() < 1e-6, "{same}");
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_cost() {
        let points = cloud(5, 4);
        let problem = HuberLine {
            points: &points,
            middle: Vector2::new(300.0, 140.0),
            loss: RobustLoss::Trivial,
        };
        let line = fit_line_total_least_squares(&points).unwrap();
        let mut normal = NormalEquations::new();
        problem.accumulate(&line, &mut normal);
        for axis in 0..2 {
            let step = SVector::<f64, 2>::ith(axis, 1e-6);
            let ahead = problem.cost(&problem.plus(&line, &step));
            let back = problem.cost(&problem.plus(&line, &-step));
            let slope = (ahead - back) / 2e-6;
            let scale = 1.0 + normal.gradient[axis].abs();
            assert!(
                (slope - normal.gradient[axis]).abs() < 1e-3 * scale,
                "{slope}"
            );
        }
    }

    #[test]
    fn bad_points_and_widths_are_refused() {
        let points = cloud(1, 2);
        for width_px in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(fit_line_huber(&points, width_px).is_err(), "{width_px}");
        }
        assert!(fit_line_huber(&points[..1], 1.0).is_err());
        assert!(fit_line_huber(&[Point2::new(f64::NAN, 0.0); 3], 1.0).is_err());
        assert!(fit_line_huber(&[Point2::new(1.0, 1.0); 9], 1.0).is_err());
    }
}
