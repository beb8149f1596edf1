//! The panels, operated by what they say: labels that a screen reader hears.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(all(feature = "panels", feature = "compute"))]

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use epipole_lab::panels::{About, App, Arrival, Host, Report, WorkId, prepare};
use epipole_lab::project::Step;
use epipole_lab::tasks::{Branch, compute};
use std::ops::ControlFlow;

/// A host that computes at once.
#[derive(Default)]
struct Desk {
    reports: Vec<Report>,
    arrivals: Vec<Arrival>,
    saved: Vec<(String, Vec<u8>)>,
    said: String,
    asked: usize,
    frames: Vec<(u32, u32)>,
    explained: Vec<About>,
    address: String,
}

impl Host for Desk {
    fn capacity(&self) -> usize {
        4
    }

    fn start(&mut self, work: WorkId, _branch: Branch, request: Vec<u8>) {
        let result = compute(&request, &mut |_| ControlFlow::Continue(()));
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

    fn ask_for_camera(&mut self) -> bool {
        self.asked += 1;
        true
    }

    fn ask_for_frames(&mut self, video: u32, num_parts: u32) {
        self.frames.push((video, num_parts));
    }

    fn save(&mut self, name: &str, bytes: Vec<u8>) -> Result<String, String> {
        self.saved.push((name.to_owned(), bytes));
        Ok(format!("{name} is saved."))
    }

    fn explain(&mut self, about: About) {
        self.explained.push(about);
    }

    fn has_book(&self) -> bool {
        true
    }

    fn address(&mut self, link: &str) {
        self.address = link.to_owned();
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
    rest(&mut bench);
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

/// Draws frames until nothing is under way.
fn rest(bench: &mut Bench<'_>) {
    for _ in 0..200 {
        bench.step();
        if !bench.state_mut().go_on() && bench.state().project().wanted().is_empty() {
            break;
        }
    }
    bench.run_steps(3);
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
        words.contains("of 640 × 480 pixels, of which there are none yet"),
        "{words}"
    );
    assert!(bench.state().project().document().camera.is_some());
    click(&mut bench, "Do not use it any more");
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
    bring(&mut bench, Arrival::Video(3));
    assert_eq!(bench.state_mut().host().frames, [(3, 20)]);
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
    let parts = vec![vec![soft.clone(), sharp.clone()], vec![sharp.clone(), soft]];
    bring(&mut bench, Arrival::Frames(3, "walk.mp4".to_owned(), parts));
    let photos = &bench.state().project().document().photos;
    let names: Vec<&str> = photos.iter().map(|photo| photo.name.as_str()).collect();
    assert_eq!(names, ["walk-01.jpg", "walk-02.jpg"]);
    let source = epipole_lab::tasks::Source::File(sharp);
    assert!(photos.iter().all(|photo| photo.source == source));
    let said = bench.state_mut().host().said.clone();
    assert!(
        said.contains("2 frames were taken from the video."),
        "{said}"
    );
    let refused = "walk.mp4 cannot be decoded here.".to_owned();
    bring(&mut bench, Arrival::News(refused.clone()));
    let said = bench.state_mut().host().said.clone();
    assert!(said.contains(&refused), "{said}");
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
