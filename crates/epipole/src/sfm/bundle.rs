//! Bundle adjustment of pinhole cameras.

use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::optim::{
    BundleProblem, BundleStep, Iteration, LmOptions, LmReport, ObservationTerms, RobustLoss,
    SchurSystem, minimize,
};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Point3, Translation3, UnitQuaternion, Vector3};
use std::ops::ControlFlow;

/// A camera saw a point at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// Index of the camera.
    pub camera: usize,
    /// Index of the point.
    pub point: usize,
    /// Where it was seen, pixels.
    pub pixel: Point2<f64>,
}

/// Radial distortion: the normalized point p is moved to `(1 + k1 ‖p‖² + k2 ‖p‖⁴) p`.
///
/// Source: Brown 1971, "Close-range camera calibration", the first two radial terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadialDistortion {
    /// Factor of ‖p‖².
    pub k1: f64,
    /// Factor of ‖p‖⁴.
    pub k2: f64,
}

impl RadialDistortion {
    /// Whether the lens is a perfect pinhole.
    pub fn is_none(&self) -> bool {
        self.k1 == 0.0 && self.k2 == 0.0
    }

    /// Moves a normalized point (x/z, y/z) to where the lens shows it.
    pub fn distort(&self, normalized: &Point2<f64>) -> Point2<f64> {
        let r_sq = normalized.coords.norm_squared();
        normalized * (1.0 + r_sq * (self.k1 + r_sq * self.k2))
    }

    /// The normalized point that [`distort`](Self::distort) moves to `distorted`.
    ///
    /// Newton's method on the radius. Where the distortion is so strong that no radius or
    /// several fit, the result is the nearest stage of the search; it is always finite.
    pub fn undistort(&self, distorted: &Point2<f64>) -> Point2<f64> {
        let wanted = distorted.coords.norm();
        if self.is_none() || wanted == 0.0 {
            return *distorted;
        }
        let mut radius = wanted;
        for _ in 0..20 {
            let r_sq = radius * radius;
            let value = radius * (1.0 + r_sq * (self.k1 + r_sq * self.k2)) - wanted;
            let slope = 1.0 + r_sq * (3.0 * self.k1 + 5.0 * r_sq * self.k2);
            if slope < 0.1 {
                break;
            }
            let step = value / slope;
            radius = (radius - step).max(0.0);
            if step.abs() <= 1e-15 * wanted {
                break;
            }
        }
        distorted * (radius / wanted)
    }
}

/// The distortion's factor at a normalized point, and its Jacobian times the point.
pub(super) struct RadialTerms {
    pub(super) r_sq: f64,
    pub(super) factor: f64,
    /// ∂(factor p)/∂p.
    pub(super) jacobian: [[f64; 2]; 2],
}

#[inline]
pub(super) fn radial_terms(p: [f64; 2], k1: f64, k2: f64) -> RadialTerms {
    let [x, y] = p;
    let r_sq = x * x + y * y;
    let factor = 1.0 + r_sq * (k1 + r_sq * k2);
    let slope = 2.0 * (k1 + 2.0 * k2 * r_sq);
    RadialTerms {
        r_sq,
        factor,
        jacobian: [
            [factor + slope * x * x, slope * x * y],
            [slope * x * y, factor + slope * y * y],
        ],
    }
}

/// `exp(δ) R`; the very same bits for δ = 0, so that a held camera stays exactly.
pub(super) fn turned(rotation: &UnitQuaternion<f64>, delta: [f64; 3]) -> UnitQuaternion<f64> {
    if delta == [0.0; 3] {
        return *rotation;
    }
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from(delta));
    UnitQuaternion::new_normalize((turn * rotation).into_inner())
}

/// Cameras, points and observations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bundle {
    /// The cameras.
    pub cameras: Vec<Camera>,
    /// The lens distortion that all cameras share.
    pub distortion: RadialDistortion,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// What was seen where.
    pub observations: Vec<Observation>,
}

