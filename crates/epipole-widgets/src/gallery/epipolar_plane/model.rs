//! Positions of both cameras and of P, in world coordinates: moving a camera leaves P in place, and
//! sliding P keeps its ray.

use super::scenery::{CAMERA_Y_M, Scenery, camera, surface};
use crate::contract::{
    Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    Space, Symbol, format_number, knobs,
};
use crate::kit::geometry::symbols;
use crate::kit::lens::{ACROSS, DOWN, Lens, Subject};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::probe::{Probe, place_words};
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture};
use epipole::camera::PosedCamera;
use epipole::epipolar::Epipole;
use nalgebra::{Point2, Point3};

/// The highlighted element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lit {
    Point,
    Baseline,
    Plane,
    Line,
    Epipole,
}

const ALL: [Lit; 5] = [
    Lit::Point,
    Lit::Baseline,
    Lit::Plane,
    Lit::Line,
    Lit::Epipole,
];
const SHOW: Choice = Choice::new(
    "show",
    "Light up",
    &[
        ("point", "P, p and p′"),
        ("baseline", "Baseline"),
        ("plane", "Epipolar plane"),
        ("line", "Epipolar lines"),
        ("epipole", "Epipoles"),
    ],
)
.at(2);

const DEPTHS_M: [f64; 2] = [0.5, 3.0];
const DEPTH: Slider = Slider::new("depth", "Depth of P")
    .range(DEPTHS_M[0], DEPTHS_M[1], 0.01)
    .at(1.64)
    .digits(2)
    .unit("m");
const fn sideways(id: &'static str, label: &'static str) -> Slider {
    let slider = Slider::new(id, label).range(-0.9, 0.9, 0.02);
    slider.digits(2).unit("m").more()
}
const fn forward(id: &'static str, label: &'static str) -> Slider {
    let slider = Slider::new(id, label).range(-1.9, -0.7, 0.02);
    slider.digits(2).unit("m").at(-1.3).more()
}
const X1: Slider = sideways("x1", "Camera 1 sideways").at(-0.5);
const Z1: Slider = forward("z1", "Camera 1 forward");
const X2: Slider = sideways("x2", "Camera 2 sideways").at(0.56);
const Z2: Slider = forward("z2", "Camera 2 forward");
const CAMERAS: [[&Slider; 2]; 2] = [[&X1, &Z1], [&X2, &Z2]];

/// Pixel of p at the start, on the mug.
const START_PX: Point2<f64> = Point2::new(410.0, 306.0);
/// Limit of the coordinates of P, ± meters; the lower end represents the initial value.
const REACH_M: f64 = 8.0;
const fn coordinate(id: &'static str, label: &'static str) -> Slider {
    let slider = Slider::new(id, label).range(-REACH_M, REACH_M, 1e-4);
    slider.at(-REACH_M).digits(4).unit("m").hidden()
}
const PX: Slider = coordinate("px", "P to the right");
const PY: Slider = coordinate("py", "P below table");
const PZ: Slider = coordinate("pz", "P away");
const COORDINATES: [&Slider; 3] = [&PX, &PY, &PZ];

const KNOBS: &[Knob] = knobs![DEPTH, SHOW, X1, Z1, X2, Z2, PX, PY, PZ];

