//! Progress reports while a reconstruction grows, early ends, and refused input.

use super::world::{Making, arc, ball, errors, intrinsics, observe, run};
use epipole::Error;
use epipole::camera::Camera;
use epipole::progress::{Stage, Status};
use epipole::sfm::{
    IncrementalReconstruction, PairMatches, SfmImage, SfmInput, SfmOptions, SfmStep, reconstruct,
};
use nalgebra::Point3;
use std::ops::ControlFlow;

#[test]
fn steps_add_one_image_each_and_lead_to_the_same() {
    let center = Point3::new(0.0, 0.0, 6.0);
    let world = observe(arc(7, center), &ball(150, center, 5), Making::default(), 5);
    let options = SfmOptions::default();
    let mut counts = Vec::new();
    let mut steps = Vec::new();
    let mut growing = start(&world.input, &options);
    while let Some(step) = growing.step(&mut ()).expect("a step") {
        steps.push(step);
        if matches!(step, SfmStep::Adjusted { .. }) {
            continue;
        }
        let so_far = growing.current().expect("a component");
        assert!(
            (so_far.points.iter())
                .all(|point| point.track.len() >= 2 && point.error_px.is_finite())
        );
        counts.push((so_far.num_registered(), so_far.points.len()));
    }
    let found = growing.finish();
    assert!(found.is_complete);
    assert_eq!(found.steps, steps);
    assert_eq!(found, run(&world, &options));
    let registered: Vec<usize> = counts.iter().map(|(registered, _)| *registered).collect();
    assert_eq!(registered, [2, 3, 4, 5, 6, 7]);
    assert!(counts[0].1 > 20 && counts[5].1 >= counts[0].1, "{counts:?}");
    // Early end by the caller.
    let mut growing = start(&world.input, &options);
    for _ in 0..3 {
        growing.step(&mut ()).expect("a step");
    }
    let ended = growing.finish();
    assert!(!ended.is_complete);
    assert_eq!(ended.components[0].num_registered(), 4);
}

fn start(input: &SfmInput, options: &SfmOptions) -> IncrementalReconstruction {
    IncrementalReconstruction::new(input, options, &mut ()).expect("pairs")
}

#[test]
fn canceling_leaves_a_valid_part() {
    let world = observe(
        arc(7, Point3::origin()),
        &ball(150, Point3::origin(), 11),
        Making::default(),
        12,
    );
    let options = SfmOptions::default();
    let mut growing = start(&world.input, &options);
    for _ in 0..3 {
        growing.step(&mut ()).expect("a step");
    }
    let result = growing.finish();
    assert_eq!(result.components[0].num_registered(), 4);
    assert_eq!(result.unregistered.len(), 3);
    let (distance, _) = errors(&world, &result.components[0].cameras);
    assert!(distance < 1e-3, "{distance}");
    // Also in the middle of an adjustment: the last step is the one that was canceled.
    let mut growing = start(&world.input, &options);
    for _ in 0..2 {
        growing.step(&mut ()).expect("a step");
    }
    let canceled = growing.step(&mut |status: Status| match status.stage {
        Stage::BundleAdjustment => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    assert_eq!(canceled, Err(Error::Canceled));
    let result = growing.finish();
    assert!(!result.is_complete);
    assert_eq!(result.components[0].num_registered(), 4);
    let (distance, _) = errors(&world, &result.components[0].cameras);
    assert!(distance < 0.01, "{distance}");
    let mut at_once = |_| ControlFlow::Break(());
    let nothing = reconstruct(&world.input, &options, &mut at_once);
    assert_eq!(nothing, Err(Error::Canceled));
}

#[test]
fn progress_names_stages_and_fractions_that_rise() {
    let world = observe(
        arc(5, Point3::origin()),
        &ball(120, Point3::origin(), 11),
        Making::default(),
        12,
    );
    let options = SfmOptions::default();
    let mut reports: Vec<Status> = Vec::new();
    let mut watch = |status| {
        reports.push(status);
        ControlFlow::Continue(())
    };
    let watched = reconstruct(&world.input, &options, &mut watch);
    assert_eq!(watched.expect("a result"), run(&world, &options));
    assert!(reports.is_sorted_by_key(|status| status.fraction));
    assert!(reports[reports.len() - 1].fraction == 1.0);
    for stage in [
        Stage::PairVerification,
        Stage::Registration,
        Stage::BundleAdjustment,
    ] {
        assert!(
            reports.iter().any(|status| status.stage == stage),
            "{stage:?}"
        );
    }
    let mut stop = |status: Status| match status.stage {
        Stage::PairVerification => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    let mut growing = IncrementalReconstruction::new(&world.input, &options, &mut stop)
        .expect("pairs are tested");
    assert_eq!(growing.step(&mut stop), Err(Error::Canceled));
    let stopped = growing.finish();
    assert_eq!(stopped.components[0].num_registered(), 2);
}

#[test]
fn images_without_overlap_give_nothing_and_no_error() {
    let mut world = observe(
        arc(3, Point3::origin()),
        &ball(80, Point3::origin(), 13),
        Making::default(),
        14,
    );
    world.input.pairs.clear();
    let result = run(&world, &SfmOptions::default());
    assert!(result.components.is_empty() && result.unregistered == [0, 1, 2]);
    // Matches that are all wrong, and photographs without keypoints.
    let making = Making {
        wrong: 1.0,
        ..Making::default()
    };
    let world = observe(
        arc(3, Point3::origin()),
        &ball(80, Point3::origin(), 13),
        making,
        15,
    );
    run(&world, &SfmOptions::default());
    let mut empty = SfmInput {
        images: vec![SfmImage::default(); 3],
        cameras: vec![Camera::pinhole(intrinsics(), 640, 480)],
        pairs: Vec::new(),
    };
    empty.pairs.push(PairMatches {
        image1: 0,
        image2: 1,
        matches: Vec::new(),
    });
    let result = reconstruct(&empty, &SfmOptions::default(), &mut ()).expect("an empty result");
    assert_eq!(result.unregistered, [0, 1, 2]);
}

#[test]
fn bad_input_is_refused() {
    let world = observe(
        arc(3, Point3::origin()),
        &ball(60, Point3::origin(), 16),
        Making::default(),
        17,
    );
    let attempt = |change: &dyn Fn(&mut SfmInput, &mut SfmOptions)| {
        let (mut input, mut options) = (world.input.clone(), SfmOptions::default());
        change(&mut input, &mut options);
        reconstruct(&input, &options, &mut ())
    };
    assert!(matches!(
        attempt(&|i, _| i.images.truncate(1)),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.cameras.clear()),
        Err(Error::SizeMismatch { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.images[1].keypoints[3].x = f64::NAN),
        Err(Error::NotFinite { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.pairs[0].matches[0].index2 = 9999),
        Err(Error::OutOfRange { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| i.pairs[0].image2 = 0),
        Err(Error::OutOfRange { .. })
    ));
    assert!(matches!(
        attempt(&|i, _| {
            i.images[0].colors.pop();
        }),
        Err(Error::SizeMismatch { .. })
    ));
    for value in [0.0, -1.0, f64::NAN] {
        let result = attempt(&|_, o| o.max_reprojection_error_px = value);
        assert!(matches!(result, Err(Error::OutOfRange { .. })));
    }
}
