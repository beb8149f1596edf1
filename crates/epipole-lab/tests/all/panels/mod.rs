//! The panels, operated by their accessible labels.

#![cfg(all(feature = "panels", feature = "compute"))]

mod all_views;
mod coming;
mod editing;
mod guided;
mod keeping;
mod measuring;
mod menus;

use crate::common::desk::{Bench, click, open, rest};
use egui_kittest::kittest::Queryable;
use epipole_lab::project::Step;
use epipole_lab::session::HostEvent;

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
        if bench.state().project().pending().is_empty() {
            break;
        }
    }
    click(&mut bench, "Undo");
    assert!(
        bench.state().project().pending().is_empty(),
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
        .host_events
        .push(HostEvent::Photographs(broken));
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
    assert_eq!(lens(&bench), epipole_lab::project::LensModel::Fisheye);
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
    // Photographs that arrive during this step are of a board, and replace the sample.
    let broken = vec![("broken.png".to_owned(), vec![1_u8, 2, 3].into())];
    let host_event = HostEvent::Photographs(broken);
    bench.state_mut().host().host_events.push(host_event);
    bench.run_steps(6);
    let document = bench.state().project().document();
    assert_eq!((document.boards.len(), document.photos.len()), (1, 9));
    let words = said(&mut bench);
    assert!(words.contains("broken.png: cannot be read"), "{words}");
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
    bench
        .state_mut()
        .host()
        .host_events
        .push(HostEvent::Link(link));
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
        assert_eq!(explained, Some(step.explanation()));
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
