//! A keypoint, a change of the photograph, and the response of three descriptors.

use super::comparison::{Comparison, Subject};
use super::question::{Answer, Question};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, Toggle, knobs,
};
use crate::kit::changed::Change;
use crate::kit::features::SIZE;
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use image::RgbImage;

const TURN: Slider = Slider::new("turn", "Turn")
    .range(-180.0, 180.0, 5.0)
    .at(40.0)
    .unit("°");
const ZOOM: Slider = Slider::new("zoom", "Scale")
    .range(0.6, 1.8, 0.05)
    .at(1.3)
    .digits(2);
const BRIGHTER: Slider = Slider::new("brighter", "Brighten")
    .range(-120.0, 120.0, 5.0)
    .at(30.0)
    .unit("levels");
const CONTRAST: Slider = Slider::new("contrast", "Contrast")
    .range(0.3, 2.0, 0.05)
    .at(1.0)
    .digits(2)
    .more();
const DIRECTION: Toggle = Toggle::new("direction", "Turn the window").on();
const SCALE: Toggle = Toggle::new("scale", "Scale the window").on();
const KNOBS: &[Knob] = knobs![TURN, ZOOM, BRIGHTER, CONTRAST, DIRECTION, SCALE];
const KEYPOINT: Probe = Probe::new("keypoint", "photograph", "Keypoint")
    .over(SIZE)
    .step(4.0)
    .at(348.0, 244.0);

/// The model of `sift-descriptor`.
pub(crate) struct SiftDescriptor {
    settings: Settings,
    photograph: Computation<Question>,
    comparison: Computation<Question>,
    pub(super) keypoint: Probe,
}

impl SiftDescriptor {
    /// Returns the photograph before its change.
    ///
    /// # Errors
    /// A message: the problem, or that the photograph is being rendered.
    pub(super) fn photograph(&self) -> Result<&RgbImage, &str> {
        match self.photograph.answer() {
            Some(Answer::Photograph(picture)) => Ok(picture.image()),
            _ => Err(self.photograph.stand_in()),
        }
    }

    /// Returns the last comparison, possibly for an earlier change.
    pub(super) fn compared(&self) -> Option<&Comparison> {
        match self.comparison.answer()? {
            Answer::Comparison(comparison) => Some(comparison),
            Answer::Photograph(_) => None,
        }
    }

    /// Returns a version number of the windows.
    pub(super) fn version(&self) -> u64 {
        self.comparison.version()
    }

    /// Returns the reason why there is no comparison, as a sentence.
    pub(super) fn problem(&self) -> Option<&str> {
        self.photograph.problem().or(self.comparison.problem())
    }

    pub(super) fn change(&self) -> Change {
        Change {
            turn_rad: self.settings.number(&TURN).to_radians(),
            zoom: self.settings.number(&ZOOM),
            brighter: self.settings.number(&BRIGHTER) / 255.0,
            contrast: self.settings.number(&CONTRAST),
        }
    }

    fn ratio(&self, way: usize) -> Option<f64> {
        Some(self.compared()?.distances[way].ratio())
    }

    fn ask(&mut self) {
        self.comparison.ask(Question::Comparison(Subject {
            place: self.keypoint.place(),
            change: self.change(),
            turns: self.settings.flag(&DIRECTION),
            scales: self.settings.flag(&SCALE),
        }));
    }
}

impl Declared for SiftDescriptor {
    const NAME: &'static str = "sift-descriptor";
    const TITLE: &'static str = "A fingerprint that lasts";
    const HELP: &'static str = "Drag the keypoint over the photograph, then turn, scale and brighten the \
        photograph. The bars say how far each fingerprint is from its original, as a share of the distance \
        to the nearest other feature: below 0.8, it would be recognized.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            photograph: Computation::of(Question::Photograph),
            comparison: Computation::default(),
            keypoint: KEYPOINT,
        };
        model.ask();
        model
    }
}

impl Model for SiftDescriptor {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.keypoint.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.keypoint.update(event) || self.settings.update(event)?.is_some() {
            self.ask();
        }
        Ok(())
    }

    /// Requests the photograph first, since features take much longer.
    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(match self.photograph.is_waiting() {
            true => &mut self.photograph,
            false => &mut self.comparison,
        })
    }
}

const CHALLENGES: &[Challenge<SiftDescriptor>] = &[
    Challenge {
        id: "light-only",
        goal: "Change the photograph so that the normalized patch is recognized and the raw one is not.",
        hint: "Undo what moves pixels. Keep what changes their values.",
        why: "Subtracting the mean and dividing by the length removes brightness and contrast, and nothing \
              else.",
        check: |model| match (model.ratio(0), model.ratio(1)) {
            (Some(raw), Some(normalized)) => raw > 0.8 && normalized < 0.5,
            _ => false,
        },
        solution: || {
            vec![
                Event::set(&TURN, 0.0),
                Event::set(&ZOOM, 1.0),
                Event::set(&BRIGHTER, 60.0),
            ]
        },
    },
    Challenge {
        id: "lost",
        goal: "Leave the scale at 1 or above and make SIFT lose the keypoint.",
        hint: "Its window follows the photograph only because two things are measured first. Switch one off.",
        why: "The 128 numbers themselves know nothing about turning or size: the window must be turned and \
              scaled before gradients are counted.",
        check: |model| {
            model.change().zoom >= 1.0 && model.ratio(2).is_some_and(|ratio| ratio > 0.8)
        },
        solution: || vec![Event::set(&DIRECTION, false), Event::set(&TURN, 90.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::{settle, settled};

    #[test]
    fn sift_survives_what_patches_do_not() {
        let mut model: SiftDescriptor = settled(&[]);
        let [raw, normalized, sift] = model.compared().unwrap().distances;
        assert!(sift.ratio() < 0.6 && normalized.ratio() > 0.8 && raw.ratio() > 0.8);
        // Without a change, the distances are 0.
        for (knob, value) in [(&TURN, 0.0), (&ZOOM, 1.0), (&BRIGHTER, 0.0)] {
            model.update(&Event::set(knob, value)).unwrap();
        }
        settle(&mut model);
        assert!(
            model
                .compared()
                .unwrap()
                .distances
                .iter()
                .all(|d| d.original == 0.0 && d.other > 0.0)
        );
        // A rotation by 90° maps pixels to pixels, up to interpolation at the center.
        model.update(&Event::set(&TURN, 90.0)).unwrap();
        settle(&mut model);
        let turned = model.compared().unwrap();
        let angles = turned.looks.each_ref().map(|look| look.angle_rad);
        let apart = libm::remainder(angles[1] - angles[0], std::f64::consts::TAU);
        assert!(
            (apart - std::f64::consts::FRAC_PI_2).abs() < 1e-3,
            "{apart}"
        );
        assert!(
            turned.distances[2].original < 0.02,
            "{:?}",
            turned.distances
        );
    }
}
