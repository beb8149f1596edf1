//! What takes long ends when it is told to, rather than running on for nobody.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(feature = "compute")]

mod common;

use epipole_lab::project::{About, Event, Project, Step};
use epipole_lab::tasks::{Request, Sample, compute};
use std::ops::ControlFlow;

/// Asks for the request and has had enough at once.
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
    let mut kinds = [false; 4];
    while let Some(task) = project.wanted().first().cloned() {
        let kind = match task.about {
            About::Features(_) => Some(0),
            About::Matches(..) => Some(1),
            About::Reconstruction => Some(2),
            About::Depth(..) => Some(3),
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
    assert_eq!(kinds, [true; 4], "each of them was asked for");
}
