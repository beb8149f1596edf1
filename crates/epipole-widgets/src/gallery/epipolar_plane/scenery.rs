//! Two cameras in front of the still life, a point, and the plane through it and both centers.

use crate::kit::geometry::Geometry;
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use epipole::Error;
use epipole::camera::{PosedCamera, look_at};
use epipole::math::Line2;
use epipole_scenes::{Transfer, still_life_camera};
use nalgebra::{Point2, Point3, Vector3};

/// World y of both cameras, meters; y points down and is 0 on the table.
pub(super) const CAMERA_Y_M: f64 = -0.43;
/// Point that both cameras look at, meters.
const TARGET: Point3<f64> = Point3::new(0.035, -0.165, 0.05);
/// Distance below which two centers coincide, meters.
const SAME_M: f64 = 1e-6;
/// Distance below which a point spans no plane with the baseline, meters.
const ON_BASELINE_M: f64 = 1e-3;
/// Distance below which a point lies on a surface, meters.
const ON_SURFACE_M: f64 = 0.004;

/// Returns the camera at (x, z), meters, looking at the still life.
///
/// # Errors
/// As [`look_at`]: the camera is straight above or below its target.
pub(super) fn camera((x, z): (f64, f64)) -> Result<PosedCamera, Error> {
    let up = Vector3::new(0.0, -1.0, 0.0);
    Ok(PosedCamera {
        cam_from_world: look_at(&Point3::new(x, CAMERA_Y_M, z), &TARGET, &up)?,
        ..still_life_camera(PHOTO_SIZE.0, PHOTO_SIZE.1)
    })
}

/// The surface that camera 1 sees at the pixel of the point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub(super) point: Point3<f64>,
    /// Its pixel in camera 2, even if hidden there; `None` behind the camera.
    pub(super) pixel2: Option<Point2<f64>>,
}

/// The epipolar plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Unit vector from the first center to the second.
    pub(super) along: Vector3<f64>,
    /// Unit vector in the plane, perpendicular to `along`, toward the point.
    pub(super) towards: Vector3<f64>,
}

impl Plane {
    /// Returns the tilt of the plane about the baseline, degrees; positive downward from level.
    pub(super) fn tilt_deg(&self) -> f64 {
        let level = libm::hypot(self.towards.x, self.towards.z);
        libm::atan2(self.towards.y, level).to_degrees()
    }
}

/// Cameras, point, and all derived values.
pub(super) struct Scenery {
    pub(super) cameras: [PosedCamera; 2],
    pub(super) point: Point3<f64>,
    /// Pixel of the point in each camera; `None` behind it.
    pub(super) pixels: [Option<Point2<f64>>; 2],
    /// Epipolar geometry; `None` while both cameras are at the same position.
    pub(super) geometry: Option<Geometry>,
    /// Epipolar plane; `None` without a baseline, or if the point lies on it.
    pub(super) plane: Option<Plane>,
    pub(super) surface: Option<Surface>,
}

impl Scenery {
    pub(super) fn new(cameras: [PosedCamera; 2], point: Point3<f64>) -> Self {
        let pixels = cameras.map(|camera| camera.project(&point).ok());
        let [one, two] = cameras.map(|camera| camera.center_in_world());
        let apart = (two - one).norm() > SAME_M;
        Self {
            cameras,
            point,
            pixels,
            geometry: apart.then(|| Geometry::of(&cameras)).flatten(),
            plane: plane(&one, &two, &point),
            surface: pixels[0].and_then(|pixel| surface(&cameras, &pixel)),
        }
    }

    /// Returns the length of the baseline, meters.
    pub(super) fn baseline_m(&self) -> f64 {
        let [one, two] = self.cameras.map(|camera| camera.center_in_world());
        (two - one).norm()
    }

    /// Returns the depth of the point in camera 1, meters; negative behind it.
    pub(super) fn depth_m(&self) -> f64 {
        (self.cameras[0].cam_from_world * self.point).z
    }

