//! Thousands of random event sequences for every figure: nothing panics, every number is finite,
//! and a permalink restores the state.
//!
//! `FUZZ_SEQUENCES` sets the number of sequences per figure; `make fuzz` runs a night's worth.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;

use common::{assert_sound, copy_of, finish, random_event};
use epipole::math::random::Random;
use epipole_widgets::Figure;
use epipole_widgets::gallery::{self, FIGURES};
use epipole_widgets::theme::Theme;
use std::ops::ControlFlow;

/// Number of sequences per figure; at four or five events each, ten thousand events.
const NUM_SEQUENCES: u64 = 2000;
const LONGEST: usize = 8;

/// Returns the number of event sequences per figure.
fn num_sequences() -> u64 {
    let wanted = std::env::var("FUZZ_SEQUENCES").ok();
    wanted.map_or(NUM_SEQUENCES, |number| {
        number.parse().expect("FUZZ_SEQUENCES is a number")
    })
}

/// Runs a check of a figure's name and index for every figure, each in a thread of its own.
fn for_every_figure(check: impl Fn(&'static str, u64) + Sync) {
    std::thread::scope(|scope| {
        for (index, entry) in FIGURES.iter().enumerate() {
            let check = &check;
            scope.spawn(move || check(entry.name, index as u64));
        }
    });
}

#[test]
fn any_events_leave_a_sound_figure_whose_state_round_trips() {
    for_every_figure(fuzz);
}

fn fuzz(name: &str, seed: u64) {
    let mut refused = 0;
    for sequence in 0..num_sequences() {
        let mut random = Random::new(1_000_000 * seed + sequence);
        let mut figure = Figure::new(name).expect("it exists");
        for _ in 0..=random.below(LONGEST) {
            let event = random_event(&figure, &mut random);
            let before = (random.below(16) == 0).then(|| figure.query());
            if let Err(problem) = figure.update(&event) {
                refused += 1;
                assert!(problem.to_string().len() > 20, "{problem}");
                if let Some(before) = before {
                    assert_eq!(figure.query(), before, "{event:?} was refused");
                }
            }
        }
        // Jobs take long, so most states are checked while theirs is pending.
        let finishes_job = sequence % 250 == 0;
        if finishes_job {
            finish(&mut figure);
            assert!(figure.job().is_none(), "{name} computes forever");
        }
        assert_sound(&figure, random.uniform(280.0, 1200.0));
        // Permalinks of hundreds of points take long to parse.
        if figure.handles().len() < 20 || sequence % 8 == 0 {
            let mut copy = copy_of(&figure);
            if finishes_job {
                finish(&mut copy);
            }
            let query = figure.query();
            assert_eq!(copy.state(), figure.state(), "{name}, sequence {sequence}");
            assert_eq!(copy.handles(), figure.handles(), "{name} at {query}");
            assert_eq!(copy.readouts(), figure.readouts(), "{name} at {query}");
            assert_eq!(copy.describe(), figure.describe(), "{name} at {query}");
        }
    }
    assert!(refused > 100, "{name}: only {refused} events were bad");
}

#[test]
fn jobs_survive_requests_of_any_bytes() {
    let mut random = Random::new(8);
    for entry in FIGURES {
        let mut figure = Figure::new(entry.name).unwrap();
        let request = figure.job().map(|job| job.request()).unwrap_or_default();
        for _ in 0..200 {
            let mut bytes = request.clone();
            bytes.truncate(random.below(request.len() + 1));
            for _ in 0..random.below(4) {
                if !bytes.is_empty() {
                    let index = random.below(bytes.len().min(64));
                    bytes[index] = random.below(256) as u8;
                }
            }
            let mut go_on = |_: f64| ControlFlow::Break(());
            if let Err(problem) = gallery::compute(entry.name, &bytes, &mut go_on) {
                assert!(!problem.to_string().is_empty());
            }
        }
        // A malformed answer must leave the figure sound.
        while let Some(key) = figure.job().map(|job| job.key()) {
            let answer = (0..random.below(50)).map(|_| random.below(256) as u8);
            let taken = figure.job_done(key, Ok(answer.collect()));
            assert!(taken);
            assert_sound(&figure, 400.0);
            if figure.job().is_some_and(|next| next.key() == key) {
                break;
            }
        }
        assert!(!figure.job_done(12345, Ok(Vec::new())));
    }
}

#[test]
fn restored_figures_look_the_same() {
    for_every_figure(|name, index| {
        for sequence in 0..5 {
            let mut random = Random::new(77 + 100 * index + sequence);
            let mut figure = Figure::new(name).unwrap();
            for _ in 0..8 {
                let event = random_event(&figure, &mut random);
                let _ = figure.update(&event);
                if random.below(3) == 0 {
                    figure.draw(300.0, 1.0, Theme::Dark).unwrap();
                }
            }
            let [restored, original] = [copy_of(&figure), figure].map(|mut figure| {
                finish(&mut figure);
                let picture = figure.draw_sharp(300.0, 1.0, Theme::Light);
                (picture.unwrap().hash(), figure.query())
            });
            assert_eq!(restored, original, "{name}");
        }
    });
}

#[test]
fn queries_of_any_bytes_are_survived() {
    let alphabet: Vec<char> = "pe19=&,.-%2C+_?#NaN∞ \u{0}".chars().collect();
    let mut random = Random::new(5);
    for entry in FIGURES {
        let mut figure = Figure::new(entry.name).unwrap();
        for _ in 0..500 {
            let query: String = (0..random.below(40))
                .map(|_| alphabet[random.below(alphabet.len())])
                .collect();
            for problem in figure.apply_query(&query) {
                assert!(!problem.to_string().is_empty());
            }
        }
        assert_sound(&figure, 500.0);
    }
}
