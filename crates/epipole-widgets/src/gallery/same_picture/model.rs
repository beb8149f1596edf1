//! A mug on a table, a camera at table height that cannot determine its distance, and one at the
//! side that can.

use crate::contract::{
    Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Symbol,
    format_number, knobs,
};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at};
use epipole_scenes::Scene;
use nalgebra::{Point3, Vector3};

pub(super) const SIZE: (u32, u32) = (640, 480);
pub(super) const FOCALS_PX: [f64; 2] = [800.0, 600.0];
/// Center and target of camera 2, in the frame of camera 1, meters.
pub(super) const CENTER2_M: [f64; 3] = [2.4, -0.75, 1.5];
const TARGET2_M: [f64; 3] = [0.05, -0.12, 1.5];

/// The ray through the mug's center has direction (RIGHT, −RISE / 2, 1), so the mug is on the
/// table.
pub(super) const RIGHT: f64 = 0.1;
const RISE: f64 = 0.2;
/// Range of the mug's distance, meters.
pub(super) const RANGE_M: [f64; 2] = [0.5, 2.5];
const START_M: f64 = 1.5;
/// Height of the mug if its size is fixed, meters.
const OWN_HEIGHT_M: f64 = 0.3;

const GROWTH: Choice = Choice::new(
    "size",
    "The mug",
    &[
        ("grows", "Grows with its distance"),
        ("stays", "Stays 0.30 m tall"),
    ],
);
const KNOBS: &[Knob] = knobs![GROWTH];

/// The model of `same-picture`.
pub(crate) struct SamePicture {
    settings: Settings,
    /// Distance from camera 1 along its optical axis.
    pub(super) distance_m: f64,
}

impl SamePicture {
    /// Returns whether the mug grows with its distance.
    pub(super) fn grows(&self) -> bool {
        self.settings.chosen(&GROWTH) == 0
    }

    pub(super) fn height_m(&self) -> f64 {
        match self.grows() {
            true => RISE * self.distance_m,
            false => OWN_HEIGHT_M,
        }
    }

    /// Returns a point on the mug's axis, at a fraction of its height.
    pub(super) fn on_axis(&self, share: f64) -> Point3<f64> {
        let y = -share * self.height_m();
        Point3::new(RIGHT * self.distance_m, y, self.distance_m)
    }

    pub(super) fn scene(&self) -> Result<Scene, Problem> {
        let foot_m = [RIGHT * self.distance_m, self.distance_m];
        Ok(Scene::studio(foot_m, self.height_m())?)
    }

    /// Returns camera 1 at the origin, level with the table, and camera 2 to the right above it.
    pub(super) fn cameras(&self) -> Result<[PosedCamera; 2], Problem> {
        let [first, second] = FOCALS_PX;
        let up = -Vector3::y();
        let second_from_world = look_at(&CENTER2_M.into(), &TARGET2_M.into(), &up)?;
        Ok([
            PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::centered(first, SIZE.0, SIZE.1)?,
                    SIZE.0,
                    SIZE.1,
                ),
                cam_from_world: RigidTransform::identity(),
            },
            PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::centered(second, SIZE.0, SIZE.1)?,
                    SIZE.0,
                    SIZE.1,
                ),
                cam_from_world: second_from_world,
            },
        ])
    }

    /// Returns the height of the mug's axis in photograph 1, pixels.
    pub(super) fn picture_px(&self) -> Result<f64, Problem> {
        let [camera, _] = self.cameras()?;
        let row = |share: f64| Ok::<f64, Problem>(camera.project(&self.on_axis(share))?.y);
        Ok(row(0.0)? - row(1.0)?)
    }

    /// Returns the column of the mug's center in photograph 2, pixels.
    pub(super) fn column2_px(&self) -> Result<f64, Problem> {
        Ok(self.cameras()?[1].project(&self.on_axis(0.5))?.x)
    }
}

