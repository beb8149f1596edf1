//! The panels, operated by what they say: labels that a screen reader hears.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(all(feature = "panels", feature = "compute"))]

mod common;

use common::desk::{Bench, click, open, rest};
use egui::accesskit::Role;
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};
use epipole_lab::panels::{Arrival, Host, Kept};
use epipole_lab::project::Step;

#[test]
fn the_line_from_the_sample_to_a_file() {
    let mut bench = open(1280.0, 720.0);
    bench.get_by_label("9 of 9");
    assert!(
        bench
            .state_mut()
            .host()
            .said
            .contains("9 of 9 photographs have a camera")
    );

    click(&mut bench, "Photographs");
    click(&mut bench, "Use this photograph");
    assert!(bench.state().project().document().photos[0].excluded);
    click(&mut bench, "Undo");
    assert!(!bench.state().project().document().photos[0].excluded);

    click(&mut bench, "Features");
    assert!(bench.state_mut().host().said.contains("features"));
    click(&mut bench, "SIFT");
    for _ in 0..200 {
        bench.step();
        if bench.state().project().wanted().is_empty() {
            break;
        }
    }
    click(&mut bench, "Undo");
    assert!(
        bench.state().project().wanted().is_empty(),
        "undo is instant"
    );

    click(&mut bench, "Two views");
    assert!(bench.state_mut().host().said.contains("A scene with depth"));

    click(&mut bench, "Export");
    click(&mut bench, "Save reconstruction.zip");
    let saved = &bench.state_mut().host().saved;
    assert_eq!(saved.len(), 1);
    assert_eq!(saved[0].0, "reconstruction.zip");
    assert!(saved[0].1.starts_with(b"PK"));

    click(&mut bench, "Add photographs…");
    assert_eq!(bench.state_mut().host().asked, 1);
    let broken = vec![("broken.png".to_owned(), vec![1_u8, 2, 3].into())];
    bench
        .state_mut()
        .host()
        .arrivals
        .push(Arrival::Photographs(broken));
    bench.run_steps(6);
    let said = bench.state_mut().host().said.clone();
    assert!(said.contains("broken.png: cannot be read"), "{said}");
    assert_eq!(
        bench.state().project().document().photos.len(),
        1,
        "the sample made room"
    );
}

#[test]
fn a_board_gives_a_camera_and_its_file() {
    let mut bench = open(1280.0, 720.0);
    click(&mut bench, "Calibrate");
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    assert!(said(&mut bench).contains("No photographs of a board yet"));
    click(&mut bench, "Open the sample");
    rest(&mut bench);
    let words = said(&mut bench);
    assert!(words.contains("found in 9 of 10 photographs"), "{words}");
    bench.get_by_label_contains("board-10.png: a grid of");
    click(&mut bench, "fisheye");
    rest(&mut bench);
    let lens = |bench: &Bench<'_>| bench.state().project().document().settings.calibration.lens;
    assert_eq!(lens(&bench), epipole_lab::tasks::LensModel::Fisheye);
    click(&mut bench, "Undo");
    bench.get_by_label_contains("board-3.png: 54 marks").click();
    bench.run_steps(3);
    let project = bench.state().project();
    assert_eq!(project.view().board, project.document().boards[2].id);
    click(&mut bench, "Save camera.json");
    assert_eq!(bench.state_mut().host().saved[0].0, "camera.json");
    click(&mut bench, "Use for my photographs");
    let words = said(&mut bench);
    assert!(
        words.contains("of 640 × 480 pixels. There are none yet"),
        "{words}"
    );
    assert!(bench.state().project().document().camera.is_some());
    click(&mut bench, "Stop using it");
    assert!(bench.state().project().document().camera.is_none());
    // What comes while this step is open is of a board, and the sample makes room.
    let broken = vec![("broken.png".to_owned(), vec![1_u8, 2, 3].into())];
    let arrival = Arrival::Photographs(broken);
    bench.state_mut().host().arrivals.push(arrival);
    bench.run_steps(6);
    let document = bench.state().project().document();
    assert_eq!((document.boards.len(), document.photos.len()), (1, 9));
    let words = said(&mut bench);
    assert!(words.contains("broken.png: cannot be read"), "{words}");
}

