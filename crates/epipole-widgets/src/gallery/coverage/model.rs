//! Arrangement of the boards, and the camera calibrated from them.

use super::boards::{Arrangement, SIZE, covered_px};
use super::question::{Found, Question};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Toggle, knobs,
};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use nalgebra::Point2;

const VIEWS: Slider = Slider::new("views", "Photographs")
    .range(2.0, 12.0, 1.0)
    .at(6.0);
const SPREAD: Slider = Slider::new("spread", "Spread")
    .range(0.0, 100.0, 5.0)
    .at(40.0)
    .unit("%");
const TILT: Slider = Slider::new("tilt", "Tilt")
    .range(0.0, 45.0, 5.0)
    .at(30.0)
    .unit("°");
const ONE_WAY: Toggle = Toggle::new("one-way", "Same tilt");
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![VIEWS, SPREAD, TILT, ONE_WAY, SEED];
/// Middle of all boards.
const BOARDS: Probe = Probe::new("boards", "image", "Middle of boards")
    .over(SIZE)
    .step(8.0)
    .at(320.0, 240.0);

/// The model of `coverage`.
pub(crate) struct Coverage {
    settings: Settings,
    boards: Probe,
    marks: Result<Vec<Vec<Point2<f64>>>, String>,
    pub(super) asked: Computation<Question>,
}

impl Coverage {
    pub(super) fn arrangement(&self) -> Arrangement {
        Arrangement {
            place: self.boards.point().into(),
            spread: self.settings.number(&SPREAD) / 100.0,
            tilt_deg: self.settings.number(&TILT),
            one_way: self.settings.flag(&ONE_WAY),
            num_views: self.settings.count(&VIEWS),
        }
    }

    /// Returns the exact marks of each board, pixels, or an error message.
    pub(super) fn marks(&self) -> Result<&[Vec<Point2<f64>>], &str> {
        let marks = self.marks.as_ref();
        marks.map(Vec::as_slice).map_err(String::as_str)
    }

    /// Returns the distance of the farthest mark from the principal point, pixels.
    pub(super) fn covered_px(&self) -> f64 {
        self.marks().map_or(0.0, covered_px)
    }

    /// Returns the middle of all boards, pixels.
    pub(super) fn place(&self) -> (f64, f64) {
        self.boards.place()
    }

    /// Returns the last calibrated camera, or an error message; `None` before the first one.
    pub(super) fn found(&self) -> Option<Result<&Found, &str>> {
        let answer = self.asked.answer()?;
        Some(answer.as_ref().map_err(String::as_str))
    }

    /// Returns the camera of the present boards, or an error message; `None` while it is computed.
    fn settled(&self) -> Option<Result<&Found, &str>> {
        self.found().filter(|_| !self.asked.is_waiting())
    }

    fn settled_camera(&self) -> Option<&Found> {
        self.settled()?.ok()
    }

    fn ask(&mut self) {
        let boards = self.arrangement();
        self.marks = boards.marks().map_err(|error| error.to_string());
        let seed = self.settings.count(&SEED) as u64;
        self.asked.ask(Question { boards, seed });
    }
}

impl Declared for Coverage {
    const NAME: &'static str = "coverage";
    const TITLE: &'static str = "Where were the boards?";
    const HELP: &'static str = "Drag the middle of the boards over the image, and choose how many there are, how far \
        apart they are and how much they are tilted. Compare the camera found with the true one.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            boards: BOARDS,
            marks: Ok(Vec::new()),
            asked: Computation::default(),
        };
        model.ask();
        model
    }
}

impl Model for Coverage {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.boards.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        self.boards.update(event);
        self.ask();
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<Coverage>] = &[
    Challenge {
        id: "corner",
        goal: "With six photographs or fewer, bring the error in the corner below 2 px.",
        hint: "Where does the curve leave the true one?",
        why: "Inside the boards the curve has to fit. Outside of them nothing holds it.",
        check: |model| {
            let found = model.settled_camera();
            model.arrangement().num_views <= 6 && found.is_some_and(|found| found.corner_px < 2.0)
        },
        solution: || vec![Event::set(&SPREAD, 100.0)],
    },
    Challenge {
        id: "side",
        goal: "Cover less than a fifth of the image, and bring the error in the corner below 5 px.",
        hint: "The model of the lens bends by the distance from the middle, alike on all sides.",
        why: "For that model one side stands for all others. No real lens is as round as that, so cover them all.",
        check: |model| {
            let found = model.settled_camera();
            found.is_some_and(|found| found.coverage < 0.2 && found.corner_px < 5.0)
        },
        solution: || {
            vec![
                Event::set(&SPREAD, 30.0),
                Event::moved(BOARDS.id(), 130.0, 240.0),
            ]
        },
    },
    Challenge {
        id: "open",
        goal: "Spread the boards over the whole image, and leave the focal length open.",
        hint: "A board square to the camera looks the same from twice as far, through a lens twice as long.",
        why: "Coverage finds the lens, and tilt finds the focal length. A set of photographs needs both.",
        check: |model| model.arrangement().spread == 1.0 && matches!(model.settled(), Some(Err(_))),
        solution: || vec![Event::set(&SPREAD, 100.0), Event::set(&TILT, 0.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::gallery::coverage::boards::FOCAL_PX;
    use crate::kit::question::settled;

    #[test]
    fn boards_in_the_middle_give_the_focal_length_and_lose_the_corner() {
        let model: Coverage = settled(&[]);
        let found = model.settled_camera().unwrap();
        assert!((found.focal_px - FOCAL_PX).abs() < 3.0 * found.focal_std_px);
        assert!(
            found.focal_std_px < 4.0 && found.corner_px > 50.0,
            "{found:?}"
        );
        let whole: Coverage = settled(&[Event::set(&SPREAD, 100.0)]);
        let found = whole.settled_camera().unwrap();
        assert!(found.corner_px < 5.0 && found.coverage > 0.25, "{found:?}");
    }

    #[test]
    fn boards_without_tilt_give_no_camera() {
        let model: Coverage = settled(&[Event::set(&TILT, 0.0)]);
        assert!(matches!(model.found(), Some(Err(_))));
        assert!(model.describe().contains("no camera"));
        assert_eq!(model.readouts()[0].text, "open");
    }

    #[test]
    fn the_boards_move_at_once_and_the_answer_follows() {
        let mut model: Coverage = settled(&[]);
        let (reach_px, focal_px) = (model.covered_px(), model.settled_camera().unwrap().focal_px);
        model.update(&Event::moved("boards", 100.0, 240.0)).unwrap();
        assert!(model.covered_px() > reach_px + 100.0 && model.asked.is_waiting());
        // The last answer is shown, but reaches no goal.
        assert_eq!(model.found().unwrap().unwrap().focal_px, focal_px);
        assert!(model.settled_camera().is_none());
    }
}
