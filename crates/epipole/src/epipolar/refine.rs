//! Nonlinear refinement of F and E: the Sampson error by Levenberg–Marquardt.

use super::coordinates::{CommonFrame, Coordinates};
use super::from_cameras::unit_norm;
use super::sampson::{EntrySums, cost, linearize};
use super::{RelativePose, enforce_rank2};
use crate::camera::{Intrinsics, cross_matrix};
use crate::math::svd3;
use crate::math::svd3::perpendicular;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use crate::robust::MatchSet;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Rotation3, SMatrix, SVector, Vector3};

/// The fundamental matrix near `fundamental` that minimizes `½ Σ ρ(e²)` over the matches, where e is
/// the Sampson error in pixels.
///
/// F is kept on the seven-dimensional set `U diag(1, σ, 0) Vᵀ` throughout.
///
/// * `fundamental`: a start, from [`fundamental_8point`](super::fundamental_8point) for instance
/// * `loss`: its width is in pixels
///
/// # Errors
/// [`Error::TooFew`] for fewer than 7 different matches, [`Error::Degenerate`] for a start of
/// rank 1 or 0, [`Error::OutOfRange`] for a loss that [`RobustLoss::check`] refuses,
/// [`Error::NotFinite`] for a start whose error is not a number at some match, and as
/// [`MatchSet::new`]; infinities and coordinates beyond 10⁹ pixels are refused, as every match counts.
///
/// Source: Bartoli & Sturm 2004, "Nonlinear estimation of the fundamental matrix with minimal
/// parameters" (the parameters); Hartley & Zisserman 2004, §11.4.3 (the error).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{fundamental_8point, refine_fundamental, sampson_sq};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Matrix3, Point2, Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // Half a pixel of noise, up and down by turns.
/// let p2: Vec<_> = p2.iter().enumerate().map(|(i, p)| Point2::new(p.x, p.y + if i % 3 == 0 { 0.5 } else { -0.5 })).collect();
/// let cost = |f: &Matrix3<f64>| p1.iter().zip(&p2).map(|(a, b)| sampson_sq(f, a, b)).sum::<f64>();
/// let linear = fundamental_8point(&p1, &p2)?;
/// let refined = refine_fundamental(&linear, &p1, &p2, RobustLoss::Trivial)?;
/// assert!(cost(&refined) < cost(&linear));
/// assert!(refined.determinant().abs() < 1e-15);
/// # Ok(()) }
/// ```
pub fn refine_fundamental(
    fundamental: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    loss: RobustLoss,
) -> Result<Matrix3<f64>> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    enough(&matches, 7, "a refined fundamental matrix")?;
    loss.check()?;
    let frame = CommonFrame::new(&matches);
    let coordinates = Coordinates::pixels(&matches).mapped(&frame);
    let start = frame.fundamental_to_frame(&unit_norm(fundamental)?);
    let singular = svd3(&start).singular_values;
    if singular[1] <= 1e-14 * singular[0] {
        return Err(Error::Degenerate {
            what: "a refined fundamental matrix",
            why: "the start has rank 1",
        });
    }
    let refined = refine_in_frame(
        &coordinates,
        &start,
        scaled(loss, frame.scale),
        &LmOptions::default(),
    )
    .ok_or(NO_ERROR_AT_THE_START)?;
    unit_norm(&frame.fundamental_to_pixels(&refined))
}

