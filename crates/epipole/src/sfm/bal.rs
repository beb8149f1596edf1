//! Bundle adjustment in the large: the text format of published problems, and their solution.

use super::bundle::{Observation, observation_pairs, radial_terms, turned};
use super::tokens::Tokens;
use crate::Result;
use crate::optim::{
    BundleProblem, BundleStep, Iteration, LmOptions, LmReport, ObservationTerms, RobustLoss,
    SchurSystem, minimize,
};
use nalgebra::{Matrix3, Point2, Point3, UnitQuaternion, Vector3};
use std::fmt::Write;
use std::ops::ControlFlow;

/// The camera of the format: it looks along −z, and its image has the origin in the middle and v
/// up.
///
/// `P = R X + t`, `p = −(P.x, P.y)/P.z`, `pixel = f (1 + k1 ‖p‖² + k2 ‖p‖⁴) p`.
///
/// Source: Agarwal, Snavely, Seitz & Szeliski 2010, "Bundle adjustment in the large".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BalCamera {
    /// Axis times angle of R, radians.
    pub rotation: Vector3<f64>,
    /// t.
    pub translation: Vector3<f64>,
    /// f, pixels.
    pub focal_px: f64,
    /// Radial distortion of second order.
    pub k1: f64,
    /// Radial distortion of fourth order.
    pub k2: f64,
}

/// A bundle adjustment problem: cameras, points and what was seen where.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::optim::RobustLoss;
/// use epipole::sfm::BalProblem;
/// // One camera at the origin with f = 100 sees a point at (1, 2, −10), 1 px too far right.
/// let text = "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n";
/// let problem = BalProblem::parse(text)?;
/// assert_eq!(problem.cost(RobustLoss::Trivial), 0.5);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BalProblem {
    /// The cameras.
    pub cameras: Vec<BalCamera>,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// The observations; their pixels have the origin in the middle of the image and v up.
    pub observations: Vec<Observation>,
}

const WHAT: &str = "the bundle adjustment problem";

impl BalProblem {
    /// Reads the format: numbers of cameras, points and observations; then one observation a line
    /// (camera, point, u, v); then nine numbers a camera (rotation, translation, f, k1, k2); then
    /// three a point.
    ///
    /// # Errors
    /// [`Malformed`](crate::Error::Malformed) with the line, if words are missing, left over, not
    /// finite, or index
    /// what is not there.
    pub fn parse(text: &str) -> Result<Self> {
        let mut tokens = Tokens::new(WHAT, text);
        let limit = u32::MAX as usize;
        let num_cameras = tokens.index("the number of cameras", limit)?;
        let num_points = tokens.index("the number of points", limit)?;
        let num_observations = tokens.index("the number of observations", limit)?;
        // A header may promise anything; room is made for what the text can hold.
        let room = |promised: usize| promised.min(text.len() / 2);
        let mut problem = Self {
            cameras: Vec::with_capacity(room(num_cameras)),
            points: Vec::with_capacity(room(num_points)),
            observations: Vec::with_capacity(room(num_observations)),
        };
        for _ in 0..num_observations {
            problem.observations.push(Observation {
                camera: tokens.index("an observation's camera", num_cameras)?,
                point: tokens.index("an observation's point", num_points)?,
                pixel: Point2::new(
                    tokens.number("an observation's u")?,
                    tokens.number("an observation's v")?,
                ),
            });
        }
        for _ in 0..num_cameras {
            let mut v = [0.0; 9];
            for value in &mut v {
                *value = tokens.number("a camera's parameter")?;
            }
            problem.cameras.push(BalCamera {
                rotation: Vector3::new(v[0], v[1], v[2]),
                translation: Vector3::new(v[3], v[4], v[5]),
                focal_px: v[6],
                k1: v[7],
                k2: v[8],
            });
        }
        for _ in 0..num_points {
            let mut v = [0.0; 3];
            for value in &mut v {
                *value = tokens.number("a point's coordinate")?;
            }
            problem.points.push(Point3::from(v));
        }
        tokens.end()?;
        Ok(problem)
    }

