//! Functions of points and matches.

use crate::{Outcome, Timers, keep};
use epipole::absolute_pose::{
    estimate_absolute_pose, fit_absolute_pose, pose_p3p, reprojection_error_px,
};
use epipole::camera::relative_motion;
use epipole::epipolar::{
    epipolar_line2, essential_5point, estimate_essential, estimate_fundamental,
    estimate_relative_pose, fundamental_7point, fundamental_8point, fundamental_from_cameras,
    refine_fundamental, sampson_px, symmetric_epipolar_px,
};
use epipole::homography::{estimate_homography, fit_homography, transfer, transfer_error_px};
use epipole::nalgebra::{Point2, Point3, Vector3};
use epipole::optim::RobustLoss;
use epipole::robust::{RansacOptions, estimate_similarity};
use epipole::synthetic::{TwoViewProblem, TwoViewProblemOptions};
use epipole::triangulation::triangulate_optimal;
use epipole::triangulation::{correct_matches, triangulate_angular, triangulate_dlt};
use epipole::two_view::{TwoViewOptions, estimate_two_view, estimate_two_view_calibrated};

/// Numbers of points of functions of single points, and of estimators.
const MANY: usize = 100_000;
const SOME: usize = 1000;

fn problem(num_points: usize, outlier_fraction: f64) -> epipole::Result<TwoViewProblem> {
    TwoViewProblem::new(
        &TwoViewProblemOptions::default()
            .with_num_points(num_points)
            .with_noise_px(0.5)
            .with_outlier_fraction(outlier_fraction)
            .with_seed(1),
    )
}

pub(crate) fn add(timers: &mut Timers) -> Outcome {
    add_points(timers, keep(problem(MANY, 0.0)?))?;
    add_one(timers, keep(problem(SOME, 0.0)?))?;
    add_estimators(timers, keep(problem(SOME, 0.3)?))
}

/// Functions of many single points, in the loop that a caller writes.
fn add_points(timers: &mut Timers, many: &'static TwoViewProblem) -> Outcome {
    let (one, two) = (&many.pixels1, &many.pixels2);
    let pairs = move || one.iter().zip(two);
    let (cam1, cam2) = (&many.camera1, &many.camera2);
    let f = fundamental_from_cameras(cam1, cam2)?;
    let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
    let h = fit_homography(one, two)?;
    let in_cam: Vec<Point3<f64>> = (many.points.iter())
        .map(|x| cam1.cam_from_world.transform_point(x))
        .collect();
    timers.add("sampson_px", move || {
        pairs()
            .map(|(p, q)| sampson_px(&f, p, q))
            .collect::<Vec<_>>()
    });
    timers.add("symmetric_epipolar_px", move || {
        let distance = |(p, q)| symmetric_epipolar_px(&f, p, q);
        pairs().map(distance).collect::<Vec<_>>()
    });
    timers.add("epipolar_line2", move || {
        one.iter()
            .map(|p| epipolar_line2(&f, p))
            .collect::<Vec<_>>()
    });
    timers.add("transfer", move || {
        one.iter().map(|p| transfer(&h, p)).collect::<Vec<_>>()
    });
    timers.add("transfer_error_px", move || {
        let error = |(p, q)| transfer_error_px(&h, p, q);
        pairs().map(error).collect::<Vec<_>>()
    });
    timers.add("Camera.project", move || {
        in_cam
            .iter()
            .map(|x| cam1.camera.project(x))
            .collect::<Vec<_>>()
    });
    timers.add("Camera.unproject", move || {
        one.iter()
            .map(|p| cam1.camera.unproject(p))
            .collect::<Vec<_>>()
    });
    timers.add("RigidTransform @ points", move || {
        let moved = |x: &Point3<f64>| motion.transform_point(x);
        many.points.iter().map(moved).collect::<Vec<_>>()
    });
    timers.add("reprojection_error_px", move || {
        let pairs = many.points.iter().zip(one);
        pairs
            .map(|(x, p)| reprojection_error_px(cam1, x, p))
            .collect::<Vec<_>>()
    });
    let (p1, p2) = (cam1.projection_matrix(), cam2.projection_matrix());
    timers.add("triangulate_dlt", move || {
        pairs()
            .map(|(p, q)| triangulate_dlt(&p1, &p2, p, q))
            .collect::<Vec<_>>()
    });
    timers.add("triangulate_optimal", move || {
        let point = |(p, q)| triangulate_optimal(cam1, cam2, p, q);
        pairs().map(point).collect::<Vec<_>>()
    });
    timers.add("correct_matches", move || {
        pairs()
            .map(|(p, q)| correct_matches(&f, p, q))
            .collect::<Vec<_>>()
    });
    let rays = |pixels: &[Point2<f64>]| -> epipole::Result<Vec<Vector3<f64>>> {
        pixels.iter().map(|p| cam1.camera.unproject(p)).collect()
    };
    let (rays1, rays2) = (rays(one)?, rays(two)?);
    timers.add("triangulate_angular", move || {
        let pairs = rays1.iter().zip(&rays2);
        pairs
            .map(|(a, b)| triangulate_angular(&motion, a, b))
            .collect::<Vec<_>>()
    });
    timers.add("fundamental_8point", move || fundamental_8point(one, two));
    timers.add("fit_homography", move || fit_homography(one, two));
    Ok(())
}

