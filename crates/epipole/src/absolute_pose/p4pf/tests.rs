//! Random problems against exact truth.

use super::super::p3p::tests::problem;
use super::*;
use crate::camera::{Intrinsics, RigidTransform};
use crate::math::random::Random;
use nalgebra::Rotation3;

const CENTER: Point2<f64> = Point2::new(320.0, 240.0);

fn focal(random: &mut Random) -> f64 {
    400.0 * libm::exp(random.uniform(0.0, 2.0))
}

/// Relative errors of focal length and pose of the solution nearest to the truth.
fn off(
    solutions: &[AbsolutePoseWithFocal],
    truth: &RigidTransform,
    focal_px: f64,
) -> Option<(f64, f64)> {
    let errors = |s: &AbsolutePoseWithFocal| {
        let t = s.cam_from_world.translation.vector - truth.translation.vector;
        let angle = s.cam_from_world.rotation.angle_to(&truth.rotation);
        ((s.focal_px / focal_px - 1.0).abs(), angle + t.norm())
    };
    let all = solutions.iter().map(errors);
    all.min_by(|a, b| (a.0 + a.1).total_cmp(&(b.0 + b.1)))
}

fn camera(focal_px: f64) -> Intrinsics {
    Intrinsics::new(focal_px, focal_px, CENTER.x, CENTER.y).unwrap()
}

#[test]
fn ten_thousand_problems() {
    let mut random = Random::new(1);
    let (mut found, mut first, mut total) = (0, 0, 0);
    for _ in 0..10_000 {
        let (truth, rays, points) = problem::<4>(&mut random);
        let focal_px = focal(&mut random);
        let pixels = rays.map(|r| camera(focal_px).project(&r.into()).unwrap());
        let solutions = pose_p4pf(&pixels, &points, &CENTER);
        total += solutions.len();
        let is_true = |list: &[AbsolutePoseWithFocal]| {
            off(list, &truth, focal_px).is_some_and(|(f, pose)| f < 1e-6 && pose < 1e-6)
        };
        found += usize::from(is_true(&solutions));
        first += usize::from(is_true(&solutions[..solutions.len().min(1)]));
    }
    println!("four points: {found} of 10000, {first} first, {total} solutions");
    assert!(found >= 9990, "{found}");
    // Four points are overdetermined by one equation, so the best solution is the true one.
    assert!(first >= 9985, "{first}");
}

/// Four points on a plane that is tilted by 10° or more.
fn tilted(random: &mut Random) -> (RigidTransform, [Point3<f64>; 4]) {
    let rotation_vector = Vector3::from_fn(|_, _| random.normal());
    let t = Vector3::from_fn(|_, _| random.normal());
    let truth = RigidTransform::new(t, rotation_vector);
    let (axis, angle) = (random.uniform(0.0, 6.3), random.uniform(0.17, 1.0));
    let tilt =
        Rotation3::from_scaled_axis(Vector3::new(libm::cos(axis), libm::sin(axis), 0.0) * angle);
    // Corners of a square, randomly displaced so that no three are collinear.
    let points = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
        let (dx, dy) = (random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
        let x = tilt * Vector3::new(x + dx, y + dy, 0.0) + Vector3::new(0.1, -0.2, 4.0);
        truth.inverse_transform_point(&Point3::from(x))
    });
    (truth, points)
}

#[test]
fn ten_thousand_planes() {
    let mut random = Random::new(2);
    // From coplanar to thick, also at the level of rounding.
    for thickness in [0.0, 1e-13, 1e-9, 1e-5, 1e-2, 0.1, 0.3] {
        let (mut found, count) = (0, 1500);
        for _ in 0..count {
            let (truth, mut points) = tilted(&mut random);
            for x in &mut points {
                x.coords += Vector3::from_fn(|_, _| thickness * random.uniform(-1.0, 1.0));
            }
            let focal_px = focal(&mut random);
            let pixels = points.map(|x| camera(focal_px).project(&(truth * x)).unwrap());
            let solutions = pose_p4pf(&pixels, &points, &CENTER);
            found += usize::from(
                off(&solutions, &truth, focal_px).is_some_and(|(f, pose)| f < 1e-6 && pose < 1e-6),
            );
        }
        println!("thickness {thickness:e}: {found} of {count}");
        assert!(1000 * found >= 999 * count, "{thickness:e}: {found}");
    }
}

