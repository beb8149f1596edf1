//! Two cameras before the still life, a point, and the plane through the point and both centers.

use crate::kit::geometry::Geometry;
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use epipole::Error;
use epipole::camera::{PosedCamera, look_at};
use epipole::math::Line2;
use epipole::synthetic::{Transfer, still_life_camera};
use nalgebra::{Point2, Point3, Vector3};

/// How high both cameras stand; y is down and 0 on the table.
pub(super) const CAMERA_Y_M: f64 = -0.43;
/// What both look at.
const TARGET: Point3<f64> = Point3::new(0.035, -0.165, 0.05);
/// Centers that are nearer to each other are one place, meters.
const SAME_M: f64 = 1e-6;
/// A point that is nearer to the baseline makes no plane with it, meters.
const ON_BASELINE_M: f64 = 1e-3;
/// A point that is nearer to a surface is on it, meters.
const ON_SURFACE_M: f64 = 0.004;

/// The camera that stands here and looks at the still life.
///
/// # Errors
/// As [`look_at`]: it stands above or below what it looks at.
pub(super) fn camera((x, z): (f64, f64)) -> Result<PosedCamera, Error> {
    let up = Vector3::new(0.0, -1.0, 0.0);
    Ok(PosedCamera {
        cam_from_world: look_at(&Point3::new(x, CAMERA_Y_M, z), &TARGET, &up)?,
        ..still_life_camera(PHOTO_SIZE.0, PHOTO_SIZE.1)
    })
}

/// What camera 1 shows at the pixel of the point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub(super) point: Point3<f64>,
    /// Where camera 2 would see it, hidden or not.
    pub(super) pixel2: Option<Point2<f64>>,
}

/// The epipolar plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// From the first center to the second, one long.
    pub(super) along: Vector3<f64>,
    /// Square to it, in the plane, on the side of the point; one long.
    pub(super) towards: Vector3<f64>,
}

impl Plane {
    /// How far the plane is tilted about the baseline, downwards from level, degrees.
    pub(super) fn tilt_deg(&self) -> f64 {
        let level = libm::hypot(self.towards.x, self.towards.z);
        libm::atan2(self.towards.y, level).to_degrees()
    }
}

/// Everything that follows from where the cameras and the point are.
pub(super) struct Scenery {
    pub(super) cameras: [PosedCamera; 2],
    pub(super) point: Point3<f64>,
    /// Where each camera sees the point; `None` behind it.
    pub(super) pixels: [Option<Point2<f64>>; 2],
    /// `None` while both cameras stand at one place.
    pub(super) geometry: Option<Geometry>,
    /// `None` then, too, and where the point is on the baseline.
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

    /// Meters from center to center.
    pub(super) fn baseline_m(&self) -> f64 {
        let [one, two] = self.cameras.map(|camera| camera.center_in_world());
        (two - one).norm()
    }

    /// How far the point is from camera 1, along its optical axis; negative behind it.
    pub(super) fn depth_m(&self) -> f64 {
        (self.cameras[0].cam_from_world * self.point).z
    }

    /// The epipolar line of the point in each photograph; `None` without a plane.
    pub(super) fn lines(&self) -> [Option<Line2>; 2] {
        let of = |pixel: &Point2<f64>| {
            let geometry = self.geometry.as_ref().filter(|_| self.plane.is_some())?;
            Some((geometry.line1(pixel), geometry.line2(pixel)))
        };
        let (one, two) = self.pixels[0].as_ref().and_then(of).unwrap_or_default();
        [one, two]
    }

    /// How far p′ is from its line, pixels.
    pub(super) fn residual_px(&self) -> Option<f64> {
        let distance = self.lines()[1]?.signed_distance(&self.pixels[1]?);
        Some(distance.abs())
    }

    /// How far the point is in front of the surface that camera 1 sees there, along the optical axis;
    /// negative behind it. Zero on it.
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

/// What the first camera shows at a pixel.
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
            // Along the ray the plane stays, and so do both lines and p.
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