/// Calls with a handful of numbers.
fn add_one(timers: &mut Timers, some: &'static TwoViewProblem) -> Outcome {
    let camera = &some.camera1.camera;
    let f = fundamental_from_cameras(&some.camera1, &some.camera2)?;
    let (p, q) = (some.pixels1[0], some.pixels2[0]);
    timers.add("sampson_px, one pair", move || sampson_px(&f, &p, &q));
    timers.add("Camera.unproject, one pixel", move || camera.unproject(&p));
    let seven = |pixels: &[Point2<f64>]| -> [Point2<f64>; 7] { std::array::from_fn(|i| pixels[i]) };
    let (seven1, seven2) = (seven(&some.pixels1), seven(&some.pixels2));
    timers.add("fundamental_7point", move || {
        fundamental_7point(&seven1, &seven2)
    });
    let rays = |pixels: &[Point2<f64>]| -> epipole::Result<Vec<Vector3<f64>>> {
        pixels[..5].iter().map(|p| camera.unproject(p)).collect()
    };
    let (rays1, rays2) = (rays(&some.pixels1)?, rays(&some.pixels2)?);
    let five = |rays: &[Vector3<f64>]| -> [Vector3<f64>; 5] { std::array::from_fn(|i| rays[i]) };
    let (five1, five2) = (five(&rays1), five(&rays2));
    timers.add("essential_5point", move || essential_5point(&five1, &five2));
    let three_rays = [rays1[0], rays1[1], rays1[2]];
    let three_points = [some.points[0], some.points[1], some.points[2]];
    timers.add("pose_p3p", move || pose_p3p(&three_rays, &three_points));
    Ok(())
}

/// Estimators, in part of matches with outliers.
fn add_estimators(timers: &mut Timers, some: &'static TwoViewProblem) -> Outcome {
    let (one, two) = (&some.pixels1, &some.pixels2);
    let camera = &some.camera1.camera;
    let cameras = [camera, &some.camera2.camera];
    let ransac = RansacOptions::default();
    timers.add("estimate_fundamental", move || {
        estimate_fundamental(one, two, &ransac, &mut ())
    });
    timers.add("estimate_essential", move || {
        estimate_essential(one, two, cameras, &ransac, &mut ())
    });
    timers.add("estimate_relative_pose", move || {
        estimate_relative_pose(one, two, cameras, &ransac, &mut ())
    });
    timers.add("estimate_homography", move || {
        estimate_homography(one, one, &ransac, &mut ())
    });
    timers.add("estimate_similarity", move || {
        estimate_similarity(one, one, &ransac, &mut ())
    });
    timers.add("estimate_absolute_pose", move || {
        estimate_absolute_pose(&some.points, two, camera, &ransac, &mut ())
    });
    timers.add("fit_absolute_pose", move || {
        fit_absolute_pose(&some.points, one, camera)
    });
    let two_view = TwoViewOptions::default();
    timers.add("estimate_two_view", move || {
        estimate_two_view(one, two, &two_view, &mut ())
    });
    timers.add("estimate_two_view_calibrated", move || {
        estimate_two_view_calibrated(one, two, cameras, &two_view, &mut ())
    });
    let f = fundamental_from_cameras(&some.camera1, &some.camera2)?;
    timers.add("refine_fundamental", move || {
        refine_fundamental(&f, one, two, RobustLoss::Trivial)
    });
    Ok(())
}
