//! Prints hashes of frames of figures, to confirm that a change alters no picture.
//!
//! `cargo run -q -p epipole-widgets --example hashes [NAME…] > before`

#![allow(clippy::unwrap_used, reason = "a tool for the desk")]

use epipole::math::random::Random;
use epipole_widgets::Figure;
use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;

#[path = "../tests/common/mod.rs"]
mod common;

/// Prints the hashes of a figure at a width, drawn at once and at full quality.
fn print(figure: &mut Figure, what: &str, width: f64, theme: Theme) {
    let at_once = figure.draw(width, 1.0, theme).unwrap().hash();
    let hash = figure.draw_settled(width, 1.0, theme).unwrap().hash();
    let (name, state) = (figure.name(), figure.query());
    println!(
        "{name} {what} {width} {at_once:016x} {hash:016x} {state} {}",
        figure.describe()
    );
}

fn main() {
    let names: Vec<String> = std::env::args().skip(1).collect();
    for entry in FIGURES {
        if !names.is_empty() && names.iter().all(|name| name != entry.name) {
            continue;
        }
        let mut figure = Figure::new(entry.name).unwrap();
        for width in [340.0, 511.0, 760.0] {
            print(&mut figure, "default", width, Theme::Light);
        }
        let mut random = Random::new(17);
        for round in 0..12 {
            for _ in 0..4 {
                let event = common::random_event(&figure, &mut random);
                // A refused event changes nothing, which the next hash shows.
                let _ = figure.update(&event);
                figure.finish_job();
            }
            print(&mut figure, &format!("round-{round}"), 640.0, Theme::Dark);
        }
    }
}
