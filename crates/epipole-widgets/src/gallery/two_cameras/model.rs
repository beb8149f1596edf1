//! Two identical cameras side by side, two identical balls, and the intersection of two rays.

use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, Symbol,
    Toggle, knobs,
};
use crate::kit::probe::Probe;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use nalgebra::{Point2, Point3};

pub(super) const FOCAL_PX: f64 = 500.0;
pub(super) const SIZE: (u32, u32) = (640, 320);
/// Principal point, pixels: round numbers, for readers who calculate along.
pub(super) const MIDDLE_PX: (f64, f64) = (320.0, 160.0);
/// Height of the balls' centers below the cameras, meters.
const BELOW_M: f64 = 0.12;
/// Disparity below which rays count as parallel, pixels.
const PARALLEL_PX: f64 = 1.0;

const BASELINE: Slider = Slider::new("baseline", "Baseline B")
    .range(0.1, 0.8, 0.05)
    .at(0.4)
    .digits(2)
    .unit("m");
const WRONG: Toggle = Toggle::new("wrong", "Take Q for P");
const KNOBS: &[Knob] = knobs![BASELINE, WRONG];
/// Range of the balls' positions, meters to the right and meters away.
const RANGES_M: [[f64; 2]; 2] = [[-1.2, 1.6], [0.7, 3.2]];

/// The balls P and Q.
const BALLS: [Probe; 2] = [
    Probe::new("point", "top", "The ball P")
        .on_plan(RANGES_M)
        .at(0.3, 2.0),
    Probe::new("other", "top", "The ball Q")
        .on_plan(RANGES_M)
        .at(-0.2, 2.6),
];

/// Intersection of the rays through two pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meeting {
    /// In front of the cameras, (x, z) meters.
    Ahead(Point2<f64>),
    /// Behind the cameras, (x, z) meters.
    Behind(Point2<f64>),
    /// No intersection: the rays are parallel.
    Nowhere,
}

/// The model of `two-cameras`.
pub(crate) struct TwoCameras {
    settings: Settings,
    balls: [Probe; 2],
}

impl TwoCameras {
    pub(super) fn baseline_m(&self) -> f64 {
        self.settings.number(&BASELINE)
    }

    pub(super) fn is_wrong(&self) -> bool {
        self.settings.flag(&WRONG)
    }

    pub(super) fn balls(&self) -> [(f64, f64); 2] {
        self.balls.map(|ball| ball.place())
    }

    /// Returns the pixel of a ball in a camera, 0 on the left and 1 on the right.
    pub(super) fn pixel(&self, camera: usize, ball: usize) -> Result<Point2<f64>, Problem> {
        let right_m = camera as f64 * self.baseline_m();
        let camera = PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::new(FOCAL_PX, FOCAL_PX, MIDDLE_PX.0, MIDDLE_PX.1)?,
                640,
                480,
            ),
            cam_from_world: RigidTransform::translation(-right_m, 0.0, 0.0),
        };
        let (x, z) = self.balls[ball].place();
        Ok(camera.project(&Point3::new(x, BELOW_M, z))?)
    }

    /// Returns the columns used as images of P, left and right.
    pub(super) fn columns(&self) -> Result<[f64; 2], Problem> {
        let taken = usize::from(self.is_wrong());
        Ok([self.pixel(0, 0)?.x, self.pixel(1, taken)?.x])
    }

    /// Returns the column in the left image minus the column in the right image, pixels.
    pub(super) fn disparity_px(&self) -> f64 {
        self.columns().map_or(0.0, |[left, right]| left - right)
    }

    /// Intersects the rays by similar triangles, `Z = f B / d`; a negative disparity gives a point
    /// behind.
    pub(super) fn meeting(&self) -> Meeting {
        let disparity_px = self.disparity_px();
        if disparity_px.abs() < PARALLEL_PX {
            return Meeting::Nowhere;
        }
        let depth_m = FOCAL_PX * self.baseline_m() / disparity_px;
        let (x, z) = self.balls[0].place();
        let point = Point2::new(x / z * depth_m, depth_m);
        match depth_m > 0.0 {
            true => Meeting::Ahead(point),
            false => Meeting::Behind(point),
        }
    }
}

