//! Focal lengths of two cameras from F alone.

use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Vector2};

/// Minimum sine of the parallelepiped of baseline and optical axes; below it the axes meet up to
/// rounding.
const LEAST_VOLUME: f64 = 1e-9;

/// Computes the focal lengths, pixels, of camera 1 and camera 2, for square pixels without skew.
///
/// With the principal points as origins of the images, and `F = [A b; cᵀ d]`, an essential matrix
/// requires `f1² = −(e2 × b) d / (e2 × A c)`, with `e2` the epipole in image 2 and `×` the third
/// component of the product; f2 is that of Fᵀ.
///
/// * `fundamental`: F of rank 2 at any scale
/// * `principal1`, `principal2`: principal points, pixels; their errors affect the focal lengths
///   more the closer the axes come to each other
///
/// # Errors
/// [`Error::Degenerate`] if the optical axes meet or are parallel, hence for cameras that look at
/// one point: then a whole family of focal lengths fits. With noise the F of these cameras gives
/// nonsense, or a negative square, with the same error. [`Error::NotFinite`] for NaN and
/// infinities.
///
/// Source: Bougnoux 1998, "From projective to Euclidean space under any practical situation, a
/// criticism of self-calibration".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{
///     essential_from_motion, focal_lengths_from_fundamental, fundamental_from_essential,
/// };
/// use nalgebra::Vector3;
/// let (k1, k2) = (Intrinsics::centered(600.0, 640, 480)?, Intrinsics::centered(750.0, 640, 480)?);
/// let principal = k1.principal_point();
/// let focals = |rotation_vector: Vector3<f64>| {
///     let e = essential_from_motion(&RigidTransform::new(Vector3::new(-1.0, 0.1, 0.2), rotation_vector))?;
///     let f = fundamental_from_essential(&e, &k1, &k2)?;
///     focal_lengths_from_fundamental(&f, &principal, &principal)
/// };
/// let [f1, f2] = focals(Vector3::new(0.2, 0.1, 0.0))?;
/// assert!((f1 - 600.0).abs() < 1e-6 && (f2 - 750.0).abs() < 1e-6);
/// // Two cameras that look straight ahead.
/// assert!(focals(Vector3::zeros()).is_err());
/// # Ok(()) }
/// ```
pub fn focal_lengths_from_fundamental(
    fundamental: &Matrix3<f64>,
    principal1: &Point2<f64>,
    principal2: &Point2<f64>,
) -> Result<[f64; 2]> {
    let places = [principal1, principal2];
    let finite = fundamental.iter().all(|x| x.is_finite());
    if !finite || !places.iter().all(|p| p.x.is_finite() && p.y.is_finite()) {
        return Err(Error::NotFinite {
            what: "every entry of a fundamental matrix and of a principal point",
        });
    }
    let [to1, to2] = places.map(|p| Matrix3::new(1.0, 0.0, p.x, 0.0, 1.0, p.y, 0.0, 0.0, 1.0));
    let about = to2.transpose() * fundamental * to1;
    let open = Error::Degenerate {
        what: "a focal length from a fundamental matrix",
        why: "the optical axes meet or are parallel, or come too near to that for these matches; give the focal \
              length, or turn the camera aside between the images",
    };
    let squares = [first_focal_sq(&about), first_focal_sq(&about.transpose())];
    // Also false for NaN.
    if !squares.iter().all(|sq| *sq > 0.0 && sq.is_finite()) {
        return Err(open);
    }
    let [f1, f2] = squares.map(f64::sqrt);
    // With rays for pixels the last entry is the volume spanned by baseline and axes.
    let scale = |f: f64| Matrix3::from_diagonal(&nalgebra::Vector3::new(f, f, 1.0));
    let essential = scale(f2) * about * scale(f1);
    let volume = essential[(2, 2)].abs() / essential.norm();
    if volume > LEAST_VOLUME {
        Ok([f1, f2])
    } else {
        Err(open)
    }
}

/// Returns f1² for an F whose origins are the principal points.
fn first_focal_sq(f: &Matrix3<f64>) -> f64 {
    let epipole = svd3(f).u.column(2).into_owned();
    let cross = |x: Vector2<f64>| epipole.x * x.y - epipole.y * x.x;
    let b = Vector2::new(f[(0, 2)], f[(1, 2)]);
    let c = Vector2::new(f[(2, 0)], f[(2, 1)]);
    let a_c = f.fixed_view::<2, 2>(0, 0) * c;
    -cross(b) * f[(2, 2)] / cross(a_c)
}

#[cfg(test)]
mod tests {
    use super::super::{essential_from_motion, estimate_fundamental, fundamental_from_essential};
    use super::*;
    use crate::camera::{Intrinsics, RigidTransform};
    use crate::math::random::Random;
    use crate::robust::RansacOptions;
    use nalgebra::{Point3, Vector3};

