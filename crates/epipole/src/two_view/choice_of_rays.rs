//! What two views show, from rays: for lenses that no pinhole camera stands for.

use super::motion::{best_and_rival, in_front_of_plane};
use super::turn_of_rays::find_explaining_turn_of_rays;
use super::{Configuration, TwoViewModel, TwoViewOptions, TwoViewReport};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Intrinsics, Observation, RigidTransform, cross_matrix};
use crate::epipolar::{estimate_relative_pose_of_rays, sampson_px_of_rays};
use crate::homography::{decompose_homography, estimate_homography_of_rays};
use crate::math::order::at_rank;
use crate::progress::Monitor;
use crate::robust::{RansacOptions, RansacReport};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// Samples of four matches, at most: where a homography explains nearly all, a tenth is plenty.
const MAX_SAMPLES: usize = 500;

/// The homography of rays that explains nearly all inliers of a motion, if there is one: they show a plane, or the
/// camera only turned.
pub(crate) fn plane_of_rays(
    inliers: &[[Observation; 2]],
    options: &TwoViewOptions,
) -> Option<RansacReport<Matrix3<f64>>> {
    let in_two_dimensions = options.in_two_dimensions();
    let ransac = RansacOptions {
        max_iterations: in_two_dimensions.max_iterations.min(MAX_SAMPLES),
        ..in_two_dimensions
    };
    let [seen1, seen2] =
        [0, 1].map(|side| -> Vec<Observation> { inliers.iter().map(|pair| pair[side]).collect() });
    let found = estimate_homography_of_rays(&seen1, &seen2, &ransac, &mut ()).ok()?;
    let needed = options.max_homography_share * inliers.len() as f64;
    (found.num_inliers as f64 >= needed).then_some(found)
}

/// What two views through any lenses show, and the motion: E, or H for a plane or a turn, from rays.
///
/// * `seen1`, `seen2`: matching pixels with their rays, in the same order; wrong matches are expected
/// * `options`: errors are in the pixels of the photographs, those of H in image 2, where matches have the noise of both:
///   they are given 1.25 √2 times [`RansacOptions::max_error_px`]
///
/// The same as [`estimate_two_view_calibrated`](super::estimate_two_view_calibrated) but for lenses without a pinhole
/// camera that could stand for them, so without F: [`TwoViewReport::model`] and [`TwoViewReport::homography`] are of
/// rays, `x2ᵀ E x1 = 0` and `x2 ∝ H x1`.
///
/// # Errors
/// As [`TwoViewOptions::check`], and as
/// [`estimate_relative_pose_of_rays`](crate::epipolar::estimate_relative_pose_of_rays).
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens};
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_of_rays};
/// use nalgebra::{Point2, Rotation3, Vector3};
/// let lens = Lens::Fisheye(Fisheye::default());
/// let camera = Camera { lens, ..Camera::pinhole(Intrinsics::centered(200.0, 640, 640)?, 640, 640) };
/// let turn = Rotation3::from_scaled_axis(Vector3::new(0.0, 0.2, 0.0));
/// let (mut seen1, mut seen2) = (Vec::new(), Vec::new());
/// for i in 0..60 {
///     let pixel = Point2::new(f64::from(120 + i * 37 % 400), f64::from(120 + i * 71 % 400));
///     let seen = camera.observe(&pixel)?;
///     let pixel2 = camera.project(&(turn * seen.ray()).into())?;
///     seen1.push(seen);
///     seen2.push(camera.observe(&pixel2)?);
/// }
/// let report = estimate_two_view_of_rays(&seen1, &seen2, &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::Panoramic);
/// assert!((report.cam2_from_cam1.unwrap().rotation.angle() - 0.2).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_two_view_of_rays(
    seen1: &[Observation],
    seen2: &[Observation],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    options.check()?;
    let epipolar = estimate_relative_pose_of_rays(seen1, seen2, &options.ransac, monitor)?;
    let options = &options.within(epipolar.max_error_px);
    let motion = epipolar.model;
    let is_degenerate =
        epipolar.num_unique_inliers < options.min_num_inliers || epipolar.could_be_chance();
    let rotation = motion.rotation.to_rotation_matrix().into_inner();
    let essential = cross_matrix(&motion.translation.vector) * rotation;
    let mut found = TwoViewReport {
        configuration: Configuration::General,
        model: TwoViewModel::Essential(essential / essential.norm()),
        fundamental: None,
        homography: None,
        cam2_from_cam1: Some(motion),
        other_cam2_from_cam1: None,
        inliers: epipolar.inliers,
        num_inliers: epipolar.num_inliers,
        num_left_out: epipolar.num_left_out,
        max_error_px: epipolar.max_error_px,
        iterations: epipolar.iterations,
        required_iterations: epipolar.required_iterations,
        stop: epipolar.stop,
        median_triangulation_angle_rad: None,
    };
    if is_degenerate {
        found.configuration = Configuration::Degenerate;
        found.cam2_from_cam1 = None;
        return Ok(found);
    }
    let inliers = inliers_of(seen1, seen2, &found.inliers);
    let turn = find_explaining_turn_of_rays(&inliers, options);
    let plane = plane_of_rays(&inliers, options);
    let flat = if let Some(turn) = turn {
        found.configuration = Configuration::Panoramic;
        found.cam2_from_cam1 = Some(turn.cam2_from_cam1);
        let rotation = turn.cam2_from_cam1.rotation.to_rotation_matrix();
        Some(rotation.into_inner() / 3.0_f64.sqrt())
    } else if let Some(plane) = plane {
        found.configuration = Configuration::Planar;
        let motions = planar_motions(&inliers, &motion, &plane, options);
        [found.cam2_from_cam1, found.other_cam2_from_cam1] = motions;
        Some(plane.model)
    } else {
        None
    };
    found.homography = flat;
    if let Some(homography) = flat {
        found.model = TwoViewModel::Homography(homography);
        let reach_px = options.in_two_dimensions().max_error_px;
        let fits = |(seen1, seen2): (&Observation, &Observation)| {
            seen2.error_sq(&(homography * seen1.ray())) < reach_px * reach_px
        };
        found.inliers = seen1.iter().zip(seen2).map(fits).collect();
        found.num_inliers = found.inliers.iter().filter(|is| **is).count();
    }
    if let (Some(motion), false) = (&found.cam2_from_cam1, turn.is_some()) {
        let mut angles: Vec<f64> = (inliers_of(seen1, seen2, &found.inliers).iter())
            .map(|[seen1, seen2]| (motion.rotation * seen1.ray()).angle(&seen2.ray()))
            .collect();
        let middle = angles.len() / 2;
        found.median_triangulation_angle_rad =
            (!angles.is_empty()).then(|| at_rank(&mut angles, middle));
    }
    Ok(found)
}

