//! Every feature's nearest neighbor, both tests, and the matches that they reject.

use super::question::{Answer, Candidate, Question};
use super::tally::{Rules, Tally};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Toggle, knobs,
};
use crate::kit::features::SIZE;
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};

pub(super) const RATIO: Slider = Slider::new("ratio", "Ratio test τ")
    .range(0.4, 1.0, 0.01)
    .at(0.8)
    .digits(2);
const MUTUAL: Toggle = Toggle::new("mutual", "Mutual check");
const KNOBS: &[Knob] = knobs![RATIO, MUTUAL];
/// Margin below τ within which a match would be rejected next.
const BRINK: f32 = 0.05;
/// Initially on the fringe of the cloth.
const PROBE: Probe = Probe::new("probe", "first", "Probe in photograph 1")
    .over(SIZE)
    .step(4.0)
    .at(217.0, 324.0);

/// The model of `ratio-test`.
pub(crate) struct RatioTest {
    settings: Settings,
    pub(super) asked: Computation<Question>,
    pub(super) probe: Probe,
    /// Precision and recall, from the smallest τ to the largest; without the mutual check, then
    /// with it.
    pub(super) curves: [Vec<Tally>; 2],
}

impl RatioTest {
    pub(super) fn rules(&self) -> Rules {
        Rules {
            max_ratio: self.settings.number(&RATIO) as f32,
            is_mutual: self.settings.flag(&MUTUAL),
        }
    }

    /// Returns the counts of accepted matches, once there are matches.
    pub(super) fn tally(&self) -> Option<Tally> {
        Some(Tally::of(self.asked.answer()?, self.rules()))
    }

    /// Returns whether a slightly smaller τ would reject the match.
    pub(super) fn is_on_the_brink(&self, candidate: &Candidate) -> bool {
        candidate.ratio >= self.rules().max_ratio - BRINK
    }

    /// Returns the feature of photograph 1 nearest to the probe, and its match.
    pub(super) fn probed(&self) -> Option<(usize, &Candidate)> {
        let answer = self.asked.answer()?;
        let (u, v) = self.probe.place();
        let distance = |index: &usize| {
            let [x, y] = answer.spots[0][*index].place;
            libm::hypot(x - u, y - v)
        };
        let nearest =
            (0..answer.candidates.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some((nearest, &answer.candidates[nearest]))
    }
}

/// Returns the counts of accepted matches for every τ of the slider.
fn curve(answer: &Answer, is_mutual: bool) -> Vec<Tally> {
    let num_steps = ((RATIO.max - RATIO.min) / RATIO.step).round() as usize;
    let ratios = (0..=num_steps).map(|k| RATIO.snap(RATIO.min + RATIO.step * k as f64) as f32);
    let rules = ratios.map(|max_ratio| Rules {
        max_ratio,
        is_mutual,
    });
    rules.map(|rules| Tally::of(answer, rules)).collect()
}

impl Declared for RatioTest {
    const NAME: &'static str = "ratio-test";
    const TITLE: &'static str = "Which matches to believe";
    const HELP: &'static str = "Move τ and watch wrong matches, dashed, go before right ones, solid. \
        Click a feature in photograph 1, or drag the probe there, to see the two patches of photograph 2 \
        that look most like it.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            asked: Computation::of(Question),
            probe: PROBE,
            curves: Default::default(),
        }
    }
}

impl Model for RatioTest {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.probe.update(event);
        self.settings.update(event).map(|_| ())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        if let Some(answer) = self.asked.answer() {
            self.curves = [false, true].map(|is_mutual| curve(answer, is_mutual));
        }
    }
}

