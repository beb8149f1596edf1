//! Triangulation from two rays.

use super::{BEYOND_NUMBERS, NO_BASELINE};
use crate::camera::RigidTransform;
use crate::epipolar::signed_depths;
use crate::math::scaling::{power_of_two, unit};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point3, Vector3};

/// Returns the midpoint of the shortest segment between two rays, in the frame of camera 1.
///
/// It minimizes distances in space, not in the images: for a point near one camera and far from
/// the other, [`triangulate_optimal`](super::triangulate_optimal) is much better.
///
/// * `cam2_from_cam1`: the motion between the cameras
/// * `ray1`, `ray2`: directions in the frames of cameras 1 and 2; their lengths do not matter
///
/// # Errors
/// [`Error::Degenerate`] if the cameras are at the same place (t = 0), [`Error::PointAtInfinity`]
/// for parallel rays, [`Error::PointBehindCamera`] if the rays diverge, [`Error::NotFinite`] for
/// NaN, infinities and zero rays, and for a point whose coordinates overflow.
///
/// Source: Hartley & Sturm 1997, "Triangulation", §5.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::triangulation::triangulate_midpoint;
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::translation(-2.0, 0.0, 0.0);
/// let point = triangulate_midpoint(&cam2_from_cam1, &Vector3::new(1.0, 0.0, 5.0), &Vector3::new(-1.0, 0.0, 5.0))?;
/// assert!((point - Point3::new(1.0, 0.0, 5.0)).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn triangulate_midpoint(
    cam2_from_cam1: &RigidTransform,
    ray1: &Vector3<f64>,
    ray2: &Vector3<f64>,
) -> Result<Point3<f64>> {
    let meeting = Meeting::new(cam2_from_cam1, ray1, ray2)?;
    let Meeting { ray1, depths, .. } = meeting;
    let on_ray1 = ray1 * depths[0];
    let on_ray2 = meeting.on_ray2(depths[1]);
    meeting.enlarged((on_ray1 + on_ray2) * 0.5)
}

/// Two rays that pass each other in front of both cameras, scaled to a baseline near 1.
struct Meeting {
    /// R of `cam2_from_cam1`.
    rotation: Matrix3<f64>,
    /// t of `cam2_from_cam1` in units of `size`.
    t: Vector3<f64>,
    size: f64,
    /// Unit vector in the frame of camera 1.
    ray1: Vector3<f64>,
    /// R ray1.
    rotated: Vector3<f64>,
    /// Unit vector in the frame of camera 2.
    ray2: Vector3<f64>,
    /// Distances along both rays to their closest points, in units of `size`.
    depths: [f64; 2],
}

impl Meeting {
    /// Rejects degenerate input.
    fn new(
        cam2_from_cam1: &RigidTransform,
        ray1: &Vector3<f64>,
        ray2: &Vector3<f64>,
    ) -> Result<Self> {
        let (Some(ray1), Some(ray2)) = (unit(ray1), unit(ray2)) else {
            return Err(Error::NotFinite {
                what: "a ray's direction",
            });
        };
        let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
        let t = cam2_from_cam1.translation.vector;
        let rotated = rotation * ray1;
        // sin² of the angle between the rays.
        let determinant = rotated.cross(&ray2).norm_squared();
        if !determinant.is_finite() || !t.iter().all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "a ray or the motion between the cameras",
            });
        }
        if t == Vector3::zeros() {
            return Err(NO_BASELINE);
        }
        if determinant <= 1e-24 {
            return Err(Error::PointAtInfinity);
        }
        let size = power_of_two(t.amax());
        let t = t / size;
        let (depth1, depth2) = signed_depths(&rotation, &t, &ray1, &ray2);
        let depths = [depth1 / determinant, depth2 / determinant];
        if !(depths[0] > 0.0 && depths[1] > 0.0) {
            return Err(Error::PointBehindCamera);
        }
        Ok(Self {
            rotation,
            t,
            size,
            ray1,
            rotated,
            ray2,
            depths,
        })
    }

    /// Returns a point of ray 2, in the frame of camera 1.
    fn on_ray2(&self, depth: f64) -> Vector3<f64> {
        self.rotation.transpose() * (self.ray2 * depth - self.t)
    }

    /// Converts a point to world units.
    fn enlarged(&self, point: Vector3<f64>) -> Result<Point3<f64>> {
        let point = Point3::from(point * self.size);
        if point.iter().all(|x| x.is_finite()) {
            Ok(point)
        } else {
            Err(BEYOND_NUMBERS)
        }
    }
}

