//! A keypoint, a rotation of the photograph, and the orientation found before and after.

use super::gradients::Surroundings;
use super::question::Question;
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, knobs,
};
use crate::kit::features::SIZE;
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};

const TURN: Slider = Slider::new("turn", "Turn")
    .range(-180.0, 180.0, 5.0)
    .at(40.0)
    .unit("°");
const SCALE: Slider = Slider::new("scale", "Scale σ")
    .range(1.8, 4.8, 0.2)
    .at(3.2)
    .digits(1)
    .unit("px");
const KNOBS: &[Knob] = knobs![TURN, SCALE];
const KEYPOINT: Probe = Probe::new("keypoint", "photograph", "Keypoint")
    .over(SIZE)
    .step(2.0)
    .at(348.0, 244.0);

/// The model of `keypoint-orientation`.
pub(crate) struct KeypointOrientation {
    settings: Settings,
    pub(super) keypoint: Probe,
    pub(super) asked: Computation<Question>,
    gray: Option<GrayImage32>,
    /// Neighborhoods before and after the rotation.
    found: Option<[Surroundings; 2]>,
    version: u64,
}

impl KeypointOrientation {
    /// Returns the neighborhoods of the keypoint before and after the rotation, once the photograph
    /// is available.
    pub(super) fn found(&self) -> Option<&[Surroundings; 2]> {
        self.found.as_ref()
    }

    /// Returns a version number of the neighborhoods.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    pub(super) fn turn_deg(&self) -> f64 {
        self.settings.number(&TURN)
    }

    pub(super) fn scale_px(&self) -> f64 {
        self.settings.number(&SCALE)
    }

    /// Returns the orientations before and after the rotation, degrees.
    pub(super) fn orientations_deg(&self) -> Option<[f64; 2]> {
        let first = |found: &Surroundings| found.peaks_rad.first().map(|rad| rad.to_degrees());
        let [before, after] = self.found()?;
        Some([first(before)?, first(after)?])
    }

    /// Returns the second peak after the rotation, relative to the first.
    pub(super) fn second(&self) -> Option<f64> {
        Some(self.found()?[1].second())
    }

    /// Returns the number of keypoints that SIFT creates here, one per orientation.
    pub(super) fn num_keypoints(&self) -> Option<usize> {
        Some(self.found()?[1].peaks_rad.len())
    }

    /// Returns the mean difference of the two normalized patches, gray levels.
    pub(super) fn patch_change(&self) -> Option<f64> {
        let [before, after] = self.found()?.each_ref().map(Surroundings::normalized);
        let pairs = before.as_raw().iter().zip(after.as_raw());
        let sum: f64 = pairs.map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        Some(sum / before.as_raw().len() as f64)
    }

    fn measure(&mut self) {
        let (place, scale_px) = (self.keypoint.place(), self.scale_px());
        let turn_rad = self.turn_deg().to_radians();
        let at = |gray, turn_rad| Surroundings::new(gray, place, turn_rad, scale_px).ok();
        let both = |gray| Some([at(gray, 0.0)?, at(gray, turn_rad)?]);
        self.found = self.gray.as_ref().and_then(both);
        self.version += 1;
    }
}

impl Declared for KeypointOrientation {
    const NAME: &'static str = "keypoint-orientation";
    const TITLE: &'static str = "Which way is up?";
    const HELP: &'static str = "Drag the keypoint over the photograph, or move it with the arrow keys. Turn the \
        photograph, and watch the peak of the histogram and the patch that follows it.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            keypoint: KEYPOINT,
            asked: Computation::of(Question),
            gray: None,
            found: None,
            version: 0,
        }
    }
}

impl Model for KeypointOrientation {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.keypoint.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.keypoint.update(event) || self.settings.update(event)?.is_some() {
            self.measure();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        let picture = self.asked.answer();
        self.gray = picture.map(|picture| rgb_to_gray_f32(picture.image(), &BT601_WEIGHTS));
        self.measure();
    }
}

const CHALLENGES: &[Challenge<KeypointOrientation>] = &[
    Challenge {
        id: "up",
        goal: "Turn the photograph until the keypoint's orientation points straight up, within 3°.",
        hint: "Up is −90°. How much is missing?",
        why: "The peak turns by exactly as much as the photograph does.",
        check: |model| {
            let is_up = |[_, after]: [f64; 2]| (after + 90.0).abs() <= 3.0;
            model.orientations_deg().is_some_and(is_up)
        },
        solution: || vec![Event::set(&TURN, -100.0)],
    },
    Challenge {
        id: "two",
        goal: "Find a place where SIFT makes two keypoints.",
        hint: "Which places have two edges of the same strength?",
        why: "At a corner or a thin line the gradients have two directions. Neither wins reliably, so SIFT \
              describes the place twice.",
        check: |model| model.num_keypoints() == Some(2),
        solution: || vec![Event::moved(KEYPOINT.id(), 144.0, 96.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    #[test]
    fn the_orientation_turns_with_the_photograph_and_the_patch_stays() {
        let mut model: KeypointOrientation = settled(&[]);
        for turn_deg in (-180..=180).step_by(20).map(f64::from) {
            model.update(&Event::set(&TURN, turn_deg)).unwrap();
            let [before, after] = model.orientations_deg().unwrap();
            let off = libm::remainder(after - before - turn_deg, 360.0);
            assert!(off.abs() < 3.0, "{turn_deg}: {off}");
            assert!(model.patch_change().unwrap() < 5.0);
        }
        model.update(&Event::set(&TURN, 0.0)).unwrap();
        assert_eq!(model.patch_change(), Some(0.0));
    }

    #[test]
    fn a_second_peak_of_80_percent_makes_a_second_keypoint() {
        let mut model: KeypointOrientation = settled(&[]);
        let mut counts = [0; 2];
        for (u, v) in (60..420)
            .step_by(24)
            .flat_map(|u| (60..300).step_by(24).map(move |v| (u, v)))
        {
            let moved = Event::moved(KEYPOINT.id(), f64::from(u), f64::from(v));
            model.update(&moved).unwrap();
            let keypoints = model.num_keypoints().unwrap();
            assert_eq!(keypoints == 2, model.second().unwrap() >= 0.8, "({u}, {v})");
            counts[keypoints - 1] += 1;
        }
        assert!(counts[0] > 50 && counts[1] > 10, "{counts:?}");
    }
}
