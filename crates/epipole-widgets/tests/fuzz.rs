//! Thousands of random event sequences for every figure: whatever a reader or a page does, nothing
//! breaks, every number is a number, and a link to the state restores it.

mod common;

use common::{assert_sound, copy_of, random_event};
use epipole::math::random::Random;
use epipole_widgets::Figure;
use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;

const NUM_SEQUENCES: u64 = 2000;
const LONGEST: usize = 12;

#[test]
fn any_events_leave_a_sound_figure_whose_state_round_trips() {
    for (index, entry) in FIGURES.iter().enumerate() {
        let mut refused = 0;
        for sequence in 0..NUM_SEQUENCES {
            let mut random = Random::new(1000 * index as u64 + sequence * 7919);
            let mut figure = Figure::new(entry.name).unwrap();
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
            assert_sound(&figure, random.uniform(280.0, 1200.0));
            let copy = copy_of(&figure);
            assert_eq!(copy.state(), figure.state(), "sequence {sequence}");
            assert_eq!(copy.handles(), figure.handles(), "{}", figure.query());
            let readouts = (copy.readouts(), figure.readouts());
            assert_eq!(readouts.0, readouts.1, "{}", figure.query());
            assert_eq!(copy.describe(), figure.describe(), "{}", figure.query());
        }
        assert!(
            refused > 100,
            "{}: only {refused} events were bad",
            entry.name
        );
    }
}

#[test]
fn restored_figures_look_the_same() {
    for (index, entry) in FIGURES.iter().enumerate() {
        for sequence in 0..12 {
            let mut random = Random::new(77 + 100 * index as u64 + sequence);
            let mut figure = Figure::new(entry.name).unwrap();
            for _ in 0..8 {
                let event = random_event(&figure, &mut random);
                let _ = figure.update(&event);
                if random.below(3) == 0 {
                    figure.draw(300.0, 1.0, Theme::Dark).unwrap();
                }
            }
            let mut copy = copy_of(&figure);
            let hash = figure
                .draw_settled(300.0, 1.0, Theme::Light)
                .unwrap()
                .hash();
            let again = copy.draw_settled(300.0, 1.0, Theme::Light).unwrap().hash();
            assert_eq!(hash, again, "{} at {}", entry.name, figure.query());
        }
    }
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