impl Bundle {
    /// Predicted minus observed pixel; not finite if the point is in the camera's center plane.
    pub fn residual_px(&self, observation: &Observation) -> Vector3<f64> {
        let camera = &self.cameras[observation.camera];
        let p = camera.cam_from_world * self.points[observation.point];
        let shown = self.distortion.distort(&Point2::new(p.x / p.z, p.y / p.z));
        let center = camera.intrinsics.principal_point();
        Vector3::new(
            camera.intrinsics.fu_px() * shown.x + center.x - observation.pixel.x,
            camera.intrinsics.fv_px() * shown.y + center.y - observation.pixel.y,
            p.z,
        )
    }
}

/// What keeps the reconstruction from drifting: position, orientation and scale of the world are
/// not observable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Gauge {
    /// The first camera and one coordinate of another one's translation are held fixed: exactly
    /// the seven free dimensions.
    #[default]
    TwoCameras,
    /// Nothing is fixed; damping alone keeps the solution in place.
    Free,
}

/// What to refine, and how.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BundleOptions {
    /// When to stop.
    pub lm: LmOptions,
    /// The loss of each reprojection error; its width is in pixels.
    pub loss: RobustLoss,
    /// Used only while fewer than two cameras are held.
    pub gauge: Gauge,
    /// Cameras that stay where they are, by index; missing entries are free.
    pub held_cameras: Vec<bool>,
    /// Points that stay where they are, by index; missing entries are free.
    pub held_points: Vec<bool>,
    /// Refine one factor for all focal lengths.
    pub refine_focal: bool,
    /// Refine the shared radial distortion.
    pub refine_distortion: bool,
}

/// Checks that observations refer to existing cameras and points and are finite.
pub(super) fn observation_pairs(
    observations: &[Observation],
    num_cameras: usize,
    num_points: usize,
) -> Result<Vec<(u32, u32)>> {
    if observations.is_empty() {
        return Err(Error::TooFew {
            what: "a bundle adjustment from observations",
            needed: 1,
            got: 0,
        });
    }
    observations
        .iter()
        .map(|o| {
            if o.camera >= num_cameras || o.point >= num_points {
                return Err(Error::OutOfRange {
                    what: "an observation's camera or point",
                    requirement: "the index of an existing one",
                    value: if o.camera >= num_cameras {
                        o.camera as f64
                    } else {
                        o.point as f64
                    },
                });
            }
            if !(o.pixel.x.is_finite() && o.pixel.y.is_finite()) {
                return Err(Error::NotFinite {
                    what: "an observation's pixel",
                });
            }
            Ok((o.camera as u32, o.point as u32))
        })
        .collect()
}

#[derive(Clone)]
struct CameraState {
    rotation: UnitQuaternion<f64>,
    matrix: Matrix3<f64>,
    translation: Vector3<f64>,
}

#[derive(Clone)]
struct State {
    cameras: Vec<CameraState>,
    /// Factor of all focal lengths, k1, k2.
    shared: [f64; 3],
    points: Vec<Point3<f64>>,
}

impl State {
    fn new(bundle: &Bundle) -> Self {
        let cameras = bundle
            .cameras
            .iter()
            .map(|camera| CameraState {
                rotation: camera.cam_from_world.rotation,
                matrix: *camera.cam_from_world.rotation.to_rotation_matrix().matrix(),
                translation: camera.cam_from_world.translation.vector,
            })
            .collect();
        Self {
            cameras,
            shared: [1.0, bundle.distortion.k1, bundle.distortion.k2],
            points: bundle.points.clone(),
        }
    }
}

struct Problem<'a> {
    cameras: &'a [Camera],
    observations: &'a [Observation],
    pairs: Vec<(u32, u32)>,
    num_points: usize,
    options: &'a BundleOptions,
    held_cameras: Vec<[bool; 6]>,
}

