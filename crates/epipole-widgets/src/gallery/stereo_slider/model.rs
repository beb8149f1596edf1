//! Position of the ball, and the rig of two cameras.

use super::rig::{Measured, Rig};
use crate::contract::{
    Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    knobs,
};
use crate::kit::guess::{BOTH, GUESS, Reveal};
use crate::kit::probe::{self, Probe};
use crate::kit::scenes::{PHOTO_SIZE, PHOTO_WIDTH};
use nalgebra::Point2;

const BASELINE: Slider = Slider::new("baseline", "Baseline")
    .range(0.0, 0.4, 0.01)
    .at(0.12)
    .digits(2)
    .unit("m");
const FOCAL: Slider = Slider::new("focal", "Focal length")
    .range(400.0, 1000.0, 20.0)
    .at(700.0)
    .unit("px");
const SHOW: Choice = Choice::new(
    "show",
    "Right photograph",
    &[("photo", "Shown"), GUESS, BOTH],
);
const KNOBS: &[Knob] = knobs![BASELINE, FOCAL, SHOW];

/// Range of the ball's distance from the line between the cameras, meters.
pub(super) const DEPTH_RANGE_M: [f64; 2] = [0.8, 10.0];
/// Range of the ball's position to the side of the left camera's axis, meters.
const SIDE_RANGE_M: [f64; 2] = [-0.8, 0.8];
/// Position along the baseline and away from it, meters. With the default rig the ball is initially
/// in columns 410 and 380.
const BALL: Probe = Probe::new("object", "top", "Ball")
    .on_plan([SIDE_RANGE_M, DEPTH_RANGE_M])
    .digits(3)
    .at(0.362, 2.8);
/// Guess of the ball's column in the right photograph; its row is that of the ball.
const COLUMN: Probe = Probe::new("guess", "right", "Your guess")
    .over(PHOTO_SIZE)
    .step(2.0)
    .at(240.0, 0.0);
/// Maximum error of a good guess, pixels.
const GOOD_GUESS_PX: f64 = 5.0;

/// The model of `stereo-slider`.
pub(crate) struct StereoSlider {
    settings: Settings,
    ball: Probe,
    guess: Probe,
}

impl StereoSlider {
    pub(super) fn rig(&self) -> Rig {
        let (x_m, z_m) = self.ball.place();
        Rig {
            baseline_m: self.settings.number(&BASELINE),
            focal_px: self.settings.number(&FOCAL),
            x_m,
            z_m,
        }
    }

    pub(super) fn reveal(&self) -> Reveal {
        Reveal::of(&self.settings, &SHOW)
    }

    /// Returns the measurement, unless the right photograph is hidden.
    pub(super) fn shown(&self) -> Option<Measured> {
        let measured = self.rig().measured();
        measured.filter(|_| self.reveal().shows_answer())
    }

    /// Returns the guess, in the row of the ball.
    fn column(&self) -> Probe {
        let row = self.rig().pixels().map_or(0.0, |[left, _]| left.y);
        let [columns, [top, bottom]] = probe::ranges(PHOTO_SIZE);
        self.guess.within([columns, [row.clamp(top, bottom); 2]])
    }

    /// Returns the guessed place in the right photograph, if it is shown.
    pub(super) fn guess(&self) -> Option<Point2<f64>> {
        self.reveal().shows_guess().then(|| self.column().point())
    }

    /// Returns the distance of the guess from the ball, pixels, if they are compared.
    pub(super) fn guess_off_px(&self) -> Option<f64> {
        let guess = self.guess().filter(|_| self.reveal().shows_answer())?;
        let [_, right] = self.rig().pixels().ok()?;
        Some((guess.x - right.x).abs())
    }

    /// Moves the ball sideways, at constant depth, to column `u_px` of a camera.
    fn move_to_column(&mut self, camera_x_m: f64, u_px: f64) {
        let center_px = (f64::from(PHOTO_WIDTH) - 1.0) / 2.0;
        let z_m = self.ball.place().1;
        let x_m = camera_x_m + (u_px - center_px) * z_m / self.settings.number(&FOCAL);
        self.ball.put(x_m, z_m);
    }

    /// Returns whether the sliders are unchanged and the measurement passes `check`.
    fn with_the_rig_as_it_is(&self, check: impl Fn(Measured) -> bool) -> bool {
        let rig = self.rig();
        rig.baseline_m == BASELINE.default
            && rig.focal_px == FOCAL.default
            && rig.measured().is_some_and(check)
    }
}

impl Declared for StereoSlider {
    const NAME: &'static str = "stereo-slider";
    const TITLE: &'static str = "Depth from disparity";
    const HELP: &'static str = "Drag the ball in the view from above, or move it with the arrow \
        keys; a click in a photograph moves it sideways. Set the baseline and the focal length \
        with the sliders. Or choose Your guess: the right photograph is hidden, and you mark where it \
        shows the ball.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            ball: BALL,
            guess: COLUMN,
        }
    }
}

