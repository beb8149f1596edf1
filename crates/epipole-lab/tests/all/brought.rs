//! Results that come with a project, or with the sample: they are taken where they fit, and
//! computed where they do not.

#![cfg(feature = "compute")]

use crate::common::{finish, reopened, solved};
use epipole_lab::project::{About, COMPUTED_BY, Computed, Event, Project, Step, Task};
use epipole_lab::tasks::{Answer, Blob, Sample};

fn table() -> Project {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    project
}

/// The sample with its precomputed results, nothing computed yet.
fn brought(computed: &Computed) -> Project {
    let mut project = table();
    project.bring(Computed::from_bytes(&computed.to_bytes()));
    project
}

#[test]
fn the_sample_comes_solved_and_only_its_pixels_are_left_to_be_made() {
    let done = solved(Sample::Table);
    let computed = done.light_computed();
    let num_bytes = computed.to_bytes().len();
    assert!(num_bytes < 1_000_000, "{num_bytes}");
    let mut project = brought(&computed);
    assert_eq!(project.reconstruction(), done.reconstruction());
    assert!(project.reconstruction().is_some());
    let is_photograph = |task: &Task| matches!(task.about, About::Photograph(_));
    assert!(project.wanted().iter().all(is_photograph));
    assert_eq!(project.wanted().len(), 9);
    // The data of a photograph are available before its pixels.
    let first = &project.document().photos[0];
    assert_eq!(
        project.camera(first),
        done.camera(&done.document().photos[0])
    );
    assert!(project.photograph(first).is_none());
    assert!(!project.can_export() && project.export_request().is_none());
    assert_eq!(finish(&mut project), 9);
    assert_eq!(project.export_request(), done.export_request());
    assert!(project.can_export());
    // Loaded results count as computed: undo finds them.
    let id = project.document().photos[0].id;
    project.update(Event::Exclude(id, true));
    assert_eq!(finish(&mut project), 1, "eight photographs, all matched");
    project.update(Event::Undo);
    assert_eq!(project.wanted(), []);
}

#[test]
fn descriptors_come_once_somebody_asks_for_them() {
    let done = solved(Sample::Table);
    let mut project = brought(&done.light_computed());
    finish(&mut project);
    let photos = project.document().photos.clone();
    let is_whole = |project: &Project, n: usize| {
        let features = project.features(&photos[n]).unwrap();
        features.has_descriptors()
    };
    assert!((0..9).all(|n| !is_whole(&project, n)));
    // Of the photograph that is looked at.
    project.update(Event::Show(Step::Features));
    project.update(Event::Look(photos[3].id));
    assert_eq!(finish(&mut project), 1);
    assert_eq!(project.features(&photos[3]), done.features(&photos[3]));
    assert!(!is_whole(&project, 2));
    // Of all that are matched anew, and then everything is as if it had been computed here.
    let tighter = |project: &mut Project| {
        let mut settings = project.document().settings.clone();
        settings.matching.ratio = 0.7;
        project.update(Event::Set(settings));
        finish(project)
    };
    let mut other = solved(Sample::Table);
    assert_eq!(tighter(&mut other) + 8, tighter(&mut project));
    assert!((0..9).all(|n| is_whole(&project, n)));
    assert_eq!(project.reconstruction(), other.reconstruction());
    assert!(project.reconstruction() != done.reconstruction());
    // The project is saved with its results so far, and opens.
    let mut again = reopened(&brought(&done.light_computed()));
    assert_eq!(finish(&mut again), 9);
    assert_eq!(again.reconstruction(), done.reconstruction());
}

#[test]
fn a_saved_project_brings_what_was_computed() {
    let done = solved(Sample::Twice);
    let mut again = reopened(&done);
    assert_eq!(
        finish(&mut again),
        1,
        "one photograph to be read, and nothing else"
    );
    let done = solved(Sample::Turned);
    let mut again = reopened(&done);
    assert_eq!(
        finish(&mut again),
        4,
        "four photographs to be read, and nothing else"
    );
    assert_eq!(again.reconstruction(), done.reconstruction());
    // A project that is kept with every change is small.
    let small = done.keep_request().to_bytes().len();
    assert!(small < 4000, "{small}");
}