    /// Returns the epipolar line of the point in each photograph; `None` without a plane.
    pub(super) fn lines(&self) -> [Option<Line2>; 2] {
        let of = |pixel: &Point2<f64>| {
            let geometry = self.geometry.as_ref().filter(|_| self.plane.is_some())?;
            Some((geometry.line1(pixel), geometry.line2(pixel)))
        };
        let (one, two) = self.pixels[0].as_ref().and_then(of).unwrap_or_default();
        [one, two]
    }

    /// Returns the distance of p′ from its line, pixels.
    pub(super) fn residual_px(&self) -> Option<f64> {
        let distance = self.lines()[1]?.signed_distance(&self.pixels[1]?);
        Some(distance.abs())
    }

    /// Returns the depth in camera 1 of the surface seen at p minus that of the point, meters:
    /// positive in front of the surface, 0 on it.
    pub(super) fn before_surface_m(&self) -> Option<f64> {
        let surface = self.cameras[0].cam_from_world * self.surface?.point;
        let before = surface.z - self.depth_m();
        Some(if before.abs() < ON_SURFACE_M {
            0.0
        } else {
            before
        })
    }
}

fn plane(one: &Point3<f64>, two: &Point3<f64>, point: &Point3<f64>) -> Option<Plane> {
    let along = (two - one).try_normalize(SAME_M)?;
    let ray = point - one;
    let towards = (ray - along * along.dot(&ray)).try_normalize(ON_BASELINE_M)?;
    Some(Plane { along, towards })
}

/// Returns the surface that the first camera sees at a pixel.
pub(super) fn surface(cameras: &[PosedCamera; 2], pixel: &Point2<f64>) -> Option<Surface> {
    let [first, second] = cameras;
    match still_life().transfer(first, second, pixel) {
        Transfer::Visible { pixel2, x_in_world }
        | Transfer::Occluded {
            pixel2, x_in_world, ..
        } => Some(Surface {
            point: x_in_world,
            pixel2: Some(pixel2),
        }),
        Transfer::BehindCamera { x_in_world } => Some(Surface {
            point: x_in_world,
            pixel2: None,
        }),
        Transfer::Nothing => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_in_the_plane_is_on_the_lines() {
        let cameras = [(-0.4, -1.3), (0.5, -1.1)].map(|at| camera(at).unwrap());
        let first = Scenery::new(cameras, Point3::new(0.1, -0.1, 0.0));
        let tilt = first.plane.unwrap().tilt_deg();
        let origin = cameras[0].center_in_world();
        for share in [0.5, 0.8, 1.4] {
            // Along the ray the plane does not change, nor do both lines and p.
            let there = Scenery::new(cameras, origin + (first.point - origin) * share);
            assert!((there.plane.unwrap().tilt_deg() - tilt).abs() < 1e-9);
            assert!(there.residual_px().unwrap() < 1e-6);
            let [a, b] = [&first, &there].map(|scenery| scenery.lines()[1].unwrap());
            assert!((a.a - b.a).abs() < 1e-9 && (a.c - b.c).abs() < 1e-6);
            assert!((there.pixels[0].unwrap() - first.pixels[0].unwrap()).norm() < 1e-6);
            assert!((there.pixels[1].unwrap() - first.pixels[1].unwrap()).norm() > 20.0);
        }
        // Above it the plane is flatter.
        let above = Scenery::new(cameras, first.point - Vector3::new(0.0, 0.2, 0.0));
        assert!(above.plane.unwrap().tilt_deg() < tilt - 3.0);
    }

    #[test]
    fn without_a_baseline_there_is_no_plane() {
        let one = camera((0.1, -1.2)).unwrap();
        let same = Scenery::new([one, one], Point3::origin());
        assert!(same.geometry.is_none() && same.plane.is_none());
        assert!(same.lines().iter().all(Option::is_none) && same.residual_px().is_none());
        let other = camera((-0.4, -1.3)).unwrap();
        let between = nalgebra::center(&one.center_in_world(), &other.center_in_world());
        assert!(Scenery::new([one, other], between).plane.is_none());
    }
}
