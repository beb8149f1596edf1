//! Two cameras, a plane of the scene with its homography, and the parallax of a point.

use crate::contract::{
    Challenge, Choice, Control, Data, Datum, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, Symbol, Toggle, knobs,
};
use crate::kit::geometry::{Geometry, symbols};
use crate::kit::probe::{Probe, place_words};
use crate::kit::scenes::{
    PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture, still_life, still_life_pair,
};
use epipole::camera::{PosedCamera, relative_motion};
use epipole::homography::{homography_from_motion, transfer};
use epipole_scenes::{Transfer, still_life_cloth, still_life_landscape};
use nalgebra::{Matrix3, Point2, Point3, Vector3};

const PLANE: Choice = Choice::new(
    "plane",
    "Plane",
    &[
        ("table", "Table"),
        ("pictures", "Pictures"),
        ("infinity", "At infinity"),
    ],
);
const BASELINE: Slider = Slider::new("baseline", "Step right")
    .range(0.0, 0.6, 0.02)
    .at(0.3)
    .digits(2)
    .unit("m");
const FORWARD: Slider = Slider::new("forward", "Step ahead")
    .range(-0.4, 0.4, 0.02)
    .at(0.0)
    .digits(2)
    .unit("m");
const TURN: Slider = Slider::new("turn", "Turn camera 2")
    .range(-10.0, 20.0, 1.0)
    .at(10.0)
    .unit("°");
const SHOW: Choice = Choice::new(
    "show",
    "On the right",
    &[("second", "Image 2"), ("warped", "Image 1 by H")],
);
const MANY: Toggle = Toggle::new("many", "Many points");
const KNOBS: &[Knob] = knobs![PLANE, SHOW, BASELINE, FORWARD, TURN, MANY];

/// Initially on the rim of the vase.
const POINT: Probe = Probe::new("p", "first", "Point p in image 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .digits(1)
    .told(|place| place_words(place, 1))
    .at(332.0, 130.0);
/// Columns and rows of the grid of points.
const MANY_POINTS: (u32, u32) = (14, 10);

/// Plane of the scene whose homography is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    Table,
    Pictures,
    Infinity,
}

/// A point of image 1 with its prediction by the homography and its true match.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parallax {
    pub(super) predicted: Point2<f64>,
    pub(super) pixel2: Point2<f64>,
    /// Whether the point is visible in photograph 2: neither hidden nor outside.
    pub(super) is_seen: bool,
    /// The point, world, meters.
    pub(super) point: Point3<f64>,
}

impl Parallax {
    pub(super) fn length_px(&self) -> f64 {
        (self.pixel2 - self.predicted).norm()
    }
}

/// The model of `plane-or-not`.
pub(crate) struct PlaneOrNot {
    settings: Settings,
    point: Probe,
}

impl PlaneOrNot {
    pub(super) fn plane(&self) -> Plane {
        [Plane::Table, Plane::Pictures, Plane::Infinity][self.settings.chosen(&PLANE)]
    }

    pub(super) fn is_warped(&self) -> bool {
        self.settings.chosen(&SHOW) == 1
    }

    pub(super) fn point(&self) -> Point2<f64> {
        self.point.point()
    }

    pub(super) fn cameras(&self) -> [PosedCamera; 2] {
        let number = |slider| self.settings.number(slider);
        still_life_pair(
            PHOTO_SIZE,
            number(&BASELINE),
            number(&FORWARD),
            number(&TURN),
        )
    }

    /// Returns the epipolar geometry; `None` while both cameras are at the same position.
    pub(super) fn geometry(&self) -> Option<Geometry> {
        Geometry::of(&self.cameras())
    }

    /// Returns the plane's unit normal toward camera 1 and one of its points, world, meters; `None`
    /// for the plane at infinity.
    fn plane_in_world(&self) -> Option<(Vector3<f64>, Point3<f64>)> {
        let [one, two, three, _] = match self.plane() {
            Plane::Table => still_life_cloth(),
            Plane::Pictures => still_life_landscape(),
            Plane::Infinity => return None,
        };
        let normal = (two - one).cross(&(three - one)).normalize();
        let toward = self.cameras()[0].center_in_world() - one;
        Some((normal * normal.dot(&toward).signum(), one))
    }

