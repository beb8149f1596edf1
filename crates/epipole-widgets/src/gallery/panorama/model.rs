//! The photographs to join, and surface, blending and exposure of the panorama.

use super::question::{Answer, BLENDS, MAX_PHOTOS, Question, SURFACES, Source};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Knob, Model, PhotoSlot, Problem,
    Settings, Slider, knobs,
};
use crate::kit::picture::{Own, Picture};
use crate::kit::question::{Computation, carry_out};
use epipole::stitch::{Blend, Surface};
use image::RgbImage;

const SOURCE: Choice = Choice::new(
    "source",
    "Photographs",
    &[("still-life", "Still life"), ("own", "Yours")],
);
const OWN: usize = 1;
const TURN: Slider = Slider::new("turn", "Turn between")
    .range(10.0, 42.0, 2.0)
    .at(20.0)
    .unit("°");
const STEP: Slider = Slider::new("step", "Step between")
    .range(0.0, 0.2, 0.02)
    .at(0.0)
    .digits(2)
    .unit("m");
const SURFACE: Choice = Choice::new(
    "surface",
    "Surface",
    &[("plane", "Plane"), ("cylinder", "Cylinder")],
)
.at(1);
const BLEND: Choice = Choice::new(
    "blend",
    "Blend",
    &[("seams", "Seams"), ("mean", "Mean"), ("bands", "Bands")],
);
const EXPOSURE: Choice = Choice::new(
    "exposure",
    "Exposure",
    &[
        ("fixed", "Fixed"),
        ("automatic", "Automatic"),
        ("even", "Evened out"),
    ],
)
.more();
const KNOBS: &[Knob] = knobs![SOURCE, TURN, STEP, SURFACE, BLEND, EXPOSURE];

const SLOTS: &[PhotoSlot] = &[
    own_slot("first", "Your photograph 1"),
    own_slot("second", "Your photograph 2"),
    own_slot("third", "Your photograph 3, if any"),
];
/// Minimum side of a photograph, pixels; smaller ones have no room for features.
const MIN_SIDE_PX: u32 = 64;

const fn own_slot(id: &'static str, label: &'static str) -> PhotoSlot {
    PhotoSlot {
        id,
        label,
        max_side_px: 640,
    }
}

/// RMS error above which the camera has not only rotated, pixels.
pub(super) const MOVED_PX: f64 = 1.0;

/// The model of `panorama`.
pub(crate) struct PanoramaFigure {
    settings: Settings,
    own: Own<MAX_PHOTOS>,
    pub(super) asked: Computation<Question>,
}

impl PanoramaFigure {
    pub(super) fn is_own(&self) -> bool {
        self.settings.chosen(&SOURCE) == OWN
    }

    pub(super) fn surface(&self) -> Surface {
        SURFACES[self.settings.chosen(&SURFACE)]
    }

    pub(super) fn blend(&self) -> Blend {
        BLENDS[self.settings.chosen(&BLEND)]
    }

    /// Returns the result for the current settings; `None` while it is computed or if there is
    /// none.
    pub(super) fn answer(&self) -> Option<&Answer> {
        let is_waiting = self.asked.is_waiting();
        self.shown().filter(|_| !is_waiting)
    }

    /// Returns the last result, possibly for earlier settings, unless the last job failed.
    pub(super) fn shown(&self) -> Option<&Answer> {
        let has_failed = self.asked.problem().is_some();
        self.asked.answer().filter(|_| !has_failed)
    }

    fn own_photos(&self) -> Vec<Picture> {
        let all = (0..MAX_PHOTOS).filter_map(|index| self.own.get(index));
        all.cloned().collect()
    }

    fn ask(&mut self) {
        let exposure = self.settings.chosen(&EXPOSURE);
        let own = self.own_photos();
        let source = match self.is_own() {
            false => Source::Rendered {
                turn_deg: self.settings.number(&TURN),
                step_m: self.settings.number(&STEP),
                is_automatic: exposure > 0,
            },
            true if own.len() < 2 => {
                let sentence = match own.len() {
                    0 => "Choose two or three photographs that overlap, taken from one place.",
                    _ => "One photograph is there; choose another that overlaps it.",
                };
                return self.asked.refuse(sentence);
            }
            true => Source::Own(own),
        };
        self.asked.ask(Question {
            source,
            surface: self.settings.chosen(&SURFACE),
            blend: self.settings.chosen(&BLEND),
            gains: exposure == 2,
        });
    }
}

