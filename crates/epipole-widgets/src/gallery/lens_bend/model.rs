//! A lens, the reader's guess for it, and straight edges of the scene through both.

use crate::contract::{
    Challenge, Control, Declared, Event, Knob, Model, Problem, Settings, Slider, knobs,
};
use epipole::camera::{Camera, Distortion, Intrinsics, PosedCamera};
use epipole::math::Line2;
use epipole_scenes::{still_life_camera, still_life_cloth, still_life_landscape};
use nalgebra::{Point2, Point3};

/// Size of the photograph, pixels, and its focal length.
pub(super) const SIZE: (u32, u32) = (400, 300);
const FOCAL_PX: f64 = 300.0;
/// Size of the wider photograph without distortion, from which the other is made; it has the same
/// focal length.
pub(super) const SHARP_SIZE: (u32, u32) = (580, 436);

const K1: Slider = Slider::new("k1", "Lens k₁")
    .range(-0.2, 0.2, 0.01)
    .at(-0.18)
    .digits(2);
const K2: Slider = Slider::new("k2", "Lens k₂")
    .range(-0.04, 0.04, 0.01)
    .at(0.0)
    .digits(2)
    .more();
const GUESS1: Slider = Slider::new("guess1", "Your k₁")
    .range(-0.2, 0.2, 0.01)
    .at(0.0)
    .digits(2);
const GUESS2: Slider = Slider::new("guess2", "Your k₂")
    .range(-0.04, 0.04, 0.01)
    .at(0.0)
    .digits(2)
    .more();
const KNOBS: &[Knob] = knobs![K1, GUESS1, K2, GUESS2];

/// Points along each edge.
const NUM_POINTS: usize = 25;
/// Maximum bend of an edge that counts as straight, pixels.
const STRAIGHT_PX: f64 = 0.3;

/// An edge of the scene, as a polyline in pixels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Edge(pub(super) Vec<Point2<f64>>);

impl Edge {
    /// Returns the maximum distance of its points from the line through its ends, pixels.
    pub(super) fn bend_px(&self) -> f64 {
        let (Some(first), Some(last)) = (self.0.first(), self.0.last()) else {
            return 0.0;
        };
        let Ok(chord) = Line2::through(first, last) else {
            return 0.0;
        };
        let distances = self
            .0
            .iter()
            .map(|point| chord.signed_distance(point).abs());
        distances.fold(0.0, f64::max)
    }
}

/// Returns straight edges of the scene, meters: the landscape's frame below and on the left, a
/// frame on the right, the table in front, the cloth on the left.
fn edges() -> [[Point3<f64>; 2]; 5] {
    let [upper_left, _, lower_right, lower_left] = still_life_landscape();
    let [far_left, _, _, near_left] = still_life_cloth();
    let at = Point3::new;
    [
        [lower_left, lower_right],
        [upper_left, lower_left],
        [at(1.04, -0.72, 1.022), at(1.04, -0.2, 1.022)],
        [at(-0.45, 0.0, -0.64), at(0.5, 0.0, -0.64)],
        [far_left, near_left],
    ]
}

/// Returns the camera without distortion, for a photograph of this size.
pub(super) fn camera((width, height): (u32, u32)) -> PosedCamera {
    PosedCamera {
        camera: Camera::pinhole(intrinsics((width, height)), width, height),
        ..still_life_camera(width, height)
    }
}

/// Returns the intrinsics for a photograph of this size.
pub(super) fn intrinsics((width, height): (u32, u32)) -> Intrinsics {
    Intrinsics::centered(FOCAL_PX, width, height).expect("the focal length is positive")
}

/// Returns the pixel of a ray (x, y, 1) without distortion.
pub(super) fn pixel(ray: &Point2<f64>, intrinsics: &Intrinsics) -> Point2<f64> {
    ray * intrinsics.fu_px() + intrinsics.principal_point().coords
}

/// Returns the ray (x, y, 1) of a pixel without distortion.
pub(super) fn ray(pixel: &Point2<f64>, intrinsics: &Intrinsics) -> Point2<f64> {
    intrinsics.ray(pixel).xy().into()
}

/// The model of `lens-bend`.
pub(crate) struct LensBend {
    settings: Settings,
}

impl LensBend {
    pub(super) fn lens(&self) -> Distortion {
        radial(self.settings.number(&K1), self.settings.number(&K2))
    }

    pub(super) fn guess(&self) -> Distortion {
        radial(self.settings.number(&GUESS1), self.settings.number(&GUESS2))
    }

