//! Photographs in a scene, each in the image plane of its camera. They hide the marks behind them,
//! so marks that intersect their planes are cut there.

use crate::canvas::Place;
use crate::kit::lens::Lens;
use epipole::camera::PosedCamera;
use epipole::homography::homography_from_motion;
use image::RgbImage;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// Sine of the viewing angle below which a photograph is edge-on and not drawn.
const EDGE_ON: f64 = 0.01;

/// A photograph in the frame of the reader's eye.
pub(crate) struct Standing<'a> {
    pub(crate) image: &'a RgbImage,
    pub(crate) corners: [Place; 4],
    sides: [Side; 4],
    /// Homography from CSS pixels of the page to pixels of the photograph.
    pub(crate) photo_from_page: Matrix3<f64>,
    plane: Plane,
    /// Depth of its center from the eye.
    pub(crate) depth: f64,
}

/// The plane `normal · x + distance = 0` of the eye's frame; the eye is on its positive side.
#[derive(Clone, Copy)]
struct Plane {
    normal: Vector3<f64>,
    distance: f64,
}

impl Plane {
    /// Returns the plane through a point with this normal, or its opposite.
    fn facing(normal: Vector3<f64>, point: &Point3<f64>) -> Self {
        let towards = -normal.dot(&point.coords);
        Self {
            normal: normal * towards.signum(),
            distance: towards.abs(),
        }
    }

    fn side(&self, in_eye: &Point3<f64>) -> f64 {
        self.normal.dot(&in_eye.coords) + self.distance
    }
}

/// A flat face in front of the eye, which hides the marks behind it.
pub(crate) struct Screen {
    plane: Plane,
    corners: Vec<Place>,
    sides: Vec<Side>,
}

impl Screen {
    /// Creates a convex face from its corners in the eye's frame and on the page; `None` if it has
    /// no area.
    pub(crate) fn new(in_eye: &[Point3<f64>], corners: Vec<Place>) -> Option<Self> {
        let [first, second, .., last] = in_eye else {
            return None;
        };
        let normal = (second - first)
            .cross(&(last - first))
            .try_normalize(1e-12)?;
        let plane = Plane::facing(normal, first);
        let sides = (0..corners.len()).map(|index| Side::of(&corners, index));
        Some(Self {
            plane,
            sides: sides.collect(),
            corners,
        })
    }

    /// Corners on the page, in order.
    pub(crate) fn corners(&self) -> &[Place] {
        &self.corners
    }

    /// Returns whether the face hides a point, given in the eye's frame and on the page.
    pub(crate) fn hides(&self, in_eye: &Point3<f64>, place: &[Place; 1]) -> bool {
        self.plane.side(in_eye) < 0.0 && !self.sides.iter().any(|side| side.has_beyond(place))
    }
}

impl<'a> Standing<'a> {
    /// Places the photograph of a camera `depth` in front of its center. `None` if it is not
    /// visible: edge-on, or partly behind the eye.
    pub(crate) fn new(
        lens: &Lens,
        camera: &PosedCamera,
        image: &'a RgbImage,
        depth: f64,
    ) -> Option<Self> {
        let (right, bottom) = (
            f64::from(image.width()) - 0.5,
            f64::from(image.height()) - 0.5,
        );
        let in_eye = |u: f64, v: f64| {
            let ray = camera.ray_in_world(&Point2::new(u, v));
            lens.eye.cam_from_world * (camera.center_in_world() + ray * depth)
        };
        let corners = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)]
            .map(|(u, v)| in_eye(u, v));
        let places = corners.map(|corner| lens.shown(&corner));
        let [Some(a), Some(b), Some(c), Some(d)] = places else {
            return None;
        };
        let middle = in_eye(right / 2.0, bottom / 2.0);
        let across = (corners[1] - corners[0]).cross(&(corners[3] - corners[0]));
        let normal = across.try_normalize(1e-12)?;
        let plane = Plane::facing(normal, &middle);
        if plane.distance < EDGE_ON * middle.coords.norm() {
            return None;
        }
        let cam_from_eye = camera.cam_from_world * lens.eye.cam_from_world.inverse();
        let corners = [a.0, b.0, c.0, d.0];
        Some(Self {
            image,
            corners,
            sides: std::array::from_fn(|index| Side::of(&corners, index)),
            photo_from_page: homography_from_motion(
                &cam_from_eye,
                &plane.normal,
                plane.distance,
                &lens.eye.camera.intrinsics,
                &camera.camera.intrinsics,
            ),
            plane,
            depth: middle.z,
        })
    }

    /// Returns whether the photograph may hide a mark: the mark is behind its plane and overlaps it
    /// on the page. Marks in the plane are not hidden.
    ///
    /// * `in_eye`: center of the mark
    /// * `places`: corners of the convex mark on the page, in order
    pub(crate) fn hides(&self, in_eye: &Point3<f64>, places: &[Place]) -> bool {
        self.plane.side(in_eye) < -1e-9 * self.depth
            && !self.sides.iter().any(|side| side.has_beyond(places))
            // A point has no sides.
            && (places.len() < 2
                || !(0..places.len()).any(|index| Side::of(places, index).has_beyond(&self.corners)))
    }

    /// Returns the fraction of a segment at which it crosses the plane.
    pub(crate) fn crossing(&self, from: &Point3<f64>, to: &Point3<f64>) -> Option<f64> {
        let (a, b) = (self.plane.side(from), self.plane.side(to));
        let tiny = 1e-9 * self.depth;
        (a.abs() > tiny && b.abs() > tiny && a * b < 0.0).then(|| a / (a - b))
    }

    /// Cuts a convex polygon into the parts in front of and behind the plane.
    pub(crate) fn halves(&self, corners: &[Point3<f64>]) -> [Vec<Point3<f64>>; 2] {
        [1.0, -1.0].map(|sign| half(corners, |corner| sign * self.plane.side(corner)))
    }
}