impl Model for StereoSlider {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles = vec![self.ball.handle()];
        handles.extend(self.guess().map(|_| self.column().handle()));
        handles
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        let mut column = self.column();
        if self.guess().is_some() && column.update(event) {
            self.guess = column;
            return Ok(());
        }
        self.ball.update(event);
        if let Event::Clicked { panel, x, .. } = event {
            match panel.as_str() {
                "left" => self.move_to_column(0.0, *x),
                "right" => self.move_to_column(self.rig().baseline_m, *x),
                _ => {}
            }
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<StereoSlider>] = &[
    Challenge {
        id: "double",
        goal: "Double the disparity to 60 px by moving the ball alone.",
        hint: "Disparity and depth are inversely proportional.",
        why: "Z = f B / d: at half the distance the disparity is twice as large.",
        check: |model| {
            model.with_the_rig_as_it_is(|measured| (measured.disparity_px - 60.0).abs() <= 0.8)
        },
        solution: || vec![Event::moved("object", 0.2, 1.4)],
    },
    Challenge {
        id: "guess",
        goal: "Hide the right photograph, halve the ball's distance and mark where the ball is. Compare: be off by \
               at most 5 px.",
        hint: "From the column of the left photograph, go left by the disparity. It was 30 px.",
        why: "Half the distance is twice the disparity: 60 px left of the column in the left photograph.",
        check: |model| {
            let is_halved = model.with_the_rig_as_it_is(|measured| {
                (measured.depth_m - 0.5 * BALL.place().1).abs() <= 0.05
            });
            is_halved && model.guess_off_px().is_some_and(|px| px <= GOOD_GUESS_PX)
        },
        solution: || {
            vec![
                Event::set(&SHOW, GUESS.0),
                Event::moved("object", 0.362, 1.4),
                Event::moved(COLUMN.id(), 441.0, 0.0),
                Event::set(&SHOW, BOTH.0),
            ]
        },
    },
    Challenge {
        id: "one-meter",
        goal: "Put the ball where 1 px of error can add more than 1 m, sliders untouched.",
        hint: "The error grows with the square of the depth.",
        why: "Far away, one pixel spans a long piece of the ray: the error of the depth grows with its \
              square.",
        check: |model| {
            model.with_the_rig_as_it_is(|measured| {
                let far_m = measured.interval.far_m.unwrap_or(f64::INFINITY);
                far_m - measured.depth_m > 1.0
            })
        },
        solution: || vec![Event::moved("object", 0.3, 9.2)],
    },
    Challenge {
        id: "same-disparity",
        goal: "With the ball at 5 m and f = 700 px, find the baseline that gives 28 px.",
        hint: "B = d Z / f.",
        why: "The baseline scales every disparity, so a longer one buys depth far away.",
        check: |model| {
            let rig = model.rig();
            let measured = rig.measured();
            (4.9..=5.1).contains(&rig.z_m)
                && rig.focal_px == FOCAL.default
                && measured.is_some_and(|measured| (measured.disparity_px - 28.0).abs() <= 0.8)
        },
        solution: || vec![Event::moved("object", 0.3, 5.0), Event::set(&BASELINE, 0.2)],
    },
];

#[cfg(test)]
mod tests {
    use super::super::rig::Sight;
    use super::*;
    use crate::contract::Words;

    #[test]
    fn without_a_baseline_there_is_a_sentence_and_as_many_numbers() {
        let mut model = StereoSlider::new();
        let ids = |model: &StereoSlider| {
            let readouts = model.readouts().into_iter();
            readouts
                .map(|readout| (readout.id, readout.main))
                .collect::<Vec<_>>()
        };
        let before = ids(&model);
        model.update(&Event::set(&BASELINE, 0.0)).unwrap();
        assert!(model.rig().measured().is_none());
        assert!(model.describe().starts_with("The baseline is 0"));
        assert_eq!(ids(&model), before);
    }

    #[test]
    fn what_hides_the_ball_is_said() {
        let mut model = StereoSlider::new();
        model.update(&Event::moved("object", -0.3, 0.9)).unwrap();
        model.update(&Event::set(&BASELINE, 0.4)).unwrap();
        assert!(
            model
                .describe()
                .contains("right photograph does not show it")
        );
        let hidden = (8..100).any(|tenths| {
            let place = Event::moved("object", 0.6, f64::from(tenths) / 10.0);
            model.update(&place).unwrap();
            let sights = model.rig().sights();
            matches!(sights, Ok([Sight::Hidden(by), _]) if model.describe().contains(by))
        });
        assert!(hidden);
    }

    #[test]
    fn a_click_in_a_photograph_moves_the_ball_there() {
        let mut model = StereoSlider::new();
        for (panel, index) in [("left", 0), ("right", 1)] {
            model.update(&Event::clicked(panel, 250.0, 10.0)).unwrap();
            let rig = model.rig();
            assert!((rig.pixels().unwrap()[index].x - 250.0).abs() < 0.2);
            assert_eq!(rig.z_m, 2.8);
        }
    }

    #[test]
    fn a_guess_hides_the_photograph_until_it_is_compared() {
        let mut model = StereoSlider::new();
        for event in [
            Event::set(&SHOW, GUESS.0),
            Event::moved("object", 0.363, 1.4),
            Event::clicked("right", 400.0, 10.0),
        ] {
            model.update(&event).unwrap();
        }
        // The click moves the guess, along the row of the ball, and not the ball.
        let [left, right] = model.rig().pixels().unwrap();
        assert_eq!(model.guess(), Some(Point2::new(400.0, left.y)));
        assert_eq!(model.rig().z_m, 1.4);
        assert!(model.shown().is_none() && model.guess_off_px().is_none());
        let said = model.describe();
        assert!(said.contains("hidden") && !said.contains("60.0"), "{said}");
        let disparity = &model.readouts()[0];
        assert_eq!((disparity.id, &*disparity.text), ("disparity", "hidden"));
        model.update(&Event::set(&SHOW, BOTH.0)).unwrap();
        assert!((model.guess_off_px().unwrap() - (right.x - 400.0)).abs() < 1e-9);
        assert!(model.describe().contains("Your guess is 41 px off"));
    }

    #[test]
    fn no_goal_is_reached_eight_meters_away() {
        let mut model = StereoSlider::new();
        model.update(&Event::moved("object", 0.4, 8.0)).unwrap();
        for challenge in CHALLENGES {
            assert!(!(challenge.check)(&model), "{}", challenge.id);
        }
    }
}
