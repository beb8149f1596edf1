//! Four corners in a photograph, the corresponding rectangle, and a ruler on its plane.

use crate::contract::{
    Challenge, Choice, Control, Data, Datum, Declared, Event, Handle, Knob, Model, PhotoSlot,
    Problem, Settings, Slider, knobs,
};
use crate::kit::corners::CORNERS;
use crate::kit::picture::{Own, Picture, slot};
use crate::kit::probe::Probe;
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use epipole::camera::{PosedCamera, look_at};
use epipole::homography::{homography_4point, transfer};
use epipole_scenes::{still_life_camera, still_life_cloth, still_life_landscape};
use image::RgbImage;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

const SOURCE: Choice = Choice::new(
    "source",
    "Image",
    &[("still-life", "Still life"), ("own", "Your photograph")],
);
const OWN: usize = 1;
const WIDTH: Slider = Slider::new("width", "Width")
    .range(5.0, 300.0, 1.0)
    .at(70.0)
    .unit("cm");
const HEIGHT: Slider = Slider::new("height", "Height")
    .range(5.0, 300.0, 1.0)
    .at(50.0)
    .unit("cm");
const KNOBS: &[Knob] = knobs![SOURCE, WIDTH, HEIGHT];

const SLOTS: &[PhotoSlot] = &[slot(1024)];
/// Minimum side of a photograph, pixels.
const MIN_SIDE_PX: u32 = 32;
/// Margin of the plane around the rectangle, relative to its larger side.
const MARGIN: f64 = 0.16;

/// Ends of the ruler, cm on the plane from corner A.
const RULER: [Probe; 2] = [
    Probe::new("from", "plane", "Ruler start")
        .digits(1)
        .told(cm_words)
        .at(12.0, 12.0),
    Probe::new("to", "plane", "Ruler end")
        .digits(1)
        .told(cm_words)
        .at(12.0, 38.0),
];

fn cm_words((x, y): (f64, f64)) -> String {
    format!("{x:.1} cm across, {y:.1} cm down")
}

/// Returns the camera of the photograph, which sees the whole cloth and the pictures on the wall.
pub(super) fn camera() -> PosedCamera {
    let (width, height) = PHOTO_SIZE;
    let eye = Point3::new(-0.42, -0.84, -1.66);
    let target = Point3::new(-0.01, -0.22, 0.1);
    PosedCamera {
        cam_from_world: look_at(&eye, &target, &Vector3::new(0.0, -1.0, 0.0))
            .expect("the table is below the camera, not above it"),
        ..still_life_camera(width, height)
    }
}

/// Returns the pixels of four visible points of the world.
fn pixels_of(points: &[Point3<f64>; 4]) -> [(f64, f64); 4] {
    let camera = camera();
    points.map(|point| {
        camera
            .project(&point)
            .map_or((0.0, 0.0), |pixel| (pixel.x, pixel.y))
    })
}

/// The model of `homography-drag`.
pub(crate) struct HomographyDrag {
    settings: Settings,
    own: Own<1>,
    corners: [Probe; 4],
    ruler: [Probe; 2],
}

impl HomographyDrag {
    /// Returns the reader's photograph, if it is shown.
    pub(super) fn own(&self) -> Option<&Picture> {
        self.own.get(0).filter(|_| self.is_own())
    }

    /// Returns whether the photograph is the reader's own, even if not chosen yet.
    pub(super) fn is_own(&self) -> bool {
        self.settings.chosen(&SOURCE) == OWN
    }