    /// Returns the ratio of a corner's distances from the center of the photograph, with and
    /// without distortion.
    pub(super) fn corner_factor(&self) -> f64 {
        let (width, height) = SIZE;
        let ray = Point2::new(f64::from(width) / 2.0, f64::from(height) / 2.0) / FOCAL_PX;
        self.lens().distort(&ray).coords.norm() / ray.coords.norm()
    }

    /// Returns the edges distorted by the lens.
    pub(super) fn bent(&self) -> Vec<Edge> {
        let (lens, intrinsics) = (self.lens(), intrinsics(SIZE));
        let cam_from_world = camera(SIZE).cam_from_world;
        let bent = edges().map(|[from, to]| {
            let points = (0..NUM_POINTS).map(|index| {
                let share = index as f64 / (NUM_POINTS - 1) as f64;
                let point = Point3::from(from.coords.lerp(&to.coords, share));
                let in_cam = cam_from_world * point;
                let ray = Point2::new(in_cam.x / in_cam.z, in_cam.y / in_cam.z);
                pixel(&lens.distort(&ray), &intrinsics)
            });
            Edge(points.collect())
        });
        bent.into()
    }

    /// Returns the edges undistorted by the reader's guess.
    pub(super) fn corrected(&self) -> Vec<Edge> {
        let (guess, intrinsics) = (self.guess(), intrinsics(SIZE));
        let straighten = |point: &Point2<f64>| {
            let straight = guess.undistort(&ray(point, &intrinsics));
            straight.ok().map(|ray| pixel(&ray, &intrinsics))
        };
        let corrected = |edge: &Edge| Edge(edge.0.iter().filter_map(straighten).collect());
        self.bent().iter().map(corrected).collect()
    }
}

fn radial(k1: f64, k2: f64) -> Distortion {
    Distortion {
        k1,
        k2,
        ..Distortion::NONE
    }
}

/// Returns the maximum bend of some edges, pixels.
pub(super) fn worst_px(edges: &[Edge]) -> f64 {
    edges.iter().map(Edge::bend_px).fold(0.0, f64::max)
}

impl Declared for LensBend {
    const NAME: &'static str = "lens-bend";
    const TITLE: &'static str = "Straighten a bent photograph";
    const HELP: &'static str = "Bend the lens with the first slider. Then move Your k₁ until the edges on the \
        right are straight.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
        }
    }
}

impl Model for LensBend {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        Ok(())
    }
}

const CHALLENGES: &[Challenge<LensBend>] = &[
    Challenge {
        id: "straight",
        goal: "Leave the lens as it is, and straighten every edge to 0.3 px.",
        hint: "Move Your k₁ and watch Bend left.",
        why: "Straight edges stay straight in a camera without distortion. So they tell what the lens does, \
              even if nobody knows what they are: this is the plumb-line method.",
        check: |model| {
            let is_lens = model.lens() == radial(K1.default, K2.default);
            is_lens && worst_px(&model.corrected()) <= STRAIGHT_PX
        },
        solution: || vec![Event::set(&GUESS1, K1.default)],
    },
    Challenge {
        id: "second",
        goal: "Set the lens to k₁ = 0.1 and k₂ = −0.04, and straighten it to 0.3 px by k₁ alone.",
        hint: "Can one coefficient stand in for two?",
        why: "Over the radii of the picture, a smaller k₁ does nearly what both do together. Coefficients trade \
              off against each other: the same pictures, other numbers.",
        check: |model| {
            let guess = model.guess();
            model.lens() == radial(0.1, -0.04)
                && guess.k2 == 0.0
                && worst_px(&model.corrected()) <= STRAIGHT_PX
        },
        solution: || {
            vec![
                Event::set(&K1, 0.1),
                Event::set(&K2, -0.04),
                Event::set(&GUESS1, 0.07),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(events: &[Event]) -> LensBend {
        let mut model = LensBend::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn the_lens_bends_and_its_own_coefficients_straighten() {
        for (k1, k2) in [(-0.18, 0.0), (0.15, 0.02), (-0.1, -0.03)] {
            let model = changed(&[
                Event::set(&K1, k1),
                Event::set(&K2, k2),
                Event::set(&GUESS1, k1),
                Event::set(&GUESS2, k2),
            ]);
            assert!(worst_px(&model.bent()) > 1.0);
            assert!(worst_px(&model.corrected()) < 1e-6);
        }
        let none = changed(&[Event::set(&K1, 0.0)]);
        assert!(worst_px(&none.bent()) < 1e-9 && none.corner_factor() == 1.0);
    }

    #[test]
    fn every_edge_is_in_the_photograph() {
        for edge in changed(&[Event::set(&K1, 0.0)]).bent() {
            for point in edge.0 {
                assert!((0.0..400.0).contains(&point.x), "{point}");
                assert!((0.0..300.0).contains(&point.y), "{point}");
            }
        }
    }
}
