//! Long computations end when canceled.

#![cfg(feature = "compute")]

use epipole_lab::project::{About, Event, Project, Step};
use epipole_lab::tasks::{Blob, Request, Sample, compute};
use std::ops::ControlFlow;

/// Computes the request and cancels at once.
fn stopped(request: &Request) -> Result<Vec<u8>, String> {
    let mut asked = 0;
    let result = compute(&request.to_bytes(), &mut |_| {
        asked += 1;
        ControlFlow::Break(())
    });
    assert!(asked > 0, "nobody was asked whether to go on");
    result
}

#[test]
fn every_long_task_stops_when_it_is_told_to() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    project.update(Event::Show(Step::Depth));
    let mut kinds = [false; 6];
    while let Some(task) = project.wanted().first().cloned() {
        let kind = match task.about {
            About::Features(_) => Some(0),
            About::Matches(..) => Some(1),
            About::Reconstruction => Some(2),
            About::Depth(..) => Some(3),
            About::Photograph(_) => Some(4),
            About::TwoViews(..) => Some(5),
            _ => None,
        };
        let request = project.request(&task).unwrap();
        if let Some(kind) = kind.filter(|kind| !kinds[*kind]) {
            assert_eq!(stopped(&request), Err("stopped".to_owned()), "{task:?}");
            kinds[kind] = true;
        }
        let result = compute(&request.to_bytes(), &mut |_| ControlFlow::Continue(()));
        project.done(task.key, result);
    }
    assert_eq!(kinds, [true; 6], "each of them was asked for");
    // An archive for which photographs must be read once more.
    let mut request = project.export_request().unwrap();
    if let Request::Export { photographs, .. } = &mut request {
        for photograph in photographs {
            photograph.used.as_mut().unwrap().rgb = Blob::default();
        }
    }
    assert_eq!(stopped(&request), Err("stopped".to_owned()));
}

/// Number of progress callbacks, if the callback of this number cancels.
fn asked(request: &Request, no_at: usize) -> (usize, Result<Vec<u8>, String>) {
    let mut count = 0;
    let result = compute(&request.to_bytes(), &mut |_| {
        count += 1;
        match count < no_at {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    });
    (count, result)
}

#[test]
fn a_pair_and_a_file_are_asked_about_more_than_once_and_end_at_the_first_no() {
    let mut project = Project::default();
    let image = image::RgbImage::from_fn(300, 200, |u, v| {
        image::Rgb([
            (u * v % 251) as u8,
            (u / 7 * 31 % 256) as u8,
            (v / 5 * 47 % 256) as u8,
        ])
    });
    project.update(Event::Add(vec![(
        "file.jpg".to_owned(),
        crate::common::jpeg(&image, 1),
    )]));
    let task = project.wanted()[0].clone();
    let file = project.request(&task).unwrap();
    // Matches without agreement take the maximum number of samples.
    let place = |n: u32| {
        let by = |factor: u32| f64::from(n * factor % 397);
        [by(31), by(57), by(101), by(139)]
    };
    let camera = epipole_lab::tasks::Calibrated {
        width: 400,
        height: 400,
        k: [500.0, 500.0, 200.0, 200.0],
    };
    let pair = Request::TwoViews {
        places: (1..80).map(place).collect(),
        ratios: (1..80).map(|n| n as f32 / 100.0).collect(),
        cameras: [camera; 2],
        options: project.document().settings.pairs,
    };
    for (request, at_least) in [(file, 3), (pair, 20)] {
        let (all, whole) = asked(&request, usize::MAX);
        assert!(all >= at_least && whole.is_ok(), "{all}");
        for no_at in [1, 2, all - 1] {
            let stopped = asked(&request, no_at);
            assert_eq!(stopped, (no_at, Err("stopped".to_owned())));
        }
    }
}
