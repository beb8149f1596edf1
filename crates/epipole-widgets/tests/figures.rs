//! Checks that hold for every figure of the gallery.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;

use common::{assert_sound, finish, random_event};
use epipole::math::random::Random;
use epipole_widgets::contract::{Control, ControlKind, Datum, Event, Place, Problem, Value};
use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;
use epipole_widgets::{Figure, POSTER_WIDTH};
use std::collections::BTreeSet;
use std::path::Path;

/// Every figure, with its first jobs finished.
fn figures() -> impl Iterator<Item = Figure> {
    FIGURES.iter().map(|entry| finished(entry.name, &[]))
}

/// Returns a figure after some events, with its jobs finished.
fn finished(name: &str, events: &[Event]) -> Figure {
    let mut figure = Figure::new(name).expect("it exists");
    for event in events {
        figure.update(event).expect("the event is good");
    }
    finish(&mut figure);
    figure
}

#[test]
fn names_and_ids_are_unique_and_fit_into_a_url() {
    let mut names = BTreeSet::new();
    for figure in figures() {
        let name = figure.name();
        assert!(names.insert(name), "{name} twice");
        assert!(!figure.title().is_empty() && figure.help().len() > 20);
        let mut ids: Vec<String> = vec![name.to_owned()];
        ids.extend(figure.controls().iter().map(|c| c.id.to_owned()));
        ids.extend(figure.handles().iter().map(|h| h.id.clone()));
        for id in &ids {
            let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(!id.is_empty() && id.chars().all(fits), "{name}: {id}");
        }
        let unique: BTreeSet<&String> = ids.iter().collect();
        assert_eq!(unique.len(), ids.len(), "{name}: {ids:?}");
        let readouts = figure.readouts();
        let unique: BTreeSet<&str> = readouts.iter().map(|readout| readout.id).collect();
        assert_eq!(unique.len(), readouts.len(), "{name}");
    }
}

#[test]
fn defaults_are_on_the_grid_of_their_sliders() {
    for figure in figures() {
        assert_eq!(
            figure.state(),
            [],
            "{} is not at its default",
            figure.name()
        );
        assert_sound(&figure, POSTER_WIDTH);
        for control in figure.controls() {
            let ControlKind::Slider {
                min,
                step,
                default,
                value,
                digits,
                ..
            } = control.kind
            else {
                continue;
            };
            assert_eq!(value, default, "{}: {}", figure.name(), control.id);
            let steps = (default - min) / step;
            assert!(
                (steps - steps.round()).abs() < 1e-9,
                "{}: the default of {} is between two steps",
                figure.name(),
                control.id
            );
            let printed: f64 = format!("{default:.digits$}").parse().unwrap();
            assert_eq!(printed, default, "{}: {}", figure.name(), control.id);
        }
    }
}

#[test]
fn labels_have_three_words_at_most_and_readouts_two() {
    // Symbols are not words: R, t, σ₃.
    let is_word = |token: &&str| token.chars().filter(|c| c.is_alphabetic()).count() >= 2;
    let words = |label: &str| label.split_whitespace().filter(is_word).count();
    let mut long = Vec::new();
    for entry in FIGURES {
        let figure = finished(entry.name, &[]);
        let controls = figure.controls();
        let mut labels: Vec<String> = controls.iter().map(|c| c.label.to_string()).collect();
        labels.extend(figure.handles().iter().map(|handle| handle.label.clone()));
        long.extend(labels.into_iter().filter(|label| words(label) > 3));
        let readouts = figure.readouts();
        let labels = readouts.iter().map(|readout| readout.label.to_string());
        long.extend(labels.filter(|label| words(label) > 2));
    }
    assert!(long.is_empty(), "{long:#?}");
}