/// Height over width of the 3D view, fixed because the model projects points into it.
pub(super) const SPACE_ASPECT: f64 = 0.505;
/// Center and radius of the visible scene.
pub(super) const SUBJECT: Subject = Subject {
    middle: Point3::new(0.03, -0.22, -0.67),
    radius: 0.68,
};
const PIXEL: Probe = Probe::new("p", "first", "p in photograph 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .digits(DIGITS);
const POINT: &str = "point";
const CENTERS: [&str; 2] = ["camera1", "camera2"];
/// Decimal places of positions in the photograph and in the 3D view.
const DIGITS: usize = 1;

/// The model of `epipolar-plane`.
pub(crate) struct EpipolarPlane {
    settings: Settings,
    pub(super) orbit: Orbit,
    /// Position of P at the start.
    start: Point3<f64>,
    scenery: Option<Scenery>,
}

impl EpipolarPlane {
    /// Returns the cameras, the point and the plane; never `None` for cameras within the range of
    /// their sliders.
    pub(super) fn scenery(&self) -> Option<&Scenery> {
        self.scenery.as_ref()
    }

    pub(super) fn lit(&self) -> Lit {
        ALL[self.settings.chosen(&SHOW).min(ALL.len() - 1)]
    }

    /// Returns the tilt of the plane about the baseline, degrees.
    pub(super) fn tilt_deg(&self) -> Option<f64> {
        Some(self.scenery.as_ref()?.plane?.tilt_deg())
    }

    fn center(&self, index: usize) -> (f64, f64) {
        let [x, z] = CAMERAS[index].map(|slider| self.settings.number(slider));
        (x, z)
    }

    fn cameras(&self) -> Option<[PosedCamera; 2]> {
        Some([camera(self.center(0)).ok()?, camera(self.center(1)).ok()?])
    }

    fn point(&self) -> Point3<f64> {
        let at = |index: usize| match self.settings.number(COORDINATES[index]) {
            start if start <= -REACH_M => self.start[index],
            number => number,
        };
        Point3::new(at(0), at(1), at(2))
    }

    /// Moves P to a point, unless it is not finite.
    fn put(&mut self, point: &Point3<f64>) {
        if !point.coords.iter().all(|x| x.is_finite()) {
            return;
        }
        for (index, slider) in COORDINATES.into_iter().enumerate() {
            let inside = 0.99 * REACH_M;
            let value = point[index].clamp(-inside, inside);
            self.settings.slide(slider, value);
        }
        self.compute();
    }

    /// Recomputes the scenery, and sets the depth slider to match.
    fn compute(&mut self) {
        let cameras = self.cameras();
        self.scenery = cameras.map(|cameras| Scenery::new(cameras, self.point()));
        if let Some(scenery) = &self.scenery {
            let depth_m = scenery.depth_m();
            self.settings.slide(&DEPTH, depth_m);
        }
    }

    /// Slides P along its ray to a depth, meters.
    fn slide(&mut self, depth_m: f64) {
        let Some(scenery) = &self.scenery else {
            return;
        };
        let first = &scenery.cameras[0];
        let center = first.center_in_world();
        // Behind the camera P has no pixel, so the optical axis serves as its ray.
        let ray = match scenery.depth_m() {
            depth if depth > 1e-6 => (scenery.point - center) / depth,
            _ => first.ray_in_world(&first.camera.intrinsics.principal_point()),
        };
        self.put(&(center + ray * depth_m.clamp(DEPTHS_M[0], DEPTHS_M[1])));
    }

    /// Moves P to the surface that camera 1 sees at a pixel, if any.
    fn look_at(&mut self, u: f64, v: f64) {
        let pixel = Point2::new(u, v);
        if let Some(seen) = self.cameras().and_then(|pair| surface(&pair, &pixel)) {
            self.put(&seen.point);
        }
    }

    fn lens(&self) -> Option<Lens> {
        Lens::of_panel(SPACE_ASPECT, &self.orbit, &SUBJECT)
    }

    /// Moves P or a camera as close to the pointer in the 3D view as its constraint allows.
    fn drag(&mut self, id: &str, place: (f64, f64)) {
        let Some(lens) = self.lens() else {
            return;
        };
        if let Some(index) = CENTERS.iter().position(|center| *center == id) {
            let Some(found) = lens.on_level(place, CAMERA_Y_M) else {
                return;
            };
            for (slider, value) in CAMERAS[index].into_iter().zip([found.x, found.z]) {
                self.settings.slide(slider, value);
            }
            return self.put(&self.point());
        }
        let found = self.scenery.as_ref().and_then(|scenery| {
            let center = scenery.cameras[0].center_in_world();
            let ray = (scenery.point - center) / scenery.depth_m();
            lens.along(place, &center, &ray)
        });
        if let Some(depth_m) = found {
            self.slide(depth_m);
        }
    }

    fn pixel_handle(&self, scenery: &Scenery) -> Handle {
        let middle = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) / 2.0;
        let pixel = scenery.pixels[0].unwrap_or(middle);
        let mut probe = PIXEL;
        probe.put(pixel.x, pixel.y);
        probe.handle().told(place_words((pixel.x, pixel.y), DIGITS))
    }

    fn space_handle(
        &self,
        id: &'static str,
        label: &'static str,
        text: String,
        point: &Point3<f64>,
    ) -> Handle {
        let probe = Probe::new(id, SPACE.panel, label).within([ACROSS, DOWN]);
        let mut probe = probe.step(3.0).digits(DIGITS);
        let (x, y) = (self.lens().and_then(|lens| lens.place(point))).unwrap_or_default();
        probe.put(x, y);
        probe.handle().told(text)
    }
}

