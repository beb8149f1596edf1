//! The reader's guess: a hidden answer, the guess, and both compared.
//!
//! A figure lists [`GUESS`] and [`BOTH`] in a choice, after the options that show its answer.

use crate::canvas::{Canvas, Stroke};
use crate::contract::{Choice, Event, Handle, Panel, Settings};
use crate::kit::plot;
use crate::theme::Role;

/// Option that hides the answer and shows the guess.
pub(crate) const GUESS: (&str, &str) = ("guess", "Your guess");
/// Option that compares them.
pub(crate) const BOTH: (&str, &str) = ("both", "Both");
/// Text in place of the guess's error while the answer is hidden.
pub(crate) const NOT_COMPARED: &str = "not compared";

/// Visibility of answer and guess.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reveal {
    Answer,
    Guess,
    Both,
}

impl Reveal {
    /// Returns the state of a choice.
    pub(crate) fn of(settings: &Settings, choice: &'static Choice) -> Self {
        match choice.options[settings.chosen(choice)] {
            option if option == GUESS => Self::Guess,
            option if option == BOTH => Self::Both,
            _ => Self::Answer,
        }
    }

    /// Returns whether the answer is visible.
    pub(crate) fn shows_answer(self) -> bool {
        self != Self::Guess
    }

    /// Returns whether the guess is visible.
    pub(crate) fn shows_guess(self) -> bool {
        self != Self::Answer
    }
}

/// Points of a guessed curve, whose heights are base-10 logarithms.
pub(crate) struct Curve<const N: usize> {
    /// Panel of the curve.
    pub(crate) panel: &'static str,
    /// Permanent names of the points.
    pub(crate) ids: [&'static str; N],
    /// Positions along the horizontal axis, in the panel's world.
    pub(crate) at: [f64; N],
    /// Range of guesses, decades.
    pub(crate) range: [f64; 2],
    /// Label of the point at a position.
    pub(crate) label: fn(f64) -> String,
    /// A guess as text.
    pub(crate) told: fn(f64) -> String,
}

/// A guessed curve.
pub(crate) struct GuessedCurve<const N: usize> {
    curve: &'static Curve<N>,
    decades: [f64; N],
}

impl<const N: usize> GuessedCurve<N> {
    /// Creates a constant guess.
    pub(crate) fn new(curve: &'static Curve<N>, decade: f64) -> Self {
        Self {
            curve,
            decades: [decade; N],
        }
    }

    /// Returns the points in the panel's world.
    pub(crate) fn places(&self) -> [(f64, f64); N] {
        std::array::from_fn(|index| (self.curve.at[index], self.decades[index]))
    }

    /// Returns the maximum ratio between guess and truth, in either direction.
    ///
    /// * `truth`: base-10 logarithm of the true value at each point
    pub(crate) fn worst_factor(&self, truth: [f64; N]) -> f64 {
        let errors =
            (self.decades.into_iter().zip(truth)).map(|(guess, truth)| (guess - truth).abs());
        libm::pow(10.0, errors.fold(0.0, f64::max))
    }

    pub(crate) fn handles(&self) -> Vec<Handle> {
        let Curve {
            panel,
            range,
            label,
            told,
            ..
        } = self.curve;
        let handle = |((at, decade), id): ((f64, f64), &'static str)| {
            Handle::new(id, panel, label(at), (at, decade), [[at; 2], *range])
                .told(told(libm::pow(10.0, decade)))
                .step([0.0, 0.05], 2)
        };
        self.places()
            .into_iter()
            .zip(self.curve.ids)
            .map(handle)
            .collect()
    }

    /// Handles a drag or, at the nearest point, a click. Returns whether it was one.
    pub(crate) fn update(&mut self, event: &Event) -> bool {
        let handles = self.handles();
        let index = match event {
            Event::HandleMoved { id, .. } => handles.iter().position(|handle| handle.id == *id),
            Event::Clicked { panel, x, .. } if *panel == self.curve.panel => {
                let away = |index: &usize| (self.curve.at[*index] - x).abs();
                (0..N).min_by(|a, b| away(a).total_cmp(&away(b)))
            }
            _ => None,
        };
        let Some(index) = index else { return false };
        if let Some((_, decade)) = handles[index].moved_by(event) {
            self.decades[index] = decade;
        }
        true
    }

    /// Draws the guess with a grip at each point.
    pub(crate) fn draw(&self, canvas: &mut Canvas, panel: &Panel) {
        plot::draw_curve(canvas, panel, self.places(), Stroke::solid(Role::Grip, 2.0));
        for place in self.places() {
            canvas.grip(panel.canvas_from_world(place), Role::Grip);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::{Knob, knobs};

    const CURVE: Curve<2> = Curve {
        panel: "plot",
        ids: ["low", "high"],
        at: [0.0, 10.0],
        range: [-1.0, 3.0],
        label: |at| format!("Guess at {at}"),
        told: |value| format!("{value}"),
    };

    #[test]
    fn options_hide_and_compare() {
        const SHOW: Choice = Choice::new("show", "Show", &[("curve", "Curve"), GUESS, BOTH]);
        const KNOBS: &[Knob] = knobs![SHOW];
        let mut settings = Settings::new(KNOBS);
        let mut seen = |option| {
            settings.update(&Event::set(&SHOW, option)).unwrap();
            let reveal = Reveal::of(&settings, &SHOW);
            (reveal.shows_answer(), reveal.shows_guess())
        };
        assert_eq!(
            ["curve", "guess", "both"].map(&mut seen),
            [(true, false), (false, true), (true, true)]
        );
    }

    #[test]
    fn points_move_up_and_down_only() {
        let mut guess = GuessedCurve::new(&CURVE, 1.0);
        assert!(guess.update(&Event::moved("high", 4.0, 2.5)));
        assert!(guess.update(&Event::clicked("plot", 2.0, 7.0)));
        assert!(!guess.update(&Event::clicked("photograph", 2.0, 0.0)));
        assert!(!guess.update(&Event::moved("other", 2.0, 0.0)));
        assert_eq!(guess.places(), [(0.0, 3.0), (10.0, 2.5)]);
        assert_eq!(guess.handles()[0].value_text, "1000");
        // 1000 is ten times 100, and the other guess is a third of a decade off.
        let factor = guess.worst_factor([2.0, 2.8]);
        assert!((factor - 10.0).abs() < 1e-9, "{factor}");
    }
}