#[test]
fn a_video_gives_its_sharpest_frames() {
    let mut bench = open(1280.0, 720.0);
    click(&mut bench, "Photographs");
    click(&mut bench, "Take photographs…");
    assert_eq!(bench.state_mut().host().asked, 1);
    let bring = |bench: &mut Bench<'_>, arrival| {
        bench.state_mut().host().arrivals.push(arrival);
        bench.run_steps(2);
        rest(bench);
    };
    let mut settings = bench.state().project().document().settings.clone();
    settings.num_frames = 3;
    let link = vec![("frames".to_owned(), "3".to_owned())];
    bring(&mut bench, Arrival::Link(link));
    assert_eq!(bench.state().project().document().settings, settings);
    // One video after the other, and of each one part after the other.
    bring(&mut bench, Arrival::Video(3));
    bring(&mut bench, Arrival::Video(4));
    assert_eq!(bench.state_mut().host().frames, [(3, 0, 3)]);
    let picture = |blur: f32| -> epipole_lab::tasks::Blob {
        let sharp = image::RgbImage::from_fn(60, 40, |u, v| {
            image::Rgb([if (u / 7 + v / 5) % 2 == 0 { 20 } else { 230 }; 3])
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        let blurred = image::imageops::blur(&sharp, blur);
        blurred
            .write_to(&mut bytes, image::ImageFormat::Png)
            .unwrap();
        bytes.into_inner().into()
    };
    let [soft, sharp] = [picture(3.0), picture(0.5)];
    let frames = |bench: &mut Bench<'_>, video, frames: Vec<_>| {
        bring(bench, Arrival::Frames(video, "walk.mp4".to_owned(), frames));
    };
    frames(&mut bench, 3, vec![soft.clone(), sharp.clone()]);
    assert_eq!(bench.state_mut().host().frames[1..], [(3, 1, 3)]);
    // What nobody asked for is not looked at.
    frames(&mut bench, 4, vec![sharp.clone()]);
    frames(&mut bench, 3, vec![vec![1_u8, 2, 3].into()]);
    assert_eq!(
        bench.state().project().document().photos.len(),
        9,
        "the sample is still there"
    );
    frames(&mut bench, 3, vec![sharp.clone(), soft]);
    let photos = &bench.state().project().document().photos;
    let names: Vec<&str> = photos.iter().map(|photo| photo.name.as_str()).collect();
    assert_eq!(names, ["walk-01.jpg", "walk-03.jpg"]);
    let source = epipole_lab::tasks::Source::File(sharp);
    assert!(photos.iter().all(|photo| photo.source == source));
    let said = bench.state_mut().host().said.clone();
    assert!(
        said.contains("2 frames were taken from the video."),
        "{said}"
    );
    // Then the next one has its turn, and fails.
    assert_eq!(bench.state_mut().host().frames[2..], [(3, 2, 3), (4, 0, 3)]);
    let refused = "walk.mp4 cannot be decoded here.".to_owned();
    bring(&mut bench, Arrival::NoFrames(4, refused.clone()));
    let said = bench.state_mut().host().said.clone();
    assert!(said.contains(&refused), "{said}");
    assert_eq!(bench.state().project().document().photos.len(), 2);
}

#[test]
fn a_photograph_is_clicked_by_keys() {
    let mut bench = open(1280.0, 720.0);
    click(&mut bench, "Two views");
    let first = "Photograph table-1.png";
    bench.get_by_label(first).focus();
    bench.run_steps(2);
    bench.get_by_label_contains("crosshair at (240, 180)");
    bench.key_press(egui::Key::ArrowLeft);
    bench.run_steps(2);
    bench.get_by_label_contains("crosshair at (230, 180)");
    bench.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::ArrowDown);
    bench.run_steps(2);
    bench.get_by_label_contains("crosshair at (230, 181)");
    click(&mut bench, "Features");
    bench.get_by_label(first).focus();
    bench.run_steps(2);
    // Somewhere on the way there is a feature.
    for _ in 0..40 {
        bench.key_press(egui::Key::ArrowRight);
        bench.run_steps(2);
        bench.key_press(egui::Key::Enter);
        bench.run_steps(3);
        if bench.query_by_label("direction:").is_some() {
            return;
        }
    }
    panic!("no feature was found by keys");
}

/// Ways to choose.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Mouse,
    Key,
    AssistiveTechnology,
}

impl Way {
    /// Presses the first thing of this name that is no mere word, and draws frames until that has done all it does.
    fn press(self, bench: &mut Bench<'_>, name: &str) {
        let is_word = |node: &Node<'_>| node.accesskit_node().role() == Role::Label;
        let named: Vec<Node<'_>> = bench.get_all_by_label(name).collect();
        let widget = named.into_iter().find(|node| !is_word(node)).unwrap();
        match self {
            Way::Mouse => widget.click(),
            Way::AssistiveTechnology => widget.click_accesskit(),
            Way::Key => {
                widget.focus();
                bench.run_steps(2);
                bench.key_press(egui::Key::Enter);
            }
        }
        bench.run_steps(4);
    }
}