    /// Writes the format; numbers have as many digits as they need to be read back unchanged.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{} {} {}",
            self.cameras.len(),
            self.points.len(),
            self.observations.len()
        );
        for o in &self.observations {
            let _ = writeln!(
                text,
                "{} {} {:e} {:e}",
                o.camera, o.point, o.pixel.x, o.pixel.y
            );
        }
        for camera in &self.cameras {
            for value in camera.rotation.iter().chain(&camera.translation) {
                let _ = writeln!(text, "{value:e}");
            }
            let _ = writeln!(
                text,
                "{:e}\n{:e}\n{:e}",
                camera.focal_px, camera.k1, camera.k2
            );
        }
        for point in &self.points {
            let _ = writeln!(text, "{:e}\n{:e}\n{:e}", point.x, point.y, point.z);
        }
        text
    }

    /// The cost `½ Σ ρ(‖r‖²)` over all observations, those of points behind their camera included.
    ///
    /// Infinite or NaN if a point lies in the center plane of a camera that sees it.
    pub fn cost(&self, loss: RobustLoss) -> f64 {
        let state = State::new(self);
        let mut sum = 0.0;
        for o in &self.observations {
            let [u, v] = state.residual(o);
            sum += loss.rho(u * u + v * v);
        }
        0.5 * sum
    }
}

#[derive(Clone)]
struct CameraState {
    rotation: UnitQuaternion<f64>,
    matrix: Matrix3<f64>,
    translation: Vector3<f64>,
    intrinsics: [f64; 3],
}

#[derive(Clone)]
struct State {
    cameras: Vec<CameraState>,
    points: Vec<Point3<f64>>,
}

impl State {
    fn new(problem: &BalProblem) -> Self {
        let cameras = problem
            .cameras
            .iter()
            .map(|camera| {
                let rotation = UnitQuaternion::from_scaled_axis(camera.rotation);
                CameraState {
                    rotation,
                    matrix: *rotation.to_rotation_matrix().matrix(),
                    translation: camera.translation,
                    intrinsics: [camera.focal_px, camera.k1, camera.k2],
                }
            })
            .collect();
        Self {
            cameras,
            points: problem.points.clone(),
        }
    }

    #[inline]
    fn residual(&self, o: &Observation) -> [f64; 2] {
        let camera = &self.cameras[o.camera];
        let p = camera.matrix * self.points[o.point].coords + camera.translation;
        let (x, y) = (-p.x / p.z, -p.y / p.z);
        let [focal, k1, k2] = camera.intrinsics;
        let r_sq = x * x + y * y;
        let scale = focal * (1.0 + r_sq * (k1 + r_sq * k2));
        [scale * x - o.pixel.x, scale * y - o.pixel.y]
    }
}

struct Problem<'a> {
    observations: &'a [Observation],
    pairs: Vec<(u32, u32)>,
    num_cameras: usize,
    num_points: usize,
    loss: RobustLoss,
}