    /// Returns the homography of the plane, from image 1 to image 2.
    pub(super) fn homography(&self) -> Matrix3<f64> {
        let [first, second] = self.cameras();
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        let (normal, distance) = match self.plane_in_world() {
            Some((normal, on_plane)) => {
                let distance = normal.dot(&(first.center_in_world() - on_plane));
                (first.cam_from_world.rotation * normal, distance)
            }
            None => (-Vector3::z(), f64::INFINITY),
        };
        let [k1, k2] = [first, second].map(|camera| camera.camera.intrinsics);
        homography_from_motion(&motion, &normal, distance, &k1, &k2)
    }

    /// Returns prediction and match of a pixel of image 1; `None` if camera 1 sees no surface or
    /// the point is behind camera 2.
    pub(super) fn parallax(&self, pixel1: &Point2<f64>) -> Option<Parallax> {
        let [first, second] = self.cameras();
        let (pixel2, point, is_visible) = match still_life().transfer(&first, &second, pixel1) {
            Transfer::Visible { pixel2, x_in_world } => (pixel2, x_in_world, true),
            Transfer::Occluded {
                pixel2, x_in_world, ..
            } => (pixel2, x_in_world, false),
            Transfer::BehindCamera { .. } | Transfer::Nothing => return None,
        };
        Some(Parallax {
            predicted: transfer(&self.homography(), pixel1)?,
            pixel2,
            is_seen: is_visible && in_picture(&pixel2),
            point,
        })
    }

    /// Returns the distance of a point from the plane, toward camera 1, meters; `None` at infinity.
    pub(super) fn height_m(&self, point: &Point3<f64>) -> Option<f64> {
        let (normal, on_plane) = self.plane_in_world()?;
        Some(normal.dot(&(point - on_plane)))
    }

    /// Returns the points of the grid visible in photograph 2, with their parallax, if the reader
    /// has turned them on.
    pub(super) fn many(&self) -> Vec<Parallax> {
        let (columns, rows) = match self.settings.flag(&MANY) {
            true => MANY_POINTS,
            false => (0, 0),
        };
        let along = |index: u32, count: u32, side: u32| {
            (f64::from(index) + 0.5) / f64::from(count) * f64::from(side) - 0.5
        };
        let pixels = (0..rows).flat_map(|row| {
            (0..columns).map(move |column| {
                Point2::new(
                    along(column, columns, PHOTO_WIDTH),
                    along(row, rows, PHOTO_HEIGHT),
                )
            })
        });
        let found = pixels.filter_map(|pixel| self.parallax(&pixel));
        found.filter(|parallax| parallax.is_seen).collect()
    }

    /// Returns the median parallax of the grid's points, pixels; `None` without them.
    pub(super) fn median_px(&self) -> Option<f64> {
        let mut lengths: Vec<f64> = self.many().iter().map(Parallax::length_px).collect();
        lengths.sort_by(f64::total_cmp);
        lengths.get(lengths.len() / 2).copied()
    }
}

impl Declared for PlaneOrNot {
    const NAME: &'static str = "plane-or-not";
    const TITLE: &'static str = "A plane and everything else";
    const HELP: &'static str = "Drag p in image 1, or move it with the arrow keys. Choose a plane, and compare \
        where its homography puts p with where it is. Move camera 2 with the sliders.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            point: POINT,
        }
    }
}

impl Model for PlaneOrNot {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.point.handle()]
    }

    fn symbols(&self) -> Vec<Symbol> {
        let pixel1 = self.point();
        let pixel2 = self.parallax(&pixel1).map(|parallax| parallax.pixel2);
        symbols([Some(pixel1), pixel2], self.geometry().as_ref())
    }

    /// Returns the homography, the fundamental matrix and the cameras.
    fn data(&self) -> Data {
        let [first, second] = self.cameras();
        let mut data = Data::from([
            ("homography", Datum::matrix(&self.homography())),
            ("camera1", Datum::camera(&first)),
            ("camera2", Datum::camera(&second)),
        ]);
        if let Some(geometry) = self.geometry() {
            data.insert("fundamental", Datum::matrix(&geometry.fundamental));
        }
        data
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        self.point.update(event);
        Ok(())
    }
}

