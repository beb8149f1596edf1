//! Frames of a moving camera, settings for finding its path, and the current frame.

use super::question::{Answer, Frame, MAX_STRIDE, Question};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Space, Toggle, knobs,
};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::question::{Computation, carry_out};
use crate::kit::sequence;
use crate::kit::timeline::Timeline;

const STRIDE: Slider = Slider::new("stride", "Every nth frame")
    .range(1.0, MAX_STRIDE as f64, 1.0)
    .at(2.0);
const CORNERS: Slider = Slider::new("corners", "Corners")
    .range(30.0, 150.0, 10.0)
    .at(100.0);
const NOISE: Slider = Slider::new("noise", "Noise σ")
    .range(0.0, 12.0, 1.0)
    .at(4.0)
    .unit("levels");
const WINDOW: Slider = Slider::new("window", "Keyframes refined")
    .range(2.0, 8.0, 1.0)
    .at(2.0);
const REFINE: Toggle = Toggle::new("refine", "Refine everything");
const KNOBS: &[Knob] = knobs![STRIDE, CORNERS, NOISE, WINDOW, REFINE];

/// The model of `odometry`.
pub(crate) struct OdometryFigure {
    settings: Settings,
    timeline: Timeline,
    pub(super) orbit: Orbit,
    pub(super) asked: Computation<Question>,
}

impl OdometryFigure {
    /// Returns the result for the current settings; `None` while it is computed.
    pub(super) fn answer(&self) -> Option<&Answer> {
        let is_waiting = self.asked.is_waiting();
        self.asked.answer().filter(|_| !is_waiting)
    }

    pub(super) fn question(&self) -> Question {
        Question {
            stride: self.settings.count(&STRIDE),
            num_corners: self.settings.count(&CORNERS),
            noise: self.settings.number(&NOISE),
            window: self.settings.count(&WINDOW),
            is_refined: self.settings.flag(&REFINE),
        }
    }

    /// Returns the index of the last frame used.
    pub(super) fn last(&self) -> usize {
        self.question().used().count() - 1
    }

    /// Returns the position of the handle on the track, frames.
    pub(super) fn place(&self) -> f64 {
        self.timeline.place(self.last())
    }

    /// Returns the index of the current frame, among those used.
    pub(super) fn frame(&self) -> usize {
        self.timeline.frame(self.last())
    }

    /// Returns the distance of a frame's camera from its true position, meters.
    pub(super) fn error_m(&self, index: usize, frame: &Frame) -> Option<f64> {
        let number = self.question().used().nth(index)?;
        let truth = sequence::camera(number).center_in_world();
        Some((frame.center()? - truth).norm())
    }
}

impl Declared for OdometryFigure {
    const NAME: &'static str = "odometry";
    const TITLE: &'static str = "A path from nothing but corners";
    const HELP: &'static str = "Press Run, or drag the handle below the plot from frame to frame. Choose how \
        many corners there are and what is refined, and compare the path with the true one.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            timeline: Timeline::of_frames(),
            orbit: Orbit::new(-30.0, 32.0),
            asked: Computation::default(),
        };
        model.asked.ask(model.question());
        model
    }
}

impl Model for OdometryFigure {
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

const CHALLENGES: &[Challenge<OdometryFigure>] = &[
    Challenge {
        id: "better",
        goal: "Bring the path error below 1 mm without more corners.",
        hint: "Each new frame is placed by the points, and the points come from the frames before. What \
               refines both together?",
        why: "With eight keyframes, a point is held by many rays at once, and the errors of single frames \
              average out.",
        check: |model| {
            let is_fair = model.question().num_corners <= CORNERS.default as usize;
            let answer = model
                .answer()
                .filter(|answer| answer.num_placed() == answer.frames.len());
            is_fair && answer.is_some_and(|answer| answer.error_m < 0.001)
        },
        solution: || vec![Event::set(&WINDOW, 8.0)],
    },
    Challenge {
        id: "lost",
        goal: "Lose the camera: bring it about that some frames cannot be placed.",
        hint: "A frame needs points that were seen before. Take fewer, and go faster.",
        why: "With large steps and few corners, too few of the points that are known stay in view. There is \
              nothing to place the next frame by.",
        check: |model| {
            let answer = model.answer();
            answer.is_some_and(|answer| answer.num_placed() < answer.frames.len())
        },
        solution: || vec![Event::set(&CORNERS, 30.0), Event::set(&STRIDE, 3.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settled;

    #[test]
    fn the_path_is_found_to_millimeters() {
        let model: OdometryFigure = settled(&[]);
        let answer = model.answer().unwrap();
        assert_eq!(answer.num_placed(), 16);
        assert!(
            (0.0005..0.003).contains(&answer.error_m),
            "{}",
            answer.error_m
        );
        assert!(answer.points.len() > 100 && answer.frames[0].is_keyframe);
        // The first step of the path has length 1 as found, and 0.1 m in the world.
        assert!((0.05..0.2).contains(&answer.scale), "{}", answer.scale);
    }

    #[test]
    fn refining_keyframes_together_brings_the_path_nearer() {
        let error = |window: f64| {
            let model: OdometryFigure = settled(&[Event::set(&WINDOW, window)]);
            model.answer().unwrap().error_m
        };
        assert!(error(8.0) < 0.7 * error(2.0));
    }

    #[test]
    fn frames_that_are_lost_have_no_error() {
        let few = [Event::set(&CORNERS, 30.0), Event::set(&STRIDE, 3.0)];
        let model: OdometryFigure = settled(&few);
        let answer = model.answer().unwrap();
        let (index, lost) = (answer.frames.iter().enumerate())
            .find(|(_, frame)| frame.world_from_cam.is_none())
            .unwrap();
        assert_eq!(model.error_m(index, lost), None);
        assert!(
            model
                .describe()
                .contains(&format!("{} of 11", answer.num_placed()))
        );
    }
}