impl Declared for TwoCameras {
    const NAME: &'static str = "two-cameras";
    const TITLE: &'static str = "Two photographs, one place";
    const HELP: &'static str = "Drag the balls P and Q, or move them with the arrow keys, and watch \
        their images. Then let the right camera take Q for P.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            balls: BALLS,
        }
    }
}

impl Model for TwoCameras {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        self.balls.map(|ball| ball.handle()).into()
    }

    fn symbols(&self) -> Vec<Symbol> {
        let (x, z) = self.balls[0].place();
        let mut symbols = vec![Symbol::point("P", "top", x, z)];
        let images = [
            ("p", "left", 0),
            ("p'", "right", usize::from(self.is_wrong())),
        ];
        for (camera, (name, panel, ball)) in images.into_iter().enumerate() {
            if let Ok(pixel) = self.pixel(camera, ball) {
                symbols.push(Symbol::point(name, panel, pixel.x, pixel.y));
            }
        }
        symbols
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        let _ = self.balls.iter_mut().any(|ball| ball.update(event));
        Ok(())
    }
}

const CHALLENGES: &[Challenge<TwoCameras>] = &[
    Challenge {
        id: "twice",
        goal: "Make a wrong match put P at twice its true depth.",
        hint: "Which shift belongs to twice the depth?",
        why: "Z = f B / d, so half the shift means twice the depth, and nothing in the two pixels \
              gives the mistake away.",
        check: |model| match model.meeting() {
            Meeting::Ahead(found) => {
                model.is_wrong() && (found.y / model.balls()[0].1 - 2.0).abs() < 0.1
            }
            _ => false,
        },
        solution: || vec![Event::set(&WRONG, true), Event::moved("other", 0.5, 2.0)],
    },
    Challenge {
        id: "behind",
        goal: "Make the two rays meet behind the cameras.",
        hint: "Then the right column is larger than the left one.",
        why: "A true point always lies farther left in the right image. A match that says otherwise \
              makes the rays part, and they meet behind the cameras.",
        check: |model| matches!(model.meeting(), Meeting::Behind(_)),
        solution: || vec![Event::set(&WRONG, true), Event::moved("other", 1.2, 2.0)],
    },
    Challenge {
        id: "shift",
        goal: "With the right match, make the shift 150 px. Leave P where it is.",
        hint: "Without Take Q for P, only one thing is left to move.",
        why: "The shift is f B / Z, so at the same depth it grows with the baseline.",
        check: |model| {
            !model.is_wrong()
                && model.balls()[0] == (0.3, 2.0)
                && (model.disparity_px() - 150.0).abs() < 5.0
        },
        solution: || vec![Event::set(&WRONG, false), Event::set(&BASELINE, 0.6)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::stereo::depth_from_disparity;

    #[test]
    fn the_true_match_finds_the_point_wherever_it_is() {
        let mut model = TwoCameras::new();
        for (x, z) in [(0.3, 2.0), (-1.2, 0.7), (1.6, 3.2)] {
            model.update(&Event::moved("point", x, z)).unwrap();
            let depth_m = depth_from_disparity(FOCAL_PX, 0.4, model.disparity_px()).unwrap();
            assert!((depth_m - z).abs() < 1e-9);
            let Meeting::Ahead(found) = model.meeting() else {
                panic!("it is in front")
            };
            assert!((found - Point2::new(x, z)).norm() < 1e-9);
        }
    }

    #[test]
    fn a_wrong_match_finds_a_phantom_or_nothing() {
        let mut model = TwoCameras::new();
        model.update(&Event::set(&WRONG, true)).unwrap();
        assert!(matches!(model.meeting(), Meeting::Ahead(found) if found.y < 1.5));
        // The ray through P from the left, and a parallel one from the right.
        model.update(&Event::moved("other", 0.7, 2.0)).unwrap();
        assert_eq!(model.meeting(), Meeting::Nowhere);
        model.update(&Event::moved("other", 1.2, 2.0)).unwrap();
        assert!(matches!(model.meeting(), Meeting::Behind(found) if found.y < 0.0));
    }
}