#[test]
fn what_something_else_has_computed_is_left() {
    let computed = solved(Sample::Alone).light_computed();
    let open = |computed: Computed| {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Alone));
        project.bring(computed);
        // Whether a camera is known; the pixels are to come in any case.
        assert_eq!(project.wanted().len(), 1);
        let photos = project.document().photos.iter();
        let is_known: Vec<bool> = photos.map(|p| project.camera(p).is_some()).collect();
        is_known
    };
    assert_eq!(computed.by, COMPUTED_BY);
    assert_eq!(open(computed.clone()), [true]);
    let by = "another version".to_owned();
    assert_eq!(open(Computed { by, ..computed }), [false]);
    assert_eq!(open(Computed::from_bytes(b"no results")), [false]);
}

/// Every answer with something that does not fit, by the kind of answer.
fn spoiled(answer: &Answer) -> Vec<Answer> {
    let mut all = Vec::new();
    let mut spoil = |change: &dyn Fn(&mut Answer)| {
        let mut other = answer.clone();
        change(&mut other);
        all.push(other);
    };
    match answer {
        Answer::Photograph(_) => {
            spoil(&|answer| {
                if let Answer::Photograph(found) = answer {
                    found.width += 1;
                }
            });
            spoil(&|answer| {
                if let Answer::Photograph(found) = answer {
                    found.focal_px = Some(f64::NAN);
                }
            });
        }
        Answer::Features(_) => {
            spoil(&|answer| {
                if let Answer::Features(found) = answer {
                    found.described.dimension = 128;
                    found.described.values = vec![0; 77].into();
                }
            });
            spoil(&|answer| {
                if let Answer::Features(found) = answer {
                    found.list[0].u = f64::INFINITY;
                }
            });
        }
        Answer::Matches(_) => spoil(&|answer| {
            if let Answer::Matches(found) = answer
                && let Some(first) = found.first_mut()
            {
                first.second = 1_000_000;
            }
        }),
        Answer::TwoViews(_) => {
            spoil(&|answer| {
                if let Answer::TwoViews(found) = answer {
                    found.inliers.pop();
                }
            });
            spoil(&|answer| {
                if let Answer::TwoViews(found) = answer {
                    found.num_inliers += 1;
                }
            });
        }
        Answer::Reconstruction(_) => {
            spoil(&|answer| {
                if let Answer::Reconstruction(found) = answer {
                    found.components[0].points[0].track.push((77, 0));
                }
            });
            spoil(&|answer| {
                if let Answer::Reconstruction(found) = answer {
                    found.components[0].cameras.pop();
                }
            });
            spoil(&|answer| {
                if let Answer::Reconstruction(found) = answer {
                    found.components[0].points[0].position[1] = f64::NAN;
                }
            });
            spoil(&|answer| {
                if let Answer::Reconstruction(found) = answer {
                    found.mean_error_px.clear();
                }
            });
        }
        _ => {}
    }
    // An answer to another question.
    all.push(Answer::Frames(Vec::new()));
    all
}

#[test]
fn results_that_do_not_fit_are_computed_once_more() {
    let done = solved(Sample::Table);
    let computed = done.light_computed();
    let mut kinds = std::collections::BTreeSet::new();
    for index in 0..computed.results.len() {
        let answer = Answer::from_bytes(&computed.results[index].1).unwrap();
        // One of each kind is enough.
        if !kinds.insert(format!("{answer:?}").split('(').next().map(str::to_owned)) {
            continue;
        }
        let cut: Blob = computed.results[index].1[..computed.results[index].1.len() / 2]
            .to_vec()
            .into();
        let others = spoiled(&answer)
            .into_iter()
            .map(|answer| answer.to_bytes().into());
        for bytes in others.chain([cut, Blob::default()]) {
            let mut computed = computed.clone();
            computed.results[index].1 = bytes;
            let mut project = table();
            project.bring(computed);
            assert!(!project.wanted().is_empty(), "{answer:?}");
        }
    }
    assert_eq!(kinds.len(), 5, "{kinds:?}");
    // The result is the same with any loaded results.
    let mut computed = computed;
    for (n, (_, bytes)) in computed.results.iter_mut().enumerate() {
        if n % 3 == 0 {
            *bytes = bytes[..bytes.len() * 2 / 3].to_vec().into();
        }
    }
    let mut project = table();
    project.bring(computed);
    finish(&mut project);
    assert_eq!(project.reconstruction(), done.reconstruction());
}