/// Returns a value other than the control's current one.
fn another_value(control: &Control) -> Option<Value> {
    match &control.kind {
        ControlKind::Slider {
            min, max, value, ..
        } => Some(Value::Number(if value == max { *min } else { *max })),
        ControlKind::Toggle { value, .. } => Some(Value::Flag(!value)),
        ControlKind::Choice { options, value, .. } => {
            let other = options.iter().find(|option| option.0 != *value)?;
            Some(Value::from(other.0))
        }
        ControlKind::Button { .. } => None,
    }
}

#[test]
fn every_control_and_handle_changes_something_that_can_be_seen_and_read() {
    for mut figure in figures() {
        let name = figure.name();
        let (describe, readouts) = (figure.describe(), figure.readouts());
        let hash = figure.draw(400.0, 1.0, Theme::Light).unwrap().hash();
        let (mut num_descriptions, mut num_pictures) = (0, 0);
        for control in figure.controls() {
            let Some(value) = another_value(&control) else {
                continue;
            };
            let id = control.id.to_owned();
            let mut changed = finished(name, &[Event::Set { id, value }]);
            assert_ne!(changed.state(), [], "{name}: {}", control.id);
            num_descriptions += usize::from(changed.describe() != describe);
            if control.place != Place::Hidden {
                let reads_differently =
                    changed.describe() != describe || changed.readouts() != readouts;
                assert!(reads_differently, "{name}: {}", control.id);
                let picture = changed.draw(400.0, 1.0, Theme::Light).unwrap();
                num_pictures += usize::from(picture.hash() != hash);
            }
        }
        assert!(num_descriptions > 0, "{name} always describes the same");
        assert!(num_pictures > 0, "{name} always looks the same");
        if let Some(handle) = figure.handles().first() {
            let middle = |[low, high]: [f64; 2]| 0.3 * low + 0.7 * high;
            let event = Event::HandleMoved {
                id: handle.id.clone(),
                x: middle(handle.x_range),
                y: middle(handle.y_range),
            };
            figure.update(&event).unwrap();
            finish(&mut figure);
            assert!(figure.query().starts_with(&format!("{}=", handle.id)));
            assert!(figure.describe() != describe || figure.readouts() != readouts);
            let picture = figure.draw(400.0, 1.0, Theme::Light).unwrap();
            assert_ne!(picture.hash(), hash, "{name}: {}", handle.id);
        }
        figure.update(&Event::Reset).unwrap();
        finish(&mut figure);
        assert_eq!(
            (figure.describe(), figure.query()),
            (describe, String::new())
        );
    }
}

#[test]
fn challenges_are_open_at_first_and_can_be_solved() {
    for figure in figures() {
        let name = figure.name();
        let challenges = figure.challenges();
        assert!(!challenges.is_empty(), "{name} has no challenge");
        let ids: BTreeSet<&str> = challenges.iter().map(|challenge| challenge.id).collect();
        assert_eq!(ids.len(), challenges.len(), "{name}");
        for challenge in challenges {
            assert!(
                !challenge.solved,
                "{name}: {} is solved at once",
                challenge.id
            );
            assert!(!challenge.goal.is_empty() && !challenge.hint.is_empty());
            let mut solver = Figure::new(name).unwrap();
            for event in solver.solution(challenge.id).unwrap() {
                solver.update(&event).unwrap();
                finish(&mut solver);
            }
            let now = solver.challenges();
            let now = now.iter().find(|other| other.id == challenge.id).unwrap();
            assert!(now.solved, "{name}: the solution of {} fails", challenge.id);
            assert_sound(&solver, POSTER_WIDTH);
        }
        assert_eq!(figure.solution("no such challenge"), None);
    }
}