    fn cameras(random: &mut Random) -> [Intrinsics; 2] {
        [0, 1].map(|_| {
            let f = random.uniform(300.0, 3000.0);
            Intrinsics::new(
                f,
                f,
                random.uniform(300.0, 340.0),
                random.uniform(220.0, 260.0),
            )
            .unwrap()
        })
    }

    #[test]
    fn exact_matrices_give_exact_focal_lengths() {
        let mut random = Random::new(1);
        for _ in 0..500 {
            let [k1, k2] = cameras(&mut random);
            let mut vector = |reach: f64| Vector3::from_fn(|_, _| random.uniform(-reach, reach));
            let (rotation, shift) = (vector(1.0), vector(1.0));
            let motion = RigidTransform::new(shift, rotation);
            let axes_span = shift.normalize().cross(&(motion.rotation * Vector3::z())).z;
            if axes_span.abs() < 0.05 {
                continue;
            }
            let e = essential_from_motion(&motion).unwrap();
            let f = fundamental_from_essential(&e, &k1, &k2).unwrap();
            let places = [k1.principal_point(), k2.principal_point()];
            let found =
                focal_lengths_from_fundamental(&(f * -3.0), &places[0], &places[1]).unwrap();
            for (found, k) in found.iter().zip([k1, k2]) {
                assert!(
                    (found / k.fu_px() - 1.0).abs() < 1e-5,
                    "{found} {}",
                    k.fu_px()
                );
            }
        }
    }

    #[test]
    fn axes_that_meet_are_refused() {
        let k = Intrinsics::centered(600.0, 640, 480).unwrap();
        let principal = k.principal_point();
        let refused = |motion: &RigidTransform| {
            let e = essential_from_motion(motion).unwrap();
            let f = fundamental_from_essential(&e, &k, &k).unwrap();
            let found = focal_lengths_from_fundamental(&f, &principal, &principal);
            assert!(
                matches!(found, Err(Error::Degenerate { .. })),
                "{found:?} {motion}"
            );
        };
        let mut random = Random::new(2);
        for _ in 0..100 {
            let angle = random.uniform(-0.5, 0.5);
            // Both look at one point: around it, or rolled, or from different distances.
            let rotation = RigidTransform::new(Vector3::zeros(), Vector3::y() * angle);
            let pivot = Vector3::new(0.0, 0.0, 5.0);
            let around = RigidTransform::new(pivot - rotation * pivot, Vector3::y() * angle);
            refused(&around);
            let roll = RigidTransform::new(Vector3::zeros(), Vector3::z() * angle);
            refused(&(roll * around));
            refused(&(RigidTransform::translation(0.0, 0.0, 1.5) * around));
            let mut shift = || random.uniform(-1.0, 1.0);
            refused(&RigidTransform::translation(shift(), shift(), shift()));
        }
        let nan = Matrix3::from_element(f64::NAN);
        assert!(focal_lengths_from_fundamental(&nan, &principal, &principal).is_err());
        assert!(focal_lengths_from_fundamental(&Matrix3::zeros(), &principal, &principal).is_err());
    }

    /// Two views of points with the noise of good features, with outliers.
    #[test]
    fn noisy_matches_give_focal_lengths_within_a_few_percent() {
        let mut random = Random::new(3);
        let [k1, k2] = [700.0, 900.0].map(|f| Intrinsics::centered(f, 800, 600).unwrap());
        let motion =
            RigidTransform::new(Vector3::new(-1.5, 0.8, 0.4), Vector3::new(0.35, 0.3, 0.2));
        let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
        while pixels1.len() < 600 {
            let mut at = |reach: f64| random.uniform(-reach, reach);
            let x = Point3::new(at(2.0), at(1.5), 5.0 + at(2.0));
            let (Ok(p1), Ok(p2)) = (k1.project(&x), k2.project(&(motion * x))) else {
                continue;
            };
            let mut noise = || nalgebra::Vector2::new(random.normal(), random.normal()) * 0.2;
            let (n1, n2) = (noise(), noise());
            pixels1.push(p1 + n1);
            pixels2.push(if pixels1.len() % 5 == 0 {
                p1 + 40.0 * n2
            } else {
                p2 + n2
            });
        }
        let report =
            estimate_fundamental(&pixels1, &pixels2, &RansacOptions::default(), &mut ()).unwrap();
        let places = [k1.principal_point(), k2.principal_point()];
        let [f1, f2] =
            focal_lengths_from_fundamental(&report.model, &places[0], &places[1]).unwrap();
        assert!(
            (f1 / 700.0 - 1.0).abs() < 0.05 && (f2 / 900.0 - 1.0).abs() < 0.05,
            "{f1} {f2}"
        );
    }
}
