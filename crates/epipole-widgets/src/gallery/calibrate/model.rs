//! Selection of ten views, and the camera calibrated from them.

use super::question::{Answer, Found, NUM_VIEWS, Question};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Knob, Model, Problem, Settings,
    Slider, knobs,
};
use crate::kit::question::{Computation, carry_out};

/// Bit mask of the views used.
const VIEWS: Slider = Slider::new("views", "Views used")
    .range(0.0, 1023.0, 1.0)
    .at(1023.0)
    .hidden();
/// Sets of views; the last one is the result of the reader's clicks.
const SET: Choice = Choice::new(
    "set",
    "Views",
    &[
        ("all", "All ten"),
        ("square", "Square ones"),
        ("middle", "Middle only"),
        ("four", "Good four"),
        ("own", "Your choice"),
    ],
);
/// Bit masks of all sets but the last.
const SETS: [u16; 4] = [1023, 0b00_0000_0111, 0b00_0111_1010, 0b11_1100_0000];
const KNOBS: &[Knob] = knobs![SET, VIEWS];

/// Panel ids of the views.
pub(super) const VIEW_IDS: [&str; NUM_VIEWS] = ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10"];

/// The model of `calibrate`.
pub(crate) struct Calibrate {
    settings: Settings,
    pub(super) asked: Computation<Question>,
}

impl Calibrate {
    fn views(&self) -> u16 {
        self.settings.count(&VIEWS) as u16
    }

    pub(super) fn is_used(&self, index: usize) -> bool {
        self.views() >> index & 1 == 1
    }

    pub(super) fn num_used(&self) -> usize {
        self.views().count_ones() as usize
    }

    /// Returns the calibrated camera, or an error message; `None` while it is computed.
    pub(super) fn found(&self) -> Option<Result<&Found, &str>> {
        let answer: Option<&Answer> = self.asked.answer();
        let answer = answer.filter(|_| !self.asked.is_waiting())?;
        Some(answer.found.as_ref().map_err(String::as_str))
    }

    fn found_camera(&self) -> Option<&Found> {
        self.found()?.ok()
    }

    fn ask(&mut self) {
        let views = self.views();
        self.asked.ask(Question { views });
    }
}

impl Found {
    /// Returns the largest error in the picture, pixels.
    pub(super) fn worst_px(&self) -> f64 {
        f64::from(self.errors_px.iter().copied().fold(0.0, f32::max))
    }
}

impl Declared for Calibrate {
    const NAME: &'static str = "calibrate";
    const TITLE: &'static str = "Ten photographs of a board";
    const HELP: &'static str = "Click a photograph to leave it out or to use it again, or choose a set. The map shows how far the camera found is from the true one.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            asked: Computation::default(),
        };
        model.ask();
        model
    }
}

impl Model for Calibrate {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let changed = self.settings.update(event)?;
        if changed == Some(SET.id)
            && let Some(views) = SETS.get(self.settings.chosen(&SET))
        {
            self.settings.slide(&VIEWS, f64::from(*views));
        }
        if let Event::Clicked { panel, .. } = event
            && let Some(index) = VIEW_IDS.iter().position(|id| id == panel)
        {
            let views = self.views() ^ (1 << index);
            self.settings.slide(&VIEWS, f64::from(views));
        }
        let known = SETS.iter().position(|set| *set == self.views());
        self.settings.choose(&SET, known.unwrap_or(SETS.len()));
        self.ask();
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<Calibrate>] = &[
    Challenge {
        id: "open",
        goal: "Use two views or more that leave the focal length open.",
        hint: "A board square to the camera looks the same nearby as farther away with a longer lens.",
        why: "Boards parallel to the image give the same two equations, whatever their distance. Tilt the board: \
              its perspective tells the focal length.",
        check: |model| model.num_used() >= 2 && matches!(model.found(), Some(Err(_))),
        solution: || vec![Event::set(&SET, "square")],
    },
    Challenge {
        id: "four",
        goal: "With four views only, keep every error in the picture below half a pixel.",
        hint: "The lens bends most in the corners. Which views reach them?",
        why: "Four views are plenty if they are tilted in different ways and cover the picture. Ten in the middle \
              say nothing about the corners.",
        check: |model| {
            let found = model.found_camera();
            model.num_used() == 4 && found.is_some_and(|found| found.worst_px() < 0.5)
        },
        solution: || vec![Event::set(&SET, "four")],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::calibrate::question::FOCAL_PX;
    use crate::kit::question::settled;

    fn of_views(views: u16) -> Calibrate {
        settled(&[Event::set(&VIEWS, f64::from(views))])
    }

    #[test]
    fn every_board_is_found_and_all_give_the_camera() {
        let model: Calibrate = settled(&[]);
        let answer = model.asked.answer().unwrap();
        assert!(answer.corners.iter().all(|corners| corners.len() == 48));
        let found = model.found_camera().unwrap();
        assert!((found.focal_px - FOCAL_PX).abs() < 3.0 * found.focal_std_px);
        assert!(
            found.focal_std_px < 1.0 && found.worst_px() < 0.5,
            "{}",
            found.worst_px()
        );
    }

    #[test]
    fn square_boards_do_not_tell_the_focal_length() {
        let model: Calibrate = settled(&[Event::set(&SET, "square")]);
        assert!(matches!(model.found(), Some(Err(_))));
    }

    #[test]
    fn boards_in_the_middle_leave_the_corners_open() {
        let (all, middle) = (of_views(1023), of_views(0b00_0111_1010));
        let worst = |model: &Calibrate| model.found_camera().unwrap().worst_px();
        assert!(worst(&middle) > 3.0 * worst(&all));
    }

    #[test]
    fn a_click_leaves_a_view_out_and_takes_it_back() {
        let mut model = Calibrate::new();
        model.update(&Event::clicked("3", 10.0, 10.0)).unwrap();
        assert!(!model.is_used(2) && model.num_used() == 9);
        assert_eq!(model.settings.chosen(&SET), SETS.len());
        model.update(&Event::clicked("3", 10.0, 10.0)).unwrap();
        assert_eq!((model.num_used(), model.settings.chosen(&SET)), (10, 0));
    }
}