#[test]
fn a_menu_closes_with_what_is_chosen_and_opens_again() {
    for way in [Way::Mouse, Way::Key, Way::AssistiveTechnology] {
        let mut bench = open(1280.0, 720.0);
        let num_photos = |bench: &Bench<'_>| bench.state().project().document().photos.len();
        for round in 0..3 {
            assert_eq!(num_photos(&bench), 9, "{way:?}, round {round}");
            way.press(&mut bench, "Project");
            way.press(&mut bench, "Remove all photographs");
            assert_eq!(num_photos(&bench), 0, "{way:?}, round {round}");
            let item = bench.query_by_label("Remove all photographs");
            assert!(item.is_none(), "{way:?}: the menu of round {round} is open");
            if way == Way::Key {
                assert!(bench.get_by_label("Project").is_focused());
            }
            way.press(&mut bench, "Undo");
        }
        way.press(&mut bench, "Samples");
        way.press(&mut bench, "A camera that only turned");
        let item = bench.query_by_label("A camera that only turned");
        assert!(item.is_none(), "{way:?}: the menu is open");
        way.press(&mut bench, "Undo");

        // The photographs of a pair are chosen from a list.
        way.press(&mut bench, "Two views");
        for name in ["table-5.png", "table-7.png"] {
            way.press(&mut bench, "First");
            way.press(&mut bench, name);
            assert!(
                bench.query_by_label(name).is_none(),
                "{way:?}: the list is open"
            );
            let (a, b) = bench.state().project().view().pair;
            let document = bench.state().project().document();
            let names = [a, b].map(|id| document.photo(id).unwrap().name.as_str());
            assert!(names.contains(&name), "{way:?}: {names:?}");
            if way == Way::Key {
                assert!(
                    bench
                        .get_by_role_and_label(Role::ComboBox, "First")
                        .is_focused()
                );
            }
        }
    }
}

#[test]
fn the_export_shows_its_command_and_saves_what_is_seen() {
    let mut bench = open(1280.0, 720.0);
    click(&mut bench, "Export");
    let command = bench.state().project().recipe().unwrap().command;
    bench.get_by_label(&command);
    click(&mut bench, "Copy the command");
    click(&mut bench, "Save view.png");
    rest(&mut bench);
    let (name, bytes) = bench.state_mut().host().saved[0].clone();
    assert_eq!(name, "view.png");
    let picture = image::load_from_memory(&bytes).unwrap().to_rgb8();
    let colors: std::collections::BTreeSet<[u8; 3]> = picture.pixels().map(|p| p.0).collect();
    assert!(
        picture.width() > 400 && colors.len() > 200,
        "{} colors",
        colors.len()
    );
}

#[test]
fn every_step_fits_on_a_phone() {
    let mut bench = open(390.0, 844.0);
    // From the middle of the row, where it opens, to both of its ends.
    let begun = Step::ALL
        .iter()
        .position(|step| *step == Step::Reconstruction);
    let (before, after) = Step::ALL.split_at(begun.unwrap());
    for step in before.iter().rev().chain(before).chain(after) {
        let step = *step;
        click(&mut bench, step.title());
        assert_eq!(bench.state().project().view().step, step);
        assert!(!bench.state_mut().host().said.is_empty());
        // All steps are in one row, and the bar above them is one row, too.
        let tops = Step::ALL.map(|step| {
            let mut all = bench.get_all_by_label(step.title());
            all.next().unwrap().rect().top()
        });
        assert!(
            tops.iter().all(|top| *top == tops[0] && *top < 100.0),
            "{tops:?}"
        );
        let undo = bench.get_by_label("Undo").rect();
        assert!(undo.bottom() < tops[0] && undo.top() < 20.0, "{undo}");
    }
}

#[test]
fn a_link_opens_a_step_and_every_step_is_explained() {
    let mut bench = open(1280.0, 720.0);
    let parameter = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    let link = vec![
        parameter("step", "matches"),
        parameter("ratio", "0.7"),
        parameter("color", "red"),
    ];
    bench.state_mut().host().arrivals.push(Arrival::Link(link));
    bench.run_steps(3);
    assert_eq!(bench.state().project().view().step, Step::Matches);
    assert_eq!(
        bench.state().project().document().settings.matching.ratio,
        0.7
    );
    bench.get_by_label_contains("The Lab knows no \"color\".");
    assert_eq!(bench.state_mut().host().address, "step=matches&ratio=0.7");
    for step in Step::ALL {
        click(&mut bench, step.title());
        click(&mut bench, "What is this?");
        let explained = bench.state_mut().host().explained.pop();
        assert_eq!(explained, Some(step.about()));
    }
}

