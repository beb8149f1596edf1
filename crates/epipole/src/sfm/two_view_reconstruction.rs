//! Reconstruction from two views with known motion: triangulation and refinement.

use super::bundle::{Bundle, BundleObservation, BundleOptions, adjust_bundle};
use crate::camera::{Camera, PosedCamera, RigidTransform};
use crate::epipolar::{decompose_essential, essential_from_motion, select_pose};
use crate::optim::{LmReport, RobustLoss};
use crate::progress::{Monitor, Part};
use crate::triangulation::{triangulate_optimal, triangulation_angle_rad};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Point2, Point3};

/// Maximum number of repeated refinements after points were removed.
const MAX_REPETITIONS: usize = 5;

/// Options of [`two_view_reconstruction`].
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TwoViewReconstructionOptions {
    /// Minimum triangulation angle, radians, ≥ 0.
    pub min_angle_rad: f64,
    /// Maximum reprojection error of a point after the refinement, pixels, > 0.
    pub max_error_px: f64,
    /// Minimum number of points of a reconstruction.
    pub min_num_points: usize,
    /// Options of the bundle adjustment of motion and points.
    pub bundle: BundleOptions,
}

impl Default for TwoViewReconstructionOptions {
    /// Returns a minimum angle of half a degree, a maximum error of 4 pixels, at least 15 points,
    /// and Huber's loss of 2 pixels.
    fn default() -> Self {
        Self {
            min_angle_rad: 0.5_f64.to_radians(),
            max_error_px: 4.0,
            min_num_points: 15,
            bundle: BundleOptions {
                loss: RobustLoss::Huber { width: 2.0 },
                ..BundleOptions::default()
            },
        }
    }
}

/// Two cameras and the points that both see, in the frame of camera 1; the baseline is 1.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewReconstruction {
    /// The refined motion, |t| = 1.
    pub cam2_from_cam1: RigidTransform,
    /// The points.
    pub points: Vec<Point3<f64>>,
    /// The points as first triangulated from the given motion, with its translation scaled to
    /// length 1.
    pub triangulated: Vec<Point3<f64>>,
    /// Index of each point's match, in increasing order.
    pub match_of_point: Vec<usize>,
    /// Number of matches that each of the four motions of E puts in front of both cameras, most
    /// first: usually one motion has nearly all.
    pub num_in_front: [usize; 4],
    /// RMS reprojection error of the points as first triangulated, pixels.
    pub rms_before_px: f64,
    /// RMS reprojection error after the refinement, pixels.
    pub rms_px: f64,
    /// Report of the last refinement.
    pub report: LmReport,
}

