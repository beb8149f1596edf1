//! Long computations end when canceled.

#![cfg(feature = "compute")]

use crate::common::computed;
use epipole_lab::project::{Blob, Project, Sample, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::{AnyQuery, Calibrated, ExportFormat, Request, VerifyPair, compute};
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
    let mut settings = project.document().settings.clone();
    settings.all_views.max_megapixels = 0.05;
    project.update(Event::Set(settings));
    project.update(Event::AllViews(true));
    let mut kinds = [false; 8];
    while let Some(pending) = project.pending().first().copied() {
        let kind = match pending.query {
            AnyQuery::Features(_) => Some(0),
            AnyQuery::Matches(_) => Some(1),
            AnyQuery::Reconstruction(_) => Some(2),
            AnyQuery::Depth(_) => Some(3),
            AnyQuery::Photograph(_) => Some(4),
            AnyQuery::TwoViews(_) => Some(5),
            AnyQuery::Reduced(_) => Some(6),
            AnyQuery::Cloud(_) => Some(7),
            _ => None,
        };
        let request = pending.request(&project).unwrap();
        if let Some(kind) = kind.filter(|kind| !kinds[*kind]) {
            assert_eq!(stopped(&request), Err("stopped".to_owned()), "{pending:?}");
            kinds[kind] = true;
        }
        project.done(&pending, computed(&request.to_bytes()));
    }
    assert_eq!(kinds, [true; 8], "each of them was asked for");
    // An archive for which photographs must be read once more.
    let mut export = project.export_request(ExportFormat::default()).unwrap();
    for photograph in &mut export.photographs {
        photograph.used.as_mut().unwrap().rgb = Blob::default();
    }
    assert_eq!(stopped(&export.into()), Err("stopped".to_owned()));
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
    let file = project.pending()[0].request(&project).unwrap();
    // Matches without agreement take the maximum number of samples.
    let place = |n: u32| {
        let by = |factor: u32| f64::from(n * factor % 397);
        [by(31), by(57), by(101), by(139)]
    };
    let camera = Calibrated {
        width: 400,
        height: 400,
        k: [500.0, 500.0, 200.0, 200.0],
    };
    let pair = Request::from(VerifyPair {
        places: (1..80).map(place).collect(),
        ratios: (1..80).map(|n| n as f32 / 100.0).collect(),
        cameras: [camera; 2],
        options: project.document().settings.pairs,
    });
    for (request, at_least) in [(file, 3), (pair, 20)] {
        let (all, whole) = asked(&request, usize::MAX);
        assert!(all >= at_least && whole.is_ok(), "{all}");
        for no_at in [1, 2, all - 1] {
            let stopped = asked(&request, no_at);
            assert_eq!(stopped, (no_at, Err("stopped".to_owned())));
        }
    }
}
