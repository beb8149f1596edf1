//! A reconstruction that is watched while it becomes more.

use epipole_lab::project::{Project, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::{Progress, compute};
use std::ops::ControlFlow;

/// Reconstructs with another seed, and checks the intermediate result after each photograph.
pub(crate) fn it_grows_as_one_watches(project: &mut Project) {
    let mut settings = project.document().settings.clone();
    settings.sfm.seed = 1;
    project.update(Event::Set(settings));
    project.update(Event::Show(Step::Reconstruction));
    let pending = project.pending();
    assert_eq!(pending.len(), 1, "{pending:?}");
    let pending = pending[0];
    let request = pending.request(project).unwrap().to_bytes();
    let mut steps = Vec::new();
    let result = compute(&request, &mut |progress| {
        if let Progress::Partial(bytes) = progress {
            steps.push(bytes);
        }
        ControlFlow::Continue(())
    });
    assert!(project.growing().is_none());
    let mut registered = Vec::new();
    for bytes in &steps {
        project.so_far(&pending, bytes);
        assert!(project.component().is_none());
        let growing = project.growing().unwrap();
        assert!(!growing.points.is_empty());
        registered.push(growing.num_registered());
    }
    assert_eq!(registered, [2, 3, 4, 5, 6, 7, 8, 9]);
    assert!(
        project.describe().contains("9 cameras"),
        "{}",
        project.describe()
    );
    // Invalid results, and those of other inputs, are not shown.
    project.so_far(&pending, b"nothing");
    assert!(project.growing().is_some());
    project.update(Event::Undo);
    assert!(project.growing().is_none());
    project.update(Event::Redo);
    project.done(&pending, result);
    assert!(project.growing().is_none());
    assert_eq!(project.component().unwrap().num_registered(), 9);
    project.update(Event::Undo);
}
