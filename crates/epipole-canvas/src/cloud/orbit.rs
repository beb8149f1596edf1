//! Viewpoint that orbits about a center.

use super::Scene;
use super::outermost::Outermost;
use super::perspective::{FOCAL, NEAREST};
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

/// A view of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// Center of the orbit and of the picture.
    pub middle: Point3<f64>,
    /// Distance from the center.
    pub distance: f64,
    /// Rotation about the vertical axis, radians.
    pub yaw_rad: f64,
    /// Elevation of the viewpoint, radians, −π/2 to π/2.
    pub pitch_rad: f64,
    /// Focal length, relative to the shorter side of the picture.
    pub focal: f64,
    /// Rotation from the world to the frame with x right, y down and z forward at zero yaw and
    /// pitch.
    upright: UnitQuaternion<f64>,
    /// Size of the scene, which bounds the distance.
    size: f64,
}

impl Orbit {
    /// Creates a view of all but the outermost points.
    ///
    /// * `down`: the downward direction of the world, unnormalized
    pub fn around(scene: &Scene, down: [f64; 3]) -> Self {
        let (mut middle, mut size) = (Point3::origin(), 1.0);
        if !scene.points.is_empty() {
            let along = |axis: usize| {
                let mut values = Vec::with_capacity(scene.points.len());
                let all = scene.points.iter().map(|(p, _)| p[axis]);
                values.extend(all.filter(|v| v.is_finite()));
                let mut at = |fraction: f64| {
                    let last = values.len().saturating_sub(1);
                    let place = (fraction * last as f64).round() as usize;
                    match values.is_empty() {
                        true => 0.0,
                        false => f64::from(*values.select_nth_unstable_by(place, f32::total_cmp).1),
                    }
                };
                (at(0.1), at(0.5), at(0.9))
            };
            let [x, y, z] = [along(0), along(1), along(2)];
            middle = Point3::new(x.1, y.1, z.1);
            let spread = Vector3::new(x.2 - x.0, y.2 - y.0, z.2 - z.0).norm();
            if spread > 0.0 {
                size = spread;
            }
        }
        Self {
            middle,
            distance: 1.9 * size,
            yaw_rad: 0.0,
            pitch_rad: 0.25,
            focal: FOCAL,
            upright: upright(Vector3::from(down)),
            size,
        }
    }

    /// Turns the view toward a direction of the world, by yaw only.
    pub fn look_along(&mut self, forward: [f64; 3]) {
        let ahead = self.upright * Vector3::from(forward);
        if libm::hypot(ahead.x, ahead.z) > 1e-9 * ahead.norm() {
            self.yaw_rad = libm::atan2(-ahead.x, ahead.z);
        }
    }

    /// Returns the view of a camera: from its place, in its direction.
    ///
    /// * `rotation`: from the world to the camera
    /// * `distance`: distance of the center of the orbit ahead of the camera
    #[must_use]
    pub fn through(&self, rotation: Rotation3<f64>, eye: Point3<f64>, distance: f64) -> Self {
        Self {
            middle: eye + rotation.inverse() * Vector3::new(0.0, 0.0, distance),
            distance,
            yaw_rad: 0.0,
            pitch_rad: 0.0,
            upright: UnitQuaternion::from_rotation_matrix(&rotation),
            ..*self
        }
    }

    /// Moves as near as possible with all points in the picture, plus a margin.
    pub fn fit(&mut self, places: &[[f64; 3]]) {
        let rotation = self.rotation();
        let rotated = places
            .iter()
            .map(|place| rotation * (Point3::from(*place) - self.middle));
        let outermost = Outermost::of(rotated);
        let (mut too_near, mut far) = self.bounds();
        let mut aside = Vector3::zeros();
        // Bisection, since proportional steps overshoot near a point, where projections grow fast.
        for _ in 0..24 {
            let distance = (too_near * far).sqrt();
            match outermost.centered(aside, distance, self.size) {
                Some(found) => (far, aside, self.distance) = (distance, found, distance),
                None => too_near = distance,
            }
        }
        self.middle += rotation.transpose() * aside;
    }

    /// Returns the smallest and the largest distance.
    fn bounds(&self) -> (f64, f64) {
        (0.02 * self.size, 20.0 * self.size)
    }

