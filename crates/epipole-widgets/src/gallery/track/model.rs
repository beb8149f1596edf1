//! Frames of a video, points tracked through them, and the current frame.

use super::question::{Answer, MAX_STRIDE, Question, Sighting};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Toggle, knobs,
};
use crate::kit::question::{Computation, carry_out};
use crate::kit::timeline::Timeline;

const STRIDE: Slider = Slider::new("stride", "Every nth frame")
    .range(1.0, MAX_STRIDE as f64, 1.0)
    .at(1.0);
const LEVELS: Slider = Slider::new("levels", "Pyramid levels")
    .range(1.0, 4.0, 1.0)
    .at(3.0);
const WINDOW: Slider = Slider::new("window", "Window")
    .range(5.0, 21.0, 2.0)
    .at(11.0)
    .unit("px");
const CHECK: Toggle = Toggle::new("check", "Follow back");
const KNOBS: &[Knob] = knobs![STRIDE, LEVELS, WINDOW, CHECK];

/// Error above which a point is wrong, pixels.
pub(super) const WRONG_PX: f64 = 2.0;

/// The model of `track`.
pub(crate) struct TrackFigure {
    settings: Settings,
    timeline: Timeline,
    pub(super) asked: Computation<Question>,
}

/// Statistics of the points in one frame.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Tally {
    pub(super) num_followed: usize,
    pub(super) num_lost: usize,
    pub(super) num_wrong: usize,
    /// Median distance of the visible points from their true positions, pixels.
    pub(super) median_px: Option<f64>,
}

impl Sighting {
    /// Returns whether the point is off its object, or its object is not visible.
    pub(super) fn is_wrong(&self) -> bool {
        self.error_px.is_none_or(|error| error > WRONG_PX)
    }
}

impl TrackFigure {
    /// Returns the result for the current settings; `None` while it is computed.
    pub(super) fn answer(&self) -> Option<&Answer> {
        let is_waiting = self.asked.is_waiting();
        self.asked.answer().filter(|_| !is_waiting)
    }

    fn question(&self) -> Question {
        Question {
            stride: self.settings.count(&STRIDE),
            num_levels: self.settings.count(&LEVELS),
            half: self.settings.count(&WINDOW) / 2,
            is_checked: self.settings.flag(&CHECK),
        }
    }

    /// Returns the index of the last frame used.
    pub(super) fn last(&self) -> usize {
        self.question().num_frames() - 1
    }

    /// Returns the position of the handle on the track, frames.
    pub(super) fn place(&self) -> f64 {
        self.timeline.place(self.last())
    }

    /// Returns the index of the current frame, among those used.
    pub(super) fn frame(&self) -> usize {
        self.timeline.frame(self.last())
    }

    /// Counts the points of a frame.
    pub(super) fn tally(&self, answer: &Answer, frame: usize) -> Tally {
        let mut tally = Tally::default();
        let mut errors = Vec::new();
        for track in &answer.tracks {
            match track.get(frame) {
                None => tally.num_lost += 1,
                Some(sighting) => {
                    tally.num_followed += 1;
                    tally.num_wrong += usize::from(sighting.is_wrong());
                    errors.extend(sighting.error_px);
                }
            }
        }
        errors.sort_by(f64::total_cmp);
        tally.median_px = errors.get(errors.len() / 2).copied();
        tally
    }
}

impl Declared for TrackFigure {
    const NAME: &'static str = "track";
    const TITLE: &'static str = "Following corners through a video";
    const HELP: &'static str = "Press Run, or drag the handle below the plot from frame to frame. Choose how \
        corners are followed, and see which of them stay where they belong.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            timeline: Timeline::of_frames(),
            asked: Computation::default(),
        };
        model.asked.ask(model.question());
        model
    }
}

impl Model for TrackFigure {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        let can_run = self.answer().is_some();
        controls.extend(self.timeline.controls(can_run, self.last()));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.timeline.handle(self.last())]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
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

const CHALLENGES: &[Challenge<TrackFigure>] = &[
    Challenge {
        id: "lost",
        goal: "Skip frames until more than half of the points at the end are wrong.",
        hint: "A pyramid makes large steps small. What if there is none?",
        why: "Lucas and Kanade step down a slope, and the slope must lead to the right place. From too far \
              away it leads elsewhere, and the window settles on something similar.",
        check: |model| {
            let tally = model
                .answer()
                .map(|answer| model.tally(answer, model.last()));
            tally.is_some_and(|tally| 2 * tally.num_wrong > tally.num_followed)
        },
        solution: || vec![Event::set(&STRIDE, 6.0), Event::set(&LEVELS, 1.0)],
    },
    Challenge {
        id: "clean",
        goal: "Keep at least 30 points to the end, with fewer than one in seven wrong.",
        hint: "A small window lies on one thing. And a point that went astray rarely finds its way back.",
        why: "Following back drops points that jumped, and a small window sees fewer outlines. What slides along \
              an outline, there and back, no check finds.",
        check: |model| {
            let tally = model
                .answer()
                .map(|answer| model.tally(answer, model.last()));
            tally.is_some_and(|tally| {
                tally.num_followed >= 30 && 7 * tally.num_wrong < tally.num_followed
            })
        },
        solution: || vec![Event::set(&CHECK, true), Event::set(&WINDOW, 5.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    fn at_end(events: &[Event]) -> Tally {
        let model: TrackFigure = settled(events);
        model.tally(model.answer().unwrap(), model.last())
    }

    #[test]
    fn most_points_are_followed_around() {
        let tally = at_end(&[]);
        assert!(
            tally.num_followed + tally.num_lost == 60 && tally.num_followed > 40,
            "{tally:?}"
        );
        assert!(tally.median_px.unwrap() < 1.0, "{tally:?}");
    }

    #[test]
    fn following_back_leaves_fewer_wrong_points() {
        let (without, with) = (at_end(&[]), at_end(&[Event::set(&CHECK, true)]));
        let errors = [&with, &without].map(|tally| tally.median_px.unwrap());
        assert!(
            with.num_wrong < without.num_wrong && errors[0] < errors[1],
            "{without:?} {with:?}"
        );
    }
}