/// Triangulates a point between two rays, closer to the ray on which its depth is smaller, in the
/// frame of camera 1.
///
/// On each ray the point is taken at the depth where the rays would meet,
/// `d1 = |x2 × t|/|R x1 × x2|`, `d2 = |R x1 × t|/|R x1 × x2|`; the two points are weighted by their
/// inverse depths. Nearly as good as minimizing the reprojection error, at the cost of
/// [`triangulate_midpoint`].
///
/// * `cam2_from_cam1`, `ray1`, `ray2`: as for [`triangulate_midpoint`]
///
/// # Errors
/// As [`triangulate_midpoint`].
///
/// Source: Lee & Civera 2019, "Triangulation: why optimize?", §4.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::triangulation::{triangulate_midpoint, triangulate_weighted_midpoint};
/// use nalgebra::Vector3;
/// // Camera 2 is 3 units ahead and sees the point at 1 unit, camera 1 at 4. Ray 2 is off by 0.1.
/// let cam2_from_cam1 = RigidTransform::translation(0.0, 0.0, -3.0);
/// let (ray1, ray2) = (Vector3::new(1.0, 0.0, 4.0), Vector3::new(1.0, 0.1, 1.0));
/// // An offset of 0.1 at the near camera is more than a quarter of that at the far one: closer to
/// // ray 2.
/// let weighted = triangulate_weighted_midpoint(&cam2_from_cam1, &ray1, &ray2)?;
/// assert!(weighted.y > 0.07);
/// assert!((triangulate_midpoint(&cam2_from_cam1, &ray1, &ray2)?.y - 0.05).abs() < 1e-3);
/// # Ok(()) }
/// ```
pub fn triangulate_weighted_midpoint(
    cam2_from_cam1: &RigidTransform,
    ray1: &Vector3<f64>,
    ray2: &Vector3<f64>,
) -> Result<Point3<f64>> {
    let meeting = Meeting::new(cam2_from_cam1, ray1, ray2)?;
    let Meeting {
        t,
        ray1,
        rotated,
        ray2,
        ..
    } = meeting;
    let across = rotated.cross(&ray2).norm();
    let (depth1, depth2) = (
        ray2.cross(&t).norm() / across,
        rotated.cross(&t).norm() / across,
    );
    let weight1 = depth2 / (depth1 + depth2);
    meeting.enlarged(ray1 * depth1 * weight1 + meeting.on_ray2(depth2) * (1.0 - weight1))
}

