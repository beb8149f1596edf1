//! Progress through the five steps, and the viewpoint.

use crate::contract::{
    Asking, Button, ButtonRole, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob,
    Model, Problem, Settings, Slider, Space, knobs,
};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::question::{Computation, carry_out};
use crate::kit::reconstruction::{Answer, Question, Source};

const STEP: Choice = Choice::new(
    "step",
    "Step",
    &[
        ("photographs", "1 Photograph"),
        ("points", "2 Find points"),
        ("matches", "3 Match"),
        ("rays", "4 Cross rays"),
        ("cloud", "5 Cloud"),
    ],
)
.at(NUM_STEPS - 1);
/// Number of steps played, the last one possibly only partly.
const TIME: Slider = Slider::new("time", "Steps told")
    .range(0.0, NUM_STEPS as f64, 0.01)
    .at(NUM_STEPS as f64)
    .digits(2)
    .hidden();
const PLAY: Button = Button::new("play", "Play", ButtonRole::Run);
const KNOBS: &[Knob] = knobs![STEP, TIME];

pub(super) const NUM_STEPS: usize = 5;
const STEPS_PER_SECOND: f64 = 0.5;

/// The model of `cover`.
pub(crate) struct Cover {
    settings: Settings,
    pub(super) orbit: Orbit,
    pub(super) asked: Computation<Question>,
    is_playing: bool,
}

impl Cover {
    pub(super) fn answer(&self) -> Option<&Answer> {
        self.asked.answer()
    }

    /// Returns the step shown, from 0.
    pub(super) fn step(&self) -> usize {
        self.settings.chosen(&STEP)
    }

    /// Returns the fraction of a step that has been played, 0 to 1.
    pub(super) fn share(&self, step: usize) -> f64 {
        (self.settings.number(&TIME) - step as f64).clamp(0.0, 1.0)
    }

    /// Sets the number of steps played, the last one possibly only partly.
    fn tell(&mut self, steps: f64) {
        self.settings.slide(&TIME, steps);
        let told = self.settings.number(&TIME).ceil().max(1.0) as usize;
        self.settings.choose(&STEP, told - 1);
        self.is_playing &= steps < NUM_STEPS as f64;
    }
}

impl Declared for Cover {
    const NAME: &'static str = "cover";
    const TITLE: &'static str = "From two photographs to a cloud";
    const HELP: &'static str = "Play the five steps, or jump to one. Drag in the picture, or use the arrow keys on \
        its handle, to look from elsewhere; with Shift, or the small cross, the scene moves; with Ctrl and \
        the wheel, or + and −, it becomes larger. On a touchscreen drag the handle, or use two fingers.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-40.0, 22.0),
            asked: Computation::of(Question {
                source: Source::Step,
                focal: 1.25,
                max_ratio: 0.8,
                max_error_px: 1.5,
                knock_deg: 0.0,
            }),
            is_playing: false,
        }
    }
}

impl Model for Cover {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        controls.push(PLAY.control(self.answer().is_some(), self.is_playing));
        controls.extend(self.orbit.controls());
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        self.orbit.handles().into()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
            return Ok(());
        }
        match self.settings.update(event)? {
            Some(id) if id == STEP.id => {
                self.is_playing = false;
                self.tell(self.step() as f64 + 1.0);
            }
            Some(id) if id == TIME.id => self.tell(self.settings.number(&TIME)),
            _ => {}
        }
        match event {
            Event::Press { id } if id == PLAY.id && self.answer().is_some() => {
                self.is_playing = !self.is_playing;
                if self.is_playing && self.settings.number(&TIME) >= NUM_STEPS as f64 {
                    self.tell(0.0);
                }
            }
            Event::Tick { dt_s } if self.is_playing => {
                self.tell(self.settings.number(&TIME) + dt_s * STEPS_PER_SECOND);
            }
            _ => {}
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.is_playing
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<Cover>] = &[
    Challenge {
        id: "as-taken",
        goal: "Look at the cloud exactly as camera 1 did.",
        hint: "Level with the camera, and straight ahead.",
        why: "From there the cloud looks like photograph 1, and its depth is gone: every point lies on the ray of \
              its pixel.",
        check: |model| {
            let (turn, rise) = (model.orbit.turn_deg(), model.orbit.rise_deg());
            model.step() == NUM_STEPS - 1 && turn.abs() <= 6.0 && rise.abs() <= 6.0
        },
        solution: || vec![Event::moved(SPACE.orbit, 0.0, 0.0)],
    },
    Challenge {
        id: "plan",
        goal: "Find out which is farther from the cameras, the vase or the mug, without either photograph.",
        hint: "Look straight down on the cloud.",
        why: "From above the cloud is a map: two photographs taken side by side hold distances that neither of \
              them shows.",
        check: |model| model.step() == NUM_STEPS - 1 && model.orbit.rise_deg() >= 70.0,
        solution: || vec![Event::moved(SPACE.orbit, 0.0, 80.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    fn answered() -> Cover {
        let mut model = Cover::new();
        let request = model.job().unwrap().request();
        let result = (Cover::COMPUTE)(&request, &mut |_| ControlFlow::Continue(()));
        model.job_done(result);
        model
    }

    #[test]
    fn the_story_is_told_from_the_beginning_to_the_end_and_stops_there() {
        let mut model = answered();
        assert_eq!(model.step(), NUM_STEPS - 1);
        model.update(&Event::press(PLAY.id)).unwrap();
        assert_eq!((model.step(), model.share(0)), (0, 0.0));
        let mut seen = vec![model.step()];
        let mut ticks = 0;
        while model.is_running() {
            model.update(&Event::Tick { dt_s: 0.05 }).unwrap();
            seen.push(model.step());
            ticks += 1;
            assert!(ticks < 1000, "it never ends");
        }
        seen.dedup();
        assert_eq!(seen, [0, 1, 2, 3, 4]);
        assert_eq!(model.share(4), 1.0);
    }

    #[test]
    fn a_jump_shows_a_step_told_and_a_drag_leaves_the_story_running() {
        let mut model = answered();
        model.update(&Event::set(&STEP, "matches")).unwrap();
        assert_eq!((model.share(2), model.share(3)), (1.0, 0.0));
        model.update(&Event::press(PLAY.id)).unwrap();
        model
            .update(&Event::moved(SPACE.orbit, 10.0, 10.0))
            .unwrap();
        assert!(model.is_running());
        model.update(&Event::set(&STEP, "points")).unwrap();
        assert!(!model.is_running());
        model.update(&Event::set(&TIME, 3.4)).unwrap();
        assert_eq!(model.step(), 3);
    }

    #[test]
    fn nothing_plays_before_there_is_something_to_tell() {
        let mut model = Cover::new();
        model.update(&Event::press(PLAY.id)).unwrap();
        assert!(!model.is_running());
    }

    #[test]
    fn the_cloud_is_the_scene_in_units_of_the_baseline() {
        let model = answered();
        let motion = model.answer().unwrap().motion.as_ref().unwrap();
        assert!(motion.points.len() > 500, "{}", motion.points.len());
        let mut depths: Vec<f64> = motion.points.iter().map(|point| point.place.z).collect();
        depths.sort_by(f64::total_cmp);
        // The objects are 1.1 to 2.3 m away, and the baseline is 0.34 m.
        let middle = depths[depths.len() / 2];
        assert!((3.0..6.6).contains(&middle), "{middle}");
    }
}
