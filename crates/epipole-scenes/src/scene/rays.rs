//! Exact rays through a scene, and exact correspondences.

use super::Scene;
use crate::objects::body::{Body, Placement};
use crate::shape::{Contact, Ray};
use epipole::camera::PosedCamera;
use nalgebra::{Point2, Point3, Vector3};

/// Minimum ray parameter of a contact; nearer ones are the ray's own starting point.
const NEAR: f64 = 1e-9;

/// The first surface that a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Position in the world, meters.
    pub point: Point3<f64>,
    /// Unit outward normal; on round bodies the smooth one used for shading.
    pub normal: Vector3<f64>,
    /// Ray parameter: `point = origin + distance_along * direction`. With the direction of
    /// [`PosedCamera::ray_in_world`] it is the depth.
    pub distance_along: f64,
    /// Name of the object, such as "the mug".
    pub object: &'static str,
}

/// Visibility in a second camera of the surface point at a pixel of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transfer {
    /// Visible to the second camera. The caller compares `pixel2` with the picture size, which a
    /// camera does not know.
    Visible {
        /// Its pixel in the second camera.
        pixel2: Point2<f64>,
        /// The point, world frame, meters.
        x_in_world: Point3<f64>,
    },
    /// Hidden from the second camera, possibly by the other side of the same object.
    Occluded {
        /// Its pixel in the second camera.
        pixel2: Point2<f64>,
        /// The point, world frame, meters.
        x_in_world: Point3<f64>,
        /// Name of the occluder.
        by: &'static str,
    },
    /// Behind the second camera.
    BehindCamera {
        /// The point, world frame, meters.
        x_in_world: Point3<f64>,
    },
    /// No surface: the first camera is outside of the room, or the pixel is not finite.
    Nothing,
}

