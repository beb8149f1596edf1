//! A window of the left photograph, the costs along its row, and a candidate.

use super::search::{Curve, LARGEST_HALF, REACH, Refinement};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, format_number, knobs,
};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::rectified::{PairQuestion, SIZE};

const WINDOW: Slider = Slider::new("window", "Window")
    .range(5.0, (2 * LARGEST_HALF + 1) as f64, 2.0)
    .at(11.0)
    .unit("px");
const REFINEMENT: Choice = Choice::new(
    "refinement",
    "Refinement",
    &[("lines", "Two lines"), ("parabola", "Parabola")],
);
const KNOBS: &[Knob] = knobs![WINDOW, REFINEMENT];

/// Initially on the mug. The largest window stays within the photograph.
const PLACE: Probe = Probe::new("place", "left", "Window")
    .within([room(SIZE.0), room(SIZE.1)])
    .at(228.0, 165.0);
const fn room(size: u32) -> [f64; 2] {
    [LARGEST_HALF as f64, (size - 1 - LARGEST_HALF) as f64]
}
/// The candidate in the right photograph, whose panel has the disparity along its rows.
const CANDIDATE: Probe = Probe::new("candidate", "right", "Candidate")
    .told(|(disparity_px, _)| format!("{} px to the left", format_number(disparity_px, 0)))
    .at(10.0, 0.0);

/// Error above which a minimum is wrong, pixels.
const WRONG_PX: f64 = 2.0;
/// Height of a curve above the level of noise, gray levels.
const DISTINCT: f64 = 30.0;

/// The model of `window-search`.
pub(crate) struct WindowSearch {
    settings: Settings,
    pub(super) place: Probe,
    candidate: Probe,
    pub(super) asked: Computation<PairQuestion>,
    curve: Option<Curve>,
}

impl WindowSearch {
    /// Returns the costs, once the photographs are available.
    pub(super) fn curve(&self) -> Option<&Curve> {
        self.curve.as_ref()
    }

    /// Returns half of the window's side without its center, pixels.
    pub(super) fn half_px(&self) -> u32 {
        self.settings.count(&WINDOW) as u32 / 2
    }

    pub(super) fn refinement(&self) -> Refinement {
        match self.settings.chosen(&REFINEMENT) {
            0 => Refinement::TwoLines,
            _ => Refinement::Parabola,
        }
    }

    /// Returns the candidate's handle, limited to windows within the right photograph.
    fn reachable(&self) -> Probe {
        let most = (self.place.pixel().0 - self.half_px()).min(REACH as u32);
        self.candidate.within([[0.0, most.into()], [0.0; 2]])
    }

    /// Returns the disparity of the candidate, pixels.
    pub(super) fn candidate_px(&self) -> usize {
        self.reachable().place().0 as usize
    }

    /// Returns the disparity at the lowest point of the chosen curve, pixels.
    pub(super) fn found_px(&self) -> Option<f64> {
        Some(self.curve()?.minimum(self.refinement()))
    }

    /// Returns the true disparity at the center of the window, pixels.
    pub(super) fn truth_px(&self) -> Option<f64> {
        let (u, v) = self.place.pixel();
        self.asked.answer()?.truth.get(u, v).map(f64::from)
    }

    /// Returns whether the center of the window is hidden from the right camera.
    pub(super) fn is_hidden(&self) -> Option<bool> {
        let (u, v) = self.place.pixel();
        Some(self.asked.answer()?.is_hidden(u, v))
    }

    /// Returns whether both cameras see the window's center, and a candidate reaches its match.
    fn is_within_reach(&self) -> bool {
        let last = self.curve().map_or(0, |curve| curve.costs().len() - 1);
        let is_reached = |truth_px: f64| truth_px <= last as f64;
        self.is_hidden() == Some(false) && self.truth_px().is_some_and(is_reached)
    }

    /// Returns computed minus true disparity, pixels.
    pub(super) fn error_px(&self) -> Option<f64> {
        Some(self.found_px()? - self.truth_px()?)
    }

    /// Returns the disparity of the second-lowest minimum, and its cost relative to the lowest.
    pub(super) fn rival(&self) -> Option<(usize, f64)> {
        let curve = self.curve()?;
        let rival = curve.runner_up()?;
        let ratio = curve.costs()[rival] / curve.costs()[curve.winner()].max(1e-9);
        Some((rival, ratio))
    }

    fn search(&mut self) {
        let (place, half_px) = (self.place.pixel(), self.half_px());
        let pair = self.asked.answer();
        self.curve = pair.map(|pair| Curve::new(&pair.pictures, place, half_px));
    }
}

impl Declared for WindowSearch {
    const NAME: &'static str = "window-search";
    const TITLE: &'static str = "Along the row";
    const HELP: &'static str = "Drag the window over the left photograph, or move it with the arrow keys. Then \
        drag the candidate along its row in the right photograph, and watch its cost.";
    const COMPUTE: Compute = carry_out::<PairQuestion>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            place: PLACE,
            candidate: CANDIDATE,
            asked: Computation::of(PairQuestion),
            curve: None,
        }
    }
}