const CHALLENGES: &[Challenge<PlaneOrNot>] = &[
    Challenge {
        id: "turn",
        goal: "Leave p at least 20 cm above the table, keep the table's homography, and bring the parallax to 0.",
        hint: "What if camera 2 stays where camera 1 is?",
        why: "A camera that only turns gives every plane the same homography, and every point obeys it. \
              Depth has no effect without a step.",
        check: |model| {
            let parallax = model.parallax(&model.point());
            model.plane() == Plane::Table
                && parallax.is_some_and(|found| {
                    found.length_px() < 0.05
                        && model
                            .height_m(&found.point)
                            .is_some_and(|height| height >= 0.2)
                })
        },
        solution: || vec![Event::set(&BASELINE, 0.0)],
    },
    Challenge {
        id: "behind",
        goal: "With the homography of the pictures, find a place whose parallax exceeds 150 px.",
        hint: "How far from the plane can a point be?",
        why: "The parallax grows with the distance from the plane, compared with that from the camera: what \
              is near to us moves most against the far wall.",
        check: |model| {
            let parallax = model.parallax(&model.point());
            model.plane() == Plane::Pictures
                && parallax.is_some_and(|found| found.is_seen && found.length_px() > 150.0)
        },
        solution: || {
            vec![
                Event::set(&PLANE, "pictures"),
                Event::moved("p", 360.0, 470.0),
                Event::set(&BASELINE, 0.5),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(events: &[Event]) -> PlaneOrNot {
        let mut model = PlaneOrNot::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn points_of_the_plane_have_no_parallax() {
        for (plane, corners) in [
            ("table", still_life_cloth()),
            ("pictures", still_life_landscape()),
        ] {
            let model = changed(&[Event::set(&FORWARD, 0.2), Event::set(&PLANE, plane)]);
            // A point on a visible edge.
            let [_, _, near_right, near_left] = corners;
            let point = near_left.coords.lerp(&near_right.coords, 0.3).into();
            let [first, second] = model
                .cameras()
                .map(|camera| camera.project(&point).unwrap());
            let predicted = transfer(&model.homography(), &first).unwrap();
            assert!(
                (predicted - second).norm() < 1e-6,
                "{plane}: {predicted} {second}"
            );
        }
    }

    /// Asserts H&Z 13.2: prediction and match are on one epipolar line for any plane.
    #[test]
    fn parallax_is_along_epipolar_lines() {
        for plane in ["table", "pictures", "infinity"] {
            let model = changed(&[Event::set(&PLANE, plane), Event::set(&FORWARD, -0.2)]);
            let geometry = model.geometry().unwrap();
            for (u, v) in [(332.0, 130.0), (450.0, 350.0), (90.0, 330.0)] {
                let pixel1 = Point2::new(u, v);
                let found = model.parallax(&pixel1).unwrap();
                let line = geometry.line2(&pixel1).unwrap();
                assert!(found.length_px() > 1.0);
                for pixel in [found.predicted, found.pixel2] {
                    assert!(line.signed_distance(&pixel).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn a_camera_that_only_turns_has_no_parallax_anywhere() {
        let model = changed(&[Event::set(&BASELINE, 0.0), Event::set(&MANY, true)]);
        assert!(model.geometry().is_none());
        let many = model.many();
        assert!(many.len() > 60);
        assert!(many.iter().all(|found| found.length_px() < 1e-6));
    }

    #[test]
    fn heights_are_above_the_plane() {
        let model = PlaneOrNot::new();
        let rim = model.parallax(&model.point()).unwrap();
        let height = model.height_m(&rim.point).unwrap();
        assert!((height - 0.34).abs() < 0.02, "{height}");
    }
}
