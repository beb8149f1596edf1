//! Measures the time per frame while dragging, at two device pixels per CSS pixel.
//!
//! ```text
//! cargo run --release -p epipole-widgets --example frames [-- NAME [CONTROL]]
//! ```
//!
//! Drags every slider and the first handle of one figure or of all, or only the named control,
//! through their ranges, and draws a frame after every event, as a page does. Long computations are
//! finished beforehand.

use epipole_widgets::Figure;
use epipole_widgets::contract::{ControlKind, Event, Problem, Value, WIDTHS};
use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;
use std::time::Instant;

const NUM_FRAMES: usize = 60;
/// Width of the broadest picture on pages, CSS pixels.
const WIDTH: f64 = WIDTHS[2];
const SCALE: f64 = 2.0;

fn main() -> Result<(), Problem> {
    println!("milliseconds                                  least  median     p95");
    let wanted = std::env::args().nth(1);
    let only = std::env::args().nth(2);
    let is_moved = |id: &str| only.as_ref().is_none_or(|only| only == id);
    let is_wanted = |name: &str| wanted.as_ref().is_none_or(|wanted| wanted == name);
    for entry in FIGURES.iter().filter(|entry| is_wanted(entry.name)) {
        let mut figure = Figure::new(entry.name)?;
        figure.finish_job();
        figure.draw(WIDTH, SCALE, Theme::Light)?;
        let slices = settle(&mut figure);
        report(entry.name, "a slice of refining", slices);
        report(entry.name, "drawing when settled", {
            let mut times = Vec::new();
            for _ in 0..NUM_FRAMES {
                times.push(frame(&mut figure, &[])?);
            }
            times
        });
        for control in Figure::new(entry.name)?.controls() {
            let ControlKind::Slider { min, max, .. } = control.kind else {
                continue;
            };
            if !is_moved(control.id) {
                continue;
            }
            let mut times = Vec::new();
            for index in 0..NUM_FRAMES {
                let share = index as f64 / (NUM_FRAMES - 1) as f64;
                let event = Event::Set {
                    id: control.id.to_owned(),
                    value: Value::Number(min + share * (max - min)),
                };
                times.push(frame(&mut figure, &[event])?);
            }
            report(entry.name, control.id, times);
            figure.update(&Event::Reset)?;
            figure.finish_job();
            figure.draw(WIDTH, SCALE, Theme::Light)?;
        }
        let handles = figure.handles();
        if let Some(handle) = handles.first().filter(|handle| is_moved(&handle.id)) {
            let mut times = Vec::new();
            for index in 0..NUM_FRAMES {
                let share = index as f64 / (NUM_FRAMES - 1) as f64;
                let at = |[low, high]: [f64; 2]| low + share * (high - low);
                let event = Event::HandleMoved {
                    id: handle.id.clone(),
                    x: at(handle.x_range),
                    y: at(handle.y_range),
                };
                times.push(frame(&mut figure, &[event])?);
            }
            report(entry.name, &handle.id, times);
        }
    }
    Ok(())
}

fn frame(figure: &mut Figure, events: &[Event]) -> Result<f64, Problem> {
    let begin = Instant::now();
    for event in events {
        figure.update(event)?;
    }
    figure.draw(WIDTH, SCALE, Theme::Light)?;
    figure.readouts();
    figure.describe();
    Ok(begin.elapsed().as_secs_f64() * 1e3)
}

fn settle(figure: &mut Figure) -> Vec<f64> {
    let mut times = Vec::new();
    loop {
        let begin = Instant::now();
        let more = figure.refine();
        times.push(begin.elapsed().as_secs_f64() * 1e3);
        if !more {
            return times;
        }
    }
}

fn report(figure: &str, what: &str, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!(
        "{figure:16} {what:24} {:9.1} {:7.1} {:7.1}",
        at(0.0),
        at(0.5),
        at(0.95)
    );
}