    /// Returns width and height of the photograph, pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        self.own().map_or(PHOTO_SIZE, Picture::size)
    }

    /// Returns width and height of the rectangle, cm.
    pub(super) fn sides_cm(&self) -> (f64, f64) {
        (self.settings.number(&WIDTH), self.settings.number(&HEIGHT))
    }

    /// Returns the corners in the photograph, pixels.
    pub(super) fn corners(&self) -> [Point2<f64>; 4] {
        self.corners.map(|corner| corner.point())
    }

    /// Returns the corners on the plane, cm.
    pub(super) fn rectangle(&self) -> [Point2<f64>; 4] {
        let (x, y) = self.sides_cm();
        [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)].map(|(x, y)| Point2::new(x, y))
    }

    /// Returns the visible range of the plane, cm: columns, then rows.
    pub(super) fn range_cm(&self) -> [[f64; 2]; 2] {
        let (width, height) = self.sides_cm();
        let margin = (MARGIN * width.max(height)).ceil();
        [[-margin, width + margin], [-margin, height + margin]]
    }

    /// Returns the ends of the ruler, cm.
    pub(super) fn ruler(&self) -> [Point2<f64>; 2] {
        self.ruler_probes().map(|probe| probe.point())
    }

    fn ruler_probes(&self) -> [Probe; 2] {
        self.ruler.map(|probe| probe.within(self.range_cm()))
    }

    /// Returns the homography from pixels to cm on the plane, positive in front of the horizon.
    ///
    /// # Errors
    /// A message if the corners do not determine one.
    pub(super) fn plane_from_photo(&self) -> Result<Matrix3<f64>, &'static str> {
        if self.wants_photos() {
            return Err(NO_PHOTO);
        }
        let corners = self.corners();
        let found = homography_4point(&corners, &self.rectangle());
        let homography = found.first().ok_or(IN_LINE)?;
        let depths = corners.map(|corner| (homography * corner.to_homogeneous()).z);
        match depths.iter().all(|depth| depth * depths[0] > 0.0) {
            true => Ok(homography * depths[0].signum()),
            false => Err(NOT_CONVEX),
        }
    }

    /// Returns the ends of the ruler in the photograph, pixels.
    pub(super) fn ruler_px(&self) -> Option<[Point2<f64>; 2]> {
        let photo_from_plane = self.plane_from_photo().ok()?.try_inverse()?;
        let [from, to] = self.ruler().map(|end| transfer(&photo_from_plane, &end));
        Some([from?, to?])
    }

    pub(super) fn length_cm(&self) -> f64 {
        let [from, to] = self.ruler();
        (to - from).norm()
    }

    /// Returns the distance between the points of the scene at the ends of the ruler, cm.
    pub(super) fn true_length_cm(&self) -> Option<f64> {
        if self.is_own() {
            return None;
        }
        let (scene, camera) = (still_life(), camera());
        let center = camera.center_in_world();
        let [from, to] = self
            .ruler_px()?
            .map(|pixel| scene.cast(&center, &camera.ray_in_world(&pixel)));
        Some(100.0 * (to?.point - from?.point).norm())
    }

    /// Returns the maximum distance of a corner from that of the cloth, pixels.
    pub(super) fn off_cloth_px(&self) -> Option<f64> {
        (!self.is_own()).then(|| self.off_px(&still_life_cloth()))
    }

    /// Returns the maximum distance of a corner from the image of the same corner of a rectangle in
    /// the world, pixels.
    fn off_px(&self, rectangle: &[Point3<f64>; 4]) -> f64 {
        let pairs = self.corners().into_iter().zip(pixels_of(rectangle));
        pairs
            .map(|(corner, (u, v))| (corner - Point2::new(u, v)).norm())
            .fold(0.0, f64::max)
    }

    /// Moves corners and ruler to their initial positions, for a new photograph.
    fn begin(&mut self) {
        let (width, height) = self.size();
        let places = match self.own() {
            None => pixels_of(&still_life_cloth()),
            Some(_) => [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)]
                .map(|(u, v)| (u * f64::from(width), v * f64::from(height))),
        };
        for (corner, (u, v)) in self.corners.iter_mut().zip(places) {
            *corner = corner.over((width, height));
            corner.put(u, v);
        }
        self.ruler = RULER;
    }
}

const NO_PHOTO: &str = "No photograph has been chosen yet.";
const IN_LINE: &str = "Three corners lie on one line, and no homography makes a rectangle of them.";
const NOT_CONVEX: &str =
    "The corners cross over. Put A, B, C and D around the rectangle, in order.";

impl Declared for HomographyDrag {
    const NAME: &'static str = "homography-drag";
    const TITLE: &'static str = "Four corners straighten a plane";
    const HELP: &'static str = "Drag A, B, C and D onto the corners of a rectangle, or move them with the \
        arrow keys, and set its width and height. Then drag the ends of the ruler over its plane.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            corners: CORNERS,
            ruler: RULER,
        };
        model.begin();
        model
    }
}