impl BundleProblem<6, 3> for Problem<'_> {
    type Parameters = State;

    fn num_cameras(&self) -> usize {
        self.cameras.len()
    }
    fn num_points(&self) -> usize {
        self.num_points
    }
    fn observations(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn loss(&self) -> RobustLoss {
        self.options.loss
    }
    fn held_camera(&self, camera: usize) -> [bool; 6] {
        self.held_cameras[camera]
    }
    fn held_shared(&self) -> [bool; 3] {
        let (focal, distortion) = (self.options.refine_focal, self.options.refine_distortion);
        [!focal, !distortion, !distortion]
    }
    fn held_point(&self, point: usize) -> bool {
        self.options
            .held_points
            .get(point)
            .copied()
            .unwrap_or(false)
    }

    fn residual(&self, state: &State, observation: usize) -> [f64; 2] {
        let o = &self.observations[observation];
        let (camera, intrinsics) = (&state.cameras[o.camera], &self.cameras[o.camera].intrinsics);
        let p = camera.matrix * state.points[o.point].coords + camera.translation;
        let (x, y) = (p.x / p.z, p.y / p.z);
        let [focal, k1, k2] = state.shared;
        let r_sq = x * x + y * y;
        let factor = focal * (1.0 + r_sq * (k1 + r_sq * k2));
        let center = intrinsics.principal_point();
        [
            factor * intrinsics.fu_px() * x + center.x - o.pixel.x,
            factor * intrinsics.fv_px() * y + center.y - o.pixel.y,
        ]
    }

    fn linearize(&self, state: &State, observation: usize) -> ObservationTerms<6, 3> {
        let o = &self.observations[observation];
        let (camera, intrinsics) = (&state.cameras[o.camera], &self.cameras[o.camera].intrinsics);
        let rotated = camera.matrix * state.points[o.point].coords;
        let p = rotated + camera.translation;
        let normalized = [p.x / p.z, p.y / p.z];
        let [x, y] = normalized;
        let [focal, k1, k2] = state.shared;
        let radial = radial_terms(normalized, k1, k2);
        let center = intrinsics.principal_point();
        let focals = [intrinsics.fu_px(), intrinsics.fv_px()];
        let seen = [o.pixel.x - center.x, o.pixel.y - center.y];
        let mut terms = ObservationTerms {
            residual: [0.0; 2],
            camera: [[0.0; 6]; 2],
            shared: [[0.0; 3]; 2],
            point: [[0.0; 3]; 2],
        };
        for row in 0..2 {
            let f = focals[row] * focal;
            terms.residual[row] = f * radial.factor * normalized[row] - seen[row];
            // ∂p/∂P = 1/z [1 0 −x; 0 1 −y], with x and y after the division.
            let (a, b) = (f * radial.jacobian[row][0], f * radial.jacobian[row][1]);
            let by_p = Vector3::new(a / p.z, b / p.z, -(a * x + b * y) / p.z);
            // exp(δ) R X moves by δ × R X, and g · (δ × q) = δ · (q × g).
            let by_rotation = rotated.cross(&by_p);
            let by_point = camera.matrix.tr_mul(&by_p);
            terms.camera[row][..3].copy_from_slice(by_rotation.as_slice());
            terms.camera[row][3..].copy_from_slice(by_p.as_slice());
            terms.shared[row] = [
                focals[row] * radial.factor * normalized[row],
                f * radial.r_sq * normalized[row],
                f * radial.r_sq * radial.r_sq * normalized[row],
            ];
            terms.point[row].copy_from_slice(by_point.as_slice());
        }
        terms
    }

    fn step(&self, from: &State, step: &BundleStep<6, 3>, into: &mut State) {
        for ((old, new), d) in from
            .cameras
            .iter()
            .zip(&mut into.cameras)
            .zip(&step.cameras)
        {
            new.rotation = turned(&old.rotation, [d[0], d[1], d[2]]);
            new.matrix = *new.rotation.to_rotation_matrix().matrix();
            new.translation = old.translation + Vector3::new(d[3], d[4], d[5]);
        }
        for k in 0..3 {
            into.shared[k] = from.shared[k] + step.shared[k];
        }
        for ((old, new), d) in from.points.iter().zip(&mut into.points).zip(&step.points) {
            *new = old + Vector3::from(*d);
        }
    }

    fn parameter_norm(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for camera in &state.cameras {
            sum += 1.0 + camera.translation.norm_squared();
        }
        sum += state
            .points
            .iter()
            .map(|p| p.coords.norm_squared())
            .sum::<f64>();
        sum.sqrt()
    }
}