    /// Returns the rotation from world to camera; the camera looks along +z with y down.
    pub fn rotation(&self) -> Matrix3<f64> {
        let yaw = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.yaw_rad);
        let pitch = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.pitch_rad);
        *(pitch * yaw * self.upright).to_rotation_matrix().matrix()
    }

    /// Returns the focal length for a picture of this size, pixels.
    pub fn focal_px(&self, size: (usize, usize)) -> f64 {
        self.focal * size.0.min(size.1) as f64
    }

    /// Rotates the view, radians.
    pub fn rotate(&mut self, yaw_rad: f64, pitch_rad: f64) {
        let most = 1.55;
        self.yaw_rad += yaw_rad;
        self.pitch_rad = (self.pitch_rad + pitch_rad).clamp(-most, most);
    }

    /// Moves the center so that the picture moves by these pixels.
    pub fn pan(&mut self, right_px: f64, down_px: f64, size: (usize, usize)) {
        let units = self.distance / self.focal_px(size).max(1.0);
        let moved = Vector3::new(-right_px * units, -down_px * units, 0.0);
        self.middle += self.rotation().transpose() * moved;
    }

    /// Divides the distance by a factor: above 1 moves nearer.
    pub fn zoom(&mut self, factor: f64) {
        if factor > 0.0 && factor.is_finite() {
            let (near, far) = self.bounds();
            self.distance = (self.distance / factor).clamp(near, far);
        }
    }

    /// Returns the pixel and the depth of a point; `None` behind the eye.
    pub fn project(&self, place: [f32; 3], size: (usize, usize)) -> Option<([f64; 2], f64)> {
        let place = Point3::from(place.map(f64::from));
        let p = self.rotation() * (place - self.middle);
        let depth = p.z + self.distance;
        if depth <= NEAREST * self.size {
            return None;
        }
        let focal_px = self.focal_px(size);
        let pixel = [
            focal_px * p.x / depth + size.0 as f64 / 2.0,
            focal_px * p.y / depth + size.1 as f64 / 2.0,
        ];
        Some((pixel, depth))
    }
}

/// Returns a frame with y along `down` and z as near as possible to that of the world.
fn upright(down: Vector3<f64>) -> UnitQuaternion<f64> {
    let y = down.try_normalize(1e-12).unwrap_or_else(Vector3::y);
    let forward = match y.z.abs() < 0.9 {
        true => Vector3::z(),
        false => Vector3::x(),
    };
    let x = y.cross(&forward).normalize();
    let z = x.cross(&y);
    let rows = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_through_a_camera_sees_what_the_camera_sees() {
        let rotation = Rotation3::from_euler_angles(0.3, -1.2, 0.7);
        let eye = Point3::new(1.0, -2.0, 0.5);
        let scene = Scene::default();
        let mut orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]).through(rotation, eye, 3.0);
        orbit.focal = 0.9;
        for place in [[0.2, 0.1, 2.0], [-1.0, 0.4, 5.0]] {
            let p = Vector3::from(place);
            let world = (eye + rotation.inverse() * p).cast::<f32>().into();
            let ([u, v], depth) = orbit.project(world, (400, 300)).expect("it is in front");
            assert!((depth - p.z).abs() < 1e-5, "{depth}");
            assert!((u - (270.0 * p.x / p.z + 200.0)).abs() < 1e-3, "{u}");
            assert!((v - (270.0 * p.y / p.z + 150.0)).abs() < 1e-3, "{v}");
        }
    }

    #[test]
    fn all_points_fill_the_picture() {
        let scene = Scene {
            points: vec![([0.0, 0.0, 5.0], [0; 3]), ([1.0, 0.5, 6.0], [0; 3])],
            ..Scene::default()
        };
        let places = [
            [-3.0, 0.1, 4.0],
            [2.0, 1.0, 9.0],
            [0.5, -1.0, 7.0],
            [0.0, 0.0, -2.0],
        ];
        for forward in [[0.0, 0.0, 1.0], [1.0, 0.2, -0.3], [0.0, -1.0, 0.0]] {
            let mut orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
            orbit.look_along(forward);
            orbit.fit(&places);
            let projected =
                places.map(|place| orbit.project(place.map(|x| x as f32), (1000, 1000)));
            let pixels = projected.map(|projected| projected.expect("all are in front").0);
            let span = |axis: usize| {
                let along = pixels.map(|pixel| pixel[axis]);
                let least = along.iter().copied().fold(f64::INFINITY, f64::min);
                let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                assert!(least > 0.0 && most < 1000.0, "{forward:?} {least} {most}");
                most - least
            };
            let spans = [span(0), span(1)];
            assert!(spans[0].max(spans[1]) > 800.0, "{forward:?} {spans:?}");
        }
        // A scene without points, with a single point or with points that are not finite leaves the
        // view unchanged.
        let before = Orbit::around(&scene, [0.0, 1.0, 0.0]);
        for places in [&[][..], &[[f64::NAN; 3]]] {
            let mut orbit = before;
            orbit.fit(places);
            assert!(orbit.distance.is_finite() && orbit.middle == before.middle);
        }
    }
}
