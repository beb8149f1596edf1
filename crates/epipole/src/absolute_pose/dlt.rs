//! Linear estimation of a camera pose from six or more points.

use super::refine::rigid;
use crate::camera::{Intrinsics, RigidTransform};
use crate::math::null_space::right_singular_vectors;
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// Estimates the pose from six or more points by the direct linear transform: `P = [R t]`
/// minimizing the algebraic error, then the nearest rotation. Suitable as initial value of
/// [`refine_absolute_pose`](super::refine_absolute_pose).
///
/// * `points_in_world`, `pixels`: points and their projections, at least 6, not all on a plane
///
/// Returns `cam_from_world`. World points are first translated and scaled to root-mean-square
/// distance √3.
///
/// # Errors
/// [`Error::TooFew`] for fewer than 6 points, [`Error::SizeMismatch`], [`Error::NotFinite`] for NaN
/// and infinities, [`Error::Degenerate`] if the points lie on a plane or in another critical
/// configuration.
///
/// Source: Hartley & Zisserman 2004, §7.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::pose_dlt;
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.2, 0.3));
/// let (mut points, mut pixels) = (Vec::new(), Vec::new());
/// for i in 0..12 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, f64::from(i * i % 7) - 2.0);
///     points.push(x);
///     pixels.push(k.project(&(cam_from_world * x))?);
/// }
/// let found = pose_dlt(&points, &pixels, &k)?;
/// assert!(found.rotation.angle_to(&cam_from_world.rotation) < 1e-7);
/// assert!((found.translation.vector - cam_from_world.translation.vector).norm() < 1e-7);
/// # Ok(()) }
/// ```
pub fn pose_dlt(
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    intrinsics: &Intrinsics,
) -> Result<RigidTransform> {
    let what = "a camera pose from points";
    if points_in_world.len() != pixels.len() {
        return Err(Error::SizeMismatch {
            what: "the list of points and that of their pixels",
            first: points_in_world.len(),
            second: pixels.len(),
        });
    }
    if pixels.len() < 6 {
        return Err(Error::TooFew {
            what,
            needed: 6,
            got: pixels.len(),
        });
    }
    let weight = 1.0 / pixels.len() as f64;
    let mut center = Vector3::zeros();
    for p in points_in_world {
        center += p.coords * weight;
    }
    let mut spread = 0.0;
    for p in points_in_world {
        spread += (p.coords - center).norm_squared() * weight;
    }
    let rays: Vec<Vector3<f64>> = pixels.iter().map(|p| intrinsics.ray(p)).collect();
    if !spread.is_finite() || !rays.iter().all(|r| r.x.is_finite() && r.y.is_finite()) {
        return Err(Error::NotFinite {
            what: "a point or its pixel",
        });
    }
    let degenerate = Error::Degenerate {
        what,
        why: "the points lie on a plane or are otherwise critical",
    };
    if spread <= f64::MIN_POSITIVE {
        return Err(degenerate);
    }
    let scale = (3.0 / spread).sqrt();
    let (values, vectors) = right_singular_vectors(2 * rays.len(), |row| {
        let ray = rays[row / 2];
        let x = (points_in_world[row / 2].coords - center) * scale;
        if row % 2 == 0 {
            let w = -ray.x;
            [
                x.x,
                x.y,
                x.z,
                1.0,
                0.0,
                0.0,
                0.0,
                0.0,
                w * x.x,
                w * x.y,
                w * x.z,
                w,
            ]
        } else {
            let w = -ray.y;
            [
                0.0,
                0.0,
                0.0,
                0.0,
                x.x,
                x.y,
                x.z,
                1.0,
                w * x.x,
                w * x.y,
                w * x.z,
                w,
            ]
        }
    });
    if values[10] <= 1e-9 * values[0] {
        return Err(degenerate);
    }
    let p = &vectors[11];
    let left = Matrix3::new(p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]);
    let last = Vector3::new(p[3], p[7], p[11]);
    let svd = svd3(&left);
    let sign = left.determinant().signum();
    let size = svd.singular_values.mean() * sign;
    if svd.singular_values[2] <= 1e-9 * svd.singular_values[0] {
        return Err(degenerate);
    }
    let mut rotation = svd.u * svd.v.transpose();
    if rotation.determinant() < 0.0 {
        rotation = -rotation;
    }
    // P maps normalized points: x' = s (x − c), so [R t] has t = last/size/s − R c.
    let t = last / (size * scale) - rotation * center;
    if !t.iter().all(|x| x.is_finite()) {
        return Err(degenerate);
    }
    Ok(rigid(&(rotation, t), &center))
}

#[cfg(test)]
mod tests {
    use super::super::p3p::tests::problem;
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn exact_points_give_the_truth() {
        let mut random = Random::new(1);
        let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
        for _ in 0..100 {
            let (truth, rays, points) = problem::<12>(&mut random);
            let pixels = rays.map(|r| k.project(&r.into()).unwrap());
            let found = pose_dlt(&points, &pixels, &k).unwrap();
            assert!(found.rotation.angle_to(&truth.rotation) < 1e-6);
            assert!((found.translation.vector - truth.translation.vector).norm() < 1e-6);
        }
    }

    #[test]
    fn degenerate_points_are_refused() {
        let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
        let mut random = Random::new(2);
        let plane: Vec<_> = (0..10)
            .map(|_| Point3::new(random.normal(), random.normal(), 6.0))
            .collect();
        let pixels: Vec<_> = plane.iter().map(|p| k.project(p).unwrap()).collect();
        assert!(matches!(
            pose_dlt(&plane, &pixels, &k),
            Err(Error::Degenerate { .. })
        ));
        let same = vec![Point3::new(0.0, 0.0, 5.0); 10];
        assert!(pose_dlt(&same, &pixels, &k).is_err());
        assert!(pose_dlt(&plane[..5], &pixels[..5], &k).is_err());
        assert!(pose_dlt(&plane, &pixels[..5], &k).is_err());
        let mut bad = plane.clone();
        bad[0].x = f64::NAN;
        assert!(pose_dlt(&bad, &pixels, &k).is_err());
    }
}