#[test]
fn pictures_of_every_size_are_drawn() {
    let mut random = Random::new(3);
    for mut figure in figures() {
        for (index, width) in [280.0, 320.0, 359.5, 499.9, 560.0, 760.0, 1200.0]
            .into_iter()
            .enumerate()
        {
            let scale = [1.0, 3.0, 2.0, 1.5, 1.25, 2.0, 1.0][index];
            let theme = Theme::ALL[index % 3].0;
            let layout = figure.layout(width);
            let picture = figure.draw(width, scale, theme).unwrap();
            assert_eq!(f64::from(picture.width()), (width * scale).round());
            assert_eq!(f64::from(picture.height()), (layout.height * scale).round());
            assert_eq!(layout.width, width);
            for (first, panel) in layout.panels.iter().enumerate() {
                let rect = panel.rect;
                assert!(
                    rect.x >= 0.0 && rect.right() <= width + 1e-9,
                    "{}",
                    panel.id
                );
                assert!(rect.y >= 0.0 && rect.bottom() <= layout.height + 1e-9);
                for other in &layout.panels[..first] {
                    let apart = other.rect.right() <= rect.x
                        || rect.right() <= other.rect.x
                        || other.rect.bottom() <= rect.y
                        || rect.bottom() <= other.rect.y;
                    assert!(apart, "{} and {} overlap", panel.id, other.id);
                }
            }
            for _ in 0..4 {
                let event = random_event(&figure, &mut random);
                let _ = figure.update(&event);
            }
        }
        for width in [1.0, 17.0, 90.0] {
            figure.draw(width, 1.0, Theme::Light).unwrap();
        }
        for (width, scale) in [(0.0, 1.0), (f64::NAN, 1.0), (1e9, 1.0), (300.0, 0.0)] {
            let refused = figure.draw(width, scale, Theme::Light);
            assert!(matches!(refused, Err(Problem::BadSize { .. })), "{width}");
        }
        // A refused size leaves the figure working.
        figure.draw(300.0, 1.0, Theme::Light).unwrap();
    }
}

#[test]
fn a_settled_picture_does_not_depend_on_the_past() {
    for mut figure in figures() {
        let name = figure.name();
        let fresh = figure
            .draw_settled(320.0, 1.0, Theme::Light)
            .unwrap()
            .hash();
        let mut random = Random::new(11);
        for _ in 0..10 {
            let event = random_event(&figure, &mut random);
            let _ = figure.update(&event);
            figure.draw(320.0, 1.0, Theme::Light).unwrap();
            figure.refine();
        }
        figure.update(&Event::Reset).unwrap();
        let again = figure
            .draw_settled(320.0, 1.0, Theme::Light)
            .unwrap()
            .hash();
        assert_eq!(fresh, again, "{name}");
        assert!(!figure.refine(), "{name} is settled");
    }
}

#[test]
fn preparations_end_and_change_no_picture() {
    let mut num_steps = 0;
    // Scenes are shared, so later figures find them prepared.
    for mut figure in figures() {
        let name = figure.name();
        let steps = (0..2000).take_while(|_| figure.prepare()).count();
        assert!(steps < 2000, "{name}");
        num_steps += steps;
        let prepared = figure.draw(320.0, 1.0, Theme::Light).unwrap().hash();
        assert!(!figure.prepare(), "{name}");
        let again = figure.draw(320.0, 1.0, Theme::Light).unwrap().hash();
        assert_eq!(prepared, again, "{name}");
    }
    assert!(num_steps > 10, "{num_steps}");
}

/// Figures with data for code of readers, and the names of their data.
const WITH_DATA: &[(&str, &str)] = &[
    ("eight-point", "fundamental pixels1 pixels2"),
    (
        "epipolar-click",
        "camera1 camera2 fundamental pixels1 pixels2",
    ),
    ("homography-drag", "homography pixels planeCm"),
    ("outlier-drag", "pixels1 pixels2"),
    ("plane-or-not", "camera1 camera2 fundamental homography"),
    ("ransac-epipolar", "pixels1 pixels2 thresholdPx"),
    ("ransac-line", "points thresholdPx"),
    ("ransac-race", "points thresholdPx"),
    ("rectify", "camera1 camera2 pixels1 pixels2"),
    ("triangulate", "camera1 camera2 pixels1 pixels2"),
    ("vanishing-points", "camera pixels"),
];

