//! Four corners of the cloth, two vanishing points, the horizon and the focal length.

use crate::contract::{
    Challenge, Control, Data, Datum, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, knobs,
};
use crate::kit::corners::CORNERS;
use crate::kit::probe::Probe;
use crate::kit::scenes::PHOTO_SIZE;
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use epipole::math::Line2;
use epipole_scenes::still_life_cloth;
use nalgebra::{Point2, Point3, Vector2, Vector3};

const AROUND: Slider = Slider::new("around", "Walk around")
    .range(-50.0, 50.0, 1.0)
    .at(-38.0)
    .unit("°");
const HEIGHT: Slider = Slider::new("height", "Camera height")
    .range(0.2, 1.0, 0.02)
    .at(0.6)
    .digits(2)
    .unit("m");
const FOCAL: Slider = Slider::new("focal", "Focal length")
    .range(500.0, 840.0, 20.0)
    .at(700.0)
    .unit("px");
const KNOBS: &[Knob] = knobs![AROUND, HEIGHT, FOCAL];

/// Point of the table at which the camera looks and around which it moves, and its distance,
/// meters.
const MIDDLE: [f64; 3] = [0.13, -0.08, -0.05];
const RADIUS_M: f64 = 1.4;
/// A point on the rim of the vase, world, meters.
const RIM: [f64; 3] = [0.045, -0.34, 0.215];

/// The model of `vanishing-points`.
pub(crate) struct VanishingPoints {
    settings: Settings,
    /// Offsets of the corners from those of the cloth, pixels.
    offsets: [Vector2<f64>; 4],
}

impl VanishingPoints {
    pub(super) fn focal_px(&self) -> f64 {
        self.settings.number(&FOCAL)
    }

    pub(super) fn height_m(&self) -> f64 {
        self.settings.number(&HEIGHT)
    }

    pub(super) fn camera(&self) -> PosedCamera {
        let (width, height) = PHOTO_SIZE;
        let (sin, cos) = libm::sincos(self.settings.number(&AROUND).to_radians());
        let middle = Point3::from(MIDDLE);
        let eye = Point3::new(
            middle.x + RADIUS_M * sin,
            -self.height_m(),
            middle.z - RADIUS_M * cos,
        );
        let up = Vector3::new(0.0, -1.0, 0.0);
        PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::centered(self.focal_px(), width, height)
                    .expect("the focal is positive"),
                width,
                height,
            ),
            cam_from_world: look_at(&eye, &middle, &up).expect("the camera is beside the table"),
        }
    }

    /// Returns the handles of the corners.
    fn probes(&self) -> [Probe; 4] {
        let camera = self.camera();
        let cloth = still_life_cloth();
        std::array::from_fn(|index| {
            let corner = camera.project(&cloth[index]).unwrap_or_default();
            let offset = self.offsets[index];
            let mut probe = CORNERS[index].over(PHOTO_SIZE).at(corner.x, corner.y);
            if offset != Vector2::zeros() {
                probe.put(corner.x + offset.x, corner.y + offset.y);
            }
            probe
        })
    }

    /// Returns the corners, pixels.
    pub(super) fn corners(&self) -> [Point2<f64>; 4] {
        self.probes().map(|probe| probe.point())
    }

    /// Returns the two pairs of opposite sides: AB with DC, and AD with BC; `None` if two corners
    /// coincide.
    pub(super) fn sides(&self) -> Option<[[Line2; 2]; 2]> {
        let [a, b, c, d] = self.corners();
        let line = |from, to| Line2::through(from, to).ok();
        Some([
            [line(&a, &b)?, line(&d, &c)?],
            [line(&a, &d)?, line(&b, &c)?],
        ])
    }

    /// Returns the vanishing points, homogeneous.
    pub(super) fn vanishing_points(&self) -> Option<[Vector3<f64>; 2]> {
        let meet = |[one, two]: [Line2; 2]| one.homogeneous().cross(&two.homogeneous());
        self.sides().map(|sides| sides.map(meet))
    }

    /// Returns the line through both vanishing points.
    pub(super) fn horizon(&self) -> Option<Line2> {
        let [first, second] = self.vanishing_points()?;
        Line2::from_homogeneous(&first.cross(&second)).ok()
    }

    /// Returns the focal length for which the two directions are perpendicular, pixels; `None` if
    /// there is none.
    pub(super) fn found_focal_px(&self) -> Option<f64> {
        let middle = self.camera().camera.intrinsics.principal_point();
        let [first, second] = self.vanishing_points()?.map(pixel);
        let focal_sq = -(first? - middle).dot(&(second? - middle));
        (focal_sq > 0.0).then(|| libm::sqrt(focal_sq))
    }

    /// Returns the distance of the rim of the vase from the horizon, pixels, positive below it.
    pub(super) fn rim_below_px(&self) -> Option<f64> {
        let (horizon, rim) = (self.horizon()?, self.camera().project(&RIM.into()).ok()?);
        // Makes the line's normal point down.
        let sign = if horizon.b > 0.0 { 1.0 } else { -1.0 };
        Some(sign * horizon.signed_distance(&rim))
    }

    /// Returns the maximum distance of a corner from that of the cloth, pixels.
    pub(super) fn moved_px(&self) -> f64 {
        let camera = self.camera();
        let pairs = self.corners().into_iter().zip(still_life_cloth());
        let moved = pairs.map(|(corner, point)| {
            let exact = camera.project(&point).unwrap_or_default();
            (corner - exact).norm()
        });
        moved.fold(0.0, f64::max)
    }
}