impl Declared for EpipolarPlane {
    const NAME: &'static str = "epipolar-plane";
    const TITLE: &'static str = "The plane through both cameras";
    const HELP: &'static str = "Drag p over photograph 1: P lies where camera 1 looks there, and the plane \
        turns about the baseline. Drag P along its ray, or a camera, in the space; drag elsewhere in it to \
        look from another side.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-12.0, 42.0),
            start: Point3::origin(),
            scenery: None,
        };
        let seen = model.cameras().and_then(|pair| surface(&pair, &START_PX));
        model.start = seen.map_or(model.start, |seen| seen.point);
        model.compute();
        model
    }
}

impl Model for EpipolarPlane {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls_and(self.orbit.controls())
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles: Vec<Handle> = self.orbit.handles().into();
        let Some(scenery) = &self.scenery else {
            return handles;
        };
        handles.push(self.pixel_handle(scenery));
        let away = format!("{} m along the ray", format_number(scenery.depth_m(), 2));
        handles.push(self.space_handle(POINT, "P on its ray", away, &scenery.point));
        for (index, id) in CENTERS.into_iter().enumerate() {
            let (x, z) = self.center(index);
            let text = format!(
                "{} m sideways, {} m forward",
                format_number(x, 2),
                format_number(z, 2)
            );
            let center = scenery.cameras[index].center_in_world();
            let label = ["Camera 1", "Camera 2"][index];
            handles.push(self.space_handle(id, label, text, &center));
        }
        handles
    }

    fn symbols(&self) -> Vec<Symbol> {
        let Some(scenery) = &self.scenery else {
            return Vec::new();
        };
        let mut symbols = symbols(scenery.pixels, scenery.geometry.as_ref());
        let place = self.lens().and_then(|lens| lens.place(&scenery.point));
        symbols.extend(place.map(|(x, y)| Symbol::point("P", SPACE.panel, x, y)));
        symbols
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
            return Ok(());
        }
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
                // After a move of P or of a camera, all three coordinates are stored, so that a
                // permalink restores them exactly.
                let moves_camera = CAMERAS.as_flattened().iter().any(|slider| slider.id == id);
                let is_put =
                    (COORDINATES.iter()).any(|slider| self.settings.number(slider) > -REACH_M);
                if id == DEPTH.id {
                    self.slide(self.settings.number(&DEPTH));
                } else if moves_camera || is_put {
                    self.put(&self.point());
                } else {
                    self.compute();
                }
            }
            Event::HandleMoved { id, x, y } => {
                // Rounding must not move the handle if its position is unchanged.
                let stays = |handle: &Handle| handle.id == *id && (handle.x, handle.y) == (*x, *y);
                if self.handles().iter().any(stays) {
                    return Ok(());
                }
                match id == PIXEL.id() {
                    true => self.look_at(*x, *y),
                    false => self.drag(id, (*x, *y)),
                }
            }
            Event::Clicked { x, y, .. } => self.look_at(*x, *y),
            _ => {}
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<EpipolarPlane>] = &[
    Challenge {
        id: "same-plane",
        goal: "Move p′ by 100 px or more without moving the plane.",
        hint: "Which way can P go and stay in the plane?",
        why: "P slid along its ray, and the ray lies in the plane; so p′ stayed on its line, and p did not \
              move at all.",
        check: |model| {
            let (fresh, changed) = (EpipolarPlane::new(), model.scenery());
            let moved = fresh
                .scenery()
                .zip(changed)
                .and_then(|(before, now)| Some((before.pixels[1]? - now.pixels[1]?).norm()));
            let same = fresh.tilt_deg().zip(model.tilt_deg());
            let centers = |model: &EpipolarPlane| [model.center(0), model.center(1)];
            moved.is_some_and(|px| px >= 100.0)
                && same.is_some_and(|(before, now)| (before - now).abs() < 0.05)
                && centers(&fresh) == centers(model)
        },
        solution: || vec![Event::set(&DEPTH, 0.9)],
    },
    Challenge {
        id: "flat",
        goal: "Turn the plane until it is within 2° of level.",
        hint: "Which things does a level plane through the cameras meet?",
        why: "The plane turns about the baseline only, and a point at the height of both cameras holds it \
              level.",
        check: |model| model.tilt_deg().is_some_and(|tilt| tilt.abs() <= 2.0),
        solution: || vec![Event::moved(PIXEL.id(), 320.0, 88.0)],
    },
    Challenge {
        id: "epipole-inside",
        goal: "Bring the epipole e′ into photograph 2.",
        hint: "It is where camera 2 sees camera 1. Where must camera 1 stand?",
        why: "With one camera in front of the other, the baseline passes through the image, and all epipolar \
              lines radiate from that point.",
        check: |model| {
            let geometry = model.scenery().and_then(|scenery| scenery.geometry);
            geometry.is_some_and(|geometry| match geometry.epipole2 {
                Epipole::Finite(pixel) => in_picture(&pixel),
                Epipole::AtInfinity(_) => false,
            })
        },
        solution: || vec![Event::set(&X2, -0.3), Event::set(&Z1, -1.8)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::Camera;
    use epipole_scenes::{Sampling, Scene};

    fn handle(model: &EpipolarPlane, id: &str) -> Handle {
        let mut handles = model.handles().into_iter();
        handles.find(|handle| handle.id == id).unwrap()
    }

    #[test]
    fn at_first_p_is_on_the_mug_and_seen_by_both() {
        let model = EpipolarPlane::new();
        let scenery = model.scenery().unwrap();
        assert_eq!(scenery.before_surface_m(), Some(0.0));
        assert!(
            scenery
                .pixels
                .iter()
                .all(|pixel| in_picture(&pixel.unwrap()))
        );
    }

    #[test]
    fn a_camera_that_moves_leaves_p_and_p_that_slides_keeps_its_pixel() {
        let mut model = EpipolarPlane::new();
        let pixel = model.scenery().unwrap().pixels[0].unwrap();
        for step in 0..40 {
            let depth = 0.6 + 0.05 * f64::from(step);
            model.update(&Event::set(&DEPTH, depth)).unwrap();
            let now = model.scenery().unwrap().pixels[0].unwrap();
            assert!((now - pixel).norm() < 0.5, "{depth}: {now}");
            assert!((model.settings.number(&DEPTH) - depth).abs() < 1e-9);
        }
        let point = model.point();
        model.update(&Event::set(&X1, 0.1)).unwrap();
        assert_eq!(model.point(), point);
        assert!((model.scenery().unwrap().pixels[0].unwrap() - pixel).norm() > 50.0);
    }

    #[test]
    fn things_of_the_space_follow_the_pointer() {
        let mut model = EpipolarPlane::new();
        let before = handle(&model, POINT);
        let tilt = model.tilt_deg().unwrap();
        model
            .update(&Event::moved(POINT, before.x - 12.0, before.y + 8.0))
            .unwrap();
        assert!((handle(&model, POINT).x - before.x).abs() > 2.0);
        assert!((model.tilt_deg().unwrap() - tilt).abs() < 0.05);
        for id in CENTERS {
            let place = handle(&model, id);
            let (x, y) = (place.x + 10.0, place.y - 6.0);
            model.update(&Event::moved(id, x, y)).unwrap();
            let now = handle(&model, id);
            assert!(
                (now.x - x).abs() < 2.5 && (now.y - y).abs() < 2.5,
                "{id}: {now:?}"
            );
            model.update(&Event::moved(id, 1e12, -1e12)).unwrap();
            model.update(&Event::moved(POINT, -1e12, 1e12)).unwrap();
        }
    }

    #[test]
    fn no_camera_stands_inside_a_thing() {
        let ends = |slider: &Slider| [slider.min, 0.5 * (slider.min + slider.max), slider.max];
        for x in ends(&X1) {
            for z in ends(&Z1) {
                let camera = camera((x, z)).unwrap();
                let small = PosedCamera {
                    camera: Camera::pinhole(camera.camera.intrinsics.scaled(0.0125).unwrap(), 8, 6),
                    ..camera
                };
                assert!(
                    Scene::still_life()
                        .render(&small, 8, 6, Sampling::Draft)
                        .is_ok()
                );
            }
        }
    }
}