/// The relative pose near `pose` that minimizes `½ Σ ρ(e²)` over the matches, where e is the Sampson
/// error in pixels.
///
/// The rotation and the direction of the translation, five parameters, are refined.
///
/// # Errors
/// [`Error::TooFew`] for fewer than 5 different matches, [`Error::OutOfRange`] for a loss that
/// [`RobustLoss::check`] refuses, [`Error::NotFinite`] for a start whose error is not a number at some
/// match, and as [`MatchSet::new`]; infinities and coordinates beyond 10⁹ pixels are refused, as every match
/// counts.
///
/// Source: Hartley & Zisserman 2004, §11.4.3, with `E = [t]ₓR` instead of F.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{RelativePose, refine_relative_pose};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // A start that is off by 0.05 rad and looks straight to the side.
/// let start = RigidTransform::new(Vector3::new(-1.0, 0.0, 0.0), Vector3::new(0.0, 0.05, 0.0));
/// let start = RelativePose::from_motion(&start, &k, &k)?;
/// let refined = refine_relative_pose(&start, &p1, &p2, &k, &k, RobustLoss::Trivial)?.cam2_from_cam1();
/// assert!(refined.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-6);
/// assert!((refined.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn refine_relative_pose(
    pose: &RelativePose,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    loss: RobustLoss,
) -> Result<RelativePose> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    enough(&matches, 5, "a refined relative pose")?;
    loss.check()?;
    let frame = CommonFrame::new(&matches);
    let coordinates = Coordinates::pixels(&matches).mapped(&frame);
    let rays = RaysInFrame::new(&frame, k1, k2);
    let (rotation, direction) = refine_pose_in_frame(
        &coordinates,
        &rays,
        pose,
        scaled(loss, frame.scale),
        &LmOptions::default(),
    )
    .ok_or(NO_ERROR_AT_THE_START)?;
    RelativePose::checked(rotation, direction, k1, k2)
}

/// Everything else was looked at before the refinement began.
const NO_ERROR_AT_THE_START: Error = Error::NotFinite {
    what: "the Sampson error of every match at the start",
};

fn enough(matches: &MatchSet, needed: usize, what: &'static str) -> Result<()> {
    if matches.len() < needed {
        return Err(Error::TooFew {
            what,
            needed,
            got: matches.len(),
        });
    }
    Ok(())
}

/// The same loss for residuals that are `factor` times as large.
pub(crate) fn scaled(loss: RobustLoss, factor: f64) -> RobustLoss {
    match loss {
        RobustLoss::Trivial => loss,
        RobustLoss::Huber { width } => RobustLoss::Huber {
            width: width * factor,
        },
        RobustLoss::Cauchy { width } => RobustLoss::Cauchy {
            width: width * factor,
        },
        RobustLoss::Truncated { width } => RobustLoss::Truncated {
            width: width * factor,
        },
    }
}

/// `Dᵀ H D` and `Dᵀ g`, where the columns of D are the derivatives of F's entries.
pub(crate) fn project<const P: usize>(
    sums: &EntrySums,
    derivatives: &SMatrix<f64, 9, P>,
    normal: &mut NormalEquations<P>,
) {
    normal.cost += sums.cost;
    normal.gradient += derivatives.transpose() * sums.gradient;
    normal.hessian += derivatives.transpose() * (sums.hessian * derivatives);
}

/// Entries row by row.
fn flatten(m: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|i, _| m[(i / 3, i % 3)])
}

/// `F = U diag(1, σ, 0) Vᵀ`, with U and V rotations up to sign.
#[derive(Debug, Clone)]
pub(crate) struct Factored {
    u: Matrix3<f64>,
    v: Matrix3<f64>,
    sigma: f64,
}

impl Factored {
    pub(crate) fn new(f: &Matrix3<f64>) -> Option<Self> {
        let svd = svd3(f);
        let sigma = svd.singular_values[1] / svd.singular_values[0];
        sigma.is_finite().then_some(Self {
            u: svd.u,
            v: svd.v,
            sigma,
        })
    }

    pub(crate) fn matrix(&self) -> Matrix3<f64> {
        self.u.column(0) * self.v.column(0).transpose()
            + self.u.column(1) * self.v.column(1).transpose() * self.sigma
    }

    /// The derivatives of F's entries with respect to (rotation of U, rotation of V, σ), the
    /// rotations acting from the left: `U ← exp([δ]ₓ) U`.
    pub(crate) fn derivatives(&self) -> SMatrix<f64, 9, 7> {
        let f = self.matrix();
        let mut d = SMatrix::<f64, 9, 7>::zeros();
        for axis in 0..3 {
            let turn = cross_matrix(&Vector3::ith(axis, 1.0));
            d.set_column(axis, &flatten(&(turn * f)));
            d.set_column(3 + axis, &flatten(&(f * turn.transpose())));
        }
        d.set_column(
            6,
            &flatten(&(self.u.column(1) * self.v.column(1).transpose())),
        );
        d
    }

