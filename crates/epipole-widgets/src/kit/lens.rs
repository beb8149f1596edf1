//! Virtual camera of a 3D view: in CSS pixels for views, and in the panel's degrees for models
//! whose objects can be dragged in 3D.

use crate::kit::orbit::{HALF_RISE_DEG, HALF_TURN_DEG, Orbit};
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use nalgebra::{Point2, Point3, Vector3};

/// Distance of the eye at zoom 1, in radii of the scene.
const DISTANCE: f64 = 2.6;
/// Fraction of the panel's shorter side that the scene fills at zoom 1.
const FILL: f64 = 0.94;
/// Near plane, in radii of the scene.
const NEAREST: f64 = 0.02;

/// Bounding sphere of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Subject {
    /// Center, scene units.
    pub(crate) middle: Point3<f64>,
    /// Radius, > 0.
    pub(crate) radius: f64,
}

/// A virtual camera for a scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lens {
    pub(crate) eye: PosedCamera,
    /// Distance from the eye to the center of the scene.
    pub(crate) distance: f64,
    /// Distance of the near plane.
    pub(crate) nearest: f64,
}

impl Lens {
    /// Creates the camera for a panel; `None` if the panel has no size, or the subject is not
    /// finite.
    ///
    /// * `size`: width and height of the panel, in any unit
    /// * `units`: result units per unit of `size`, horizontally and vertically
    /// * `middle`: position of the scene center, in result units
    pub(crate) fn new(
        (width, height): (f64, f64),
        units: (f64, f64),
        middle: (f64, f64),
        orbit: &Orbit,
        subject: &Subject,
    ) -> Option<Self> {
        let distance = DISTANCE * subject.radius / orbit.zoom();
        let (turn, rise) = (orbit.turn_deg().to_radians(), orbit.rise_deg().to_radians());
        let level = libm::cos(rise);
        let towards_eye = Vector3::new(
            -libm::sin(turn) * level,
            -libm::sin(rise),
            -libm::cos(turn) * level,
        );
        let focal = 0.5 * FILL * width.min(height) * DISTANCE;
        let up = Vector3::new(0.0, -1.0, 0.0);
        let at = subject.middle + distance * towards_eye;
        Some(Self {
            eye: PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::new(focal * units.0, focal * units.1, middle.0, middle.1).ok()?,
                    640,
                    480,
                ),
                cam_from_world: look_at(&at, &subject.middle, &up).ok()?,
            },
            distance,
            nearest: NEAREST * subject.radius,
        })
    }

    /// Creates the camera in degrees of the panel of [`Orbit::panel`]; `aspect` is its height over
    /// width.
    pub(crate) fn of_panel(aspect: f64, orbit: &Orbit, subject: &Subject) -> Option<Self> {
        let units = (2.0 * HALF_TURN_DEG, 2.0 * HALF_RISE_DEG / aspect);
        Self::new((1.0, aspect), units, orbit.middle(), orbit, subject)
    }

    /// Projects a point of the eye's frame. Returns its position and depth; `None` if it is nearer
    /// than the near plane.
    pub(crate) fn shown(&self, in_eye: &Point3<f64>) -> Option<((f64, f64), f64)> {
        if in_eye.z.is_nan() || in_eye.z < self.nearest {
            return None;
        }
        let place = self.eye.camera.intrinsics.project(in_eye).ok()?;
        let finite = place.x.is_finite() && place.y.is_finite();
        finite.then_some(((place.x, place.y), in_eye.z))
    }

    /// Projects a point.
    pub(crate) fn place(&self, point: &Point3<f64>) -> Option<(f64, f64)> {
        let shown = self.shown(&(self.eye.cam_from_world * point));
        shown.map(|(place, _)| place)
    }

    /// Intersects the ray through a position with the horizontal plane at height `y`; `None` above
    /// its horizon.
    pub(crate) fn on_level(&self, (u, v): (f64, f64), y: f64) -> Option<Point3<f64>> {
        let (eye, ray) = self.ray((u, v));
        let along = (y - eye.y) / ray.y;
        (along.is_finite() && along > 0.0).then(|| eye + ray * along)
    }

    /// Returns the parameter of the point on a line that is closest to the viewing ray of a
    /// position: `from + along · towards`. `None` if the line is viewed end-on.
    pub(crate) fn along(
        &self,
        (u, v): (f64, f64),
        from: &Point3<f64>,
        towards: &Vector3<f64>,
    ) -> Option<f64> {
        let (eye, ray) = self.ray((u, v));
        // In the span of both directions and perpendicular to the viewing ray, hence to the
        // shortest segment.
        let square = ray.cross(towards).cross(&ray);
        let along = square.dot(&(eye - from)) / square.dot(towards);
        along.is_finite().then_some(along)
    }

    fn ray(&self, (u, v): (f64, f64)) -> (Point3<f64>, Vector3<f64>) {
        let eye = self.eye.center_in_world();
        (eye, self.eye.ray_in_world(&Point2::new(u, v)).normalize())
    }
}

/// Range of a handle's x in a panel of [`Lens::of_panel`], degrees, with a margin at the edge.
pub(crate) const ACROSS: [f64; 2] = [8.0 - HALF_TURN_DEG, HALF_TURN_DEG - 8.0];
/// Range of its y, degrees.
pub(crate) const DOWN: [f64; 2] = [5.0 - HALF_RISE_DEG, HALF_RISE_DEG - 5.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Rect;
    use crate::kit::space::Space;

    const SUBJECT: Subject = Subject {
        middle: Point3::new(0.2, -0.1, 1.0),
        radius: 1.5,
    };

    #[test]
    fn a_model_sees_things_where_the_panel_shows_them() {
        let orbit = Orbit::new(-40.0, 25.0).zoomed(1.4);
        let rect = Rect::new(10.0, 24.0, 600.0, 330.0);
        let panel = Orbit::panel(rect);
        let space = Space::new(&panel, &orbit, &SUBJECT).unwrap();
        let lens = Lens::of_panel(330.0 / 600.0, &orbit, &SUBJECT).unwrap();
        for point in [Point3::new(0.0, 0.3, 0.5), Point3::new(-0.6, -0.4, 1.7)] {
            let (shown, _) = space.place(&point).unwrap();
            let (u, v) = panel.canvas_from_world(lens.place(&point).unwrap());
            assert!((u - shown.0).abs() < 1e-9 && (v - shown.1).abs() < 1e-9);
        }
    }

    #[test]
    fn what_is_seen_at_a_place_is_found_again() {
        let lens = Lens::of_panel(0.6, &Orbit::new(30.0, 35.0), &SUBJECT).unwrap();
        let point = Point3::new(0.4, -0.25, 1.3);
        let found = lens.on_level(lens.place(&point).unwrap(), -0.25).unwrap();
        assert!((found - point).norm() < 1e-9);
        let (from, towards) = (Point3::new(-1.0, 0.5, 0.0), Vector3::new(0.7, -0.4, 0.9));
        let place = lens.place(&(from + towards * 1.25)).unwrap();
        assert!((lens.along(place, &from, &towards).unwrap() - 1.25).abs() < 1e-9);
        // At eye level the plane is seen edge-on.
        let level = Lens::of_panel(0.6, &Orbit::new(0.0, 0.0), &SUBJECT).unwrap();
        assert!(level.on_level((10.0, 0.0), SUBJECT.middle.y).is_none());
    }
}
