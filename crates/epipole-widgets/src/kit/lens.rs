//! How a reader sees a scene in three dimensions: the camera behind a space, in CSS pixels for a view,
//! in the panel's own degrees for a model whose things are moved in the space itself.

use crate::kit::orbit::{HALF_RISE_DEG, HALF_TURN_DEG, Orbit};
use epipole::camera::{Intrinsics, PosedCamera, look_at};
use nalgebra::{Point2, Point3, Vector3};

/// How far the reader stands off at zoom 1, in radii of the scene.
const DISTANCE: f64 = 2.6;
/// Share of the panel's shorter side that the scene fills at zoom 1.
const FILL: f64 = 0.94;
/// Nothing nearer to the reader than this is seen, in radii of the scene.
const NEAREST: f64 = 0.02;

/// The ball that the reader looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Subject {
    /// Its middle.
    pub(crate) middle: Point3<f64>,
    /// Its radius, > 0.
    pub(crate) radius: f64,
}

/// A scene as it is seen from somewhere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lens {
    pub(crate) eye: PosedCamera,
    /// From the eye to the middle of the scene.
    pub(crate) distance: f64,
    /// Nothing nearer is seen.
    pub(crate) nearest: f64,
}

impl Lens {
    /// For a panel of this size; `None` if there is no room, or the subject is nowhere.
    ///
    /// * `size`: width and height of the panel, in any unit
    /// * `units`: units of the result for a unit of the size, across and down
    /// * `middle`: where the middle of the scene is, in units of the result
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
                intrinsics: Intrinsics::new(focal * units.0, focal * units.1, middle.0, middle.1)
                    .ok()?,
                cam_from_world: look_at(&at, &subject.middle, &up).ok()?,
            },
            distance,
            nearest: NEAREST * subject.radius,
        })
    }

    /// In degrees of the panel of [`Orbit::panel`], which is so many times as tall as broad.
    pub(crate) fn of_panel(aspect: f64, orbit: &Orbit, subject: &Subject) -> Option<Self> {
        let units = (2.0 * HALF_TURN_DEG, 2.0 * HALF_RISE_DEG / aspect);
        Self::new((1.0, aspect), units, orbit.middle(), orbit, subject)
    }

    /// Where a point of the eye's own frame is seen, and how far away it is; `None` behind the eye.
    pub(crate) fn shown(&self, in_eye: &Point3<f64>) -> Option<((f64, f64), f64)> {
        if in_eye.z.is_nan() || in_eye.z < self.nearest {
            return None;
        }
        let place = self.eye.intrinsics.project(in_eye).ok()?;
        let finite = place.x.is_finite() && place.y.is_finite();
        finite.then_some(((place.x, place.y), in_eye.z))
    }

    /// Where a point is seen.
    pub(crate) fn place(&self, point: &Point3<f64>) -> Option<(f64, f64)> {
        let shown = self.shown(&(self.eye.cam_from_world * point));
        shown.map(|(place, _)| place)
    }

    /// Where on the level plane at the height `y` a place is that is seen here; `None` above its
    /// horizon.
    pub(crate) fn on_level(&self, (u, v): (f64, f64), y: f64) -> Option<Point3<f64>> {
        let (eye, ray) = self.ray((u, v));
        let along = (y - eye.y) / ray.y;
        (along.is_finite() && along > 0.0).then(|| eye + ray * along)
    }

    /// How far along a ray the point is that is seen nearest to a place: `from + along · towards`.
    /// `None` if the eye looks along the ray.
    pub(crate) fn along(
        &self,
        (u, v): (f64, f64),
        from: &Point3<f64>,
        towards: &Vector3<f64>,
    ) -> Option<f64> {
        let (eye, ray) = self.ray((u, v));
        // Both directions are square to the shortest connection of the two lines.
        let square = ray.cross(towards).cross(&ray);
        let along = square.dot(&(eye - from)) / square.dot(towards);
        along.is_finite().then_some(along)
    }

    fn ray(&self, (u, v): (f64, f64)) -> (Point3<f64>, Vector3<f64>) {
        let eye = self.eye.center_in_world();
        (eye, self.eye.ray_in_world(&Point2::new(u, v)).normalize())
    }
}

/// Where a handle of a panel of [`Lens::of_panel`] may be: a little off its edge.
pub(crate) const ACROSS: [f64; 2] = [8.0 - HALF_TURN_DEG, HALF_TURN_DEG - 8.0];
/// The same from top to bottom.
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
        // Level with the plane it is seen edge-on.
        let level = Lens::of_panel(0.6, &Orbit::new(0.0, 0.0), &SUBJECT).unwrap();
        assert!(level.on_level((10.0, 0.0), SUBJECT.middle.y).is_none());
    }
}