    pub(crate) fn plus(&self, delta: &SVector<f64, 7>) -> Self {
        let turn = |i: usize| {
            Rotation3::from_scaled_axis(Vector3::new(delta[i], delta[i + 1], delta[i + 2]))
                .into_inner()
        };
        Self {
            u: turn(0) * self.u,
            v: turn(3) * self.v,
            sigma: self.sigma + delta[6],
        }
    }
}

struct FundamentalProblem<'a> {
    coordinates: &'a Coordinates,
    loss: RobustLoss,
}

impl FixedProblem<7> for FundamentalProblem<'_> {
    type Parameters = Factored;

    fn accumulate(&self, factored: &Factored, normal: &mut NormalEquations<7>) {
        let sums = linearize(self.coordinates, &factored.matrix(), &self.loss);
        project(&sums, &factored.derivatives(), normal);
    }

    fn cost(&self, factored: &Factored) -> f64 {
        cost(self.coordinates, &factored.matrix(), &self.loss)
    }

    fn plus(&self, factored: &Factored, delta: &SVector<f64, 7>) -> Factored {
        factored.plus(delta)
    }
}

/// Refines F in the frame of the coordinates.
pub(crate) fn refine_in_frame(
    coordinates: &Coordinates,
    start: &Matrix3<f64>,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Matrix3<f64>> {
    let mut factored = Factored::new(start)?;
    let problem = FundamentalProblem { coordinates, loss };
    minimize_fixed(&problem, &mut factored, options).ok()?;
    enforce_rank2(&factored.matrix()).ok()
}

/// How rays become coordinates of the common frame: `F = A2ᵀ E A1`.
#[derive(Debug, Clone)]
pub(crate) struct RaysInFrame {
    a1: Matrix3<f64>,
    a2t: Matrix3<f64>,
}

impl RaysInFrame {
    pub(crate) fn new(frame: &CommonFrame, k1: &Intrinsics, k2: &Intrinsics) -> Self {
        Self {
            a1: k1.inverse_matrix() * frame.frame_to_pixels(0),
            a2t: (k2.inverse_matrix() * frame.frame_to_pixels(1)).transpose(),
        }
    }

    /// A homography of the frame as one of rays.
    pub(crate) fn homography_of_rays(&self, in_frame: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        Some(self.a2t.transpose() * in_frame * self.a1.try_inverse()?)
    }

    pub(crate) fn fundamental(&self, essential: &Matrix3<f64>) -> Matrix3<f64> {
        self.a2t * essential * self.a1
    }
}

type Pose = (Matrix3<f64>, Vector3<f64>);

/// Two unit vectors that span the plane perpendicular to a unit vector.
fn tangent_plane(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = perpendicular(direction);
    [first, direction.cross(&first)]
}

/// The derivatives of E = [t]ₓR with respect to a rotation from the left, `R ← exp([δ]ₓ) R`, and
/// to steps of t along its tangent plane.
pub(crate) fn essential_derivatives(
    rotation: &Matrix3<f64>,
    direction: &Vector3<f64>,
) -> [Matrix3<f64>; 5] {
    let t = cross_matrix(direction);
    let [b1, b2] = tangent_plane(direction);
    [
        t * cross_matrix(&Vector3::x()) * rotation,
        t * cross_matrix(&Vector3::y()) * rotation,
        t * cross_matrix(&Vector3::z()) * rotation,
        cross_matrix(&b1) * rotation,
        cross_matrix(&b2) * rotation,
    ]
}

struct PoseProblem<'a> {
    coordinates: &'a Coordinates,
    rays: &'a RaysInFrame,
    loss: RobustLoss,
}

impl PoseProblem<'_> {
    fn fundamental(&self, (rotation, direction): &Pose) -> Matrix3<f64> {
        self.rays.fundamental(&(cross_matrix(direction) * rotation))
    }
}

impl FixedProblem<5> for PoseProblem<'_> {
    type Parameters = Pose;

    fn accumulate(&self, pose: &Pose, normal: &mut NormalEquations<5>) {
        let sums = linearize(self.coordinates, &self.fundamental(pose), &self.loss);
        let mut d = SMatrix::<f64, 9, 5>::zeros();
        for (i, essential) in essential_derivatives(&pose.0, &pose.1).iter().enumerate() {
            d.set_column(i, &flatten(&self.rays.fundamental(essential)));
        }
        project(&sums, &d, normal);
    }

    fn cost(&self, pose: &Pose) -> f64 {
        cost(self.coordinates, &self.fundamental(pose), &self.loss)
    }

    fn plus(&self, pose: &Pose, delta: &SVector<f64, 5>) -> Pose {
        moved_pose(pose, delta)
    }
}