/// A side of a convex polygon on the page.
struct Side {
    from: Place,
    along: Place,
    /// Signed extent of the polygon from the side, times the side's length.
    reach: f64,
}

impl Side {
    /// Returns the side from a corner to the next one.
    fn of(polygon: &[Place], index: usize) -> Self {
        let (from, to) = (polygon[index], polygon[(index + 1) % polygon.len()]);
        let mut side = Self {
            from,
            along: (to.0 - from.0, to.1 - from.1),
            reach: 0.0,
        };
        for corner in polygon {
            let reach = side.off(corner);
            if reach.abs() > side.reach.abs() {
                side.reach = reach;
            }
        }
        side
    }

    fn off(&self, (x, y): &Place) -> f64 {
        self.along.0 * (y - self.from.1) - self.along.1 * (x - self.from.0)
    }

    /// Returns whether another convex polygon is entirely on the other side.
    fn has_beyond(&self, other: &[Place]) -> bool {
        let beyond = |place: &Place| self.off(place) * self.reach < -1e-9 * self.reach * self.reach;
        !other.is_empty() && other.iter().all(beyond)
    }
}

/// Clips a convex polygon to the part in which `side`, a linear function, is not negative.
pub(crate) fn half(
    corners: &[Point3<f64>],
    side: impl Fn(&Point3<f64>) -> f64,
) -> Vec<Point3<f64>> {
    let mut inside = Vec::with_capacity(corners.len() + 1);
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    for (from, to) in edges {
        let (a, b) = (side(from), side(to));
        if a >= 0.0 {
            inside.push(*from);
        }
        if a * b < 0.0 {
            inside.push(from + (to - from) * (a / (a - b)));
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::lens::Subject;
    use crate::kit::orbit::Orbit;
    use epipole::camera::{Camera, Intrinsics};
    use epipole::homography::transfer;
    use nalgebra::Isometry3;

    #[test]
    fn pixels_are_where_the_scene_shows_them_and_hide_what_is_behind() {
        let camera = PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(50.0, 40, 30).unwrap(), 40, 30),
            cam_from_world: Isometry3::translation(0.3, 0.1, 0.0),
        };
        let image = RgbImage::new(40, 30);
        let subject = Subject {
            middle: Point3::new(0.0, 0.0, 1.0),
            radius: 1.5,
        };
        for (turn, eye_is_behind) in [(20.0, true), (200.0, false)] {
            let orbit = Orbit::new(turn, 25.0);
            let size = (300.0, 200.0);
            let lens = Lens::new(size, (1.0, 1.0), (150.0, 100.0), &orbit, &subject);
            let lens = lens.unwrap();
            let standing = Standing::new(&lens, &camera, &image, 0.8).unwrap();
            for (u, v) in [(3.0, 4.0), (39.5, -0.5), (20.0, 29.0)] {
                let ray = camera.ray_in_world(&Point2::new(u, v));
                let (x, y) = lens.place(&(camera.center_in_world() + ray * 0.8)).unwrap();
                let pixel = transfer(&standing.photo_from_page, &Point2::new(x, y)).unwrap();
                assert!((pixel - Point2::new(u, v)).norm() < 1e-6, "{pixel}");
            }
            let at = |z: f64| lens.eye.cam_from_world * Point3::new(-0.3, -0.1, z);
            let hides =
                |point: &Point3<f64>| standing.hides(point, &[lens.shown(point).unwrap().0]);
            assert_eq!(hides(&at(1.2)), eye_is_behind);
            assert_eq!(hides(&at(0.6)), !eye_is_behind);
            // Outside of the photograph's outline nothing is hidden, on either side of the plane.
            for z in [0.6, 1.2] {
                assert!(!hides(&(at(z) + Vector3::new(1.5, 0.0, 0.0))));
            }
            let share = standing.crossing(&at(0.0), &at(2.0)).unwrap();
            assert!((share - 0.4).abs() < 1e-9);
            assert!(standing.crossing(&at(0.0), &at(0.7)).is_none());
            let sheet = [at(0.0), at(2.0), at(2.0) + Vector3::new(0.0, 0.5, 0.0)];
            let [before, behind] = standing.halves(&sheet);
            assert!(before.len() >= 3 && behind.len() >= 3);
            assert!(behind.iter().all(|p| standing.plane.side(p) < 1e-9));
        }
        // Seen edge-on the photograph is a line.
        let lens = Lens::new(
            (300.0, 200.0),
            (1.0, 1.0),
            (150.0, 100.0),
            &Orbit::new(90.0, 0.0),
            &Subject {
                middle: Point3::new(0.0, 0.0, 0.8),
                radius: 1.0,
            },
        );
        assert!(Standing::new(&lens.unwrap(), &camera, &image, 0.8).is_none());
    }
}