#[test]
fn noise_moves_the_answer_no_more_than_it_must() {
    let mut random = Random::new(3);
    let mut medians = Vec::new();
    for noise_px in [0.01, 0.1, 1.0] {
        let mut errors = Vec::new();
        for _ in 0..1000 {
            let (truth, rays, points) = problem::<4>(&mut random);
            let focal_px = focal(&mut random);
            let pixels = rays.map(|r| {
                let p = camera(focal_px).project(&r.into()).unwrap();
                p + noise_px * nalgebra::Vector2::new(random.normal(), random.normal())
            });
            let solutions = pose_p4pf(&pixels, &points, &CENTER);
            errors.push(off(&solutions, &truth, focal_px).map_or(1.0, |(f, _)| f));
        }
        errors.sort_by(f64::total_cmp);
        println!(
            "noise {noise_px} px: median {:e}, 90 % {:e}",
            errors[500], errors[900]
        );
        medians.push(errors[500]);
    }
    // Proportional to the noise: one pixel in some thousand costs a few percent.
    assert!(medians[2] < 0.03, "{medians:?}");
    assert!(
        medians[0] < 0.02 * medians[2] && medians[1] < 0.15 * medians[2],
        "{medians:?}"
    );
}

#[test]
fn far_from_the_origin_and_in_any_unit() {
    let mut random = Random::new(4);
    for (shift, scale) in [(1e6, 1.0), (0.0, 1e-9), (0.0, 1e9)] {
        for _ in 0..100 {
            let (truth, points) = tilted(&mut random);
            let thick = points.map(|x| x + Vector3::from_fn(|_, _| random.uniform(-0.5, 0.5)));
            let pixels = thick.map(|x| camera(800.0).project(&(truth * x)).unwrap());
            let moved = thick.map(|x| x * scale + Vector3::new(shift, -shift, shift));
            let best = pose_p4pf(&pixels, &moved, &CENTER)[0];
            // The pixels are known to 1e-13 of the points' distance from the origin.
            assert!((best.focal_px / 800.0 - 1.0).abs() < 1e-6, "{best:?}");
            for (x, pixel) in moved.iter().zip(&pixels) {
                let projected = camera(best.focal_px)
                    .project(&(best.cam_from_world * x))
                    .unwrap();
                assert!(
                    (projected - pixel).norm() < 1e-3,
                    "{}",
                    (projected - pixel).norm()
                );
            }
        }
    }
}

#[test]
fn degenerate_input_has_no_solution_or_finite_ones() {
    let mut random = Random::new(5);
    let (truth, points) = tilted(&mut random);
    let pixels = points.map(|x| camera(700.0).project(&(truth * x)).unwrap());
    // A plane that faces the camera.
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let facing = square.map(|(x, y)| Point3::new(x, y, 5.0));
    let projected = facing.map(|x| camera(700.0).project(&x).unwrap());
    assert!(pose_p4pf(&projected, &facing, &CENTER).is_empty());
    // Equal points, equal pixels, three and four points on a line.
    assert!(pose_p4pf(&pixels, &[points[0]; 4], &CENTER).is_empty());
    assert!(pose_p4pf(&[CENTER; 4], &points, &CENTER).is_empty());
    let line = [0.0, 1.0, 2.5, 4.0].map(|s| Point3::new(s, 0.3 * s, 5.0 - 0.5 * s));
    let projected = line.map(|x| camera(700.0).project(&x).unwrap());
    assert!(pose_p4pf(&projected, &line, &CENTER).is_empty());
    let three = [line[0], line[1], line[2], Point3::new(0.0, 2.0, 6.0)];
    let projected = three.map(|x| camera(700.0).project(&x).unwrap());
    assert!(pose_p4pf(&projected, &three, &CENTER).is_empty());
    // A plane seen edge-on.
    let side = square.map(|(x, y)| Point3::new(0.0, x + 0.2 * y, 5.0 + y));
    let projected = side.map(|x| camera(700.0).project(&x).unwrap());
    assert!(pose_p4pf(&projected, &side, &CENTER).is_empty());
    // Coordinates that are not finite, or far too large.
    for bad in [f64::NAN, f64::INFINITY, 1e300, -1e200] {
        for place in 0..4 {
            let (mut p, mut x) = (pixels, points);
            p[place].x = bad;
            x[place].z = bad;
            for found in [
                pose_p4pf(&p, &points, &CENTER),
                pose_p4pf(&pixels, &x, &CENTER),
            ] {
                let finite = |s: &AbsolutePoseWithFocal| {
                    s.focal_px.is_finite()
                        && s.cam_from_world
                            .to_homogeneous()
                            .iter()
                            .all(|v| v.is_finite())
                };
                assert!(found.iter().all(finite), "{found:?}");
            }
        }
    }
    // Random points with random pixels: a least-squares solution or none, and always finite.
    for _ in 0..2000 {
        let any = |random: &mut Random, r: f64| random.uniform(-r, r);
        let p = [(); 4].map(|()| Point2::new(any(&mut random, 500.0), any(&mut random, 400.0)));
        let x = [(); 4].map(|()| {
            Point3::new(
                any(&mut random, 1.0),
                any(&mut random, 1.0),
                any(&mut random, 1.0),
            )
        });
        for s in pose_p4pf(&p, &x, &CENTER) {
            assert!(s.focal_px > 0.0 && s.focal_px.is_finite());
        }
    }
}