/// As [`essential_derivatives`] has the parameters.
fn moved_pose((rotation, direction): &Pose, delta: &SVector<f64, 5>) -> Pose {
    let turn = Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
    let [b1, b2] = tangent_plane(direction);
    (
        turn.into_inner() * rotation,
        (direction + b1 * delta[3] + b2 * delta[4]).normalize(),
    )
}

/// Refines a relative pose in the frame of the coordinates.
pub(crate) fn refine_pose_in_frame(
    coordinates: &Coordinates,
    rays: &RaysInFrame,
    start: &RelativePose,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Pose> {
    let mut pose = (start.rotation, start.direction);
    let problem = PoseProblem {
        coordinates,
        rays,
        loss,
    };
    minimize_fixed(&problem, &mut pose, options).ok()?;
    orthogonal(&pose)
}

/// Products of many rotations drift from orthogonality.
fn orthogonal((rotation, direction): &Pose) -> Option<Pose> {
    let svd = svd3(rotation);
    let rotation = svd.u * svd.v.transpose();
    let mut entries = rotation.iter().chain(direction.iter());
    entries
        .all(|x| x.is_finite())
        .then_some((rotation, *direction))
}

/// How the rays of cameras that share a focal length become coordinates of the common frame.
#[derive(Debug, Clone)]
pub(crate) struct FocalCenters {
    /// Coordinates of the frame as pixels about the principal point, of images 1 and 2.
    about: [Matrix3<f64>; 2],
}

impl FocalCenters {
    pub(crate) fn new(frame: &CommonFrame, centers: &[Point2<f64>; 2]) -> Self {
        let about = |image: usize| {
            let c = &centers[image];
            let shift = Matrix3::new(1.0, 0.0, -c.x, 0.0, 1.0, -c.y, 0.0, 0.0, 1.0);
            shift * frame.frame_to_pixels(image)
        };
        Self {
            about: [0, 1].map(about),
        }
    }

    /// `F = A2ᵀ D E D A1`, D = diag(1, 1, f): that of K⁻¹, times f², which F does not see.
    fn fundamental(&self, essential: &Matrix3<f64>, focal_px: f64) -> Matrix3<f64> {
        let d = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, focal_px));
        self.about[1].transpose() * (d * essential * d) * self.about[0]
    }

    /// Its derivative by log f.
    fn by_log_focal(&self, essential: &Matrix3<f64>, focal_px: f64) -> Matrix3<f64> {
        let d = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, focal_px));
        let slope = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, focal_px));
        let inner = slope * essential * d + d * essential * slope;
        self.about[1].transpose() * inner * self.about[0]
    }
}

struct FocalProblem<'a> {
    coordinates: &'a Coordinates,
    centers: &'a FocalCenters,
    loss: RobustLoss,
}

impl FocalProblem<'_> {
    fn fundamental(&self, ((rotation, direction), focal_px): &(Pose, f64)) -> Matrix3<f64> {
        let essential = cross_matrix(direction) * rotation;
        self.centers.fundamental(&essential, *focal_px)
    }
}

impl FixedProblem<6> for FocalProblem<'_> {
    type Parameters = (Pose, f64);

    fn accumulate(&self, model: &(Pose, f64), normal: &mut NormalEquations<6>) {
        let sums = linearize(self.coordinates, &self.fundamental(model), &self.loss);
        let ((rotation, direction), focal_px) = model;
        let mut d = SMatrix::<f64, 9, 6>::zeros();
        for (i, essential) in essential_derivatives(rotation, direction)
            .iter()
            .enumerate()
        {
            d.set_column(i, &flatten(&self.centers.fundamental(essential, *focal_px)));
        }
        let essential = cross_matrix(direction) * rotation;
        d.set_column(
            5,
            &flatten(&self.centers.by_log_focal(&essential, *focal_px)),
        );
        project(&sums, &d, normal);
    }

    fn cost(&self, model: &(Pose, f64)) -> f64 {
        cost(self.coordinates, &self.fundamental(model), &self.loss)
    }

    fn plus(&self, (pose, focal_px): &(Pose, f64), delta: &SVector<f64, 6>) -> (Pose, f64) {
        let moved = moved_pose(pose, &delta.fixed_rows::<5>(0).into_owned());
        (moved, focal_px * libm::exp(delta[5]))
    }
}

