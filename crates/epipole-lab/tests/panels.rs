//! The panels, operated by what they say: labels that a screen reader hears.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(all(feature = "panels", feature = "compute"))]

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use epipole_lab::panels::{App, Arrival, Host, Report, WorkId, prepare};
use epipole_lab::project::Step;
use epipole_lab::tasks::compute;
use std::ops::ControlFlow;

/// A host that computes at once.
#[derive(Default)]
struct Desk {
    reports: Vec<Report>,
    arrivals: Vec<Arrival>,
    saved: Vec<(String, Vec<u8>)>,
    said: String,
    asked: usize,
}

impl Host for Desk {
    fn capacity(&self) -> usize {
        4
    }

    fn start(&mut self, work: WorkId, request: Vec<u8>) {
        let result = compute(&request, &mut |_, _| ControlFlow::Continue(()));
        self.reports.push(Report::Done(work, result));
    }

    fn cancel(&mut self, _work: WorkId) {}

    fn reports(&mut self) -> Vec<Report> {
        std::mem::take(&mut self.reports)
    }

    fn arrivals(&mut self) -> Vec<Arrival> {
        std::mem::take(&mut self.arrivals)
    }

    fn ask_for_photographs(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_project(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String> {
        self.saved.push((name.to_owned(), bytes));
        Ok(format!("{name} is saved."))
    }

    fn say(&mut self, words: &str) {
        self.said = words.to_owned();
    }
}

type Bench<'a> = Harness<'a, App<Desk>>;

fn open<'a>(width: f32, height: f32) -> Bench<'a> {
    let frame = |ui: &mut egui::Ui, app: &mut App<Desk>| {
        app.go_on();
        app.ui(ui);
    };
    let mut bench = Harness::builder()
        .with_size(egui::vec2(width, height))
        .with_context_setup(prepare)
        .build_ui_state(frame, App::new(Desk::default()));
    for _ in 0..200 {
        bench.step();
        if !bench.state_mut().go_on() && bench.state().project().wanted().is_empty() {
            break;
        }
    }
    bench.run_steps(3);
    bench
}

/// Clicks the first thing of this name.
fn click(bench: &mut Bench<'_>, name: &str) {
    bench.get_all_by_label(name).next().unwrap().click();
    bench.run_steps(4);
}

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
    click(&mut bench, "takes part");
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
fn every_step_fits_on_a_phone() {
    let mut bench = open(390.0, 844.0);
    for step in Step::ALL {
        click(&mut bench, step.title());
        assert_eq!(bench.state().project().view().step, step);
        assert!(!bench.state_mut().host().said.is_empty());
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
