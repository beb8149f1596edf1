//! Uncertainty of a point: its region, and the standard deviation along the rays over the angle and
//! over the distance.

use epipole::camera::{PosedCamera, look_at};
use epipole::math::{Svd3, svd3};
use epipole::triangulation::point_covariance;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// Range of the angle, degrees.
pub(super) const ANGLES_DEG: [f64; 2] = [0.0, 90.0];
/// Range of the distance, powers of ten of a meter.
pub(super) const DISTANCES: [f64; 2] = [-0.3, 2.0];
const NUM_STEPS: usize = 120;

/// One standard deviation along the rays, meters.
pub(super) struct Curves {
    /// Over the angle between the rays, degrees, with camera 2 moved around the point.
    pub(super) angle: Vec<(f64, f64)>,
    /// Over the distance of the point from camera 1, meters, with the point moved along that ray.
    pub(super) distance: Vec<(f64, f64)>,
    /// Over the same distance, proportional to its square and equal at the far end.
    pub(super) square: Vec<(f64, f64)>,
}

impl Curves {
    /// Computes the curves; empty if both cameras have the same center.
    pub(super) fn new(cameras: &[PosedCamera; 2], truth: &Point3<f64>, sigma_px: f64) -> Self {
        let [center1, center2] = cameras.map(|camera| camera.center_in_world());
        let (ray1, ray2) = (truth - center1, truth - center2);
        let mut curves = Self {
            angle: Vec::new(),
            distance: Vec::new(),
            square: Vec::new(),
        };
        let along = |center2: &Point3<f64>, point: &Point3<f64>| {
            let looking = |camera: &PosedCamera, center: &Point3<f64>| {
                let cam_from_world = look_at(center, point, &Vector3::new(0.0, -1.0, 0.0)).ok()?;
                Some(PosedCamera {
                    cam_from_world,
                    ..*camera
                })
            };
            let cameras = [
                looking(&cameras[0], &center1)?,
                looking(&cameras[1], center2)?,
            ];
            Some(axes_of(&cameras, point, sigma_px)?[0].norm())
        };
        let direction = ray1.normalize();
        let across = ray2 - direction * ray2.dot(&direction);
        for step in 1..=NUM_STEPS {
            let share = step as f64 / NUM_STEPS as f64;
            let angle_deg = ANGLES_DEG[0] + (ANGLES_DEG[1] - ANGLES_DEG[0]) * share;
            let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), angle_deg.to_radians());
            let led = truth - turn * direction * ray2.norm();
            if let Some(long_m) = along(&led, truth) {
                curves.angle.push((angle_deg, long_m));
            }
            let distance_m = libm::exp10(DISTANCES[0] + (DISTANCES[1] - DISTANCES[0]) * share);
            if let Some(long_m) = along(&center2, &(center1 + direction * distance_m)) {
                curves.distance.push((distance_m, long_m));
            }
        }
        if across.norm() > 0.0
            && let Some(&(far_m, long_m)) = curves.distance.last()
        {
            let square = |&(distance_m, _): &(f64, f64)| {
                let share = distance_m / far_m;
                (distance_m, long_m * share * share)
            };
            curves.square = curves.distance.iter().map(square).collect();
        }
        curves
    }

    /// Returns the standard deviation at a distance, meters, linear between logarithms.
    pub(super) fn long_m_at(&self, distance_m: f64) -> Option<f64> {
        let log = |(x, y): (f64, f64)| (libm::log10(x), libm::log10(y));
        let index = self.distance.iter().position(|(x, _)| *x >= distance_m)?;
        let (x1, y1) = log(self.distance[index]);
        let (x0, y0) = log(*self.distance.get(index.checked_sub(1)?)?);
        let share = (libm::log10(distance_m) - x0) / (x1 - x0);
        Some(libm::exp10(y0 + share * (y1 - y0)))
    }
}

/// Returns the semi-axes of the one-sigma ellipsoid around a point, longest first, in the world.
pub(super) fn axes_of(
    cameras: &[PosedCamera; 2],
    truth: &Point3<f64>,
    sigma_px: f64,
) -> Option<[Vector3<f64>; 3]> {
    let covariance: Matrix3<f64> = point_covariance(cameras, truth, sigma_px).ok()?;
    // For a symmetric matrix without negative eigenvalues these are its axes.
    let Svd3 {
        u, singular_values, ..
    } = svd3(&covariance);
    Some([0, 1, 2].map(|n| u.column(n) * singular_values[n].sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::{Camera, Intrinsics, RigidTransform};

    fn curves(second: Point3<f64>) -> Curves {
        let camera = |center: &Point3<f64>| PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(500.0, 640, 480).unwrap(), 640, 480),
            cam_from_world: RigidTransform::translation(-center.x, -center.y, -center.z),
        };
        let cameras = [camera(&Point3::origin()), camera(&second)];
        Curves::new(&cameras, &Point3::new(0.0, 0.0, 2.0), 1.0)
    }

    #[test]
    fn far_away_it_is_what_a_pixel_of_disparity_costs() {
        // Expected: √2 σ Z² / (f B).
        let found = curves(Point3::new(0.4, 0.0, 0.0));
        let &(far_m, long_m) = found.distance.last().unwrap();
        let expected = std::f64::consts::SQRT_2 * far_m * far_m / (500.0 * 0.4);
        assert!(
            (long_m / expected - 1.0).abs() < 0.01,
            "{long_m} {expected}"
        );
        let &(_, square_m) = found.square.last().unwrap();
        assert_eq!(square_m, long_m);
    }

    #[test]
    fn between_two_distances_it_is_interpolated() {
        let found = curves(Point3::new(0.4, 0.0, 0.0));
        let expected = std::f64::consts::SQRT_2 * 31.0 * 31.0 / (500.0 * 0.4);
        let long_m = found.long_m_at(31.0).unwrap();
        assert!(
            (long_m / expected - 1.0).abs() < 0.01,
            "{long_m} {expected}"
        );
        assert_eq!((found.long_m_at(0.1), found.long_m_at(200.0)), (None, None));
    }

    #[test]
    fn equal_cameras_at_an_angle() {
        // Two directions at the angle α give σ r / (f √2 sin(α / 2)) along their bisector.
        let found = curves(Point3::new(2.0, 0.0, 2.0));
        for &(angle_deg, long_m) in &found.angle {
            let half = (angle_deg / 2.0).to_radians();
            let expected = 2.0 / (500.0 * std::f64::consts::SQRT_2 * libm::sin(half));
            assert!((long_m / expected - 1.0).abs() < 1e-9, "{angle_deg}");
        }
    }

    #[test]
    fn cameras_in_one_place_have_no_curve_over_the_distance() {
        let found = curves(Point3::origin());
        assert!(found.distance.is_empty() && found.square.is_empty());
    }
}