/// Triangulates the point with the smallest angular corrections of the rays, in the frame of camera
/// 1: minimizes `sin² θ1 + sin² θ2`, where θi is the angle between ray i and the direction to the
/// point.
///
/// Exact and in closed form: the plane through both centers closest to the rays, `min ‖A n‖` over
/// unit normals n, where the rows of A are the rays without their components along the baseline.
/// Unlike pixels, angles are meaningful for any camera.
///
/// * `cam2_from_cam1`, `ray1`, `ray2`: as for [`triangulate_midpoint`]
///
/// # Errors
/// As [`triangulate_midpoint`].
///
/// Source: Lee & Civera 2019, "Closed-form optimal two-view triangulation based on angular errors",
/// §4.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::triangulation::{triangulate_angular, triangulate_midpoint};
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::translation(-2.0, 0.0, 0.0);
/// // Up and down by the same angle: the point lies between, at the depth of the rays.
/// let rays = [Vector3::new(1.0, 0.1, 5.0), Vector3::new(-1.0, -0.1, 5.0)];
/// let point = triangulate_angular(&cam2_from_cam1, &rays[0], &rays[1])?;
/// assert!((point - Point3::new(1.0, 0.0, 5.0)).norm() < 1e-12);
/// // The closest points of the rays are a little nearer.
/// assert!((triangulate_midpoint(&cam2_from_cam1, &rays[0], &rays[1])?.z - 4.95).abs() < 1e-3);
/// # Ok(()) }
/// ```
pub fn triangulate_angular(
    cam2_from_cam1: &RigidTransform,
    ray1: &Vector3<f64>,
    ray2: &Vector3<f64>,
) -> Result<Point3<f64>> {
    let meeting = Meeting::new(cam2_from_cam1, ray1, ray2)?;
    let Meeting {
        rotation,
        t,
        rotated,
        ray2,
        ..
    } = meeting;
    let along = t.normalize();
    let (along1, along2) = (rotated.dot(&along), ray2.dot(&along));
    // A Aᵀ. Its smallest eigenvector holds the depths up to scale: d1 R x1 − d2 x2 is closest to
    // the baseline.
    let (across1, across2) = (1.0 - along1 * along1, 1.0 - along2 * along2);
    let both = rotated.dot(&ray2) - along1 * along2;
    let half = 0.5 * (across1 - across2);
    let radius = (half * half + both * both).sqrt();
    let (depth1, depth2) = if half > 0.0 {
        (both, radius + half)
    } else {
        (radius - half, both)
    };
    let scale = t.norm() / (depth2 * along2 - depth1 * along1);
    let (depth1, depth2) = (depth1 * scale, depth2 * scale);
    if !(depth1.is_finite() && depth2.is_finite()) {
        return Err(Error::PointAtInfinity);
    }
    if !(depth1 > 0.0 && depth2 > 0.0) {
        return Err(Error::PointBehindCamera);
    }
    // The gap between the rays is split so that both rotate by the required angle.
    let gap = rotated * depth1 + t - ray2 * depth2;
    let weight1 = depth1 * depth1 / (depth1 * depth1 + depth2 * depth2);
    meeting.enlarged(rotation.transpose() * (rotated * depth1 - gap * weight1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// The cases of COLMAP's src/colmap/geometry/triangulation_test.cc.
    #[test]
    fn rays_that_miss_or_never_meet() {
        let shift = RigidTransform::translation;
        let relative = shift(1.0, 0.0, 0.0) * shift(-1.0, 0.0, 0.0).inverse();
        let expected = Point3::new(-1.0, 0.0, 5.0);
        let (ray1, ray2) = (Vector3::new(-1.0, 0.1, 5.0), Vector3::new(1.0, -0.1, 5.0));
        // |x2 × t| = √(100 + 0.04), |x1 × x2| = √101, and by symmetry the weights are equal.
        let point = triangulate_weighted_midpoint(&relative, &ray1, &ray2).unwrap();
        assert!((point.z - 5.0 * (100.04_f64 / 101.0).sqrt()).abs() < 1e-12);
        assert!((point - expected).norm() < 0.03 && point.y.abs() < 1e-12);
        // The closest points of the rays are a little nearer: minimize (2 − 2s)² + (0.2 s)².
        let plain = triangulate_midpoint(&relative, &ray1, &ray2).unwrap();
        assert!((plain - Point3::new(-1.0, 0.0, 5.0 * 4.0 / 4.04)).norm() < 0.02);
        assert!((plain.z - 5.0 * 4.0 / 4.04).abs() < 1e-12);
        // COLMAP's expected point, which its test requires to 1e-3 relative.
        let angular = triangulate_angular(&relative, &ray1, &ray2).unwrap();
        assert!((angular - expected).norm() < 1e-12);
        let right = shift(1.0, 0.0, 0.0);
        assert_eq!(
            triangulate_angular(&right, &Vector3::z(), &Vector3::z()),
            Err(Error::PointAtInfinity)
        );
        assert_eq!(
            triangulate_midpoint(&right, &Vector3::z(), &Vector3::z()),
            Err(Error::PointAtInfinity)
        );
        assert_eq!(
            triangulate_midpoint(
                &right,
                &Vector3::new(0.1, 0.0, 1.0),
                &Vector3::new(-0.1, 0.0, 1.0)
            ),
            Err(Error::PointBehindCamera)
        );
        assert!(triangulate_midpoint(&right, &Vector3::zeros(), &Vector3::z()).is_err());
        assert!(
            triangulate_midpoint(&right, &Vector3::from_element(f64::NAN), &Vector3::z()).is_err()
        );
    }

    #[test]
    fn exact_rays_meet() {
        let mut random = Random::new(1);
        for _ in 0..100 {
            let mut vector = || Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
            let motion = RigidTransform::new(vector(), vector());
            let point = Point3::from(vector());
            let found =
                triangulate_midpoint(&motion, &point.coords, &(motion * point).coords).unwrap();
            assert!((found - point).norm() < 1e-10);
            let (r1, r2) = (point.coords, (motion * point).coords);
            let weighted = triangulate_weighted_midpoint(&motion, &r1, &r2).unwrap();
            assert!((weighted - point).norm() < 1e-10);
            let angular = triangulate_angular(&motion, &r1, &r2).unwrap();
            assert!((angular - point).norm() < 1e-10);
        }
    }

    /// No point nearby has smaller angular corrections.
    #[test]
    fn angles_are_least() {
        let mut random = Random::new(2);
        for _ in 0..200 {
            let mut vector = |size: f64| Vector3::from_fn(|_, _| random.uniform(-size, size));
            let motion = RigidTransform::new(vector(1.0), vector(0.3));
            let truth = Point3::from(vector(1.0) + Vector3::new(0.0, 0.0, 4.0));
            let ray1 = truth.coords.normalize() + vector(0.02);
            let ray2 = (motion * truth).coords.normalize() + vector(0.02);
            let Ok(point) = triangulate_angular(&motion, &ray1, &ray2) else {
                continue;
            };
            let angles = |x: &Point3<f64>| {
                let sine_sq = |a: &Vector3<f64>, b: &Vector3<f64>| {
                    a.cross(b).norm_squared() / (a.norm_squared() * b.norm_squared())
                };
                sine_sq(&x.coords, &ray1) + sine_sq(&(motion * x).coords, &ray2)
            };
            let least = angles(&point);
            for _ in 0..20 {
                let step = vector(1.0) * 1e-3 * point.coords.norm();
                assert!(angles(&(point + step)) >= least);
            }
        }
    }

    type Method = fn(&RigidTransform, &Vector3<f64>, &Vector3<f64>) -> Result<Point3<f64>>;
    const METHODS: [Method; 3] = [
        triangulate_midpoint,
        triangulate_weighted_midpoint,
        triangulate_angular,
    ];

    #[test]
    fn cameras_at_the_same_place() {
        let rotation_only = RigidTransform::rotation(Vector3::new(0.1, -0.2, 0.0));
        for motion in [RigidTransform::identity(), rotation_only] {
            for ray2 in [Vector3::z(), Vector3::new(0.1, 0.3, 1.0)] {
                for method in METHODS {
                    assert_eq!(method(&motion, &Vector3::z(), &ray2), Err(NO_BASELINE));
                }
            }
        }
    }

    /// The unit of length and the lengths of rays are arbitrary.
    #[test]
    fn worlds_and_rays_of_any_size() {
        let motion = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.1, 0.2, 0.3));
        let point = Point3::new(0.5, -0.3, 4.0);
        let (ray1, ray2) = (point.coords, (motion * point).coords);
        for size in [1e-300, 1e-160, 1e160, 1e300] {
            let mut enlarged = motion;
            enlarged.translation.vector *= size;
            for length in [1e-300, 1e-160, 1e160, 1e300] {
                for method in METHODS {
                    let found = method(&enlarged, &(ray1 * length), &(ray2 / length)).unwrap();
                    assert!(
                        (found / size - point).norm() < 1e-12,
                        "{size} {length}: {found}"
                    );
                }
            }
        }
        // Nearly parallel rays: the point overflows.
        let far = RigidTransform::translation(-1e305, 0.0, 0.0);
        for method in METHODS {
            let found = method(&far, &Vector3::z(), &Vector3::new(-1e-8, 0.0, 1.0));
            assert_eq!(found, Err(BEYOND_NUMBERS));
        }
    }
}