const CHALLENGES: &[Challenge<RatioTest>] = &[
    Challenge {
        id: "half-wrong",
        goal: "Keep so many matches that more than half of them are wrong.",
        hint: "Switch both tests off.",
        why: "Every feature has a nearest neighbor, even one whose true match is hidden or was not \
              detected. Without a test, each of those adds a wrong match.",
        check: |model| {
            let precision = model.tally().and_then(|tally| tally.precision());
            precision.is_some_and(|precision| precision < 0.5)
        },
        solution: || vec![Event::set(&RATIO, 1.0)],
    },
    Challenge {
        id: "nine-of-ten",
        goal: "Keep at least 100 matches, nine in ten of them right.",
        hint: "Be stricter than usual.",
        why: "Wrong matches have ratios near 1, so a stricter test removes many of them for each right one.",
        check: |model| {
            let tally = model.tally();
            tally.is_some_and(|tally| {
                tally.num_kept >= 100 && tally.precision().is_some_and(|share| share >= 0.9)
            })
        },
        solution: || vec![Event::set(&RATIO, 0.6)],
    },
    Challenge {
        id: "right-and-rejected",
        goal: "With τ = 0.8, find a feature whose nearest neighbor is right but rejected.",
        hint: "Look where one thing resembles the next.",
        why: "The test asks whether the runner-up is clearly worse, not whether the winner is right. \
              Where things repeat, even a right match is not clearly better.",
        check: |model| {
            let rules = model.rules();
            let is_one = |found: &Candidate| found.is_right && !rules.keep(found);
            rules.max_ratio == 0.8 && model.probed().is_some_and(|(_, found)| is_one(found))
        },
        solution: || vec![Event::moved("probe", 193.0, 319.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::features::Pair;
    use crate::kit::question::settled;
    use epipole::feature::{MatchOptions, match_descriptors};
    use std::ops::ControlFlow;

    #[test]
    fn the_core_keeps_the_same_matches() {
        let model: RatioTest = settled(&[]);
        let answer = model.asked.answer().unwrap();
        let pair = Pair::of_still_life(&mut |_| ControlFlow::Continue(())).unwrap();
        let [first, second] = pair.features.each_ref().map(|found| &found.descriptors);
        for (max_ratio, is_mutual) in [(0.8, true), (0.8, false), (0.62, true), (1.0, false)] {
            let options = MatchOptions::default()
                .with_max_ratio(Some(max_ratio))
                .with_mutual(is_mutual)
                .with_unique(false);
            let matches = match_descriptors(first, second, &options, &mut ()).unwrap();
            let tally = Tally::of(
                answer,
                Rules {
                    max_ratio,
                    is_mutual,
                },
            );
            assert_eq!(matches.len(), tally.num_kept);
            for found in matches {
                let ours = &answer.candidates[found.index1];
                assert_eq!(ours.nearest[0] as usize, found.index2);
                assert!((ours.ratio - found.ratio).abs() < 1e-6);
                assert!(
                    ours.nearest[1] != ours.nearest[0] && ours.distances[0] <= ours.distances[1]
                );
            }
        }
    }

    /// Compares with NumPy on the same photographs, features and truth: all distances between
    /// descriptors, sorted.
    #[test]
    fn the_curve_is_that_of_numpy() {
        let mut model: RatioTest = settled(&[]);
        assert_eq!(model.asked.answer().unwrap().num_findable, 334);
        for (ratio, is_mutual, num_kept, num_right, precision, recall) in [
            (0.5, false, 104, 98, 0.942308, 0.293413),
            (0.6, false, 117, 106, 0.905983, 0.317365),
            (0.7, false, 147, 125, 0.850340, 0.374251),
            (0.8, false, 191, 141, 0.738220, 0.422156),
            (0.9, false, 292, 158, 0.541096, 0.473054),
            (1.0, false, 600, 181, 0.301667, 0.541916),
            (0.6, true, 112, 101, 0.901786, 0.302395),
            (0.7, true, 139, 119, 0.856115, 0.356287),
            (0.8, true, 165, 132, 0.800000, 0.395210),
            (0.9, true, 199, 143, 0.718593, 0.428144),
            (1.0, true, 260, 155, 0.596154, 0.464072),
        ] {
            model.update(&Event::set(&RATIO, ratio)).unwrap();
            model.update(&Event::set(&MUTUAL, is_mutual)).unwrap();
            let tally = model.tally().unwrap();
            assert_eq!((tally.num_kept, tally.num_right), (num_kept, num_right));
            assert!((tally.precision().unwrap() - precision).abs() < 1e-6);
            assert!((tally.recall() - recall).abs() < 1e-6);
            // The current point is on the drawn curve.
            assert!(model.curves[usize::from(is_mutual)].contains(&tally));
        }
    }
}
