//! A house scaled about the first camera, and a second camera moved along the baseline.

use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, Space,
    knobs,
};
use crate::kit::house::House;
use crate::kit::orbit::{Orbit, SPACE};
use epipole::camera::{PosedCamera, RigidTransform};
use nalgebra::{Point2, Point3, Translation3};

/// Indices of the two cameras whose photographs are shown.
const PAIR: [usize; 2] = [1, 2];
/// Changes below this are treated as zero, pixels.
const SAME_PX: f64 = 1e-6;

const HOUSE: Slider = Slider::new("house", "House size")
    .range(0.5, 4.0, 0.25)
    .at(2.0)
    .digits(2)
    .unit("×");
const BASELINE: Slider = Slider::new("baseline", "Baseline")
    .range(0.5, 4.0, 0.25)
    .at(2.0)
    .digits(2)
    .unit("×");
const KNOBS: &[Knob] = knobs![HOUSE, BASELINE];

/// The scaled house and its cameras.
pub(super) struct World {
    pub(super) cameras: [PosedCamera; 2],
    pub(super) points: Vec<Point3<f64>>,
    /// Projection of each point into each camera, pixels.
    pub(super) pixels: [Vec<Point2<f64>>; 2],
}

/// The model of `scale-ambiguity`.
pub(crate) struct ScaleAmbiguity {
    settings: Settings,
    pub(super) orbit: Orbit,
    house: Option<House>,
}

impl ScaleAmbiguity {
    pub(super) fn house(&self) -> Option<&House> {
        self.house.as_ref()
    }

    /// Returns the scale factors of the house and of the baseline.
    pub(super) fn times(&self) -> [f64; 2] {
        [&HOUSE, &BASELINE].map(|slider| self.settings.number(slider))
    }

    /// Returns the world with these scale factors; `None` if a point is behind a camera.
    pub(super) fn world(&self, [house_times, baseline_times]: [f64; 2]) -> Option<World> {
        let house = self.house.as_ref()?;
        let [first, second] = PAIR.map(|index| house.cameras[index]);
        let origin = first.center_in_world();
        let center = origin + (second.center_in_world() - origin) * baseline_times;
        let rotation = second.cam_from_world.rotation;
        let translation = Translation3::from(-(rotation * center.coords));
        let second = PosedCamera {
            cam_from_world: RigidTransform::from_parts(translation, rotation),
            ..second
        };
        let enlarged = |point: &Point3<f64>| origin + (point - origin) * house_times;
        let points: Vec<_> = house.points.iter().map(enlarged).collect();
        let cameras = [first, second];
        let seen = |camera: &PosedCamera| {
            let pixels = points.iter().map(|point| camera.project(point).ok());
            pixels.collect::<Option<Vec<_>>>()
        };
        let pixels = [seen(&first)?, seen(&second)?];
        Some(World {
            cameras,
            points,
            pixels,
        })
    }

    /// Returns the maximum displacement of a point in each photograph, pixels; `None` if a point is
    /// behind a camera.
    pub(super) fn changes_px(&self) -> Option<[f64; 2]> {
        let (before, now) = (self.world([1.0, 1.0])?, self.world(self.times())?);
        let change = |index: usize| {
            let pairs = before.pixels[index].iter().zip(&now.pixels[index]);
            let most = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            if most < SAME_PX { 0.0 } else { most }
        };
        Some([change(0), change(1)])
    }
}

impl Declared for ScaleAmbiguity {
    const NAME: &'static str = "scale-ambiguity";
    const TITLE: &'static str = "How large is the house?";
    const HELP: &'static str = "Change the size of the house and the length of the baseline, and watch the \
        two photographs. Drag in the space to turn it.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-16.0, 30.0),
            // Built from constants; a test verifies that this succeeds.
            house: House::new().ok(),
        }
    }
}

impl Model for ScaleAmbiguity {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls_and(self.orbit.controls())
    }

    fn handles(&self) -> Vec<Handle> {
        self.orbit.handles().into()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.orbit.update(event)?;
        self.settings.update(event).map(|_| ())
    }
}

const CHALLENGES: &[Challenge<ScaleAmbiguity>] = &[
    Challenge {
        id: "one-notices",
        goal: "Change photograph 2 by at least 40 px and photograph 1 not at all.",
        hint: "Does one camera alone notice the size of the house?",
        why: "Enlarged about camera 1, the house keeps every corner on its ray to camera 1. Camera 2 sees those \
              rays from the side, unless it moves along.",
        check: |model| {
            model
                .changes_px()
                .is_some_and(|[one, two]| one == 0.0 && two >= 40.0)
        },
        solution: || vec![Event::set(&BASELINE, 1.0)],
    },
    Challenge {
        id: "thrice",
        goal: "Make the house three times as large with both photographs as they were.",
        hint: "Two things have to grow.",
        why: "House and baseline grew by the same factor, so all rays meet as before. Photographs give the \
              shape of the world, never its size.",
        check: |model| {
            let is_same = model.changes_px() == Some([0.0; 2]);
            is_same && model.times()[0] == 3.0
        },
        solution: || vec![Event::set(&HOUSE, 3.0), Event::set(&BASELINE, 3.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photographs_stay_if_all_grows_and_only_then() {
        let mut model = ScaleAmbiguity::new();
        for step in 0..=14 {
            let times = 0.5 + 0.25 * f64::from(step);
            model.update(&Event::set(&HOUSE, times)).unwrap();
            model.update(&Event::set(&BASELINE, times)).unwrap();
            let before = model.world([1.0, 1.0]).unwrap();
            let now = model.world(model.times()).unwrap();
            for (a, b) in before
                .pixels
                .iter()
                .flatten()
                .zip(now.pixels.iter().flatten())
            {
                assert!((a - b).norm() < 1e-10, "{times}");
            }
            assert_eq!(model.changes_px(), Some([0.0; 2]));
            let other = if times > 2.0 { 1.0 } else { 3.5 };
            model.update(&Event::set(&BASELINE, other)).unwrap();
            let changes = model.changes_px();
            assert!(
                changes.is_none_or(|[one, two]| one == 0.0 && two > 10.0),
                "{changes:?}"
            );
        }
    }
}