/// Triangulates the matches of two views and refines the points together with the motion.
///
/// Points behind a camera, or with a small triangulation angle, are dropped; bundle adjustment
/// refines the others and the motion. Points that are then behind a camera, at a small angle, or
/// far from their pixels are also dropped, and the rest is refined again.
///
/// * `pixels1`, `pixels2`: matches without outliers: all of them count
/// * `cameras`: the two cameras, with any lens
/// * `cam2_from_cam1`: initial motion; the length of its translation does not matter
/// * `monitor`: the only stage is
///   [`Stage::BundleAdjustment`](crate::progress::Stage::BundleAdjustment)
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN and
/// infinities, [`Error::OutOfRange`] for options outside their ranges, [`Error::Degenerate`] for a
/// motion without translation, [`Error::TooFew`] if fewer than `min_num_points` points remain, as
/// for a camera that hardly moved; and as [`adjust_bundle`].
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.4 (filtering and
/// repeated refinement); the four motions are those of Hartley & Zisserman 2004, §9.6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::sfm::{TwoViewReconstructionOptions, two_view_reconstruction};
/// use nalgebra::{Point2, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(500.0, 500.0, 320.0, 240.0)?, 640, 480);
/// // Camera 2 is one unit to the right. Points 4 and 5 units away have disparities of 125 and 100.
/// let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let pixel = Point2::new(300.0 + 8.0 * f64::from(i % 5), 180.0 + 30.0 * f64::from(i / 5));
///     let disparity = if i % 2 == 0 { 125.0 } else { 100.0 };
///     pixels1.push(pixel);
///     pixels2.push(Point2::new(pixel.x - disparity, pixel.y));
/// }
/// // The initial motion is rotated by a hundredth of a radian too far.
/// let start = RigidTransform::new(Vector3::new(-1.0, 0.0, 0.0), Vector3::new(0.01, 0.0, 0.0));
/// let options = TwoViewReconstructionOptions::default();
/// let found =
///     two_view_reconstruction(&pixels1, &pixels2, [&camera; 2], &start, &options, &mut ())?;
/// assert!(found.rms_before_px > 1.0 && found.rms_px < 1e-3);
/// assert_eq!((found.points.len(), found.num_in_front), (20, [20, 0, 0, 0]));
/// assert!((found.points[0].z - 4.0).abs() < 0.01 && (found.points[1].z - 5.0).abs() < 0.01);
/// assert!((found.cam2_from_cam1.translation.x + 1.0).abs() < 1e-4);
/// # Ok(()) }
/// ```
pub fn two_view_reconstruction(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    cam2_from_cam1: &RigidTransform,
    options: &TwoViewReconstructionOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReconstruction> {
    check(pixels1, pixels2, cam2_from_cam1, options)?;
    let posed = |camera: &Camera, cam_from_world| PosedCamera {
        camera: *camera,
        cam_from_world,
    };
    let mut start = Bundle {
        cameras: vec![
            posed(cameras[0], RigidTransform::identity()),
            posed(cameras[1], in_baselines(cam2_from_cam1)),
        ],
        lens_of_camera: vec![0, usize::from(cameras[0].lens != cameras[1].lens)],
        ..Bundle::default()
    };
    let mut matches = Vec::new();
    for (index, (pixel1, pixel2)) in pixels1.iter().zip(pixels2).enumerate() {
        let triangulated =
            triangulate_optimal(&start.cameras[0], &start.cameras[1], pixel1, pixel2);
        // Parallel or diverging rays have no point.
        let Ok(point) = triangulated else { continue };
        if angle_rad(&start, &point) < options.min_angle_rad {
            continue;
        }
        for (camera, pixel) in [*pixel1, *pixel2].into_iter().enumerate() {
            start.observations.push(BundleObservation {
                camera,
                point: matches.len(),
                pixel,
            });
        }
        start.points.push(point);
        matches.push(index);
    }
    enough(matches.len(), options)?;
    let mut bundle = start.clone();
    let mut fraction = 0.5;
    let mut part = Part::new(monitor, 0.0, fraction);
    let mut report = adjust_bundle(&mut bundle, &options.bundle, &mut part)?;
    for round in 0.. {
        let inliers: Vec<usize> = (0..matches.len())
            .filter(|&point| is_good(&bundle, point, options))
            .collect();
        enough(inliers.len(), options)?;
        if inliers.len() == matches.len() {
            break;
        }
        matches = inliers.iter().map(|&point| matches[point]).collect();
        (start, bundle) = (only(&start, &inliers), only(&bundle, &inliers));
        // The removed points had biased all the others.
        if round < MAX_REPETITIONS {
            // Each repetition takes half of the remaining progress.
            let next = 0.5 * (1.0 + fraction);
            let mut part = Part::new(monitor, fraction, next);
            report = adjust_bundle(&mut bundle, &options.bundle, &mut part)?;
            fraction = next;
        }
    }
    let all: Vec<usize> = (0..matches.len()).collect();
    // The unit of length is the baseline.
    let motion = bundle.cameras[1].cam_from_world * bundle.cameras[0].cam_from_world.inverse();
    let unit = motion.translation.vector.norm();
    let motion = in_baselines(&motion);
    let in_cam1 = |&point: &usize| {
        Point3::from((bundle.cameras[0].cam_from_world * bundle.points[point]).coords / unit)
    };
    let rms_before_px = rms_px(&start, &all);
    Ok(TwoViewReconstruction {
        cam2_from_cam1: motion,
        points: all.iter().map(in_cam1).collect(),
        triangulated: start.points,
        match_of_point: matches,
        num_in_front: four_counts(&motion, pixels1, pixels2, &bundle.cameras)?,
        rms_before_px,
        rms_px: rms_px(&bundle, &all),
        report,
    })
}

fn check(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cam2_from_cam1: &RigidTransform,
    options: &TwoViewReconstructionOptions,
) -> Result<()> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    let translation = &cam2_from_cam1.translation.vector;
    let finite = |x: &f64| x.is_finite();
    let motion_is_finite =
        translation.norm().is_finite() && cam2_from_cam1.rotation.coords.iter().all(finite);
    let mut pixels = pixels1.iter().chain(pixels2);
    if !(motion_is_finite && pixels.all(|pixel| pixel.iter().all(finite))) {
        return Err(Error::NotFinite {
            what: "a matched pixel or the motion between two views",
        });
    }
    if translation.norm() <= 0.0 {
        return Err(Error::Degenerate {
            what: "the depth of what two views show",
            why: "both were taken from one place",
        });
    }
    for (what, requirement, value, is_good) in [
        (
            "the smallest angle of two rays",
            "0 or more and finite",
            options.min_angle_rad,
            options.min_angle_rad >= 0.0,
        ),
        (
            "the largest reprojection error",
            "greater than 0 and finite",
            options.max_error_px,
            options.max_error_px > 0.0,
        ),
    ] {
        if !(is_good && value.is_finite()) {
            return Err(Error::OutOfRange {
                what,
                requirement,
                value,
            });
        }
    }
    Ok(())
}

fn enough(got: usize, options: &TwoViewReconstructionOptions) -> Result<()> {
    let needed = options.min_num_points.max(1);
    if got >= needed {
        return Ok(());
    }
    Err(Error::TooFew {
        what: "a reconstruction from two views, in points whose rays meet at a wide angle,",
        needed,
        got,
    })
}

/// Scales the translation to length 1.
fn in_baselines(motion: &RigidTransform) -> RigidTransform {
    let mut motion = *motion;
    motion.translation.vector /= motion.translation.vector.norm();
    motion
}

/// Returns some points of a bundle of two cameras with their observations, two per point.
fn only(bundle: &Bundle, points: &[usize]) -> Bundle {
    let observation = |(new, &old): (usize, &usize)| {
        [2 * old, 2 * old + 1].map(|observation| BundleObservation {
            point: new,
            ..bundle.observations[observation]
        })
    };
    Bundle {
        cameras: bundle.cameras.clone(),
        lens_of_camera: bundle.lens_of_camera.clone(),
        points: points.iter().map(|&point| bundle.points[point]).collect(),
        observations: points.iter().enumerate().flat_map(observation).collect(),
        ..Bundle::default()
    }
}

fn angle_rad(bundle: &Bundle, point: &Point3<f64>) -> f64 {
    let [first, second] = [0, 1].map(|n: usize| bundle.cameras[n].center_in_world());
    triangulation_angle_rad(&first, &second, point)
}

/// Returns whether a point is in front of both cameras, at a sufficient angle, and near both of its
/// pixels.
fn is_good(bundle: &Bundle, point: usize, options: &TwoViewReconstructionOptions) -> bool {
    let place = &bundle.points[point];
    let in_front = (bundle.cameras.iter()).all(|camera| camera.project(place).is_ok());
    let is_near = |observation| bundle.residual_px(observation).norm() <= options.max_error_px;
    in_front
        && is_near(2 * point)
        && is_near(2 * point + 1)
        && angle_rad(bundle, place) >= options.min_angle_rad
}

/// Returns the RMS reprojection error of some points, at least one.
fn rms_px(bundle: &Bundle, points: &[usize]) -> f64 {
    let squares = points
        .iter()
        .flat_map(|&point| [2 * point, 2 * point + 1])
        .map(|observation| bundle.residual_px(observation).norm_squared());
    (squares.sum::<f64>() / (2 * points.len()) as f64).sqrt()
}

/// Returns the number of matches that each of the four motions of E puts in front of both cameras,
/// most first.
fn four_counts(
    motion: &RigidTransform,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: &[PosedCamera],
) -> Result<[usize; 4]> {
    let [first, second] = [&cameras[0].camera, &cameras[1].camera];
    // Pixels without a ray are in front of no camera.
    let straight = |(p1, p2)| {
        first
            .pinhole_pixel(p1)
            .ok()
            .zip(second.pinhole_pixel(p2).ok())
    };
    let (pixels1, pixels2): (Vec<_>, Vec<_>) =
        pixels1.iter().zip(pixels2).filter_map(straight).unzip();
    let mut counts = [0; 4];
    let motions = decompose_essential(&essential_from_motion(motion)?)?;
    for (count, motion) in counts.iter_mut().zip(motions) {
        *count = select_pose(
            &[motion],
            &pixels1,
            &pixels2,
            &first.intrinsics,
            &second.intrinsics,
        )?
        .num_in_front;
    }
    counts.sort_unstable_by_key(|count| std::cmp::Reverse(*count));
    Ok(counts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Intrinsics, Lens, LensKind};
    use crate::math::random::Random;
    use nalgebra::{UnitQuaternion, Vector2, Vector3};

    fn camera() -> Camera {
        Camera::pinhole(
            Intrinsics::new(800.0, 800.0, 320.0, 240.0).unwrap(),
            640,
            480,
        )
    }

    fn motion() -> RigidTransform {
        RigidTransform::new(
            Vector3::new(-0.96, 0.1, 0.2),
            Vector3::new(0.03, 0.2, -0.05),
        )
    }

    /// Matches of points about 6 units away, and the points.
    fn matches(count: usize, noise_px: f64, far: f64) -> ([Vec<Point2<f64>>; 2], Vec<Point3<f64>>) {
        matches_through([&camera(); 2], count, noise_px, far)
    }

    fn matches_through(
        cameras: [&Camera; 2],
        count: usize,
        noise_px: f64,
        far: f64,
    ) -> ([Vec<Point2<f64>>; 2], Vec<Point3<f64>>) {
        let mut random = Random::new(8);
        let (mut pixels, mut points) = ([Vec::new(), Vec::new()], Vec::new());
        for _ in 0..count {
            let mut within = |reach: f64| random.uniform(-reach, reach);
            let point = Point3::new(within(1.5), within(1.2), 6.0 + within(1.5)) * far;
            let poses = [RigidTransform::identity(), motion()];
            for (list, (pose, camera)) in pixels.iter_mut().zip(poses.iter().zip(cameras)) {
                let noise = Vector2::new(random.normal(), random.normal()) * noise_px;
                list.push(camera.project(&(pose * point)).unwrap() + noise);
            }
            points.push(point);
        }
        (pixels, points)
    }

    fn reconstruct(
        [pixels1, pixels2]: &[Vec<Point2<f64>>; 2],
        start: &RigidTransform,
    ) -> Result<TwoViewReconstruction> {
        let options = TwoViewReconstructionOptions::default();
        two_view_reconstruction(pixels1, pixels2, [&camera(); 2], start, &options, &mut ())
    }

    #[test]
    fn distorted_matches_give_the_scene() {
        let lens = |kind, numbers: &[f64]| Lens::from_coefficients(kind, numbers).unwrap();
        let brown = Camera {
            lens: lens(LensKind::Brown, &[-0.25, 0.06, 0.001, -0.002, 0.0]),
            ..camera()
        };
        let fisheye = Camera {
            lens: lens(LensKind::Fisheye, &[-0.02, 0.004, -0.001, 0.0]),
            ..camera()
        };
        let ([pixels1, pixels2], truth) = matches_through([&brown, &fisheye], 200, 0.0, 1.0);
        let options = TwoViewReconstructionOptions::default();
        let start = knocked(0.02);
        let found = two_view_reconstruction(
            &pixels1,
            &pixels2,
            [&brown, &fisheye],
            &start,
            &options,
            &mut (),
        )
        .unwrap();
        assert_eq!(found.points.len(), 200);
        assert_eq!(found.num_in_front[0], 200);
        let unit = motion().translation.vector.norm();
        for (point, truth) in found.points.iter().zip(&truth) {
            assert!((point.coords * unit - truth.coords).norm() < 1e-3);
        }
    }

    /// The motion, perturbed by an angle and a shift, with a translation three times as long.
    fn knocked(angle_rad: f64) -> RigidTransform {
        let knock = Vector3::new(0.6, 0.64, -0.48) * angle_rad;
        let mut start = motion();
        start.rotation = UnitQuaternion::from_scaled_axis(knock) * start.rotation;
        start.translation.vector += Vector3::new(0.3, -1.0, 0.8) * angle_rad;
        start.translation.vector *= 3.0;
        start
    }

    #[test]
    fn exact_matches_give_the_scene_from_a_motion_that_is_off() {
        let (pixels, truth) = matches(200, 0.0, 1.0);
        let found = reconstruct(&pixels, &knocked(0.02)).unwrap();
        assert!(found.rms_before_px > 2.0, "{}", found.rms_before_px);
        assert!(found.rms_px < 1e-3, "{}", found.rms_px);
        assert_eq!(found.num_in_front, [200, 0, 0, 0]);
        assert_eq!(found.match_of_point, (0..200).collect::<Vec<_>>());
        // From the true motion they are triangulated at their final positions.
        let at_once = reconstruct(&pixels, &motion()).unwrap();
        for (place, point) in at_once.triangulated.iter().zip(&found.points) {
            assert!((place - point).norm() < 0.01, "{place} {point}");
        }
        let unit = motion().translation.vector.norm();
        let angle = (found.cam2_from_cam1.rotation.inverse() * motion().rotation).angle();
        assert!(angle < 1e-4, "{angle}");
        assert!((found.cam2_from_cam1.translation.vector.norm() - 1.0).abs() < 1e-12);
        for (point, truth) in found.points.iter().zip(&truth) {
            assert!((point - truth / unit).norm() < 0.01, "{point} {truth}");
        }
    }

    #[test]
    fn the_error_falls_to_the_noise_less_what_the_unknowns_take_up() {
        let (pixels, _) = matches(300, 0.5, 1.0);
        let found = reconstruct(&pixels, &knocked(0.01)).unwrap();
        assert_eq!(found.points.len(), 300);
        // 1200 numbers, 300 points, a motion of five unknowns.
        let expected = 2.0 * 0.25 * (1200.0 - 905.0) / 1200.0;
        let mean_square = found.rms_px * found.rms_px;
        assert!((mean_square / expected - 1.0).abs() < 0.2, "{mean_square}");
        assert!(found.report.final_cost < found.report.initial_cost);
    }

    #[test]
    fn wrong_matches_and_narrow_ones_are_left_out() {
        let (mut pixels, _) = matches(100, 0.2, 1.0);
        let (far, _) = matches(20, 0.0, 100.0);
        for (list, far) in pixels.iter_mut().zip(far) {
            list.extend(far);
        }
        for wrong in (0..100).step_by(10) {
            pixels[1][wrong].y += 40.0;
        }
        let found = reconstruct(&pixels, &motion()).unwrap();
        let expected: Vec<usize> = (0..100).filter(|index| index % 10 != 0).collect();
        assert_eq!(found.match_of_point, expected);
        assert!(found.rms_px < 0.2, "{}", found.rms_px);
    }

    #[test]
    fn bad_input_is_refused_with_a_reason() {
        let (pixels, _) = matches(40, 0.0, 1.0);
        assert!(matches!(
            reconstruct(&pixels, &RigidTransform::identity()),
            Err(Error::Degenerate { .. })
        ));
        let (far, _) = matches(40, 0.0, 1000.0);
        assert!(matches!(
            reconstruct(&far, &motion()),
            Err(Error::TooFew {
                needed: 15,
                got: 0,
                ..
            })
        ));
        let mut fewer = pixels.clone();
        fewer[0].pop();
        assert!(matches!(
            reconstruct(&fewer, &motion()),
            Err(Error::SizeMismatch { .. })
        ));
        assert!(matches!(
            reconstruct(&[Vec::new(), Vec::new()], &motion()),
            Err(Error::TooFew { .. })
        ));
        let mut broken = pixels.clone();
        broken[1][3].x = f64::NAN;
        assert!(matches!(
            reconstruct(&broken, &motion()),
            Err(Error::NotFinite { .. })
        ));
        for (min_angle_rad, max_error_px) in [(-0.1, 4.0), (f64::NAN, 4.0), (0.1, 0.0)] {
            let options = TwoViewReconstructionOptions {
                min_angle_rad,
                max_error_px,
                ..TwoViewReconstructionOptions::default()
            };
            let [pixels1, pixels2] = &pixels;
            let refused = two_view_reconstruction(
                pixels1,
                pixels2,
                [&camera(); 2],
                &motion(),
                &options,
                &mut (),
            );
            assert!(matches!(refused, Err(Error::OutOfRange { .. })));
        }
    }
}