impl Declared for PanoramaFigure {
    const NAME: &'static str = "panorama";
    const TITLE: &'static str = "A panorama from one place";
    const HELP: &'static str = "Turn the camera between three photographs with the sliders, and let it step \
        aside. Choose a surface and a blend, or join two or three photographs of your own.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            asked: Computation::default(),
        };
        model.ask();
        model
    }
}

impl Model for PanoramaFigure {
    fn controls(&self) -> Vec<Control> {
        let is_own = self.is_own();
        let is_of_rendered = |id: &str| id == TURN.id || id == STEP.id;
        self.settings
            .controls_enabled(|id| !is_own || !is_of_rendered(id))
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.settings.update(event)? == Some(SOURCE.id) {
            self.asked.forget();
        }
        self.ask();
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn wants_photos(&self) -> bool {
        self.is_own() && self.own_photos().len() < 2
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        self.settings.choose(&SOURCE, OWN);
        self.asked.forget();
        self.ask();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<PanoramaFigure>] = &[
    Challenge {
        id: "parallax",
        goal: "Take photographs that no turn can join: bring the misfit above 1 px.",
        hint: "When is a homography not enough for all points?",
        why: "With a step between the photographs, near things shift against far ones, and no homography \
              fits both. The mean of such photographs shows things twice.",
        check: |model| {
            let answer = model.answer().filter(|_| !model.is_own());
            answer.is_some_and(|answer| answer.misfit_px > MOVED_PX)
        },
        solution: || vec![Event::set(&STEP, 0.04)],
    },
    Challenge {
        id: "apart",
        goal: "Turn so far that not all photographs can be joined.",
        hint: "The field of view is 44°. How much must two photographs share?",
        why: "Only what both photographs show can be matched. For panoramas, let neighbors share a quarter \
              to a third of the picture.",
        check: |model| {
            let is_rendered = !model.is_own();
            let has_failed = model.asked.problem().is_some();
            let is_partial = |answer: &Answer| answer.turns_deg.iter().any(Option::is_none);
            is_rendered && (has_failed || model.answer().is_some_and(is_partial))
        },
        solution: || vec![Event::set(&TURN, 42.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settle;

    fn changed(events: &[Event]) -> PanoramaFigure {
        let mut model = PanoramaFigure::new();
        for event in events {
            model.update(event).unwrap();
        }
        settle(&mut model);
        model
    }

    #[test]
    fn a_turned_camera_gives_focal_length_and_angles() {
        let model = changed(&[]);
        let answer = model.answer().unwrap();
        // The photographs are 480 pixels wide; the still life is taken at 1.25 widths.
        assert!((answer.focal_px - 600.0).abs() < 3.0, "{}", answer.focal_px);
        let turns: Vec<f64> = answer.turns_deg.iter().map(|turn| turn.unwrap()).collect();
        assert!(
            (turns[1] - 20.0).abs() < 0.1 && (turns[2] - 40.0).abs() < 0.2,
            "{turns:?}"
        );
        assert!(answer.misfit_px < 0.5, "{}", answer.misfit_px);
        assert!(answer.joints.iter().all(|joint| joint.num_inliers > 50));
    }

    #[test]
    fn a_step_shows() {
        let model = changed(&[Event::set(&STEP, 0.1)]);
        let answer = model.answer().unwrap();
        assert!(answer.misfit_px > MOVED_PX && model.describe().contains("stepped aside"));
    }

    #[test]
    fn own_photographs_are_asked_for_and_joined() {
        let mut model = changed(&[Event::set(&SOURCE, "own")]);
        assert!(model.wants_photos() && model.answer().is_none());
        let photographs = changed(&[]).answer().unwrap().photographs.clone();
        for (slot, photograph) in SLOTS.iter().zip(&photographs[..2]) {
            model
                .take_photo(slot.id, photograph.image().clone())
                .unwrap();
        }
        assert!(!model.wants_photos());
        settle(&mut model);
        assert_eq!(model.answer().unwrap().turns_deg.len(), 2);
        model.take_photo("third", RgbImage::new(200, 100)).unwrap();
        settle(&mut model);
        assert_eq!(model.answer().unwrap().turns_deg[2], None);
    }
}
