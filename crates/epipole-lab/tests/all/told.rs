//! Results that are not sound are said to be so, and files hold what was measured.

use crate::common::{computed, exported, finish, png, solved};
use epipole_lab::project::{Measure, Project, Sample, Step};
use epipole_lab::session::{Event, Pending, StepState, Suggestion, Verdict};
use epipole_lab::tasks::{
    AnyQuery, CameraFound, MatchesOf, Query, Reconstruct, Reconstructed, ReconstructionOfAll, Task,
};

/// The sample with another reconstruction in place of its own.
fn with(project: &mut Project, change: impl FnOnce(&mut Reconstructed)) {
    let mut found = project.get(ReconstructionOfAll).unwrap().clone();
    change(&mut found);
    let key = ReconstructionOfAll.key(project).unwrap();
    let query = AnyQuery::Reconstruction(ReconstructionOfAll);
    project.done(&Pending { key, query }, Ok(Reconstruct::write(&found)));
}

#[test]
fn a_focal_length_that_the_photographs_do_not_tell_is_no_sound_result() {
    let mut project = solved(Sample::Table);
    project.update(Event::Show(Step::Reconstruction));
    assert!(project.knows_focal());
    assert!(!project.describe().contains("do not tell the focal length"));
    with(&mut project, |found| found.determines_focal = vec![false]);
    assert!(!project.knows_focal());
    let words = project.describe();
    assert!(words.contains("do not tell the focal length"), "{words}");
}

#[test]
fn a_corrected_lens_is_told_with_the_error_before() {
    let mut project = solved(Sample::Table);
    project.update(Event::Show(Step::Reconstruction));
    with(&mut project, |found| {
        found.before_correction_px = vec![Some(0.673)]
    });
    let words = project.describe();
    assert!(
        words.contains("before, the error was 0.67 pixels"),
        "{words}"
    );
}

#[test]
fn two_photographs_do_not_prove_a_focal_length() {
    let mut project = solved(Sample::Table);
    project.update(Event::Show(Step::TwoViews));
    let ids: Vec<_> = project.document().photos.iter().map(|p| p.id).collect();
    for pair in ids.windows(2) {
        project.update(Event::LookAtPair(pair[0], pair[1]));
        finish(&mut project);
        let words = project.describe();
        let claims = ["intrinsics hold", "focal length may be wrong"];
        assert!(claims.iter().all(|claim| !words.contains(claim)), "{words}");
    }
}

#[test]
fn pairs_are_counted_while_they_are_matched() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    let mut labels = Vec::new();
    while let Some(pending) = project.pending().first().copied() {
        if let AnyQuery::Matches(query) = pending.query {
            labels.push(MatchesOf::label(query, &project));
        }
        let request = pending.request(&project).unwrap();
        project.done(&pending, computed(&request.to_bytes()));
        if labels.len() == 3 {
            break;
        }
    }
    let counted = [0, 1, 2].map(|n| format!("Matching pairs: {n} of 36"));
    assert_eq!(labels, counted);
}

#[test]
fn a_focal_length_is_typed_once_for_all_photographs_of_a_camera() {
    let mut project = Project::default();
    let files = ["a.png", "b.png", "c.png"].map(|name| {
        let size = if name == "c.png" { (60, 40) } else { (80, 50) };
        (name.to_owned(), png(size.0, size.1))
    });
    // Equal files would count as one photograph.
    let files = files.into_iter().enumerate().map(|(n, (name, file))| {
        let mut bytes = file.to_vec();
        bytes.extend(vec![0; n]);
        (name, bytes.into())
    });
    project.update(Event::Add(files.collect()));
    finish(&mut project);
    let photos = project.document().photos.clone();
    let alike = project.alike(&photos[0]);
    assert_eq!(alike, [photos[0].id, photos[1].id]);
    project.update(Event::Focal(alike, Some(90.0)));
    let typed: Vec<_> = project
        .document()
        .photos
        .iter()
        .map(|p| p.focal_px)
        .collect();
    assert_eq!(typed, [Some(90.0), Some(90.0), None]);
    project.update(Event::Undo);
    let mut photos = project.document().photos.iter();
    assert!(photos.all(|photo| photo.focal_px.is_none()));
}