impl BundleProblem<9, 0> for Problem<'_> {
    type Parameters = State;

    fn num_cameras(&self) -> usize {
        self.num_cameras
    }
    fn num_points(&self) -> usize {
        self.num_points
    }
    fn observations(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn loss(&self) -> RobustLoss {
        self.loss
    }
    fn residual(&self, state: &State, observation: usize) -> [f64; 2] {
        state.residual(&self.observations[observation])
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<9, 0> {
        let o = &self.observations[observation];
        let camera = &state.cameras[o.camera];
        let rotated = camera.matrix * state.points[o.point].coords;
        let p = rotated + camera.translation;
        let [focal, k1, k2] = camera.intrinsics;
        let normalized = [-p.x / p.z, -p.y / p.z];
        let radial = radial_terms(normalized, k1, k2);
        let [x, y] = normalized;
        let mut terms = ObservationTerms {
            residual: [
                focal * radial.factor * x - o.pixel.x,
                focal * radial.factor * y - o.pixel.y,
            ],
            camera: [[0.0; 9]; 2],
            shared: [[], []],
            point: [[0.0; 3]; 2],
        };
        for row in 0..2 {
            // ∂p/∂P = −1/z [1 0 x; 0 1 y], with x and y after the division.
            let (a, b) = (
                focal * radial.jacobian[row][0],
                focal * radial.jacobian[row][1],
            );
            let by_p = Vector3::new(-a / p.z, -b / p.z, -(a * x + b * y) / p.z);
            // exp(δ) R X moves by δ × R X, and g · (δ × q) = δ · (q × g).
            let by_rotation = rotated.cross(&by_p);
            let by_point = camera.matrix.tr_mul(&by_p);
            terms.camera[row][..3].copy_from_slice(by_rotation.as_slice());
            terms.camera[row][3..6].copy_from_slice(by_p.as_slice());
            terms.camera[row][6] = radial.factor * normalized[row];
            terms.camera[row][7] = focal * radial.r_sq * normalized[row];
            terms.camera[row][8] = focal * radial.r_sq * radial.r_sq * normalized[row];
            terms.point[row].copy_from_slice(by_point.as_slice());
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<9, 0>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            new.rotation = turned(&old.rotation, [d[0], d[1], d[2]]);
            new.matrix = *new.rotation.to_rotation_matrix().matrix();
            new.translation = old.translation + Vector3::new(d[3], d[4], d[5]);
            for k in 0..3 {
                new.intrinsics[k] = old.intrinsics[k] + d[6 + k];
            }
        }
        for ((old, new), d) in from.points.iter().zip(&mut into.points).zip(&step.points) {
            *new = old + Vector3::from(*d);
        }
    }

    fn parameter_norm(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for camera in &state.cameras {
            sum += 1.0 + camera.translation.norm_squared();
            sum += camera.intrinsics.iter().map(|x| x * x).sum::<f64>();
        }
        sum += state
            .points
            .iter()
            .map(|p| p.coords.norm_squared())
            .sum::<f64>();
        sum.sqrt()
    }
}

/// Refines all cameras and points of a problem, in place.
///
/// * `loss`: its width is in pixels
/// * `observer`: called once before the first step and after every step; answer
///   [`ControlFlow::Break`] to cancel; the problem is then the best found so far
///
/// Every observation counts, those of points behind their camera too, so that costs can be
/// compared.
///
/// # Errors
/// [`TooFew`](crate::Error::TooFew) without observations, [`OutOfRange`](crate::Error::OutOfRange) if
/// an observation refers to a camera or point that is not there, or for a loss that
/// [`RobustLoss::check`] refuses, [`NotFinite`](crate::Error::NotFinite) if the cost at the start is
/// not finite.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis".
pub fn adjust_bal(
    problem: &mut BalProblem,
    options: &LmOptions,
    loss: RobustLoss,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<LmReport> {
    loss.check()?;
    let pairs = observation_pairs(
        &problem.observations,
        problem.cameras.len(),
        problem.points.len(),
    )?;
    let mut state = State::new(problem);
    let bundle = Problem {
        observations: &problem.observations,
        pairs,
        num_cameras: problem.cameras.len(),
        num_points: problem.points.len(),
        loss,
    };
    let mut system = SchurSystem::new(&bundle);
    let report = minimize(&mut system, &mut state, options, observer)?;
    for (camera, new) in problem.cameras.iter_mut().zip(&state.cameras) {
        camera.rotation = new.rotation.scaled_axis();
        camera.translation = new.translation;
        [camera.focal_px, camera.k1, camera.k2] = new.intrinsics;
    }
    problem.points = state.points;
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    /// Cameras around a ball of points; every point is seen by every camera.
    fn ring(num_cameras: usize, num_points: usize, noise_px: f64, seed: u64) -> BalProblem {
        let mut random = Random::new(seed);
        let mut problem = BalProblem::default();
        for i in 0..num_cameras {
            let turn = Vector3::new(0.1 * random.normal(), 0.3 * i as f64, 0.1 * random.normal());
            problem.cameras.push(BalCamera {
                rotation: turn,
                translation: Vector3::new(0.0, 0.1, -6.0),
                focal_px: 500.0 + 5.0 * i as f64,
                k1: 0.01,
                k2: -0.002,
            });
        }
        for _ in 0..num_points {
            let mut coordinate = || random.uniform(-1.0, 1.0);
            problem
                .points
                .push(Point3::new(coordinate(), coordinate(), coordinate()));
        }
        let state = State::new(&problem);
        for camera in 0..num_cameras {
            for point in 0..num_points {
                let mut o = Observation {
                    camera,
                    point,
                    pixel: Point2::origin(),
                };
                let [u, v] = state.residual(&o);
                o.pixel = Point2::new(
                    u + noise_px * random.normal(),
                    v + noise_px * random.normal(),
                );
                problem.observations.push(o);
            }
        }
        problem
    }

    fn disturb(problem: &mut BalProblem, amount: f64, seed: u64) {
        let mut random = Random::new(seed);
        for camera in &mut problem.cameras {
            camera.rotation += Vector3::from_fn(|_, _| amount * random.normal());
            camera.translation += Vector3::from_fn(|_, _| amount * random.normal());
            camera.focal_px += 100.0 * amount * random.normal();
        }
        for point in &mut problem.points {
            *point += Vector3::from_fn(|_, _| amount * random.normal());
        }
    }

    fn go_on(_: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    #[test]
    fn jacobians_are_those_of_central_differences() {
        let mut problem = ring(3, 4, 0.0, 1);
        disturb(&mut problem, 0.05, 2);
        let state = State::new(&problem);
        let pairs = observation_pairs(&problem.observations, 3, 4).unwrap();
        let bundle = Problem {
            observations: &problem.observations,
            pairs,
            num_cameras: 3,
            num_points: 4,
            loss: RobustLoss::Trivial,
        };
        for (index, o) in problem.observations.iter().enumerate() {
            let terms = bundle.linearize(&state, index);
            let mut analytic = DMatrix::zeros(2, 12);
            for row in 0..2 {
                for c in 0..9 {
                    analytic[(row, c)] = terms.camera[row][c];
                }
                for k in 0..3 {
                    analytic[(row, 9 + k)] = terms.point[row][k];
                }
            }
            let residuals = |d: &DVector<f64>| {
                let mut step = BundleStep {
                    cameras: vec![[0.0; 9]; 3],
                    shared: [],
                    points: vec![[0.0; 3]; 4],
                };
                step.cameras[o.camera].copy_from_slice(&d.as_slice()[..9]);
                step.points[o.point].copy_from_slice(&d.as_slice()[9..]);
                let mut moved = state.clone();
                bundle.step(&state, &step, &mut moved);
                DVector::from_row_slice(&bundle.residual(&moved, index))
            };
            assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
            assert_eq!(terms.residual, bundle.residual(&state, index));
        }
    }

    #[test]
    fn exact_data_are_met_exactly() {
        let mut problem = ring(5, 60, 0.0, 3);
        disturb(&mut problem, 0.02, 4);
        assert!(problem.cost(RobustLoss::Trivial) > 1e3);
        let options = LmOptions {
            max_iterations: 100,
            cost_tolerance: 0.0,
            ..LmOptions::default()
        };
        let report = adjust_bal(&mut problem, &options, RobustLoss::Trivial, &mut go_on).unwrap();
        assert!(report.final_cost < 1e-15, "{report:?}");
        let again = problem.cost(RobustLoss::Trivial);
        assert!(again < 1e-15, "{again}");
    }

    #[test]
    fn noise_leaves_what_statistics_predicts() {
        let mut problem = ring(6, 200, 0.5, 5);
        disturb(&mut problem, 0.01, 6);
        let report = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut go_on,
        )
        .unwrap();
        // E[½ Σ r²] = ½ σ² (residuals − parameters + 7 of the gauge).
        let freedom = (2 * 6 * 200 - 9 * 6 - 3 * 200 + 7) as f64;
        let expected = 0.5 * 0.25 * freedom;
        assert!(
            (report.final_cost / expected - 1.0).abs() < 0.1,
            "{report:?} {expected}"
        );
    }

    #[test]
    fn the_robust_cost_falls_monotonically_beside_outliers() {
        let mut problem = ring(5, 80, 0.3, 7);
        let truth = problem.clone();
        for o in problem.observations.iter_mut().step_by(17) {
            o.pixel.x += 60.0;
        }
        disturb(&mut problem, 0.005, 8);
        let loss = RobustLoss::Cauchy { width: 1.0 };
        let mut costs = Vec::new();
        let report = adjust_bal(&mut problem, &LmOptions::default(), loss, &mut |i| {
            costs.push(i.cost);
            ControlFlow::Continue(())
        })
        .unwrap();
        assert!(costs.windows(2).all(|pair| pair[1] <= pair[0]));
        assert!((problem.cost(loss) - report.final_cost).abs() < 1e-9 * report.final_cost);
        // Without the outliers the refined cameras explain what the true ones do.
        problem.observations = truth.observations.clone();
        let clean = problem.cost(RobustLoss::Trivial);
        assert!(clean < 1.5 * truth.cost(RobustLoss::Trivial), "{clean}");
    }

    #[test]
    fn cameras_and_points_without_observations_stay() {
        let mut problem = ring(4, 30, 0.2, 9);
        let mut lonely = problem.cameras[0];
        lonely.focal_px = 777.0;
        problem.cameras.push(lonely);
        problem.points.push(Point3::new(5.0, 6.0, 7.0));
        let report = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut go_on,
        )
        .unwrap();
        assert!(report.termination.is_converged(), "{report:?}");
        assert_eq!(problem.cameras[4].focal_px, 777.0);
        assert_eq!(problem.points[30], Point3::new(5.0, 6.0, 7.0));
    }

    #[test]
    fn the_text_is_read_back_unchanged() {
        let problem = ring(3, 5, 0.7, 10);
        let text = problem.to_text();
        assert_eq!(BalProblem::parse(&text).unwrap(), problem);
    }

    #[test]
    fn malformed_texts_name_the_line() {
        let good = "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n";
        assert!(BalProblem::parse(good).is_ok());
        for (bad, line, why) in [
            ("", 1, "ends"),
            ("1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2\n", 4, "ends"),
            ("1 1 1\n0 0 11 nan\n", 2, "not finite"),
            ("1 1 1\n0 0 eleven 20\n", 2, "not a number"),
            ("1 1 1\n1 0 11 20\n", 2, "less than 1"),
            ("1 1 1\n0 -1 11 20\n", 2, "whole"),
            (
                "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n7\n",
                5,
                "should end",
            ),
            ("99999999 9 4000000000\n", 1, "ends"),
        ] {
            match BalProblem::parse(bad) {
                Err(Error::Malformed {
                    line: got,
                    why: said,
                    ..
                }) => {
                    assert_eq!(got, line, "{bad:?}");
                    assert!(said.contains(why), "{said}");
                }
                other => panic!("{bad:?} gave {other:?}"),
            }
        }
    }

    #[test]
    fn a_point_in_the_center_plane_is_an_error() {
        let mut problem =
            BalProblem::parse("1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 0\n").unwrap();
        let result = adjust_bal(
            &mut problem,
            &LmOptions::default(),
            RobustLoss::Trivial,
            &mut go_on,
        );
        assert!(matches!(result, Err(Error::NotFinite { .. })));
    }
}
