//! The number of samples that RANSAC needs, N = log(1 − p) / log(1 − wˢ), for samples of several
//! sizes.

use super::guess::{CURVE, PLOT, START};
use crate::contract::{
    Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    format_number, knobs,
};
use crate::kit::guess::{BOTH, GUESS, GuessedCurve, Reveal};
use epipole::robust::num_trials_with_replacement;

/// Sample sizes: for a line, a homography, E, and F from seven or from eight matches.
pub(super) const SIZES: [usize; 5] = [2, 4, 5, 7, 8];

/// Minimum and maximum inlier ratio; then the default.
pub(super) const RATIOS: [f64; 2] = [0.1, 0.99];
const RATIO: f64 = 0.5;

const CONFIDENCE: Slider = Slider::new("p", "Confidence p")
    .range(0.5, 0.999, 0.001)
    .at(0.99)
    .digits(3);
const SHOW: Choice = Choice::new("show", "Show", &[("curves", "Curves"), GUESS, BOTH]);
const KNOBS: &[Knob] = knobs![SHOW, CONFIDENCE];

/// Sample size whose curve the reader guesses.
pub(super) const GUESSED: usize = 8;

/// The model of `ransac-budget`.
pub struct RansacBudget {
    settings: Settings,
    pub(super) inlier_ratio: f64,
    guess: GuessedCurve<5>,
}

impl RansacBudget {
    fn reveal(&self) -> Reveal {
        Reveal::of(&self.settings, &SHOW)
    }

    /// Returns whether the curves are shown, rather than only the guess.
    pub(super) fn shows_curves(&self) -> bool {
        self.reveal().shows_answer()
    }

    /// Returns the guess, if it is shown.
    pub(super) fn guess(&self) -> Option<&GuessedCurve<5>> {
        self.reveal().shows_guess().then_some(&self.guess)
    }

    /// Returns the maximum factor between guess and curve, if they are compared.
    pub(super) fn guess_factor(&self) -> Option<f64> {
        let trials = |w| self.trials(GUESSED, w).unwrap_or(u64::MAX);
        let truth = CURVE.at.map(|w| libm::log10(trials(w) as f64));
        let guess = self.guess().filter(|_| self.shows_curves())?;
        Some(guess.worst_factor(truth))
    }

    pub(super) fn confidence(&self) -> f64 {
        self.settings.number(&CONFIDENCE)
    }

    /// Returns the number of samples of this size needed at inlier ratio `w`.
    pub(super) fn trials(&self, size: usize, w: f64) -> Option<u64> {
        num_trials_with_replacement(w, size, self.confidence()).ok()
    }

    pub(super) fn now(&self, size: usize) -> u64 {
        self.trials(size, self.inlier_ratio).unwrap_or(u64::MAX)
    }

    fn handle(&self) -> Handle {
        let (place, ranges) = ((self.inlier_ratio, 0.0), [RATIOS, [0.0; 2]]);
        let percent = format_number(100.0 * self.inlier_ratio, 0);
        Handle::new("share", PLOT, "Inlier ratio w", place, ranges)
            .told(format!("{percent}% inliers"))
            .step([0.01, 0.0], 2)
    }
}

impl Declared for RansacBudget {
    const NAME: &'static str = "ransac-budget";
    const TITLE: &'static str = "How many samples?";
    const HELP: &'static str = "Drag the dashed line to an inlier ratio, or click where it should be, and \
        change the confidence. Or choose Your guess, drag its points, and compare.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            inlier_ratio: RATIO,
            guess: GuessedCurve::new(&CURVE, START),
        }
    }
}

impl Model for RansacBudget {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles = match self.shows_curves() {
            true => vec![self.handle()],
            false => Vec::new(),
        };
        handles.extend(self.guess().into_iter().flat_map(GuessedCurve::handles));
        handles
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        // With the curves shown, a click moves their dashed line.
        let is_click = matches!(event, Event::Clicked { .. });
        let is_guess = self.guess().is_some()
            && !(is_click && self.shows_curves())
            && self.guess.update(event);
        if !is_guess && let Some((ratio, _)) = self.handle().moved_by(event) {
            self.inlier_ratio = ratio;
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<RansacBudget>] = &[
    Challenge {
        id: "guess",
        goal: "Guess the curve of samples of 8. Compare: be off by less than a factor of 3 everywhere.",
        hint: "A sample of 8 is clean with probability w⁸. What is 0.3⁸?",
        why: "N grows like 1/w⁸: a third of the inliers costs 6561 times the samples.",
        check: |model| model.guess_factor().is_some_and(|factor| factor < 3.0),
        solution: || {
            let guesses = [
                ("guess30", 4.9),
                ("guess45", 3.4),
                ("guess60", 2.4),
                ("guess75", 1.6),
                ("guess90", 1.0),
            ];
            let moves = guesses.map(|(id, decade)| Event::moved(id, 0.0, decade));
            let mut events = vec![Event::set(&SHOW, "guess")];
            events.extend(moves);
            events.push(Event::set(&SHOW, "both"));
            events
        },
    },
    Challenge {
        id: "dear",
        goal: "Make samples of 8 a thousand times as expensive as samples of 2.",
        hint: "Where do the curves run apart?",
        why: "The ratio of the two is about 1/w⁶: with w near 0.3 that is more than a thousand.",
        check: |model| model.now(8) >= 1000 * model.now(2),
        solution: || vec![Event::moved("share", 0.25, 0.0)],
    },
    Challenge {
        id: "sure",
        goal: "At an inlier ratio of 50%, make fewer than 600 samples of 8 enough.",
        hint: "How sure do you have to be?",
        why: "From 90% to 99% confidence the number only doubles: being sure is cheap, being without \
              inliers is not.",
        check: |model| model.inlier_ratio == 0.5 && model.now(8) < 600,
        solution: || vec![Event::set(&CONFIDENCE, 0.9)],
    },
    Challenge {
        id: "cheap",
        goal: "With p = 0.99, find the lowest inlier ratio where 20 samples of 8 are enough.",
        hint: "One percent less, and 20 are not enough.",
        why: "At 83% inliers a sample of eight is still spoiled three times in four, and 20 of them are \
              enough all the same.",
        check: |model| {
            let less = model.trials(8, model.inlier_ratio - 0.01);
            model.confidence() == 0.99 && model.now(8) <= 20 && less.is_none_or(|less| less > 20)
        },
        solution: || vec![Event::moved("share", 0.83, 0.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_the_chapter() {
        let model = RansacBudget::new();
        assert_eq!(SIZES.map(|size| model.now(size)), [17, 72, 146, 588, 1177]);
    }
}