#[test]
fn files_stand_on_the_floor_and_hold_the_measures() {
    let mut project = solved(Sample::Table);
    // Three points in a plane of their own; any will do.
    let component = project.component().unwrap().clone();
    let mut longest: Vec<usize> = (0..component.points.len()).collect();
    longest.sort_by_key(|&n| std::cmp::Reverse(component.points[n].track.len()));
    let place = |n: usize| nalgebra::Point3::from(component.points[n].position);
    let a = longest[0];
    let far = |from: usize| {
        let away = |n: &usize| (place(*n) - place(from)).norm();
        longest[..200]
            .iter()
            .copied()
            .max_by(|m, n| away(m).total_cmp(&away(n)))
    };
    let b = far(a).unwrap();
    let area = |n: &usize| (place(b) - place(a)).cross(&(place(*n) - place(a))).norm();
    let c = longest[..200]
        .iter()
        .copied()
        .max_by(|m, n| area(m).total_cmp(&area(n)));
    let anchors = [a, b, c.unwrap()].map(|point| project.anchor_of(point).unwrap());
    project.update(Event::Floor(Some(anchors)));
    project.update(Event::Measure(Measure {
        ends: [anchors[0], anchors[1]],
        length_m: Some(0.5),
    }));
    project.update(Event::Measure(Measure {
        ends: [anchors[0], anchors[2]],
        length_m: None,
    }));
    let mut read = exported(&project);
    let json: serde_json::Value = serde_json::from_slice(&read("reconstruction.json")).unwrap();
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect()
    };
    let measures = json["measures"].as_array().unwrap();
    assert_eq!(measures.len(), 2);
    for measure in measures {
        let [from, to] = [0, 1].map(|n| numbers(&measure["ends"][n]));
        let length: f64 = (from.iter().zip(&to)).map(|(a, b)| (a - b) * (a - b)).sum();
        let told = measure["length"].as_f64().unwrap();
        assert!((length.sqrt() / told - 1.0).abs() < 1e-9, "{measure}");
        assert!(
            from[2].abs() < 1e-9 && to[2].abs() < 1e-9,
            "they are on the floor: {measure}"
        );
    }
    assert_eq!(measures[0]["typed_m"], 0.5);
    let table = String::from_utf8(read("measures.csv")).unwrap();
    assert_eq!(table.lines().count(), 3, "{table}");
    // Cameras are above the floor, where the screen has them.
    let floor = project.floor().unwrap();
    let meters = project.scale().unwrap().meters_per_unit;
    let images = json["images"].as_array().unwrap();
    for (image, camera) in images.iter().zip(component.cameras.iter().flatten()) {
        let motion = &image["cam_from_world"];
        let rows: Vec<Vec<f64>> =
            motion["rotation"]
                .as_array()
                .map_or_else(Vec::new, |rows| match rows[0].is_array() {
                    true => rows.iter().map(numbers).collect(),
                    false => numbers(&motion["rotation"])
                        .chunks(3)
                        .map(<[f64]>::to_vec)
                        .collect(),
                });
        let shift = numbers(&motion["translation"]);
        let height: f64 = -(0..3).map(|row| rows[row][2] * shift[row]).sum::<f64>();
        let expected = (CameraFound::center(camera) - floor.origin).dot(&floor.up) * meters;
        assert!((height - expected).abs() < 1e-9, "{height} {expected}");
    }
    // The mean of the files is that of the screen.
    let mean_px = project.get(ReconstructionOfAll).unwrap().mean_error_px[0];
    assert_eq!(json["mean_reprojection_px"].as_f64(), Some(mean_px));
}

#[test]
fn a_verdict_names_what_is_wrong_and_what_to_do() {
    let mut project = Project::default();
    assert_eq!(project.verdict(), None);
    project.update(Event::OpenSample(Sample::Table));
    assert_eq!(project.verdict(), None, "nothing is computed yet");
    finish(&mut project);
    assert_eq!(project.verdict(), Some(Verdict::Sound));
    with(&mut project, |found| {
        found.before_correction_px = vec![Some(0.673)]
    });
    assert_eq!(project.verdict(), Some(Verdict::LensCorrected));
    with(&mut project, |found| found.determines_focal = vec![false]);
    assert_eq!(project.verdict(), Some(Verdict::FocalUnsure));
    for (sample, verdict) in [
        (Sample::Turned, Some(Verdict::Nothing)),
        (Sample::Alone, None),
        (Sample::Twice, None),
        (Sample::Plane, Some(Verdict::Flat)),
        (Sample::Mixed, Some(Verdict::Parts(2))),
        (Sample::Upright, Some(Verdict::Sound)),
    ] {
        assert_eq!(solved(sample).verdict(), verdict, "{sample:?}");
    }
}

#[test]
fn a_suggestion_leads_to_another_view_or_adds_photographs() {
    for sample in [Sample::Table, Sample::Plane, Sample::Mixed, Sample::Turned] {
        let mut project = solved(sample);
        project.update(Event::Show(Step::Reconstruction));
        let suggestions = project.suggestions(project.verdict().unwrap());
        assert!(!suggestions.is_empty());
        for suggestion in suggestions {
            let Suggestion::Send(label, events) = suggestion else {
                continue;
            };
            let before = project.view().clone();
            for event in events {
                project.update(event);
            }
            assert_ne!(*project.view(), before, "{sample:?}: {label}");
            project.update(Event::Show(Step::Reconstruction));
        }
    }
}

#[test]
fn steps_are_done_in_order() {
    let chain = [
        Step::Photographs,
        Step::Features,
        Step::Matches,
        Step::Reconstruction,
    ];
    let mut project = Project::default();
    assert!(project.step_states().is_empty());
    project.update(Event::OpenSample(Sample::Upright));
    while let Some(pending) = project.pending().first().copied() {
        let states = project.step_states();
        let is_done = chain.map(|step| states.contains_key(&step));
        assert!(
            is_done.is_sorted_by(|before, after| before >= after),
            "{states:?}"
        );
        let request = pending.request(&project).unwrap();
        project.done(&pending, computed(&request.to_bytes()));
    }
    let states = project.step_states();
    assert!(chain.iter().all(|step| states[step] == StepState::Done));
    assert_eq!(states.get(&Step::TwoViews), Some(&StepState::Done));
    assert_eq!(states.get(&Step::Measure), None);
    // Nothing is lost while computing is stopped, and what changed is open again.
    project.update(Event::Pause(true));
    assert_eq!(project.step_states(), states);
    let mut settings = project.document().settings.clone();
    settings.matching.ratio = 0.7;
    project.update(Event::Set(settings));
    let states = project.step_states();
    assert!(states.contains_key(&Step::Features) && !states.contains_key(&Step::Matches));
    assert!(!states.contains_key(&Step::Reconstruction));
}

#[test]
fn a_file_that_cannot_be_read_marks_its_step() {
    let mut project = Project::default();
    let file = ("broken.png".to_owned(), vec![1_u8, 2, 3].into());
    project.update(Event::Add(vec![file]));
    finish(&mut project);
    let states = project.step_states();
    assert_eq!(states.get(&Step::Photographs), Some(&StepState::Failed));
}