/// Which degrees of freedom of each camera are held.
fn held_freedoms(bundle: &Bundle, options: &BundleOptions) -> Vec<[bool; 6]> {
    let is_held = |i: usize| options.held_cameras.get(i).copied().unwrap_or(false);
    let mut held: Vec<[bool; 6]> = (0..bundle.cameras.len()).map(|i| [is_held(i); 6]).collect();
    let num_held = held.iter().filter(|h| h[0]).count();
    let point_held = options.held_points.iter().any(|&h| h);
    if options.gauge == Gauge::Free || num_held >= 2 || point_held {
        return held;
    }
    let mut seen = vec![false; bundle.cameras.len()];
    for o in &bundle.observations {
        seen[o.camera] = true;
    }
    let Some(anchor) = (0..held.len())
        .find(|&i| held[i][0])
        .or_else(|| (0..held.len()).find(|&i| seen[i]))
    else {
        return held;
    };
    held[anchor] = [true; 6];
    let origin = bundle.cameras[anchor].center_in_world();
    let mut farthest = (0.0, None);
    for (i, camera) in bundle.cameras.iter().enumerate() {
        let distance = (camera.center_in_world() - origin).norm();
        if i != anchor && seen[i] && distance > farthest.0 {
            farthest = (distance, Some(i));
        }
    }
    if let Some(other) = farthest.1 {
        // A change of scale moves this camera's translation along R (C − C₀).
        let camera = &bundle.cameras[other];
        let slide = camera.cam_from_world.rotation * (camera.center_in_world() - origin);
        held[other][3 + slide.iamax()] = true;
    }
    held
}