impl Scene {
    /// Casts the ray `origin + a direction`, `a > 0`, to the first surface; `None` if the origin is
    /// outside of the room and the ray misses it, or a number is not finite.
    ///
    /// Contacts with `a` below `10⁻⁹` are ignored, so a ray may start on a surface.
    ///
    /// ```
    /// use epipole_scenes::Scene;
    /// use nalgebra::{Point3, Vector3};
    /// // The table's top is the plane y = 0, and y points down.
    /// let scene = Scene::still_life();
    /// let down = Vector3::new(0.0, 2.0, 0.0);
    /// let hit = scene.cast(&Point3::new(-0.7, -0.5, -0.5), &down).ok_or("nothing")?;
    /// assert_eq!(hit.object, "the table");
    /// assert!((hit.distance_along - 0.25).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn cast(&self, origin: &Point3<f64>, direction: &Vector3<f64>) -> Option<Hit> {
        let finite = origin.coords.iter().chain(direction.iter());
        if !finite.into_iter().all(|x| x.is_finite()) || direction.norm_squared() == 0.0 {
            return None;
        }
        let ray = Ray {
            origin: origin.coords,
            direction: *direction,
        };
        let mut nearest: Option<(Contact, &Body, Placement)> = None;
        for (body, placed) in self.placed() {
            let far = nearest.map_or(f64::INFINITY, |(contact, ..)| contact.along);
            if let Some(contact) = body.meet(&ray, &placed, NEAR, far) {
                nearest = Some((contact, body, placed));
            }
        }
        let (contact, body, placed) = nearest?;
        let local = body.local_ray(&ray, &placed).at(contact.along);
        let place = body.shape.place(&local, contact.part);
        Some(Hit {
            point: Point3::from(ray.at(contact.along)),
            normal: body.normal_in_world(&place.normal),
            distance_along: contact.along,
            object: body.name,
        })
    }

    /// Transfers `pixel1` of `cam1` exactly to `cam2`, by the surface point that it shows.
    ///
    /// Casts the ray of `pixel1` to the first surface and projects the point into `cam2`; a ray
    /// from there determines whether it is hidden.
    ///
    /// ```
    /// use epipole_scenes::{Scene, Transfer, still_life_camera};
    /// use nalgebra::Point2;
    /// // From the same camera, every pixel is seen where it is.
    /// let camera = still_life_camera(640, 480);
    /// let pixel = Point2::new(320.0, 300.0);
    /// let Transfer::Visible { pixel2, .. } = Scene::still_life().transfer(&camera, &camera, &pixel)
    /// else {
    ///     panic!("a camera sees what it sees");
    /// };
    /// assert!((pixel2 - pixel).norm() < 1e-9);
    /// ```
    pub fn transfer(
        &self,
        cam1: &PosedCamera,
        cam2: &PosedCamera,
        pixel1: &Point2<f64>,
    ) -> Transfer {
        let Some(hit) = self.cast(&cam1.center_in_world(), &cam1.ray_in_world(pixel1)) else {
            return Transfer::Nothing;
        };
        let x_in_world = hit.point;
        let Ok(pixel2) = cam2.project(&x_in_world) else {
            return Transfer::BehindCamera { x_in_world };
        };
        let center2 = cam2.center_in_world();
        match self.cast(&center2, &(x_in_world - center2)) {
            // The surface itself is hit at 1, up to rounding.
            Some(blocker) if blocker.distance_along < 1.0 - 1e-7 => Transfer::Occluded {
                pixel2,
                x_in_world,
                by: blocker.object,
            },
            _ => Transfer::Visible { pixel2, x_in_world },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sets::still_life_camera;
    use epipole::camera::{cross_matrix, relative_motion};
    use nalgebra::{Isometry3, Translation3};

    fn pair() -> (PosedCamera, PosedCamera) {
        let camera1 = still_life_camera(640, 480);
        let camera2 = PosedCamera {
            cam_from_world: Isometry3::rotation(Vector3::new(0.02, -0.2, 0.05))
                * Translation3::new(-0.4, 0.05, -0.1)
                * camera1.cam_from_world,
            ..camera1
        };
        (camera1, camera2)
    }

    #[test]
    fn a_ray_passes_by_nothing_that_it_meets() {
        use crate::sets::{MovableKind, MovableObject};
        use epipole::math::random::Random;
        let mut random = Random::new(4);
        let ball = MovableObject {
            kind: MovableKind::Ball,
            x_m: 0.2,
            z_m: 1.7,
        };
        let scenes = [Scene::still_life(), Scene::long_table(ball).unwrap()];
        let mut num_objects = 0;
        for scene in &scenes {
            for _ in 0..4000 {
                let mut point = |reach: f64| Vector3::from_fn(|_, _| random.uniform(-reach, reach));
                let (origin, direction) = (point(0.8), point(1.0));
                let ray = Ray { origin, direction };
                // All shapes, without the bounding-sphere test.
                let contacts = scene.placed().filter_map(|(body, placed)| {
                    let local = body.local_ray(&ray, &placed);
                    let contact = body.shape.meet(&local, NEAR, f64::INFINITY)?;
                    Some((contact.along, body.name))
                });
                let nearest = contacts.min_by(|a, b| a.0.total_cmp(&b.0));
                let hit = scene.cast(&origin.into(), &direction);
                let found = hit.map(|hit| (hit.distance_along, hit.object));
                assert_eq!(
                    found.map(|(along, _)| along),
                    nearest.map(|(along, _)| along)
                );
                num_objects += usize::from(found.is_some_and(|(_, name)| name != "the wall"));
            }
        }
        assert!(num_objects > 1000, "{num_objects}");
    }

    /// Asserts that transferred points obey x2ᵀ F x1 = 0 with F from the cameras, and transfer back
    /// to their origin.
    #[test]
    fn transfers_obey_the_epipolar_constraint() {
        let scene = Scene::still_life();
        let (camera1, camera2) = pair();
        let motion = relative_motion(&camera1.cam_from_world, &camera2.cam_from_world);
        let essential = cross_matrix(&motion.translation.vector)
            * motion.rotation.to_rotation_matrix().into_inner();
        let f = camera2.camera.intrinsics.inverse_matrix().transpose()
            * essential
            * camera1.camera.intrinsics.inverse_matrix();
        let (mut num_visible, mut num_occluded) = (0, 0);
        for v in (3..480).step_by(17) {
            for u in (2..640).step_by(13) {
                let pixel1 = Point2::new(f64::from(u), f64::from(v));
                let (pixel2, x_in_world) = match scene.transfer(&camera1, &camera2, &pixel1) {
                    Transfer::Visible { pixel2, x_in_world } => {
                        num_visible += 1;
                        let Transfer::Visible { pixel2: back, .. } =
                            scene.transfer(&camera2, &camera1, &pixel2)
                        else {
                            panic!("what both see goes back: {pixel1}");
                        };
                        assert!((back - pixel1).norm() < 1e-4, "{pixel1} {back}");
                        (pixel2, x_in_world)
                    }
                    Transfer::Occluded {
                        pixel2, x_in_world, ..
                    } => {
                        num_occluded += 1;
                        (pixel2, x_in_world)
                    }
                    other => panic!("{other:?}"),
                };
                assert!((camera1.project(&x_in_world).unwrap() - pixel1).norm() < 1e-8);
                let line = f * pixel1.to_homogeneous();
                let distance_px = line.dot(&pixel2.to_homogeneous()).abs()
                    / (line.x * line.x + line.y * line.y).sqrt();
                assert!(distance_px < 1e-7, "{pixel1}: {distance_px}");
            }
        }
        assert!(
            num_visible > 1000 && num_occluded > 50,
            "{num_visible} {num_occluded}"
        );
    }

    /// Asserts that the wall behind the jug is visible from the left of it and hidden from the
    /// right.
    #[test]
    fn the_jug_hides_the_wall() {
        let scene = Scene::still_life();
        let camera1 = still_life_camera(640, 480);
        let behind_jug = Point3::new(0.08, -0.20, 1.05);
        let beside = PosedCamera {
            cam_from_world: Translation3::new(0.8, 0.0, 0.0) * camera1.cam_from_world,
            ..camera1
        };
        let pixel1 = beside.project(&behind_jug).unwrap();
        match scene.transfer(&beside, &camera1, &pixel1) {
            Transfer::Occluded { by, x_in_world, .. } => {
                assert_eq!(by, "the jug");
                assert!((x_in_world - behind_jug).norm() < 1e-9);
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn behind_the_camera_and_nothing() {
        let scene = Scene::still_life();
        let camera1 = still_life_camera(640, 480);
        let backward = PosedCamera {
            cam_from_world: Isometry3::rotation(Vector3::new(0.0, std::f64::consts::PI, 0.0))
                * camera1.cam_from_world,
            ..camera1
        };
        let middle = Point2::new(320.0, 240.0);
        assert!(matches!(
            scene.transfer(&camera1, &backward, &middle),
            Transfer::BehindCamera { .. }
        ));
        let nan = Point2::new(f64::NAN, 1.0);
        assert_eq!(scene.transfer(&camera1, &camera1, &nan), Transfer::Nothing);
        let outside = Point3::new(0.0, -90.0, 0.0);
        assert_eq!(scene.cast(&outside, &-Vector3::y()), None);
        assert_eq!(scene.cast(&outside, &Vector3::zeros()), None);
    }
}
