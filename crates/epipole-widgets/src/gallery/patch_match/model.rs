//! The reader's picks, and the score.

use super::question::{NUM_OPTIONS, NUM_ROUNDS, Question, Round};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Knob, Model, Problem, Settings,
};
use crate::kit::question::{Computation, carry_out};

/// Panel ids of the options of each round.
pub(super) const OPTIONS: [[&str; NUM_OPTIONS]; NUM_ROUNDS] = [
    ["1a", "1b", "1c", "1d"],
    ["2a", "2b", "2c", "2d"],
    ["3a", "3b", "3c", "3d"],
    ["4a", "4b", "4c", "4d"],
    ["5a", "5b", "5c", "5d"],
];
const LETTERS: &[(&str, &str)] = &[
    ("none", "–"),
    ("a", "A"),
    ("b", "B"),
    ("c", "C"),
    ("d", "D"),
];
static PICKS: [Choice; NUM_ROUNDS] = [
    Choice::new("patch1", "Patch 1", LETTERS),
    Choice::new("patch2", "Patch 2", LETTERS),
    Choice::new("patch3", "Patch 3", LETTERS),
    Choice::new("patch4", "Patch 4", LETTERS),
    Choice::new("patch5", "Patch 5", LETTERS),
];
static KNOBS: [Knob; NUM_ROUNDS] = [
    Knob::Choice(&PICKS[0]),
    Knob::Choice(&PICKS[1]),
    Knob::Choice(&PICKS[2]),
    Knob::Choice(&PICKS[3]),
    Knob::Choice(&PICKS[4]),
];

/// The model of `patch-match`.
pub(crate) struct PatchMatch {
    settings: Settings,
    pub(super) asked: Computation<Question>,
}

impl PatchMatch {
    /// Returns the index of the option picked in a round.
    pub(super) fn picked(&self, round: usize) -> Option<usize> {
        self.settings.chosen(&PICKS[round]).checked_sub(1)
    }

    pub(super) fn num_picked(&self) -> usize {
        (0..NUM_ROUNDS)
            .filter(|round| self.picked(*round).is_some())
            .count()
    }

    pub(super) fn is_finished(&self) -> bool {
        self.num_picked() == NUM_ROUNDS
    }

    fn rounds(&self) -> &[Round] {
        self.asked.answer().map_or(&[], |answer| &answer.rounds)
    }

    /// Returns the number of rounds that the reader answered correctly.
    pub(super) fn score(&self) -> usize {
        let rounds = self.rounds().iter().enumerate();
        rounds
            .filter(|(k, round)| self.picked(*k) == Some(usize::from(round.right)))
            .count()
    }

    /// Returns the number of rounds in which the nearest descriptor is correct.
    pub(super) fn machine_score(&self) -> usize {
        let is_right = |round: &&Round| round.machine() == usize::from(round.right);
        self.rounds().iter().filter(is_right).count()
    }
}

impl Declared for PatchMatch {
    const NAME: &'static str = "patch-match";
    const TITLE: &'static str = "Match them by eye";
    const HELP: &'static str = "For each patch of photograph 1, click the patch of photograph 2 that shows the \
        same place, or choose its letter. When all five are chosen, you see what the descriptors say.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(&KNOBS),
            asked: Computation::of(Question),
        }
    }
}

impl Model for PatchMatch {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        if let Event::Clicked { panel, .. } = event {
            for (round, names) in OPTIONS.iter().enumerate() {
                if let Some(option) = names.iter().position(|name| name == panel) {
                    self.settings.choose(&PICKS[round], option + 1);
                }
            }
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

/// Returns the events that pick these letters in all rounds.
fn picks(letters: [&'static str; NUM_ROUNDS]) -> Vec<Event> {
    let pairs = PICKS.iter().zip(letters);
    pairs
        .map(|(pick, letter)| Event::set(pick, letter))
        .collect()
}

const CHALLENGES: &[Challenge<PatchMatch>] = &[
    Challenge {
        id: "four",
        goal: "Match at least four of the five.",
        hint: "Look at the surroundings of the middle, too.",
        why: "You compared shapes and ignored light, direction and size. A descriptor has to do the same.",
        check: |model| model.score() >= 4,
        solution: || picks(RIGHT),
    },
    Challenge {
        id: "better",
        goal: "Beat the nearest descriptor.",
        hint: "One patch lies on the rim of a thing, where half of it shows what is behind.",
        why: "The nearest descriptor is only the most similar one, and that is not always the same \
              place: matches need a test.",
        check: |model| model.is_finished() && model.score() > model.machine_score(),
        solution: || picks(RIGHT),
    },
];

/// Correct letters, checked by a test.
const RIGHT: [&str; NUM_ROUNDS] = ["c", "c", "b", "c", "a"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    #[test]
    fn the_nearest_descriptor_is_wrong_twice() {
        let mut model: PatchMatch = settled(&[]);
        let rounds = model.rounds().to_vec();
        let letters: Vec<_> = rounds
            .iter()
            .map(|one| LETTERS[usize::from(one.right) + 1].0)
            .collect();
        assert_eq!(letters, RIGHT);
        assert_eq!(model.machine_score(), 3);
        for round in &rounds {
            let places: Vec<_> = round.options.iter().map(|spot| spot.place).collect();
            assert!((1..4).all(|k| !places[..k].contains(&places[k])));
        }
        assert_eq!((model.score(), model.is_finished()), (0, false));
        for event in picks(RIGHT) {
            model.update(&event).unwrap();
        }
        assert_eq!((model.score(), model.is_finished()), (5, true));
        model.update(&Event::clicked("2d", 0.0, 0.0)).unwrap();
        assert_eq!(model.picked(1), Some(3));
    }
}