/// Refines cameras, points and, if wanted, a common focal length and lens distortion, in place:
/// minimizes `½ Σ ρ(‖predicted − observed‖²)`, in square pixels.
///
/// * `observer`: called once before the first step and after every step; answer
///   [`ControlFlow::Break`] to cancel; the bundle is then the best found so far
///
/// Cameras and points without observations stay where they are.
///
/// # Errors
/// [`Error::TooFew`] without observations, [`Error::OutOfRange`] if an observation refers to a
/// camera or point that is not there, [`Error::NotFinite`] if a pixel or the cost at the start is
/// not finite, or the loss has no positive width.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis"; the gauge by two cameras
/// is its §9.
pub fn adjust_bundle(
    bundle: &mut Bundle,
    options: &BundleOptions,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<LmReport> {
    if !options.loss.is_valid() {
        return Err(Error::NotFinite {
            what: "the inverse of the width of a robust loss",
        });
    }
    let pairs = observation_pairs(
        &bundle.observations,
        bundle.cameras.len(),
        bundle.points.len(),
    )?;
    let mut state = State::new(bundle);
    let problem = Problem {
        cameras: &bundle.cameras,
        observations: &bundle.observations,
        pairs,
        num_points: bundle.points.len(),
        options,
        held_cameras: held_freedoms(bundle, options),
    };
    let mut system = SchurSystem::new(&problem);
    let report = minimize(&mut system, &mut state, &options.lm, observer)?;
    let [focal, k1, k2] = state.shared;
    let mut cameras = bundle.cameras.clone();
    for (camera, new) in cameras.iter_mut().zip(&state.cameras) {
        camera.cam_from_world =
            RigidTransform::from_parts(Translation3::from(new.translation), new.rotation);
        if options.refine_focal {
            let center = camera.intrinsics.principal_point();
            camera.intrinsics = Intrinsics::new(
                camera.intrinsics.fu_px() * focal,
                camera.intrinsics.fv_px() * focal,
                center.x,
                center.y,
            )?;
        }
    }
    bundle.cameras = cameras;
    bundle.points = state.points;
    bundle.distortion = RadialDistortion { k1, k2 };
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::look_at;
    use crate::math::random::Random;
    use crate::optim::{Termination, check_jacobian};
    use nalgebra::{DMatrix, DVector};

    /// Cameras on an arc look at a ball of points.
    fn arc(num_cameras: usize, num_points: usize, distortion: RadialDistortion) -> Bundle {
        let mut random = Random::new(21);
        let mut bundle = Bundle {
            distortion,
            ..Bundle::default()
        };
        let up = Vector3::new(0.0, -1.0, 0.0);
        for i in 0..num_cameras {
            let (s, c) = libm::sincos(0.15 * i as f64);
            let center = Point3::new(6.0 * s, 0.2 * i as f64, -6.0 * c);
            bundle.cameras.push(Camera {
                intrinsics: Intrinsics::centered(800.0, 640, 480).unwrap(),
                cam_from_world: look_at(&center, &Point3::origin(), &up).unwrap(),
            });
        }
        for _ in 0..num_points {
            let mut coordinate = || random.uniform(-1.5, 1.5);
            bundle
                .points
                .push(Point3::new(coordinate(), coordinate(), coordinate()));
        }
        for camera in 0..num_cameras {
            for point in 0..num_points {
                let mut o = Observation {
                    camera,
                    point,
                    pixel: Point2::origin(),
                };
                let r = bundle.residual_px(&o);
                o.pixel = Point2::new(r.x, r.y);
                bundle.observations.push(o);
            }
        }
        bundle
    }

    fn disturb(bundle: &mut Bundle, amount: f64) {
        let mut random = Random::new(22);
        for camera in bundle.cameras.iter_mut().skip(1) {
            let turn = Vector3::from_fn(|_, _| amount * random.normal());
            let shift = Vector3::from_fn(|_, _| amount * random.normal());
            camera.cam_from_world = RigidTransform::new(shift, turn) * camera.cam_from_world;
        }
        for point in &mut bundle.points {
            *point += Vector3::from_fn(|_, _| amount * random.normal());
        }
    }

    fn go_on(_: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn exact() -> LmOptions {
        LmOptions {
            cost_tolerance: 0.0,
            max_iterations: 100,
            ..LmOptions::default()
        }
    }

    #[test]
    fn jacobians_are_those_of_central_differences() {
        let distortion = RadialDistortion { k1: -0.1, k2: 0.03 };
        let mut bundle = arc(3, 5, distortion);
        disturb(&mut bundle, 0.02);
        let options = BundleOptions {
            refine_focal: true,
            refine_distortion: true,
            ..BundleOptions::default()
        };
        let problem = Problem {
            cameras: &bundle.cameras,
            observations: &bundle.observations,
            pairs: observation_pairs(&bundle.observations, 3, 5).unwrap(),
            num_points: 5,
            options: &options,
            held_cameras: vec![[false; 6]; 3],
        };
        let state = State::new(&bundle);
        for (index, o) in bundle.observations.iter().enumerate() {
            let terms = problem.linearize(&state, index);
            let mut analytic = DMatrix::zeros(2, 12);
            for row in 0..2 {
                for (column, value) in terms.camera[row]
                    .iter()
                    .chain(&terms.shared[row])
                    .chain(&terms.point[row])
                    .enumerate()
                {
                    analytic[(row, column)] = *value;
                }
            }
            let residuals = |d: &DVector<f64>| {
                let d = d.as_slice();
                let mut step = BundleStep {
                    cameras: vec![[0.0; 6]; 3],
                    shared: [d[6], d[7], d[8]],
                    points: vec![[0.0; 3]; 5],
                };
                step.cameras[o.camera].copy_from_slice(&d[..6]);
                step.points[o.point].copy_from_slice(&d[9..]);
                let mut moved = state.clone();
                problem.step(&state, &step, &mut moved);
                DVector::from_row_slice(&problem.residual(&moved, index))
            };
            assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
        }
    }

    #[test]
    fn two_cameras_fix_the_gauge_and_the_truth_is_found() {
        let mut bundle = arc(5, 50, RadialDistortion::default());
        let truth = bundle.clone();
        disturb(&mut bundle, 0.02);
        // Give the far camera back the coordinate that holds the scale.
        bundle.cameras[4] = truth.cameras[4];
        let options = BundleOptions {
            lm: exact(),
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < 1e-15, "{report:?}");
        assert_eq!(bundle.cameras[0], truth.cameras[0]);
        for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
            let error = (got.center_in_world() - want.center_in_world()).norm();
            assert!(error < 1e-8, "{error}");
        }
        for (got, want) in bundle.points.iter().zip(&truth.points) {
            assert!((got - want).norm() < 1e-8);
        }
    }

    #[test]
    fn a_shared_focal_length_and_distortion_are_refined() {
        let distortion = RadialDistortion {
            k1: -0.08,
            k2: 0.02,
        };
        let mut bundle = arc(6, 80, distortion);
        bundle.distortion = RadialDistortion::default();
        for camera in &mut bundle.cameras {
            camera.intrinsics = Intrinsics::centered(830.0, 640, 480).unwrap();
        }
        disturb(&mut bundle, 0.01);
        let options = BundleOptions {
            lm: exact(),
            refine_focal: true,
            refine_distortion: true,
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < 1e-12, "{report:?}");
        assert!((bundle.cameras[3].intrinsics.fu_px() - 800.0).abs() < 1e-4);
        assert!((bundle.distortion.k1 + 0.08).abs() < 1e-6);
        assert!((bundle.distortion.k2 - 0.02).abs() < 1e-5);
    }

    #[test]
    fn held_cameras_and_points_stay() {
        let mut bundle = arc(4, 20, RadialDistortion::default());
        disturb(&mut bundle, 0.01);
        let before = bundle.clone();
        let options = BundleOptions {
            held_cameras: vec![false, true, true],
            held_points: vec![true, true],
            ..BundleOptions::default()
        };
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).unwrap();
        assert!(report.final_cost < report.initial_cost);
        assert_eq!(bundle.cameras[1], before.cameras[1]);
        assert_eq!(bundle.cameras[2], before.cameras[2]);
        assert_ne!(bundle.cameras[0], before.cameras[0]);
        assert_eq!(bundle.points[..2], before.points[..2]);
    }

    #[test]
    fn cancelling_leaves_the_best_so_far() {
        let mut bundle = arc(4, 20, RadialDistortion::default());
        disturb(&mut bundle, 0.02);
        let mut stop = |i: &Iteration| {
            if i.index == 1 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let report = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut stop).unwrap();
        assert_eq!(report.termination, Termination::Cancelled);
        let sum: f64 = bundle
            .observations
            .iter()
            .map(|o| 0.5 * bundle.residual_px(o).xy().norm_squared())
            .sum();
        assert!((sum - report.final_cost).abs() <= 1e-9 * sum);
        assert!(report.final_cost < report.initial_cost);
    }

    #[test]
    fn bad_observations_are_refused() {
        let good = arc(2, 8, RadialDistortion::default());
        let options = BundleOptions::default();
        let mut none = good.clone();
        none.observations.clear();
        assert!(matches!(
            adjust_bundle(&mut none, &options, &mut go_on),
            Err(Error::TooFew { .. })
        ));
        let mut beyond = good.clone();
        beyond.observations[3].point = 8;
        assert!(matches!(
            adjust_bundle(&mut beyond, &options, &mut go_on),
            Err(Error::OutOfRange { value: 8.0, .. })
        ));
        let mut nan = good.clone();
        nan.observations[3].pixel.x = f64::NAN;
        assert!(matches!(
            adjust_bundle(&mut nan, &options, &mut go_on),
            Err(Error::NotFinite { .. })
        ));
    }

    #[test]
    fn undistorting_undoes_distorting() {
        let lens = RadialDistortion { k1: -0.2, k2: 0.05 };
        for (x, y) in [(0.0, 0.0), (0.3, -0.2), (0.7, 0.6)] {
            let p = Point2::new(x, y);
            assert!((lens.undistort(&lens.distort(&p)) - p).norm() < 1e-14);
        }
        let absurd = RadialDistortion { k1: -50.0, k2: 0.0 };
        let p = absurd.undistort(&Point2::new(3.0, 4.0));
        assert!(p.x.is_finite() && p.y.is_finite());
    }
}
