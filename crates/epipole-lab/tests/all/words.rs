//! Messages about photographs that fail: once each, with advice.

#![cfg(feature = "compute")]

use crate::common::{finish, solved};
use epipole_lab::project::{Blob, Project, Sample, Step};
use epipole_lab::session::Event;

/// Text of a step.
fn said(project: &mut Project, step: Step) -> String {
    project.update(Event::Show(step));
    project.describe()
}

#[test]
fn a_file_that_is_no_photograph_is_said_to_be_none_once() {
    let file = |name: &str, bytes: &[u8]| (name.to_owned(), Blob::from(bytes.to_vec()));
    let mut project = Project::default();
    project.update(Event::Add(vec![
        file("letter.jpg", b"Dear reader, this is no photograph."),
        file("empty.jpg", b""),
    ]));
    finish(&mut project);
    let words = |n: usize| project.outcome_words(&project.document().photos[n]);
    assert_eq!(
        words(0),
        "cannot be read: it is no PNG, JPEG, WebP, TIFF, BMP or PNM file"
    );
    assert_eq!(words(1), "cannot be read: the file is empty");
    let features = said(&mut project, Step::Features);
    assert_eq!(
        features,
        "letter.jpg: cannot be read: it is no PNG, JPEG, WebP, TIFF, BMP or PNM file."
    );
}

#[test]
fn a_pair_with_a_photograph_that_takes_no_part_is_not_waited_for() {
    let mut project = solved(Sample::Twice);
    for step in [Step::TwoViews, Step::Depth] {
        let words = said(&mut project, step);
        assert!(
            words.starts_with("twice-2.png: the same file as twice-1.png"),
            "{words}"
        );
    }
    assert_eq!(
        said(&mut project, Step::Matches),
        "A pair needs two photographs."
    );
}

#[test]
fn one_pair_shares() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    let ids: Vec<u32> = (project.document().photos.iter())
        .map(|photo| photo.id)
        .collect();
    for id in &ids[2..] {
        project.update(Event::Remove(*id));
    }
    finish(&mut project);
    let words = said(&mut project, Step::Matches);
    assert!(
        words.starts_with("1 of 1 pair shares enough matches."),
        "{words}"
    );
}
