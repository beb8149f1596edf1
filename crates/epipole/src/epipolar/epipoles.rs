//! Epipoles: the image of each camera in the other.

use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};

/// Image of the other camera's center.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Epipole {
    /// Pixel, perhaps far outside the image.
    Finite(Point2<f64>),
    /// Unit direction of an epipole beyond 10⁹ pixels, with arbitrary sign: all epipolar lines are
    /// parallel to it.
    AtInfinity(Vector2<f64>),
}

/// Computes the epipoles of images 1 and 2: `F e1 = 0` and `Fᵀ e2 = 0`.
///
/// If the rank is not exactly 2, these are the singular vectors of the smallest singular value.
///
/// # Errors
/// [`Error::Degenerate`] if F has rank 1 or 0, [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, §9.2.4.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{Epipole, epipoles, essential_from_motion};
/// // Straight ahead: each camera sees the other in the middle.
/// let e = essential_from_motion(&RigidTransform::translation(0.0, 0.0, -1.0))?;
/// let (Epipole::Finite(e1), Epipole::Finite(e2)) = epipoles(&e)? else { panic!() };
/// assert!(e1.coords.norm() < 1e-15 && e2.coords.norm() < 1e-15);
/// // Sideways: infinitely far, along u.
/// let e = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let Epipole::AtInfinity(direction) = epipoles(&e)?.0 else { panic!() };
/// assert!(direction.y.abs() < 1e-15);
/// # Ok(()) }
/// ```
pub fn epipoles(fundamental: &Matrix3<f64>) -> Result<(Epipole, Epipole)> {
    if !fundamental.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a fundamental matrix",
        });
    }
    let svd = svd3(fundamental);
    if svd.singular_values[1] <= 1e-14 * svd.singular_values[0] || svd.singular_values[0] == 0.0 {
        return Err(Error::Degenerate {
            what: "the epipole",
            why: "the fundamental matrix has rank 1 or 0",
        });
    }
    Ok((
        epipole(&svd.v.column(2).into_owned()),
        epipole(&svd.u.column(2).into_owned()),
    ))
}

fn epipole(direction: &Vector3<f64>) -> Epipole {
    let in_plane = direction.xy().norm();
    if direction.z.abs() > 1e-9 * in_plane {
        Epipole::Finite(Point2::new(
            direction.x / direction.z,
            direction.y / direction.z,
        ))
    } else {
        Epipole::AtInfinity(direction.xy() / in_plane)
    }
}

#[cfg(test)]
mod tests {
    use super::super::from_cameras::tests::random_cameras;
    use super::super::fundamental_from_cameras;
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn the_epipole_is_the_other_cameras_center() {
        let mut random = Random::new(9);
        let mut compared = 0;
        for _ in 0..100 {
            let (cam1, cam2) = random_cameras(&mut random);
            let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
            let (Epipole::Finite(e1), Epipole::Finite(e2)) = epipoles(&f).unwrap() else {
                continue;
            };
            // project rejects centers behind the camera, whose epipole is the same pixel.
            if let Ok(projected) = cam1.project(&cam2.center_in_world()) {
                assert!((e1 - projected).norm() < 1e-6 * (1.0 + projected.coords.norm()));
                compared += 1;
            }
            if let Ok(projected) = cam2.project(&cam1.center_in_world()) {
                assert!((e2 - projected).norm() < 1e-6 * (1.0 + projected.coords.norm()));
                compared += 1;
            }
        }
        assert!(compared > 30, "{compared}");
    }

    #[test]
    fn matrices_without_epipoles_are_refused() {
        assert!(epipoles(&Matrix3::zeros()).is_err());
        assert!(epipoles(&(Vector3::new(1.0, 2.0, 3.0) * Vector3::x().transpose())).is_err());
        assert!(epipoles(&Matrix3::from_element(f64::NAN)).is_err());
    }
}
