//! Refinement of a relative pose with all matches.

use super::RelativePose;
use super::coordinates::{CommonFrame, Coordinates};
use super::lens_matches::LensMatches;
use super::observed_matches::ObservedMatches;
use super::refine::{NO_ERROR_AT_THE_START, scaled};
use super::refine_pose::{ErrorsInFrame, RaysInFrame, Steps, refine_pose};
use crate::camera::Camera;
use crate::optim::{LmOptions, RobustLoss, Subset};
use crate::robust::MatchSet;
use crate::{Error, Result};
use nalgebra::Point2;

/// Refines a relative pose: minimizes `½ Σ ρ(e²)` over the matches, where e is the Sampson error in
/// pixels.
///
/// * `cameras`: the two cameras; for lenses other than pinholes e is the [tangent Sampson
///   error](super::tangent_sampson_px)
///
/// Rotation and direction of the translation, five parameters, are refined.
///
/// # Errors
/// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 5 matches, [`Error::OutOfRange`] for
/// a loss that [`RobustLoss::check`] rejects, [`Error::NotFinite`] for an initial pose with a NaN
/// error at some match, [`Error::Degenerate`] for a pixel without a ray, and as [`MatchSet::new`];
/// infinities and coordinates beyond 10⁹ pixels are rejected, as every match counts.
///
/// Source: Hartley & Zisserman 2004, §11.4.3, with `E = [t]ₓR` instead of F.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::epipolar::{RelativePose, refine_relative_pose};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(camera.project(&x)?);
///     p2.push(camera.project(&(cam2_from_cam1 * x))?);
/// }
/// // An initial pose that is off by 0.05 rad and looks straight to the side.
/// let start = RigidTransform::new(Vector3::new(-1.0, 0.0, 0.0), Vector3::new(0.0, 0.05, 0.0));
/// let start = RelativePose::from_motion(&start)?;
/// let refined = refine_relative_pose(&start, &p1, &p2, [&camera; 2], RobustLoss::Trivial)?.cam2_from_cam1();
/// assert!(refined.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-6);
/// assert!((refined.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn refine_relative_pose(
    pose: &RelativePose,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    loss: RobustLoss,
) -> Result<RelativePose> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    matches.at_least(5, "a refined relative pose")?;
    loss.check()?;
    let options = LmOptions::default();
    let refined = if Camera::are_pinholes(cameras) {
        let frame = CommonFrame::new(&matches);
        let errors = ErrorsInFrame {
            coordinates: &Coordinates::pixels(&matches).mapped(&frame),
            rays: &RaysInFrame::new(&frame, &cameras[0].intrinsics, &cameras[1].intrinsics),
            loss: scaled(loss, frame.scale),
        };
        let start = (pose.rotation, pose.direction);
        refine_pose(&errors, start, &Steps::Free, &options).map(RelativePose::from)
    } else {
        let observed = ObservedMatches::new(pixels1, pixels2, cameras)?;
        if observed.matches.len() < matches.len() {
            return Err(Error::Degenerate {
                what: "a refined relative pose",
                why: "a lens bends no ray to one of the pixels",
            });
        }
        let all: Vec<usize> = (0..matches.len()).collect();
        let used = Subset::alike(&all);
        LensMatches::new(&observed).minimize(used, pose, loss, &Steps::Free, &options)
    };
    refined.ok_or(NO_ERROR_AT_THE_START)
}