#[test]
fn data_of_figures_are_finite_and_matches_come_in_pairs() {
    let mut found = Vec::new();
    for figure in figures() {
        let data = figure.data();
        if data.is_empty() {
            continue;
        }
        for (name, datum) in &data {
            let is_finite = match datum {
                Datum::Number(value) => value.is_finite(),
                Datum::Points(points) => points.iter().flatten().all(|x| x.is_finite()),
                Datum::Matrix(rows) => rows.iter().flatten().all(|x| x.is_finite()),
                Datum::Camera(_) => true,
            };
            assert!(is_finite, "{}: {name}", figure.name());
        }
        if let (Some(Datum::Points(one)), Some(Datum::Points(two))) =
            (data.get("pixels1"), data.get("pixels2"))
        {
            assert_eq!(one.len(), two.len(), "{}", figure.name());
            assert!(!one.is_empty(), "{}", figure.name());
        }
        let names: Vec<&str> = data.keys().copied().collect();
        found.push((figure.name(), names.join(" ")));
    }
    found.sort();
    let expected = WITH_DATA
        .iter()
        .map(|&(name, data)| (name, data.to_owned()));
    assert_eq!(found, expected.collect::<Vec<_>>());
}

#[test]
fn a_photograph_has_the_pixels_of_its_panel() {
    let mut found = BTreeSet::new();
    for mut figure in figures() {
        for panel in figure.layout(POSTER_WIDTH).panels {
            let Some(photograph) = figure.photograph(panel.id) else {
                continue;
            };
            let columns = (panel.x_axis.end - panel.x_axis.start).round() as u32;
            let rows = (panel.y_axis.end - panel.y_axis.start).round() as u32;
            assert_eq!(
                photograph.dimensions(),
                (columns, rows),
                "{}",
                figure.name()
            );
            found.insert(figure.name());
        }
    }
    let expected = [
        "disparity-map",
        "eight-point",
        "epipolar-click",
        "homography-drag",
        "keypoint-orientation",
        "lens-bend",
        "panorama",
        "path-costs",
        "plane-or-not",
        "ransac-epipolar",
        "vanishing-points",
    ];
    assert!(found.iter().eq(&expected), "{found:?}");
}

#[test]
fn models_name_no_drawing_and_no_clock() {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gallery");
    let mut num_models = 0;
    for folder in std::fs::read_dir(gallery).unwrap() {
        let folder = folder.unwrap().path();
        if !folder.is_dir() {
            continue;
        }
        let source = std::fs::read_to_string(folder.join("model.rs")).unwrap();
        num_models += 1;
        for word in identifiers(&source) {
            let word = word.to_lowercase();
            let bad = ["canvas", "theme", "view", "instant", "systemtime"];
            assert!(
                !bad.contains(&word.as_str()),
                "{}: {word}",
                folder.display()
            );
        }
    }
    assert_eq!(num_models, FIGURES.len());
}

/// Returns the identifiers of Rust source, without comments and strings.
fn identifiers(source: &str) -> Vec<String> {
    let mut code = String::new();
    let mut rest = source;
    while let Some(character) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if character == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            end.map_or(rest.len(), |end| end + 2)
        } else {
            code.push(character);
            rest = &rest[character.len_utf8()..];
            continue;
        };
        code.push(' ');
        rest = &rest[skipped..];
    }
    code.split(|c: char| !c.is_alphanumeric() && c != '_')
        .map(str::to_owned)
        .collect()
}

#[test]
fn identifiers_leave_out_comments_and_strings() {
    let words = identifiers("use a::view; // theme\nlet s = \"canvas \\\" clock\"; Instant");
    assert!(words.contains(&"view".to_owned()) && words.contains(&"Instant".to_owned()));
    assert!(!words.contains(&"theme".to_owned()) && !words.contains(&"canvas".to_owned()));
    assert!(!words.contains(&"clock".to_owned()));
}
