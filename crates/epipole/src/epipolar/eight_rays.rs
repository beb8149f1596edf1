//! Linear estimation of E from eight or more pairs of rays.

use super::essential::{bearing_row, project_to_essential};
use crate::math::null_space::right_singular_vectors;
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Vector3};

/// Estimates the essential matrix that minimizes `Σ (x2ᵀ E x1)²` over eight or more pairs of rays,
/// projected to singular values (1, 1, 0)/√2.
///
/// The rays of each camera are normalized first: a linear map equalizes their spread in all
/// directions, which matters for narrow fields of view.
///
/// * `rays1`, `rays2`: matching rays in the camera frames; their lengths do not matter
///
/// [`Error::TooFew`] for fewer than 8 pairs, [`Error::SizeMismatch`], [`Error::NotFinite`] for NaN,
/// infinities and zero rays, [`Error::Degenerate`] if the rays do not determine E.
///
/// Source: Hartley & Zisserman 2004, §11.7.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{essential_8point, essential_from_motion};
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// // Twelve points in the frame of camera 1; a ray is the direction to a point.
/// let points = (0..12).map(|i| Point3::new((i % 3) as f64 - 1.0, (i / 3) as f64 - 1.0, 4.0 + (i * i % 5) as f64));
/// let (rays1, rays2): (Vec<_>, Vec<_>) =
///     points.map(|x| (x.coords, (cam2_from_cam1 * x).coords)).unzip();
/// let (e, truth) = (essential_8point(&rays1, &rays2)?, essential_from_motion(&cam2_from_cam1)?);
/// assert!((e - truth).norm().min((e + truth).norm()) < 1e-9);
/// # Ok(()) }
/// ```
pub fn essential_8point(rays1: &[Vector3<f64>], rays2: &[Vector3<f64>]) -> Result<Matrix3<f64>> {
    if rays1.len() != rays2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching rays",
            first: rays1.len(),
            second: rays2.len(),
        });
    }
    if rays1.len() < 8 {
        return Err(Error::TooFew {
            what: "the eight-point algorithm",
            needed: 8,
            got: rays1.len(),
        });
    }
    let usable = |ray: &Vector3<f64>| {
        let length = ray.norm();
        length.is_finite() && length > f64::MIN_POSITIVE
    };
    if !rays1.iter().chain(rays2).all(usable) {
        return Err(Error::NotFinite {
            what: "a ray's direction",
        });
    }
    let [Some(t1), Some(t2)] = [rays1, rays2].map(evenly_spread) else {
        return Err(LEFT_OPEN);
    };
    let (values, vectors) = right_singular_vectors(rays1.len(), |i| {
        bearing_row(&(t1 * rays1[i].normalize()), &(t2 * rays2[i].normalize()))
    });
    if values[7] <= 1e-12 * values[0] {
        return Err(LEFT_OPEN);
    }
    project_to_essential(&(t2 * Matrix3::from_row_slice(&vectors[8]) * t1))
}

const LEFT_OPEN: Error = Error::Degenerate {
    what: "the essential matrix",
    why: "the rays fit many: they lie in a plane or a line, or the camera only rotated",
};

/// Hartley's normalization for rays of any field of view: returns the symmetric matrix that
/// equalizes the spread of the unit rays in all directions. `None` if they lie in a plane.
///
/// Source: Hartley 1997, "In defense of the eight-point algorithm", §5.3 (equal moments), in three
/// dimensions.
fn evenly_spread(rays: &[Vector3<f64>]) -> Option<Matrix3<f64>> {
    let mut moments = Matrix3::zeros();
    for ray in rays {
        let ray = ray.normalize();
        moments += ray * ray.transpose() / rays.len() as f64;
    }
    let svd = svd3(&moments);
    if svd.singular_values[2] <= 1e-14 * svd.singular_values[0] {
        return None;
    }
    let scales = svd.singular_values.map(|moment| 1.0 / moment.sqrt());
    Some(svd.v * Matrix3::from_diagonal(&scales) * svd.v.transpose())
}

#[cfg(test)]
mod tests {
    use super::super::essential_from_motion;
    use super::*;
    use crate::camera::RigidTransform;
    use crate::math::random::Random;

    /// Rays of a long lens hardly differ, and without normalization noise dominates: the median was
    /// .039, now .026.
    #[test]
    fn eight_rays_of_a_narrow_view_are_normalized() {
        let mut random = Random::new(8);
        let reach = libm::tan(5.5_f64.to_radians());
        let mut errors: Vec<f64> = (0..300)
            .map(|_| {
                let motion = RigidTransform::new(
                    Vector3::from_fn(|_, _| random.normal()).normalize(),
                    Vector3::from_fn(|_, _| 0.02 * random.normal()),
                );
                let truth = essential_from_motion(&motion).unwrap();
                let (r1, r2): (Vec<_>, Vec<_>) = (0..100)
                    .map(|_| {
                        let mut noise = || 2e-3 * reach * random.normal();
                        let noise = [noise(), noise(), noise(), noise()];
                        let depth = random.uniform(4.0, 12.0);
                        let x = nalgebra::Point3::new(
                            depth * random.uniform(-reach, reach),
                            0.3 * depth * random.uniform(-reach, reach),
                            depth,
                        );
                        let y = motion * x;
                        (
                            Vector3::new(x.x / x.z + noise[0], x.y / x.z + noise[1], 1.0),
                            Vector3::new(y.x / y.z + noise[2], y.y / y.z + noise[3], 1.0),
                        )
                    })
                    .unzip();
                let e = essential_8point(&r1, &r2).unwrap();
                (e - truth).norm().min((e + truth).norm())
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        assert!(errors[150] < 0.03, "{}", errors[150]);
    }
}