impl Declared for SamePicture {
    const NAME: &'static str = "same-picture";
    const TITLE: &'static str = "A mug that grows along its ray";
    const HELP: &'static str = "Drag the mug along its ray, or move it with the arrow keys, and \
        compare the two photographs.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            distance_m: START_M,
        }
    }
}

impl Model for SamePicture {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let meters = format_number(self.distance_m, 2);
        let place = (RIGHT * self.distance_m, self.distance_m);
        let ranges = [RANGE_M.map(|z| RIGHT * z), RANGE_M];
        let handle = Handle::new("mug", "top", "The mug", place, ranges);
        vec![handle.told(format!("{meters} m away")).step([0.1, 0.05], 3)]
    }

    fn symbols(&self) -> Vec<Symbol> {
        let middle = self.on_axis(0.5);
        let mut symbols = vec![Symbol::point("P", "top", middle.x, middle.z)];
        if let Ok(cameras) = self.cameras() {
            let images = [("p", "first"), ("p'", "second")];
            for ((name, panel), camera) in images.into_iter().zip(cameras) {
                if let Ok(pixel) = camera.project(&middle) {
                    symbols.push(Symbol::point(name, panel, pixel.x, pixel.y));
                }
            }
        }
        symbols
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        if let Event::HandleMoved { x, y, .. } = event {
            // Nearest position on the ray, rounded to a centimeter.
            let along = (RIGHT * x + y) / (RIGHT * RIGHT + 1.0);
            let along = along.clamp(RANGE_M[0], RANGE_M[1]);
            self.distance_m = (along * 100.0).round() / 100.0;
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<SamePicture>] = &[
    Challenge {
        id: "ordinary",
        goal: "Make it an ordinary mug, 10 cm tall, in the same photograph 1.",
        hint: "It is 0.30 m tall at 1.50 m. If the height is divided by 3, what happens to the distance?",
        why: "A photograph fixes only height over distance, here 0.2. Both 0.10 m at 0.50 m and 0.30 m \
              at 1.50 m make 0.2.",
        check: |model| model.grows() && model.height_m() < 0.105,
        solution: || vec![Event::moved("mug", 0.05, 0.5)],
    },
    Challenge {
        id: "shrink",
        goal: "Let the mug keep its size, and make it 120 px tall in photograph 1.",
        hint: "Choose Stays 0.30 m tall. 120 px is 3/4 of what it was.",
        why: "Height in pixels is f H / Z: with H fixed, 3/4 of the height means 4/3 of the distance.",
        check: |model| {
            !model.grows() && (model.picture_px()).is_ok_and(|px| (px - 120.0).abs() < 1.5)
        },
        solution: || vec![Event::set(&GROWTH, "stays"), Event::moved("mug", 0.2, 2.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use epipole_scenes::Sampling;

    #[test]
    fn photograph_1_stays_the_same_and_photograph_2_does_not() {
        let mut model = SamePicture::new();
        let mut photographs = Vec::new();
        for z in [0.5, 1.13, 2.5] {
            model.update(&Event::moved("mug", RIGHT * z, z)).unwrap();
            assert_eq!(model.distance_m, z);
            assert!((model.picture_px().unwrap() - 160.0).abs() < 1e-9);
            let scene = model.scene().unwrap();
            let render =
                |camera: &PosedCamera| scene.render(camera, SIZE.0, SIZE.1, Sampling::Full);
            photographs.push(model.cameras().unwrap().map(|c| render(&c).unwrap().image));
        }
        for [first, second] in &photographs[1..] {
            assert!(*first == photographs[0][0]);
            assert!(*second != photographs[0][1]);
        }
    }

    #[test]
    fn the_mug_stays_on_its_ray() {
        let mut model = SamePicture::new();
        model.update(&Event::moved("mug", 0.25, 1.0)).unwrap();
        let Handle { x, y, .. } = model.handles().remove(0);
        assert!((x - RIGHT * y).abs() < 1e-12);
        assert_eq!(model.distance_m, 1.01);
        model.update(&Event::set(&GROWTH, "stays")).unwrap();
        assert_eq!(model.height_m(), OWN_HEIGHT_M);
    }
}