impl Model for HomographyDrag {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let probes = self.corners.into_iter().chain(self.ruler_probes());
        probes.map(|probe| probe.handle()).collect()
    }

    /// Returns the corners in the photograph and on the plane, and the homography between them.
    fn data(&self) -> Data {
        let mut data = Data::from([
            ("pixels", Datum::points(&self.corners())),
            ("planeCm", Datum::points(&self.rectangle())),
        ]);
        if let Ok(homography) = self.plane_from_photo() {
            data.insert("homography", Datum::matrix(&homography));
        }
        data
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.corners.iter_mut().any(|corner| corner.update(event)) {
            return Ok(());
        }
        self.ruler = self.ruler_probes();
        if self.ruler.iter_mut().any(|end| end.update(event)) {
            return Ok(());
        }
        if self.settings.update(event)? == Some(SOURCE.id) {
            self.begin();
        }
        Ok(())
    }

    fn wants_photos(&self) -> bool {
        self.is_own() && self.own.get(0).is_none()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        self.settings.choose(&SOURCE, OWN);
        self.begin();
        Ok(())
    }
}

/// Maximum distance of a corner that counts as placed correctly, pixels.
const THERE_PX: f64 = 4.0;

const CHALLENGES: &[Challenge<HomographyDrag>] = &[
    Challenge {
        id: "picture",
        goal: "Straighten the landscape on the wall. Its frame is 62 cm wide and 46 cm high.",
        hint: "A is the upper left corner of the frame, and B, C and D follow clockwise.",
        why: "Any four corners of a known rectangle give the homography of its plane, on a table or on a wall.",
        check: |model| {
            !model.is_own()
                && model.sides_cm() == (62.0, 46.0)
                && model.off_px(&still_life_landscape()) <= THERE_PX
        },
        solution: || {
            let corners = CORNERS.iter().zip(pixels_of(&still_life_landscape()));
            let moved = corners.map(|(corner, (u, v))| Event::moved(corner.id(), u, v));
            [Event::set(&WIDTH, 62.0), Event::set(&HEIGHT, 46.0)]
                .into_iter()
                .chain(moved)
                .collect()
        },
    },
    Challenge {
        id: "wrong",
        goal: "With the corners on the cloth, place the ruler so that it is wrong by 10 cm or more.",
        hint: "What does the plane show where something stands on the table?",
        why: "The homography holds for the plane alone. Whatever rises above it is drawn where its ray \
              would meet the table, stretched away from the camera.",
        check: |model| {
            let truth = model.true_length_cm();
            model.off_cloth_px().is_some_and(|off| off <= THERE_PX)
                && truth.is_some_and(|truth| (truth - model.length_cm()).abs() >= 10.0)
        },
        solution: || {
            vec![
                Event::moved("from", 37.0, 31.0),
                Event::moved("to", 56.0, 3.0),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn changed(events: &[Event]) -> HomographyDrag {
        let mut model = HomographyDrag::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn on_the_cloth_the_ruler_tells_the_true_length() {
        let model = HomographyDrag::new();
        assert!(model.off_cloth_px().unwrap() < 0.1);
        for (from, to) in [((12.0, 12.0), (12.0, 38.0)), ((10.0, 46.0), (60.0, 46.0))] {
            let model = changed(&[
                Event::moved("from", from.0, from.1),
                Event::moved("to", to.0, to.1),
            ]);
            let truth = model.true_length_cm().unwrap();
            // The corners are rounded to a tenth of a pixel, about a millimeter at the far edge.
            assert!((truth - model.length_cm()).abs() < 0.2, "{truth}");
        }
    }

    #[test]
    fn corners_in_a_line_or_out_of_order_are_named() {
        let [a, b, c, _] = HomographyDrag::new().corners();
        let middle = nalgebra::center(&a, &b);
        let flat = changed(&[Event::moved("c", middle.x, middle.y)]);
        assert!(flat.plane_from_photo().is_err() && flat.length_cm() > 0.0);
        let crossed = changed(&[Event::moved("b", c.x, c.y), Event::moved("c", b.x, b.y)]);
        assert_eq!(crossed.plane_from_photo(), Err(NOT_CONVEX));
        assert!(crossed.describe().starts_with(NOT_CONVEX));
        let one = changed(&[Event::moved("b", a.x, a.y)]);
        assert_eq!(one.plane_from_photo(), Err(IN_LINE));
    }

    #[test]
    fn an_own_photograph_has_its_own_corners_and_no_truth() {
        let mut model = HomographyDrag::new();
        model.take_photo("photo", RgbImage::new(400, 200)).unwrap();
        assert_eq!(model.corners()[2], Point2::new(300.0, 150.0));
        assert_eq!((model.true_length_cm(), model.off_cloth_px()), (None, None));
        assert!(model.plane_from_photo().is_ok() && !model.wants_photos());
        model.update(&Event::set(&SOURCE, "still-life")).unwrap();
        assert!(model.off_cloth_px().unwrap() < 0.1);
    }
}