#[test]
fn the_space_turns_by_keys_and_a_click_finds_a_point() {
    let mut bench = open(900.0, 700.0);
    let space = || "Space with ";
    let node = bench.get_by_label_contains(space());
    let rect = node.rect();
    node.click();
    bench.run_steps(3);
    for key in [egui::Key::ArrowRight, egui::Key::ArrowUp, egui::Key::Plus] {
        bench.key_press(key);
        bench.run_steps(2);
    }
    // Somewhere in the middle there are points.
    let mut found = false;
    for n in 0..60 {
        let at =
            rect.center() + egui::vec2((n % 10) as f32 * 7.0 - 35.0, (n / 10) as f32 * 9.0 - 20.0);
        bench.drag_at(at);
        bench.drop_at(at);
        bench.run_steps(2);
        if bench.query_by_label_contains("seen in").is_some() {
            found = true;
            break;
        }
    }
    assert!(found, "no click found a point");
}

#[test]
fn a_project_is_kept_by_choice_comes_back_and_is_forgotten() {
    let mut bench = open(1280.0, 720.0);
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    let broken = |name: &str| vec![(name.to_owned(), vec![1_u8, 2, 3].into())];
    let give = |bench: &mut Bench<'_>, name: &str| {
        let arrival = Arrival::Photographs(broken(name));
        bench.state_mut().host().arrivals.push(arrival);
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
    host.arrivals.push(Arrival::Link(link));
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
        bench.state_mut().host().arrivals.push(Arrival::Kept(kept));
        rest(bench);
        bench.run_steps(40);
    };
    click(&mut bench, "Project");
    click(&mut bench, "Keep in this browser");
    bench.run_steps(40);
    hear(
        &mut bench,
        Kept::Not {
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
    hear(&mut bench, Kept::Project(vec![1_u8, 2, 3].into()));
    let words = said(&mut bench);
    assert!(
        words.contains("does not open: this file is no project of the Lab"),
        "{words}"
    );
    assert_eq!(bench.state().project().document().photos.len(), 9);
    hear(&mut bench, Kept::Forgotten);
    let words = said(&mut bench);
    assert!(words.contains("Another page of the Lab"), "{words}");
    click(&mut bench, "Project");
    bench.get_by_label("Keep in this browser");
}

#[test]
fn what_broke_down_is_told_and_tried_again() {
    let mut bench = open(1280.0, 720.0);
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    let step = |bench: &mut Bench<'_>, name| {
        click(bench, name);
        rest(bench);
    };
    bench.state_mut().host().breaks = true;
    step(&mut bench, "Features");
    step(&mut bench, "SIFT");
    step(&mut bench, "Photographs");
    let words = said(&mut bench);
    assert!(words.contains("there is not enough memory"), "{words}");
    assert_eq!(bench.state().project().document().photos.len(), 9);
    bench.state_mut().host().breaks = false;
    step(&mut bench, "Try again");
    step(&mut bench, "Reconstruction");
    let words = said(&mut bench);
    assert!(
        words.contains("9 of 9 photographs have a camera"),
        "{words}"
    );
    assert!(bench.query_by_label("Try again").is_none());
}

#[test]
fn the_sample_comes_solved_or_is_computed_where_it_does_not_come() {
    use epipole_lab::tasks::Sample;
    let computed = common::solved(Sample::Table).light_computed().to_bytes();
    // Only photographs are rendered, or there is more to do.
    for (bytes, is_solved) in [(computed, true), (Vec::new(), false)] {
        let mut bench = common::desk::open_with(
            common::desk::Desk {
                brings_sample: true,
                ..Default::default()
            },
            1280.0,
            720.0,
        );
        assert_eq!(bench.state_mut().host().num_started, 0, "it waits");
        assert!(bench.get_all_by_label("Reconstructing.").next().is_some());
        let arrival = Arrival::Solved(bytes.into());
        bench.state_mut().host().arrivals.push(arrival);
        rest(&mut bench);
        bench.get_by_label("9 of 9");
        let started = bench.state_mut().host().num_started;
        assert_eq!(started == 9, is_solved, "{started}");
        // Another sample is computed as ever.
        click(&mut bench, "Samples");
        click(&mut bench, Sample::Alone.title());
        rest(&mut bench);
        assert!(bench.state_mut().host().num_started > started);
    }
}
