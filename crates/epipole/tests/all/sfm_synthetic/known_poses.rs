//! Points from matches of photographs with known poses.

use super::world::{Making, World, arc, ball, observe};
use epipole::Error;
use epipole::camera::RigidTransform;
use epipole::sfm::{SfmOptions, triangulate_tracks};
use nalgebra::{Point3, Vector3};
use std::ops::ControlFlow;

fn poses(world: &World) -> Vec<Option<RigidTransform>> {
    let cameras = world.cameras.iter();
    cameras.map(|camera| Some(camera.cam_from_world)).collect()
}

#[test]
fn points_are_at_their_places_in_the_world_of_the_poses() {
    let points = ball(200, Point3::origin(), 3);
    let making = Making {
        noise_px: 0.5,
        wrong: 0.25,
        ..Making::default()
    };
    let world = observe(arc(6, Point3::origin()), &points, making, 4);
    let found = triangulate_tracks(
        &world.input,
        &poses(&world),
        &SfmOptions::default(),
        &mut (),
    )
    .expect("points");
    for (camera, truth) in found.cameras.iter().zip(&world.cameras) {
        assert_eq!(
            camera.expect("a camera").cam_from_world,
            truth.cam_from_world
        );
    }
    // Its color is the number of a point.
    let far = |position: &Point3<f64>, n: usize| (position - points[n]).norm() > 0.05;
    let long: Vec<_> = (found.points.iter())
        .filter(|point| point.track.len() >= 4)
        .collect();
    let num_far = (long.iter())
        .filter(|point| far(&point.position, usize::from(point.color[0])))
        .count();
    println!("{} points, {num_far} far", long.len());
    assert!(long.len() >= 190, "{}", long.len());
    assert!(num_far * 50 <= long.len(), "{num_far} of {}", long.len());
    assert!(found.mean_reprojection_px(&world.input.images) < 1.0);
}

#[test]
fn images_without_a_pose_and_poses_of_others_give_no_points() {
    let points = ball(200, Point3::origin(), 5);
    let world = observe(arc(5, Point3::origin()), &points, Making::default(), 6);
    let options = SfmOptions::default();
    let mut known = poses(&world);
    known[2] = None;
    let found = triangulate_tracks(&world.input, &known, &options, &mut ()).expect("points");
    assert!(found.cameras[2].is_none());
    assert!(found.points.len() > 150);
    let mut elements = found.points.iter().flat_map(|point| &point.track);
    assert!(elements.all(|element| element.image != 2));
    // Cameras that move ahead see points move away from the middle, these move to the side.
    let ahead = |n| {
        Some(RigidTransform::translation(
            0.0,
            0.0,
            8.0 - 0.5 * f64::from(n),
        ))
    };
    let others: Vec<_> = (0..5).map(ahead).collect();
    let few = triangulate_tracks(&world.input, &others, &options, &mut ()).expect("few points");
    assert!(
        few.points.len() * 5 < found.points.len(),
        "{}",
        few.points.len()
    );
}

#[test]
fn input_that_is_no_such_problem_is_refused() {
    let world = observe(
        arc(3, Point3::origin()),
        &ball(30, Point3::origin(), 7),
        Making::default(),
        8,
    );
    let run = |known: &[Option<RigidTransform>]| {
        triangulate_tracks(&world.input, known, &SfmOptions::default(), &mut ())
    };
    let known = poses(&world);
    assert!(matches!(run(&known[..2]), Err(Error::SizeMismatch { .. })));
    let one = [known[0], None, None];
    assert!(matches!(run(&one), Err(Error::TooFew { got: 1, .. })));
    let mut bad = known.clone();
    bad[1] = Some(RigidTransform::new(
        Vector3::new(f64::NAN, 0.0, 0.0),
        Vector3::zeros(),
    ));
    assert!(matches!(run(&bad), Err(Error::NotFinite { .. })));
    let mut stop = |_| ControlFlow::Break(());
    let stopped = triangulate_tracks(&world.input, &known, &SfmOptions::default(), &mut stop);
    assert!(matches!(stopped, Err(Error::Canceled)));
}