impl Model for WindowSearch {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.place.handle(), self.reachable().handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let mut candidate = self.reachable();
        if candidate.update(event) {
            self.candidate = candidate;
        } else if self.place.update(event) || self.settings.update(event)?.is_some() {
            self.search();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        self.search();
    }
}

const CHALLENGES: &[Challenge<WindowSearch>] = &[
    Challenge {
        id: "wrong",
        goal: "Find a place that both cameras see, with a minimum that is more than 2 px wrong.",
        hint: "Where does a small window hold nothing to go by?",
        why: "The search always returns its lowest cost. On a blank surface noise decides, and at the rim of a \
              near thing the stronger texture does.",
        check: |model| {
            let is_wrong = |error_px: f64| error_px.abs() > WRONG_PX;
            model.is_within_reach() && model.error_px().is_some_and(is_wrong)
        },
        solution: || {
            vec![
                Event::set(&WINDOW, 5.0),
                Event::moved(PLACE.id(), 100.0, 64.0),
            ]
        },
    },
    Challenge {
        id: "rival",
        goal: "Find two minima that cost almost the same, within 30%, on a curve that rises above 30.",
        hint: "What repeats along a row? Try the border of the cloth with a small window.",
        why: "A pattern that repeats fits its neighbor about as well as itself, and a small window sees one \
              period only. This is what the uniqueness test is for.",
        check: |model| {
            let is_distinct = model
                .curve()
                .is_some_and(|curve| curve.highest() > DISTINCT);
            is_distinct && model.rival().is_some_and(|(_, ratio)| ratio < 1.3)
        },
        solution: || {
            vec![
                Event::set(&WINDOW, 5.0),
                Event::moved(PLACE.id(), 170.0, 214.0),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    fn at(window_px: f64, (u, v): (f64, f64)) -> WindowSearch {
        let moved = Event::moved(PLACE.id(), u, v);
        settled(&[Event::set(&WINDOW, window_px), moved])
    }

    #[test]
    fn the_mug_is_found_within_a_quarter_of_a_pixel() {
        let model: WindowSearch = settled(&[]);
        assert_eq!(model.is_hidden(), Some(false));
        assert!(
            model.error_px().unwrap().abs() < 0.25,
            "{:?}",
            model.error_px()
        );
        let (_, ratio) = model.rival().unwrap();
        assert!(ratio > 3.0, "{ratio}");
    }

    #[test]
    fn blank_walls_repeated_patterns_and_edges_have_their_curves() {
        let highest = |model: &WindowSearch| model.curve().unwrap().highest();
        let blank = at(5.0, (100.0, 64.0));
        assert!(highest(&blank) < 5.0);
        assert!(blank.error_px().unwrap().abs() > WRONG_PX);
        // The lower edge of the frame: high contrast, all of it perpendicular to the row.
        let edge = at(11.0, (100.0, 72.0));
        assert!(highest(&edge) < 10.0 && edge.error_px().unwrap().abs() < 0.5);
        let repeated = at(5.0, (170.0, 214.0));
        let (rival, ratio) = repeated.rival().unwrap();
        assert_eq!((rival, repeated.curve().unwrap().winner()), (22, 32));
        assert!(ratio < 1.1);
        // A window larger than one period distinguishes them.
        let (_, ratio) = at(15.0, (170.0, 214.0)).rival().unwrap();
        assert!(ratio > 4.0, "{ratio}");
    }

    #[test]
    fn two_lines_are_nearer_to_the_truth_than_a_parabola() {
        let mut sums = [0.0; 2];
        let mut model: WindowSearch = settled(&[]);
        for (u, v) in (64..300)
            .step_by(12)
            .flat_map(|u| (16..224).step_by(12).map(move |v| (u, v)))
        {
            model
                .update(&Event::moved(PLACE.id(), u.into(), v.into()))
                .unwrap();
            let (curve, truth) = (model.curve().unwrap(), model.truth_px().unwrap());
            if (curve.winner() as f64 - truth).abs() > 1.0 {
                continue;
            }
            let both = [Refinement::TwoLines, Refinement::Parabola];
            for (sum, refinement) in sums.iter_mut().zip(both) {
                *sum += (curve.minimum(refinement) - truth).abs();
            }
        }
        assert!(sums[0] < sums[1], "{sums:?}");
    }

    #[test]
    fn the_candidate_stays_within_the_right_photograph() {
        let mut model = at(21.0, (30.0, 100.0));
        model
            .update(&Event::moved(CANDIDATE.id(), 40.0, 7.0))
            .unwrap();
        assert_eq!(model.candidate_px(), 20);
        assert_eq!(model.curve().unwrap().costs().len(), 21);
        assert!(model.is_within_reach());
        model
            .update(&Event::moved(PLACE.id(), 10.0, 100.0))
            .unwrap();
        assert_eq!(
            (model.candidate_px(), model.curve().unwrap().winner()),
            (0, 0)
        );
        assert!(!model.is_within_reach());
    }
}
