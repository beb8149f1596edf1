//! Results that come with a project, or with the sample: they are taken where they fit, and
//! computed where they do not.

#![cfg(feature = "compute")]

use crate::common::{finish, reopened, solved};
use epipole_lab::project::{Blob, COMPUTED_BY, Computed, Project, Sample, Step};
use epipole_lab::session::{Event, Pending};
use epipole_lab::tasks::{
    AnyQuery, ExportFormat, FeaturesOf, MatchesOf, Output, PhotographOf, Query,
    ReconstructionOfAll, Request, Task, TwoViewsOf,
};

fn table() -> Project {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    project
}

/// The sample with its precomputed results, nothing computed yet.
fn imported(computed: &Computed) -> Project {
    let mut project = table();
    project.import(Computed::from_bytes(&computed.to_bytes()));
    project
}

#[test]
fn the_sample_comes_solved_and_only_its_pixels_are_left_to_be_made() {
    let done = solved(Sample::Table);
    let computed = done.light_computed();
    let num_bytes = computed.to_bytes().len();
    assert!(num_bytes < 1_000_000, "{num_bytes}");
    let mut project = imported(&computed);
    assert_eq!(
        project.get(ReconstructionOfAll),
        done.get(ReconstructionOfAll)
    );
    assert!(project.get(ReconstructionOfAll).is_some());
    let is_photograph = |pending: &Pending| matches!(pending.query, AnyQuery::Photograph(_));
    assert!(project.pending().iter().all(is_photograph));
    assert_eq!(project.pending().len(), 9);
    // The data of a photograph are available before its pixels.
    let first = &project.document().photos[0];
    assert_eq!(
        project.camera(first),
        done.camera(&done.document().photos[0])
    );
    assert!(project.photograph(first).is_none());
    assert!(!project.can_export() && project.export_request(ExportFormat::default()).is_none());
    assert_eq!(finish(&mut project), 9);
    assert_eq!(
        project.export_request(ExportFormat::default()),
        done.export_request(ExportFormat::default())
    );
    assert!(project.can_export());
    // Loaded results count as computed: undo finds them.
    let id = project.document().photos[0].id;
    project.update(Event::Exclude(id, true));
    assert_eq!(finish(&mut project), 1, "eight photographs, all matched");
    project.update(Event::Undo);
    assert_eq!(project.pending(), []);
}

#[test]
fn descriptors_come_once_somebody_asks_for_them() {
    let done = solved(Sample::Table);
    let mut project = imported(&done.light_computed());
    finish(&mut project);
    let photos = project.document().photos.clone();
    let is_whole = |project: &Project, n: usize| {
        let features = project.get(FeaturesOf(photos[n].id)).unwrap();
        features.has_descriptors()
    };
    assert!((0..9).all(|n| !is_whole(&project, n)));
    // Of the photograph that is looked at.
    project.update(Event::Show(Step::Features));
    project.update(Event::Look(photos[3].id));
    assert_eq!(finish(&mut project), 1);
    assert_eq!(
        project.get(FeaturesOf(photos[3].id)),
        done.get(FeaturesOf(photos[3].id))
    );
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
    assert_eq!(
        project.get(ReconstructionOfAll),
        other.get(ReconstructionOfAll)
    );
    assert!(project.get(ReconstructionOfAll) != done.get(ReconstructionOfAll));
    // The project is saved with its results so far, and opens.
    let mut again = reopened(&imported(&done.light_computed()));
    assert_eq!(finish(&mut again), 9);
    assert_eq!(
        again.get(ReconstructionOfAll),
        done.get(ReconstructionOfAll)
    );
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
    assert_eq!(
        again.get(ReconstructionOfAll),
        done.get(ReconstructionOfAll)
    );
    // A project that is kept with every change is small.
    let small = Request::from(done.keep_request()).to_bytes().len();
    assert!(small < 4000, "{small}");
}

#[test]
fn what_something_else_has_computed_is_left() {
    let computed = solved(Sample::Alone).light_computed();
    let open = |computed: Computed| {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Alone));
        project.import(computed);
        // Whether a camera is known; the pixels are to come in any case.
        assert_eq!(project.pending().len(), 1);
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

/// Imports an output with each of the changes, after which it does not fit, and cut.
fn refuses<Q: Query>(query: Q, done: &Project, changes: &[fn(&mut Output<Q>)]) {
    let computed = done.light_computed();
    let key = query.key(done).unwrap();
    let is_it = |(of, _): &(u64, Blob)| *of == key.0;
    let index = computed.results.iter().position(is_it).unwrap();
    let whole = computed.results[index].1.clone();
    let corrupt = |change: &fn(&mut Output<Q>)| {
        let mut output = Q::Task::read(&whole).unwrap();
        change(&mut output);
        Q::Task::write(&output).into()
    };
    let cut = whole[..whole.len() / 2].to_vec().into();
    for bytes in changes.iter().map(corrupt).chain([cut, Blob::default()]) {
        let mut computed = computed.clone();
        computed.results[index].1 = bytes;
        let mut project = table();
        project.import(computed);
        assert!(project.get(query).is_none());
    }
}

#[test]
fn results_that_do_not_fit_are_computed_once_more() {
    let done = solved(Sample::Table);
    let [a, b] = [0, 1].map(|n| done.document().photos[n].id);
    refuses(
        PhotographOf(a),
        &done,
        &[
            |found| found.width = 0,
            |found| {
                found.focal_px = Some(f64::NAN);
            },
        ],
    );
    refuses(
        FeaturesOf(a),
        &done,
        &[
            |found| {
                found.described.dimension = 128;
                found.described.values = vec![0; 77].into();
            },
            |found| found.list[0].u = f64::INFINITY,
        ],
    );
    refuses(
        MatchesOf(a, b),
        &done,
        &[|found| found[0].second = 1_000_000],
    );
    refuses(
        TwoViewsOf(a, b),
        &done,
        &[
            |found| found.inliers.truncate(5),
            |found| {
                found.num_inliers += 1;
            },
        ],
    );
    refuses(
        ReconstructionOfAll,
        &done,
        &[
            |found| found.components[0].points[0].track.push((77, 0)),
            |found| found.components[0].cameras.truncate(5),
            |found| found.components[0].points[0].position[1] = f64::NAN,
            |found| found.mean_error_px.clear(),
        ],
    );
    // The result is the same with any loaded results.
    let mut computed = done.light_computed();
    for (n, (_, bytes)) in computed.results.iter_mut().enumerate() {
        if n % 3 == 0 {
            *bytes = bytes[..bytes.len() * 2 / 3].to_vec().into();
        }
    }
    let mut project = table();
    project.import(computed);
    finish(&mut project);
    assert_eq!(
        project.get(ReconstructionOfAll),
        done.get(ReconstructionOfAll)
    );
}