/// The standard deviation of the focal length, as a share of it: that of the errors, and how they depend on all
/// six parameters. `None` if they do not determine it.
///
/// * `num_matches`: there are so many in the coordinates, all of them inliers
pub(crate) fn relative_focal_deviation(
    coordinates: &Coordinates,
    num_matches: usize,
    centers: &FocalCenters,
    (pose, focal_px): (&RelativePose, f64),
) -> Option<f64> {
    let problem = FocalProblem {
        coordinates,
        centers,
        loss: RobustLoss::Trivial,
    };
    let mut normal = NormalEquations::new();
    problem.accumulate(&((pose.rotation, pose.direction), focal_px), &mut normal);
    let variance = 2.0 * normal.cost / num_matches.checked_sub(6).filter(|n| *n > 0)? as f64;
    let inverse = normal.hessian.cholesky()?.inverse();
    let share = (variance * inverse[(5, 5)]).sqrt();
    share.is_finite().then_some(share)
}

/// Refines a relative pose together with the focal length that both cameras share.
pub(crate) fn refine_pose_and_focal_in_frame(
    coordinates: &Coordinates,
    centers: &FocalCenters,
    (start, focal_px): (&RelativePose, f64),
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<(Pose, f64)> {
    let mut model = ((start.rotation, start.direction), focal_px);
    let problem = FocalProblem {
        coordinates,
        centers,
        loss,
    };
    minimize_fixed(&problem, &mut model, options).ok()?;
    Some((orthogonal(&model.0)?, model.1))
}

#[cfg(test)]
mod tests {
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::{fundamental_8point, fundamental_from_cameras, sampson_sq};
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    fn noisy_matches(
        random: &mut Random,
        noise_px: f64,
    ) -> (Matrix3<f64>, Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let (cam1, cam2) = random_cameras(random);
        let (mut p1, mut p2) = (Vec::new(), Vec::new());
        for _ in 0..60 {
            let point = random_point(random);
            let mut noisy = |p: Point2<f64>| {
                Point2::new(
                    p.x + noise_px * random.normal(),
                    p.y + noise_px * random.normal(),
                )
            };
            p1.push(noisy(cam1.project(&point).unwrap()));
            p2.push(noisy(cam2.project(&point).unwrap()));
        }
        (fundamental_from_cameras(&cam1, &cam2).unwrap(), p1, p2)
    }

    /// The Sampson residual with its sign, in the frame.
    fn residuals(coordinates: &Coordinates, f: &Matrix3<f64>) -> DVector<f64> {
        DVector::from_fn(coordinates.len(), |i, _| {
            let [u1, v1, u2, v2] = coordinates.at(i);
            let (x1, x2) = (Vector3::new(u1, v1, 1.0), Vector3::new(u2, v2, 1.0));
            let (l2, l1) = (f * x1, f.transpose() * x2);
            x2.dot(&l2) / (l2.xy().norm_squared() + l1.xy().norm_squared()).sqrt()
        })
    }

    #[test]
    fn jacobians_agree_with_differences() {
        let mut random = Random::new(1);
        for _ in 0..20 {
            let (truth, p1, p2) = noisy_matches(&mut random, 2.0);
            let matches = MatchSet::new(&p1, &p2).unwrap();
            let frame = CommonFrame::new(&matches);
            let coordinates = Coordinates::pixels(&matches).mapped(&frame);
            let factored = Factored::new(&frame.fundamental_to_frame(&truth)).unwrap();
            // One residual at a time: the Jacobian of a single match is recovered from its sums,
            // gradient = Jᵀ r.
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 7>::from_column_slice(delta.as_slice());
                residuals(&coordinates, &factored.plus(&delta).matrix())
            };
            let mut analytic = DMatrix::zeros(matches.len(), 7);
            let r = residuals(&coordinates, &factored.matrix());
            for i in 0..matches.len() {
                let (a, b) = matches.pair(i);
                let one = MatchSet::new(&[a], &[b]).unwrap();
                let alone = Coordinates::pixels(&one).mapped(&frame);
                let sums = linearize(&alone, &factored.matrix(), &RobustLoss::Trivial);
                let mut normal = NormalEquations::new();
                project(&sums, &factored.derivatives(), &mut normal);
                analytic.set_row(i, &(normal.gradient / r[i]).transpose());
                let outer = normal.gradient * normal.gradient.transpose() / (r[i] * r[i]);
                assert!((outer - normal.hessian).amax() < 1e-9 * normal.hessian.amax());
            }
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6);
        }
    }

    #[test]
    fn pose_derivatives_agree_with_differences() {
        let mut random = Random::new(2);
        for _ in 0..20 {
            let axis = Vector3::from_fn(|_, _| random.normal());
            let rotation = Rotation3::from_scaled_axis(axis).into_inner();
            let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
            let (coordinates, rays) = (
                Coordinates::pixels(&MatchSet::new(&[], &[]).unwrap()),
                RaysInFrame {
                    a1: Matrix3::identity(),
                    a2t: Matrix3::identity(),
                },
            );
            let problem = PoseProblem {
                coordinates: &coordinates,
                rays: &rays,
                loss: RobustLoss::Trivial,
            };
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 5>::from_column_slice(delta.as_slice());
                let e = problem.fundamental(&problem.plus(&(rotation, direction), &delta));
                DVector::from_column_slice(flatten(&e).as_slice())
            };
            let columns = essential_derivatives(&rotation, &direction).map(|e| flatten(&e));
            let analytic = DMatrix::from_fn(9, 5, |i, j| columns[j][i]);
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6);
        }
    }

    #[test]
    fn refinement_lowers_the_error() {
        let mut random = Random::new(3);
        for _ in 0..20 {
            let (_, p1, p2) = noisy_matches(&mut random, 0.5);
            let linear = fundamental_8point(&p1, &p2).unwrap();
            let refined = refine_fundamental(&linear, &p1, &p2, RobustLoss::Trivial).unwrap();
            let total = |f: &Matrix3<f64>| -> f64 {
                p1.iter().zip(&p2).map(|(a, b)| sampson_sq(f, a, b)).sum()
            };
            assert!(total(&refined) <= total(&linear));
            // 60 residuals, 7 parameters, variance 0.25.
            assert!(total(&refined) < 0.25 * 53.0 * 2.0);
            assert!(refined.determinant().abs() < 1e-16);
        }
    }

    #[test]
    fn each_failure_has_its_own_sentence() {
        let (f, p1, p2) = noisy_matches(&mut Random::new(4), 0.5);
        let k = Intrinsics::centered(700.0, 640, 480).unwrap();
        let pose = RelativePose::checked(Matrix3::identity(), Vector3::x(), &k, &k).unwrap();
        for width in [0.0, -1.0, f64::NAN] {
            for loss in [
                RobustLoss::Huber { width },
                RobustLoss::Cauchy { width },
                RobustLoss::Truncated { width },
            ] {
                let refused = loss.check().unwrap_err();
                let refined = refine_fundamental(&f, &p1, &p2, loss).unwrap_err();
                // Equal as sentences, since NaN does not equal itself.
                assert_eq!(refined.to_string(), refused.to_string());
                let refined = refine_relative_pose(&pose, &p1, &p2, &k, &k, loss).unwrap_err();
                assert_eq!(refined.to_string(), refused.to_string());
            }
        }
        let loss = RobustLoss::Trivial;
        let rank1 = Vector3::new(1.0, 2.0, 3.0) * Vector3::new(0.5, -1.0, 1.0).transpose();
        for start in [rank1, Matrix3::zeros()] {
            let refined = refine_fundamental(&start, &p1, &p2, loss);
            assert!(
                matches!(refined, Err(Error::Degenerate { .. })),
                "{refined:?}"
            );
        }
        let nowhere = RelativePose {
            direction: Vector3::from_element(f64::NAN),
            ..pose
        };
        let refined = refine_relative_pose(&nowhere, &p1, &p2, &k, &k, loss);
        assert!(
            matches!(refined, Err(Error::NotFinite { .. })),
            "{refined:?}"
        );
    }
}
