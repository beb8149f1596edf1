//! Planes through a baseline, by their angle, and their intersections with two photographs.

use epipole::camera::{PosedCamera, relative_motion};
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2, Unit, UnitQuaternion, Vector3};

/// Planes through the centers of two cameras; the plane at angle 0 contains a given ray of camera
/// 1.
pub(super) struct Pencil {
    /// Direction of the baseline, in camera 1.
    baseline: Unit<Vector3<f64>>,
    /// Normal of the plane at angle 0, in camera 1.
    normal: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    /// `K⁻¹` of both cameras.
    inverse: [Matrix3<f64>; 2],
}

impl Pencil {
    /// Returns the planes through the baseline, with the ray of `pixel1` in the plane at angle 0.
    /// `None` if the cameras are at the same position, or the ray runs along the baseline.
    pub(super) fn new([first, second]: &[PosedCamera; 2], pixel1: &Point2<f64>) -> Option<Self> {
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        let center2 = motion.inverse().translation.vector;
        let baseline = Unit::try_new(center2, 1e-9)?;
        let inverse = [first, second].map(|camera| camera.camera.intrinsics.inverse_matrix());
        let normal = baseline.cross(&(inverse[0] * pixel1.to_homogeneous()));
        Some(Self {
            normal: Unit::try_new(normal, 1e-9)?.into_inner(),
            baseline,
            rotation: motion.rotation,
            inverse,
        })
    }

    /// Returns the lines in which the plane at this angle intersects both photographs; `None` if
    /// one is infinitely far away.
    pub(super) fn lines(&self, angle_rad: f64) -> Option<[Line2; 2]> {
        let turn = UnitQuaternion::from_axis_angle(&self.baseline, angle_rad);
        let normal1 = turn * self.normal;
        let normals = [normal1, self.rotation * normal1];
        let line = |index: usize| {
            Line2::from_homogeneous(&(self.inverse[index].transpose() * normals[index])).ok()
        };
        Some([line(0)?, line(1)?])
    }

    /// Returns the angle of the plane with the ray of a pixel of photograph 1, in (−π/2, π/2].
    pub(super) fn angle_rad(&self, pixel1: &Point2<f64>) -> f64 {
        let normal = self
            .baseline
            .cross(&(self.inverse[0] * pixel1.to_homogeneous()));
        let (sin, cos) = (
            self.normal.cross(&normal).dot(&self.baseline),
            self.normal.dot(&normal),
        );
        // A plane has two normals.
        libm::atan2(sin * cos.signum(), cos.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::geometry::Geometry;
    use crate::kit::scenes::{PHOTO_SIZE, still_life_pair};

    #[test]
    fn the_plane_of_a_ray_cuts_photograph_2_in_its_epipolar_line() {
        let cameras = still_life_pair(PHOTO_SIZE, 0.3, 0.2, 10.0);
        let pixel = Point2::new(240.0, 130.0);
        let pencil = Pencil::new(&cameras, &pixel).unwrap();
        let [line1, line2] = pencil.lines(0.0).unwrap();
        assert!(line1.signed_distance(&pixel).abs() < 1e-9);
        let wanted = Geometry::of(&cameras).unwrap().line2(&pixel).unwrap();
        for at in [0.0, 640.0].map(|x| Point2::new(x, 100.0)) {
            let foot = wanted.nearest(&at);
            assert!(line2.signed_distance(&foot).abs() < 1e-6);
        }
    }

    #[test]
    fn an_angle_leads_to_a_plane_and_back() {
        let cameras = still_life_pair(PHOTO_SIZE, 0.3, 0.2, 10.0);
        let pencil = Pencil::new(&cameras, &Point2::new(240.0, 130.0)).unwrap();
        for degrees in [-60.0_f64, -3.0, 0.0, 12.0, 85.0] {
            let [line, _] = pencil.lines(degrees.to_radians()).unwrap();
            let on_it = line.nearest(&Point2::new(50.0, 60.0));
            assert!((pencil.angle_rad(&on_it).to_degrees() - degrees).abs() < 1e-6);
        }
    }

    #[test]
    fn a_ray_along_the_baseline_has_no_plane() {
        let cameras = still_life_pair(PHOTO_SIZE, 0.0, 0.3, 0.0);
        let middle = cameras[0].camera.intrinsics.principal_point();
        assert!(Pencil::new(&cameras, &middle).is_none());
        let same = still_life_pair(PHOTO_SIZE, 0.0, 0.0, 0.0);
        assert!(Pencil::new(&same, &Point2::new(1.0, 2.0)).is_none());
    }
}
