//! Photographs on an arc, the steps of their reconstruction, and the current step.

use super::question::{Answer, Question};
use super::steps::Step;
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Space, knobs,
};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::question::{Computation, carry_out};
use crate::kit::timeline::Timeline;

const APART: Slider = Slider::new("apart", "Angle between")
    .range(4.0, 24.0, 1.0)
    .at(10.0)
    .unit("°");
const PHOTOGRAPHS: Slider = Slider::new("photographs", "Photographs")
    .range(3.0, 9.0, 1.0)
    .at(8.0);
const NEEDED: Slider = Slider::new("needed", "Matches needed")
    .range(8.0, 60.0, 1.0)
    .at(15.0);
const KNOBS: &[Knob] = knobs![APART, PHOTOGRAPHS, NEEDED];
/// Registrations per second of a run.
const PACE: f64 = 1.2;

/// The model of `incremental-sfm`.
pub(crate) struct IncrementalSfm {
    settings: Settings,
    timeline: Timeline,
    pub(super) orbit: Orbit,
    pub(super) asked: Computation<Question>,
}

impl IncrementalSfm {
    /// Returns the result for the current settings; `None` while it is computed.
    pub(super) fn answer(&self) -> Option<&Answer> {
        let is_waiting = self.asked.is_waiting();
        self.asked.answer().filter(|_| !is_waiting)
    }

    pub(super) fn question(&self) -> Question {
        Question {
            num_photographs: self.settings.count(&PHOTOGRAPHS),
            apart_deg: self.settings.number(&APART),
            min_num_inliers: self.settings.count(&NEEDED),
        }
    }

    /// Returns the index of the last step.
    pub(super) fn last(&self) -> usize {
        let all = self.question().num_photographs - 2;
        self.answer().map_or(all, |answer| answer.steps.len() - 1)
    }

    /// Returns the position of the handle on the track, steps.
    pub(super) fn place(&self) -> f64 {
        self.timeline.place(self.last())
    }

    /// Returns the current step.
    pub(super) fn step(&self) -> Option<&Step> {
        self.answer()?.steps.get(self.timeline.frame(self.last()))
    }

    /// Returns the next photograph to register, if any.
    pub(super) fn next(&self) -> Option<usize> {
        let next = self.timeline.frame(self.last()) + 1;
        Some(self.answer()?.steps.get(next)?.newest)
    }

    /// Returns the photographs in order of registration; those never registered come last.
    pub(super) fn order(&self) -> Vec<usize> {
        let Some(answer) = self.answer() else {
            return Vec::new();
        };
        let first = answer.steps.first();
        let start = first.into_iter().flat_map(|step| {
            let registered = |image: &usize| step.cam_from_world[*image].is_some();
            (0..step.cam_from_world.len()).filter(registered)
        });
        let mut order: Vec<usize> = start.collect();
        order.extend(answer.steps.iter().skip(1).map(|step| step.newest));
        let rest = (0..answer.pictures.len()).filter(|image| !order.contains(image));
        let rest: Vec<usize> = rest.collect();
        order.extend(rest);
        order
    }
}

impl Declared for IncrementalSfm {
    const NAME: &'static str = "incremental-sfm";
    const TITLE: &'static str = "One photograph after the other";
    const HELP: &'static str = "Press Run, or drag the handle below the bars from step to step. Choose the angle \
        between neighbors, and see which photographs can be registered.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            timeline: Timeline::new("now", "Step", PACE),
            orbit: Orbit::new(-4.0, 38.0),
            asked: Computation::default(),
        };
        model.asked.ask(model.question());
        model
    }
}

impl Model for IncrementalSfm {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        let can_run = self.answer().is_some();
        controls.extend(self.timeline.controls(can_run, self.last()));
        controls.extend(self.orbit.controls());
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let [turn, center] = self.orbit.handles();
        vec![turn, center, self.timeline.handle(self.last())]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
            return Ok(());
        }
        let last = self.last();
        if !self.timeline.update(event, last) && self.settings.update(event)?.is_some() {
            self.timeline.stop();
            self.asked.ask(self.question());
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn is_running(&self) -> bool {
        self.timeline.is_running()
    }
}

const CHALLENGES: &[Challenge<IncrementalSfm>] = &[Challenge {
    id: "left-out",
    goal: "Space the photographs so that some cannot be registered.",
    hint: "What does a photograph need before PnP can place it?",
    why: "From too far aside, patches look different and few features match. A photograph that sees fewer \
              known points than it needs is left out.",
    check: |model| {
        let steps = model.answer().map(|answer| &answer.steps);
        let last = steps.and_then(|steps| steps.last());
        last.is_some_and(|step| step.num_registered() < step.cam_from_world.len())
    },
    solution: || vec![Event::set(&APART, 22.0)],
}];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settled;

    #[test]
    fn photographs_join_one_after_the_other() {
        let model: IncrementalSfm = settled(&[]);
        let steps = &model.answer().unwrap().steps;
        assert_eq!(steps.len(), 7);
        for (index, step) in steps.iter().enumerate() {
            assert_eq!(step.num_registered(), index + 2);
            assert!(step.cam_from_world[step.newest].is_some());
            let agreeing = step.sights.iter().filter(|(_, agrees)| *agrees).count();
            assert!(
                2 * agreeing > step.sights.len() && agreeing > 100,
                "{index}"
            );
        }
        assert!(
            steps
                .windows(2)
                .all(|pair| pair[1].num_points > pair[0].num_points)
        );
        let mut order = model.order();
        assert_eq!(order.last(), Some(&steps[6].newest));
        order.sort_unstable();
        assert_eq!(order, (0..8).collect::<Vec<_>>());
    }

    #[test]
    fn cameras_are_found_to_centimeters() {
        let model: IncrementalSfm = settled(&[]);
        let step = model.step().unwrap();
        assert!(
            step.off_m < 0.015 && step.error_px < 0.5,
            "{} {}",
            step.off_m,
            step.error_px
        );
        assert!(model.next().is_none() && model.describe().contains("No photograph is left"));
    }

    #[test]
    fn a_photograph_sees_more_as_its_neighbors_are_registered() {
        let model: IncrementalSfm = settled(&[Event::moved("now", 0.0, 0.0)]);
        let steps = &model.answer().unwrap().steps;
        let next = model.next().unwrap();
        assert!(model.step().unwrap().num_seen[next] > 100);
        let last = model.order()[7];
        let seen = steps.iter().map(|step| step.num_seen[last]);
        assert!(seen.is_sorted());
    }

    #[test]
    fn too_far_apart_some_are_left_out() {
        let model: IncrementalSfm = settled(&[Event::set(&APART, 24.0)]);
        let step = model.step().unwrap();
        assert!(step.num_registered() < 8 && model.describe().contains("left out"));
        assert_eq!(model.last(), step.num_registered() - 2);
    }
}
