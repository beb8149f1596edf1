//! Progress and cancellation of two-view estimation.

use std::ops::ControlFlow;

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::math::random::Random;
use epipole::progress::{Monitor, Stage, Status};
use epipole::two_view::{TwoViewOptions, estimate_two_view, estimate_two_view_calibrated};
use nalgebra::{Point2, Point3, Vector3};

/// 60 right matches of a scene with depth and 30 wrong ones.
fn matches(k: &Intrinsics) -> (Vec<Point2<f64>>, Vec<Point2<f64>>) {
    let mut random = Random::new(5);
    let cam2_from_cam1 = RigidTransform::new(Vector3::new(-0.6, 0.1, 0.2), Vector3::y() * 0.1);
    let wrong = (0..30).map(|_| {
        let mut pixel = || Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        (pixel(), pixel())
    });
    let wrong: Vec<_> = wrong.collect();
    let right = (0..60).map(|_| {
        let mut coordinate = || random.uniform(-1.0, 1.0);
        let x = Point3::new(coordinate(), coordinate(), 4.0 + coordinate());
        (
            k.project(&x).unwrap(),
            k.project(&(cam2_from_cam1 * x)).unwrap(),
        )
    });
    wrong.into_iter().chain(right).unzip()
}

#[test]
fn progress_rises_and_the_work_can_be_canceled_at_any_report() {
    let k = Intrinsics::centered(600.0, 640, 480).unwrap();
    let (p1, p2) = matches(&k);
    let options = TwoViewOptions::default();
    let run = |calibrated: bool, monitor: &mut dyn Monitor| match calibrated {
        true => estimate_two_view_calibrated(
            &p1,
            &p2,
            [&Camera::pinhole(k, 640, 480); 2],
            &options,
            monitor,
        ),
        false => estimate_two_view(&p1, &p2, &options, monitor),
    };
    for calibrated in [false, true] {
        let whole = run(calibrated, &mut ()).unwrap();
        let mut fractions = Vec::new();
        let mut watch = |status: Status| {
            assert_eq!(status.stage, Stage::RobustEstimation);
            fractions.push(status.fraction);
            ControlFlow::Continue(())
        };
        let watched = run(calibrated, &mut watch).unwrap();
        assert_eq!(watched, whole, "watching changes nothing");
        assert!(fractions.len() > 10 && fractions.is_sorted() && fractions[0] < 0.1);
        assert!(
            fractions
                .iter()
                .all(|fraction| (0.0..=1.0).contains(fraction))
        );
        for end in 1..=fractions.len() {
            let mut count = 0;
            let canceled = run(calibrated, &mut |_: Status| {
                count += 1;
                match count == end {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            });
            assert_eq!(canceled, Err(Error::Canceled));
            assert_eq!(count, end, "none after the end");
        }
    }
}

#[test]
fn bad_input_is_refused_before_anything_is_drawn() {
    let k = Intrinsics::centered(600.0, 640, 480).unwrap();
    let (p1, p2) = matches(&k);
    let options = TwoViewOptions::default();
    let mut never = |status: Status| panic!("{status:?}");
    let short = estimate_two_view(&p1, &p2[1..], &options, &mut never);
    assert!(
        matches!(short, Err(Error::SizeMismatch { .. })),
        "{short:?}"
    );
    let few = estimate_two_view_calibrated(
        &p1[..1],
        &p2[..1],
        [&Camera::pinhole(k, 640, 480); 2],
        &options,
        &mut never,
    );
    assert!(matches!(few, Err(Error::TooFew { .. })), "{few:?}");
}
