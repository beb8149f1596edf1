//! Transfer of pixels from a photo to a neighbor.

use super::plane::Plane;
use crate::camera::{PosedCamera, relative_motion};

/// Maps pixel (u, v) with inverse depth w to `q = A (u, v, 1) + w b` of another camera: the pixel
/// is `q.xy / q.z`, the inverse depth there `w / q.z`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// A, row by row.
    of_ray: [[f64; 3]; 3],
    /// b.
    of_inverse_depth: [f64; 3],
    /// Image motion per unit of inverse depth, in the middle, pixels.
    pub(super) px_per_inverse_depth: f64,
}

/// Minimum depth relative to that in the other photo; below it a point counts as behind the camera.
const MIN_DEPTH: f64 = 1e-9;

/// Transfer of a small piece of a plane: its middle, and the Jacobian between pixels,
/// `[∂x/∂u, ∂x/∂v, ∂y/∂u, ∂y/∂v]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Affine {
    pub(super) center: [f32; 2],
    pub(super) matrix: [f32; 4],
}

impl Pair {
    /// Creates the transfer between two cameras without distortion.
    pub(super) fn new(from: &PosedCamera, to: &PosedCamera) -> Self {
        let motion = relative_motion(&from.cam_from_world, &to.cam_from_world);
        let k = to.camera.intrinsics.matrix();
        let rotation = motion.rotation.to_rotation_matrix();
        let of_ray = k * rotation.matrix() * from.camera.intrinsics.inverse_matrix();
        Self {
            of_ray: of_ray.transpose().into(),
            of_inverse_depth: (k * motion.translation.vector).into(),
            px_per_inverse_depth: to.camera.intrinsics.fu_px() * motion.translation.vector.norm(),
        }
    }

    /// Returns `A (u, v, 1)`.
    #[inline(always)]
    pub(super) fn of_pixel(&self, u: f64, v: f64) -> [f64; 3] {
        let a = &self.of_ray;
        [
            a[0][0] * u + a[0][1] * v + a[0][2],
            a[1][0] * u + a[1][1] * v + a[1][2],
            a[2][0] * u + a[2][1] * v + a[2][2],
        ]
    }

    /// Returns the pixel and inverse depth of a point given by `of_pixel` and an inverse depth;
    /// `None` behind the camera.
    #[inline(always)]
    pub(super) fn transfer(&self, of_pixel: &[f64; 3], inverse_depth: f64) -> Option<[f64; 3]> {
        let b = &self.of_inverse_depth;
        let z = of_pixel[2] + inverse_depth * b[2];
        if z <= MIN_DEPTH {
            return None;
        }
        let scale = 1.0 / z;
        let x = (of_pixel[0] + inverse_depth * b[0]) * scale;
        let y = (of_pixel[1] + inverse_depth * b[1]) * scale;
        Some([x, y, inverse_depth * scale])
    }

    /// Returns the transfer of a piece of a plane; `None` behind the camera.
    #[inline(always)]
    pub(super) fn affine(&self, of_pixel: &[f64; 3], plane: Plane) -> Option<Affine> {
        let (a, b) = (&self.of_ray, &self.of_inverse_depth);
        let (w, du, dv) = (
            f64::from(plane.inverse_depth),
            f64::from(plane.du),
            f64::from(plane.dv),
        );
        let z = of_pixel[2] + w * b[2];
        if z <= MIN_DEPTH {
            return None;
        }
        let scale = 1.0 / z;
        let x = (of_pixel[0] + w * b[0]) * scale;
        let y = (of_pixel[1] + w * b[1]) * scale;
        let zu = a[2][0] + du * b[2];
        let zv = a[2][1] + dv * b[2];
        let xu = (a[0][0] + du * b[0] - x * zu) * scale;
        let xv = (a[0][1] + dv * b[0] - x * zv) * scale;
        let yu = (a[1][0] + du * b[1] - y * zu) * scale;
        let yv = (a[1][1] + dv * b[1] - y * zv) * scale;
        Some(Affine {
            center: [x as f32, y as f32],
            matrix: [xu as f32, xv as f32, yu as f32, yv as f32],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, RigidTransform};
    use nalgebra::{Point2, Point3, Vector3};

    #[test]
    fn pixels_of_a_plane_map_to_their_projections() {
        let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
        let camera = Camera::pinhole(k, 640, 480);
        let from = PosedCamera {
            camera,
            cam_from_world: RigidTransform::identity(),
        };
        let to = PosedCamera {
            camera,
            cam_from_world: RigidTransform::new(
                Vector3::new(-0.4, 0.1, 0.05),
                Vector3::new(0.02, -0.1, 0.03),
            ),
        };
        let pair = Pair::new(&from, &to);
        let normal = Vector3::new(0.3, -0.2, -0.9);
        let at = |u: f64, v: f64| {
            let ray = k.ray(&Point2::new(u, v));
            Point3::from(ray * (normal.z * 4.0 / normal.dot(&ray)))
        };
        let (u, v) = (300.0, 200.0);
        let (here, ray) = (at(u, v), k.ray(&Point2::new(u, v)));
        let there = to.project(&here).unwrap();
        let depth = (to.cam_from_world * here).z;
        let of_pixel = pair.of_pixel(u, v);
        let [x, y, w] = pair.transfer(&of_pixel, 1.0 / here.z).unwrap();
        assert!((Point2::new(x, y) - there).norm() < 1e-9 && (w * depth - 1.0).abs() < 1e-9);
        let plane = Plane::from_normal(&k, &ray, 1.0 / here.z, &normal);
        let affine = pair.affine(&of_pixel, plane).unwrap();
        let [xu, xv, yu, yv] = affine.matrix.map(f64::from);
        let beside = to.project(&at(u + 3.0, v - 2.0)).unwrap();
        let predicted = Point2::new(x + 3.0 * xu - 2.0 * xv, y + 3.0 * yu - 2.0 * yv);
        assert!((beside - predicted).norm() < 0.02, "{beside} {predicted}");
        let shift = pair.transfer(&of_pixel, 1.0 / here.z + 1e-3).unwrap();
        let moved = libm::hypot(shift[0] - x, shift[1] - y) / 1e-3;
        assert!((moved / pair.px_per_inverse_depth - 1.0).abs() < 0.2);
    }
}
