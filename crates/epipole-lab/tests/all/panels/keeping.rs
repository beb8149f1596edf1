//! A project that is kept where the Lab runs, by choice.

use crate::common::desk::{Bench, click, open, rest};
use egui_kittest::kittest::Queryable;
use epipole_lab::project::Step;
use epipole_lab::session::{Host, HostEvent, Stored};

#[test]
fn a_project_is_kept_by_choice_comes_back_and_is_forgotten() {
    let mut bench = open(1280.0, 720.0);
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    let broken = |name: &str| vec![(name.to_owned(), vec![1_u8, 2, 3].into())];
    let give = |bench: &mut Bench<'_>, name: &str| {
        let host_event = HostEvent::Photographs(broken(name));
        bench.state_mut().host().host_events.push(host_event);
        rest(bench);
        bench.run_steps(40);
    };
    give(&mut bench, "one.png");
    assert_eq!(
        bench.state_mut().host().kept,
        None,
        "nobody has chosen to keep it"
    );
    click(&mut bench, "Project");
    bench.get_by_label("Uses less than 0.1 MB on this machine. Nothing is uploaded.");
    click(&mut bench, "Keep in this browser");
    bench.run_steps(40);
    let words = said(&mut bench);
    assert!(words.contains("This browser keeps the project"), "{words}");
    let first = bench.state_mut().host().kept.clone().unwrap();
    give(&mut bench, "two.png");
    let second = bench.state_mut().host().kept.clone().unwrap();
    assert!(second.len() > first.len(), "a change is kept, too");

    // The next visit: what comes with the project comes after it.
    let mut again = open(1280.0, 720.0);
    let host = again.state_mut().host();
    host.kept = Some(second.clone());
    host.ask_for_kept();
    let link = vec![
        ("step".to_owned(), "matches".to_owned()),
        ("ratio".to_owned(), "0.7".to_owned()),
    ];
    host.host_events.push(HostEvent::Link(link));
    rest(&mut again);
    let project = again.state().project();
    let names = project.document().photos.iter().map(|photo| &photo.name);
    assert_eq!(names.collect::<Vec<_>>(), ["one.png", "two.png"]);
    assert_eq!(project.document().settings.matching.ratio, 0.7);
    assert_eq!(project.view().step, Step::Matches);
    let words = said(&mut again);
    assert!(
        words.contains("The project kept in this browser is open again"),
        "{words}"
    );
    again.run_steps(40);
    assert_ne!(
        again.state_mut().host().kept,
        Some(second),
        "the link turned a knob"
    );
    click(&mut again, "Start over");
    rest(&mut again);
    assert_eq!(again.state().project().document().photos.len(), 9);
    assert_eq!(again.state_mut().host().kept, None);
    again.run_steps(40);
    assert_eq!(
        again.state_mut().host().kept,
        None,
        "forgotten, and not kept any more"
    );

    click(&mut bench, "Project");
    click(&mut bench, "Forget it");
    bench.run_steps(40);
    assert_eq!(bench.state_mut().host().kept, None);
    assert_eq!(bench.state().project().document().photos.len(), 2);
}

#[test]
fn what_cannot_be_kept_or_opened_again_is_told_and_the_photographs_stay() {
    let mut bench = open(1280.0, 720.0);
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    let hear = |bench: &mut Bench<'_>, kept| {
        bench
            .state_mut()
            .host()
            .host_events
            .push(HostEvent::Stored(kept));
        rest(bench);
        bench.run_steps(40);
    };
    click(&mut bench, "Project");
    click(&mut bench, "Keep in this browser");
    bench.run_steps(40);
    hear(
        &mut bench,
        Stored::Failed {
            why: "there is no room for 3.0 MB.".to_owned(),
            is_there: true,
        },
    );
    let words = said(&mut bench);
    assert!(
        words.contains("there is no room for 3.0 MB. Save it as a file"),
        "{words}"
    );
    assert!(
        words.contains("The project kept before is still there"),
        "{words}"
    );
    // It is not written over until the reader says so.
    let before = bench.state_mut().host().kept.take();
    click(&mut bench, "Undo");
    bench.run_steps(40);
    assert_eq!(bench.state_mut().host().kept, None);
    bench.state_mut().host().kept = before;
    click(&mut bench, "Project");
    assert!(bench.query_by_label("Keep in this browser").is_none());
    click(&mut bench, "Open the kept project");
    rest(&mut bench);
    let words = said(&mut bench);
    assert!(words.contains("is open again"), "{words}");
    hear(&mut bench, Stored::Project(vec![1_u8, 2, 3].into()));
    let words = said(&mut bench);
    assert!(
        words.contains("does not open: this file is no project of the Lab"),
        "{words}"
    );
    assert_eq!(bench.state().project().document().photos.len(), 9);
    hear(&mut bench, Stored::Erased);
    let words = said(&mut bench);
    assert!(words.contains("Another page of the Lab"), "{words}");
    click(&mut bench, "Project");
    bench.get_by_label("Keep in this browser");
}
