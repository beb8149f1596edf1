//! Helpers for tests of figures: random events and invariants.

#![allow(dead_code, reason = "each test uses a part")]

use epipole::math::random::Random;
use epipole_widgets::contract::{Control, ControlKind, Event, ReadoutValue, Value};
use epipole_widgets::{Answers, Figure};

/// Maximum length of a description, characters, as a screen reader reads it aloud.
const LONGEST_DESCRIPTION: usize = 400;

/// Returns a random event, usually valid.
pub(crate) fn random_event(figure: &Figure, random: &mut Random) -> Event {
    match random.below(100) {
        0..35 => {
            let controls = figure.controls();
            if controls.is_empty() {
                return Event::Reset;
            }
            let control = &controls[random.below(controls.len())];
            let value = match random.below(8) {
                0 => odd_value(random),
                _ => sensible_value(control, random),
            };
            match control.kind {
                ControlKind::Button { .. } => Event::Press {
                    id: control.id.to_owned(),
                },
                _ => Event::Set {
                    id: control.id.to_owned(),
                    value,
                },
            }
        }
        35..60 => {
            let handles = figure.handles();
            if handles.is_empty() {
                return Event::Tick { dt_s: 0.02 };
            }
            let handle = &handles[random.below(handles.len())];
            let mut along = |[low, high]: [f64; 2]| {
                let margin = 0.2 * (high - low);
                match random.below(12) {
                    0 => odd_number(random),
                    _ => random.uniform(low - margin, high + margin),
                }
            };
            Event::HandleMoved {
                id: handle.id.clone(),
                x: along(handle.x_range),
                y: along(handle.y_range),
            }
        }
        60..66 => {
            let handles = figure.handles();
            let index = random.below(handles.len().max(1));
            let id = handles.get(index).map_or("none", |handle| &handle.id);
            Event::HandleRemoved { id: id.to_owned() }
        }
        66..80 => {
            let layout = figure.layout(random.uniform(280.0, 1200.0));
            let panel = &layout.panels[random.below(layout.panels.len())];
            let mut along = |a: f64, b: f64| match random.below(12) {
                0 => odd_number(random),
                _ => a + (b - a) * random.uniform(-0.1, 1.1),
            };
            Event::Clicked {
                panel: panel.id.to_owned(),
                x: along(panel.x_axis.start, panel.x_axis.end),
                y: along(panel.y_axis.start, panel.y_axis.end),
            }
        }
        80..94 => Event::Tick {
            dt_s: match random.below(6) {
                0 => odd_number(random),
                _ => random.uniform(0.0, 0.1),
            },
        },
        94..95 => Event::Reset,
        _ => {
            let names = [
                "",
                "nothing",
                "p999",
                "baseline ",
                "NaN",
                "ä",
                "object,object",
            ];
            let id = names[random.below(names.len())].to_owned();
            match random.below(4) {
                0 => Event::Set {
                    id,
                    value: odd_value(random),
                },
                1 => Event::Press { id },
                2 => Event::HandleMoved { id, x: 1.0, y: 2.0 },
                _ => Event::Clicked {
                    panel: id,
                    x: 0.0,
                    y: 0.0,
                },
            }
        }
    }
}

fn sensible_value(control: &Control, random: &mut Random) -> Value {
    match &control.kind {
        ControlKind::Slider { min, max, .. } => {
            let number = random.uniform(*min, *max);
            match random.below(4) {
                0 => Value::Number(*min),
                1 => Value::Text(number.to_string()),
                _ => Value::Number(number),
            }
        }
        ControlKind::Toggle { .. } => Value::Flag(random.below(2) == 0),
        ControlKind::Choice { options, .. } => {
            Value::Text(options[random.below(options.len())].0.to_owned())
        }
        ControlKind::Button { .. } => Value::Flag(true),
    }
}

fn odd_number(random: &mut Random) -> f64 {
    let numbers = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        1e300,
        -1e300,
        5e-324,
        -0.0,
        f64::MAX,
    ];
    numbers[random.below(numbers.len())]
}

fn odd_value(random: &mut Random) -> Value {
    match random.below(4) {
        0 => Value::Number(odd_number(random)),
        1 => Value::Flag(random.below(2) == 0),
        _ => {
            let texts = ["", "many", "NaN", "inf", "-1e999", "1,2", "0x10", "💥"];
            Value::Text(texts[random.below(texts.len())].to_owned())
        }
    }
}

/// Asserts the invariants of every state of every figure.
pub(crate) fn assert_sound(figure: &Figure, width: f64) {
    let name = figure.name();
    let context = format!("{name} at {}", figure.query());
    let description = figure.describe();
    assert_readable(&description, &context);
    let length = description.chars().count();
    assert!(
        length <= LONGEST_DESCRIPTION,
        "{context}: {length} characters: {description}"
    );
    for readout in figure.readouts() {
        assert_readable(&readout.text, &context);
        assert_readable(readout.label, &context);
        if let ReadoutValue::Number(number) = readout.value {
            assert!(number.is_finite(), "{context}: {}", readout.id);
        }
    }
    for control in figure.controls() {
        if let ControlKind::Slider {
            min, max, value, ..
        } = control.kind
        {
            assert!((min..=max).contains(&value), "{}: {}", context, control.id);
            assert_readable(&control.value_text, &context);
        }
    }
    let layout = figure.layout(width);
    for handle in figure.handles() {
        assert_readable(&handle.label, &context);
        assert_readable(&handle.value_text, &context);
        let inside = |value: f64, [low, high]: [f64; 2]| (low..=high).contains(&value);
        assert!(
            inside(handle.x, handle.x_range) && inside(handle.y, handle.y_range),
            "{}: {} is out of range",
            context,
            handle.id
        );
        let panel = layout.panel(handle.panel);
        let place = panel.canvas_from_world((handle.x, handle.y));
        assert!(
            panel.rect.contains(place),
            "{}: {} is at {place:?}, outside of {:?}",
            context,
            handle.id,
            panel.rect
        );
    }
}

/// Asserts that a text is not empty and has no debug output such as "NaN" or "None".
fn assert_readable(text: &str, context: &str) {
    assert!(!text.trim().is_empty(), "{context}: an empty text");
    let bad = ["NaN", "nan", "inf", "None", "Some"];
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    let found = words.find(|word| bad.contains(word));
    assert!(found.is_none(), "{context}: {found:?} in \"{text}\"");
}

static ANSWERS: Answers = Answers::new();

/// Finishes the pending jobs of a figure, cached across tests.
pub(crate) fn finish(figure: &mut Figure) {
    ANSWERS.finish(figure);
}

/// Creates a new figure with the state of another.
pub(crate) fn copy_of(figure: &Figure) -> Figure {
    let mut copy = Figure::new(figure.name()).expect("it exists");
    let problems = copy.apply(&figure.state());
    assert!(problems.is_empty(), "{}: {problems:?}", figure.query());
    copy
}
