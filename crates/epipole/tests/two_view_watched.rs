//! The search for what two views show can be watched, and ended at any sample.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::ops::ControlFlow;

use epipole::Error;
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::math::random::Random;
use epipole::robust::{RansacOptions, StopReason};
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, TwoViewSearch, TwoViewTrial,
    estimate_two_view, estimate_two_view_calibrated, estimate_two_view_calibrated_with,
    estimate_two_view_with,
};
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

/// What an answer says, in words, and that its parts agree.
fn check(answer: &Result<TwoViewReport, Error>, drawn: usize, canceled: bool) {
    let report = match answer {
        Err(error) => {
            assert_eq!(*error, Error::Canceled);
            assert!(canceled);
            return;
        }
        Ok(report) => report,
    };
    assert_eq!(report.iterations, drawn);
    assert_eq!(report.stop == StopReason::Canceled, canceled);
    let count = report.inliers.iter().filter(|inlier| **inlier).count();
    assert_eq!(
        (report.inliers.len(), count),
        (90, report.num_inliers),
        "the mask is of all matches"
    );
    if report.configuration == Configuration::Degenerate {
        assert_eq!(report.cam2_from_cam1, None);
    }
}

#[test]
fn the_work_may_end_at_any_sample() {
    let k = Intrinsics::centered(600.0, 640, 480).unwrap();
    let (p1, p2) = matches(&k);
    let options = TwoViewOptions {
        // 20 samples a search at least: E, F, H and the turn are all reached soon.
        ransac: RansacOptions {
            min_iterations: 20,
            max_iterations: 60,
            ..RansacOptions::default()
        },
        ..TwoViewOptions::default()
    };
    let whole = [
        estimate_two_view(&p1, &p2, &options).unwrap(),
        estimate_two_view_calibrated(&p1, &p2, &k, &k, &options).unwrap(),
    ];
    assert!(matches!(whole[0].model, TwoViewModel::Fundamental(_)));
    assert!(matches!(whole[1].model, TwoViewModel::Essential(_)));
    for (calibrated, whole) in whole.iter().enumerate() {
        let (mut found, mut early_pose) = (0, 0);
        for end in 1..=whole.iterations + 1 {
            let mut trials: Vec<TwoViewTrial> = Vec::new();
            let mut observer = |trial: &TwoViewTrial| {
                trials.push(*trial);
                if trials.len() == end {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let answer = if calibrated == 1 {
                estimate_two_view_calibrated_with(&p1, &p2, &k, &k, &options, &mut observer)
            } else {
                estimate_two_view_with(&p1, &p2, &options, &mut observer)
            };
            assert_eq!(
                trials.len(),
                end.min(whole.iterations),
                "none after the end"
            );
            check(&answer, trials.len(), end <= whole.iterations);
            // Each search counts its own samples, from one.
            for pair in trials.windows(2) {
                let expected = if pair[0].search == pair[1].search {
                    pair[0].iteration + 1
                } else {
                    1
                };
                assert_eq!(pair[1].iteration, expected);
            }
            if let Ok(report) = &answer {
                found += 1;
                let in_first = trials.iter().all(|t| t.search == trials[0].search);
                early_pose += usize::from(in_first && report.cam2_from_cam1.is_some());
            }
            if end > whole.iterations {
                assert_eq!(answer.as_ref(), Ok(whole), "watching changes nothing");
                let mut searches: Vec<TwoViewSearch> = trials.iter().map(|t| t.search).collect();
                searches.dedup();
                let all = [
                    TwoViewSearch::Essential,
                    TwoViewSearch::Fundamental,
                    TwoViewSearch::Homography,
                    TwoViewSearch::Rotation,
                ];
                let expected = if calibrated == 1 {
                    &all[..]
                } else {
                    &all[1..3]
                };
                assert_eq!(searches, expected);
            }
        }
        assert!(found > whole.iterations / 2);
        assert_eq!(
            early_pose > 0,
            calibrated == 1,
            "E alone is enough for a motion"
        );
    }
}

#[test]
fn what_is_wrong_with_the_input_is_said_before_anything_is_drawn() {
    let k = Intrinsics::centered(600.0, 640, 480).unwrap();
    let (p1, p2) = matches(&k);
    let options = TwoViewOptions::default();
    let mut never = |trial: &TwoViewTrial| panic!("{trial:?}");
    let short = estimate_two_view_with(&p1, &p2[1..], &options, &mut never);
    assert!(
        matches!(short, Err(Error::SizeMismatch { .. })),
        "{short:?}"
    );
    let few = estimate_two_view_calibrated_with(&p1[..1], &p2[..1], &k, &k, &options, &mut never);
    assert!(matches!(few, Err(Error::TooFew { .. })), "{few:?}");
}