/// Returns the pixel of a homogeneous point; `None` at infinity.
pub(super) fn pixel(point: Vector3<f64>) -> Option<Point2<f64>> {
    /// Distance beyond which lines are treated as parallel, pixels.
    const FAR_PX: f64 = 1e6;
    let pixel = Point2::new(point.x / point.z, point.y / point.z);
    (pixel.coords.amax() < FAR_PX).then_some(pixel)
}

impl Declared for VanishingPoints {
    const NAME: &'static str = "vanishing-points";
    const TITLE: &'static str = "Where parallels meet";
    const HELP: &'static str = "Walk around the table and change height and focal length with the sliders. \
        Drag the corners A to D, or move them with the arrow keys, and watch the vanishing points.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            offsets: [Vector2::zeros(); 4],
        }
    }
}

impl Model for VanishingPoints {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        self.probes().iter().map(Probe::handle).collect()
    }

    /// Returns the corners and the camera.
    fn data(&self) -> Data {
        Data::from([
            ("pixels", Datum::points(&self.corners())),
            ("camera", Datum::camera(&self.camera())),
        ])
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        let before = self.probes();
        for (index, mut probe) in before.into_iter().enumerate() {
            if probe.update(event) {
                let moved = probe.point() - before[index].point();
                self.offsets[index] += moved;
            }
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<VanishingPoints>] = &[
    Challenge {
        id: "rim",
        goal: "Leave the corners on the cloth, and bring the horizon to the rim of the vase.",
        hint: "Which slider moves the horizon up and down behind the vase?",
        why: "The horizon is at the height of the camera: it cuts everything that is as high above the table \
              as the camera itself. So the vase is 34 cm high.",
        check: |model| {
            let off = model.rim_below_px();
            model.moved_px() < 0.1 && off.is_some_and(|off| off.abs() <= 6.0)
        },
        solution: || vec![Event::set(&HEIGHT, 0.34)],
    },
    Challenge {
        id: "fragile",
        goal: "Move one corner by 3 px or less, so that the focal length is wrong by more than 100 px.",
        hint: "From where do two sides of the cloth stay nearly parallel in the photograph?",
        why: "If a pair of sides is nearly parallel in the image, a pixel moves their vanishing point by \
              thousands, and the focal length goes with it.",
        check: |model| {
            let moved = model.moved_px();
            let off = model
                .found_focal_px()
                .map(|focal| (focal - model.focal_px()).abs());
            moved > 0.0 && moved <= 3.0 && off.is_none_or(|off| off > 100.0)
        },
        solution: || {
            let mut model = VanishingPoints::new();
            let around = Event::set(&AROUND, 0.0);
            let _ = model.update(&around);
            let [a, ..] = model.corners();
            vec![around, Event::moved("a", a.x, a.y + 2.5)]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(events: &[Event]) -> VanishingPoints {
        let mut model = VanishingPoints::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn exact_corners_tell_the_exact_focal_length_from_everywhere() {
        for (around, height, focal) in [(-38.0, 0.6, 700.0), (30.0, 0.9, 500.0), (45.0, 0.3, 840.0)]
        {
            let model = changed(&[
                Event::set(&AROUND, around),
                Event::set(&HEIGHT, height),
                Event::set(&FOCAL, focal),
            ]);
            assert!((model.found_focal_px().unwrap() - focal).abs() < 1e-6);
        }
    }

    /// Asserts that the horizon passes through far points at the height of the camera.
    #[test]
    fn the_horizon_is_at_the_height_of_the_camera() {
        let model = changed(&[Event::set(&HEIGHT, 0.5), Event::set(&AROUND, 20.0)]);
        let horizon = model.horizon().unwrap();
        for (x, z) in [(-0.5, 1.0), (0.3, 0.4), (1.2, 0.9)] {
            let pixel = model.camera().project(&Point3::new(x, -0.5, z)).unwrap();
            assert!(horizon.signed_distance(&pixel).abs() < 1e-6);
        }
    }

    #[test]
    fn the_whole_cloth_is_in_every_photograph() {
        for around in [AROUND.min, -20.0, 0.0, 20.0, AROUND.max] {
            for height in [HEIGHT.min, HEIGHT.max] {
                let model = changed(&[
                    Event::set(&AROUND, around),
                    Event::set(&HEIGHT, height),
                    Event::set(&FOCAL, FOCAL.max),
                ]);
                for corner in model.corners() {
                    assert!(
                        corner.x > 0.0 && corner.x < 639.0,
                        "{around} {height} {corner}"
                    );
                    assert!(
                        corner.y > 0.0 && corner.y < 479.0,
                        "{around} {height} {corner}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_moved_corner_stays_moved_when_the_camera_walks() {
        let mut model = VanishingPoints::new();
        let [a, ..] = model.corners();
        model.update(&Event::moved("a", a.x + 10.0, a.y)).unwrap();
        assert!((model.moved_px() - 10.0).abs() < 0.1);
        let exact = VanishingPoints::new().found_focal_px().unwrap();
        assert!((model.found_focal_px().unwrap() - exact).abs() > 5.0);
        model.update(&Event::set(&AROUND, 0.0)).unwrap();
        assert!((model.moved_px() - 10.0).abs() < 0.1);
    }
}