fn inliers_of(
    seen1: &[Observation],
    seen2: &[Observation],
    inliers: &[bool],
) -> Vec<[Observation; 2]> {
    let kept = seen1.iter().zip(seen2).zip(inliers).filter(|(_, is)| **is);
    kept.map(|((seen1, seen2), _)| [*seen1, *seen2]).collect()
}

/// The motion past a plane that most matches agree with, and another one with nearly as many.
///
/// * `motion`: that of E
fn planar_motions(
    inliers: &[[Observation; 2]],
    motion: &RigidTransform,
    plane: &RansacReport<Matrix3<f64>>,
    options: &TwoViewOptions,
) -> [Option<RigidTransform>; 2] {
    let on_plane = inliers.iter().zip(&plane.inliers).filter(|(_, is)| **is);
    let rays1 = on_plane.map(|([seen1, _], _)| seen1.ray());
    // Rays are what a camera with the identity for K sees.
    let of_rays = Intrinsics::new(1.0, 1.0, 0.0, 0.0);
    let decomposed = of_rays.and_then(|k| decompose_homography(&plane.model, &k, &k));
    let mut motions = vec![*motion];
    for (rotation, direction) in in_front_of_plane(&decomposed.unwrap_or_default(), rays1) {
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        motions.push(RigidTransform::from_parts(
            direction.into(),
            rotation.into(),
        ));
    }
    let max_error_px = options.ransac.max_error_px;
    let score = |motion: &RigidTransform| {
        let fits = |[seen1, seen2]: &&[Observation; 2]| {
            sampson_px_of_rays(motion, seen1, seen2) < max_error_px
        };
        inliers.iter().filter(fits).count()
    };
    let scores: Vec<usize> = motions.iter().map(score).collect();
    let pose = |i: usize| -> (Matrix3<f64>, Vector3<f64>) {
        let rotation = motions[i].rotation.to_rotation_matrix().into_inner();
        (rotation, motions[i].translation.vector)
    };
    best_and_rival(&scores, pose).map(|place| place.map(|i| motions[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::camera::{Camera, Division, Fisheye, Lens};
    use crate::math::random::Random;
    use nalgebra::{Point2, Point3};

    /// Matches with noise of half a pixel, every tenth wrong.
    fn seen(
        lens: &Lens,
        focal_px: f64,
        motion: &RigidTransform,
        point: impl Fn(&mut Random) -> Point3<f64>,
    ) -> [Vec<Observation>; 2] {
        let mut random = Random::new(4);
        let k = Intrinsics::centered(focal_px, 800, 800).unwrap();
        let camera = Camera {
            lens: *lens,
            ..Camera::pinhole(k, 800, 800)
        };
        let mut seen = [Vec::new(), Vec::new()];
        while seen[0].len() < 240 {
            let x = point(&mut random);
            let mut see = |x: &Point3<f64>, off_px: f64| {
                let off = Point2::new(random.normal(), random.normal()).coords * off_px;
                let pixel = camera.project(x).ok()? + off;
                let inside = 0.0..800.0;
                let is_inside = inside.contains(&pixel.x) && inside.contains(&pixel.y);
                camera.observe(&pixel).ok().filter(|_| is_inside)
            };
            let off_px = if seen[0].len() % 10 == 0 { 50.0 } else { 0.5 };
            if let (Some(one), Some(two)) = (see(&x, 0.5), see(&(motion * x), off_px)) {
                seen[0].push(one);
                seen[1].push(two);
            }
        }
        seen
    }

    fn wall(random: &mut Random) -> Point3<f64> {
        Point3::new(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 3.0)
    }

    fn room(random: &mut Random) -> Point3<f64> {
        Point3::new(
            random.uniform(-3.0, 3.0),
            random.uniform(-3.0, 3.0),
            random.uniform(2.0, 7.0),
        )
    }

    #[test]
    fn depth_a_plane_and_a_turn_are_told_apart_by_wide_and_by_narrow_lenses() {
        let fisheye = Lens::Fisheye(Fisheye {
            coefficients: [-0.02, 0.004, 0.0, 0.0],
        });
        let narrow = Lens::Division(Division { k: -0.2 });
        let turn = Vector3::new(0.03, -0.1, 0.05);
        let step = RigidTransform::new(Vector3::new(-0.5, 0.1, 0.2), turn);
        let still = RigidTransform::rotation(turn);
        let options = TwoViewOptions::default().within(2.0);
        for (lens, focal_px) in [(fisheye, 260.0), (narrow, 1400.0)] {
            let run = |motion, point: fn(&mut Random) -> Point3<f64>| {
                let [seen1, seen2] = seen(&lens, focal_px, motion, point);
                estimate_two_view_of_rays(&seen1, &seen2, &options, &mut ()).unwrap()
            };
            let general = run(&step, room);
            assert_eq!(general.configuration, Configuration::General, "{lens:?}");
            let found = general.cam2_from_cam1.unwrap();
            let off = found.rotation.angle_to(&step.rotation).to_degrees();
            let direction = step.translation.vector;
            let aside = found.translation.vector.angle(&direction).to_degrees();
            assert!(off < 0.3 && aside < 4.0, "{lens:?} {off} {aside}");

            let planar = run(&step, wall);
            assert_eq!(planar.configuration, Configuration::Planar, "{lens:?}");
            // One of the two is right, if there are two.
            let both = [planar.cam2_from_cam1, planar.other_cam2_from_cam1];
            let off = both
                .iter()
                .flatten()
                .map(|motion| motion.rotation.angle_to(&step.rotation).to_degrees());
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off < 1.0, "{lens:?} {off}");
            assert!(
                (214..=226).contains(&planar.num_inliers),
                "{}",
                planar.num_inliers
            );

            let panoramic = run(&still, room);
            assert_eq!(
                panoramic.configuration,
                Configuration::Panoramic,
                "{lens:?}"
            );
            let found = panoramic.cam2_from_cam1.unwrap();
            assert!(found.rotation.angle_to(&still.rotation) < 1e-3);
            assert_eq!(found.translation.vector, Vector3::zeros());
            assert_eq!(panoramic.median_triangulation_angle_rad, None);
        }
    }

    #[test]
    fn few_matches_are_degenerate_or_refused() {
        let lens = Lens::Fisheye(Fisheye::default());
        let step = RigidTransform::translation(-0.5, 0.0, 0.0);
        let [seen1, seen2] = seen(&lens, 260.0, &step, room);
        let options = TwoViewOptions::default().within(2.0);
        let few = estimate_two_view_of_rays(&seen1[..12], &seen2[..12], &options, &mut ()).unwrap();
        assert_eq!(few.configuration, Configuration::Degenerate);
        assert_eq!(few.cam2_from_cam1, None);
        let refused = estimate_two_view_of_rays(&seen1[..4], &seen2[..4], &options, &mut ());
        assert!(matches!(refused, Err(Error::TooFew { .. })));
    }
}
