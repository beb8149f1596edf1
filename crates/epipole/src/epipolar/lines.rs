//! Epipolar lines.

use crate::math::Line2;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// Computes the line of image 2 that contains the match of a pixel of image 1, `l2 = F x1`.
///
/// The line's sign is that of `F x1`.
///
/// # Errors
/// [`Error::Degenerate`] if `pixel1` is the epipole of image 1, whose match can be anywhere, or if
/// the line is at infinity; [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, §9.2.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{epipolar_line2, essential_from_motion};
/// use nalgebra::Point2;
/// // A step to the right: every point keeps its row.
/// let e = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let line2 = epipolar_line2(&e, &Point2::new(0.5, 0.25))?;
/// assert!(line2.signed_distance(&Point2::new(-3.0, 0.25)).abs() < 1e-15);
/// # Ok(()) }
/// ```
#[doc(alias = "computeCorrespondEpilines")]
pub fn epipolar_line2(fundamental: &Matrix3<f64>, pixel1: &Point2<f64>) -> Result<Line2> {
    let x1 = pixel1.to_homogeneous();
    let line = fundamental * x1;
    let rounding = fundamental.abs() * x1.abs();
    if !line.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "an epipolar line",
        });
    }
    if (0..3).all(|row| line[row].abs() <= 1e-12 * rounding[row]) {
        return Err(Error::Degenerate {
            what: "the epipolar line",
            why: "the pixel is the epipole",
        });
    }
    Line2::from_homogeneous(&line)
}

/// Computes the line of image 1 that contains the match of a pixel of image 2, `l1 = Fᵀ x2`.
///
/// # Errors
/// As [`epipolar_line2`], with the images exchanged.
///
/// Source: Hartley & Zisserman 2004, §9.2.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{epipolar_line1, essential_from_motion};
/// use nalgebra::Point2;
/// // Straight ahead: points move away from the middle, so they were on the line to it.
/// let e = essential_from_motion(&RigidTransform::translation(0.0, 0.0, -1.0))?;
/// let line1 = epipolar_line1(&e, &Point2::new(4.0, 2.0))?;
/// assert!(line1.signed_distance(&Point2::new(2.0, 1.0)).abs() < 1e-15);
/// # Ok(()) }
/// ```
pub fn epipolar_line1(fundamental: &Matrix3<f64>, pixel2: &Point2<f64>) -> Result<Line2> {
    epipolar_line2(&fundamental.transpose(), pixel2)
}

#[cfg(test)]
mod tests {
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::{Epipole, epipoles, fundamental_from_cameras};
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn lines_pass_through_the_match_and_the_epipole() {
        let mut random = Random::new(5);
        for _ in 0..100 {
            let (cam1, cam2) = random_cameras(&mut random);
            let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
            let point = random_point(&mut random);
            let (x1, x2) = (cam1.project(&point).unwrap(), cam2.project(&point).unwrap());
            let line2 = epipolar_line2(&f, &x1).unwrap();
            let line1 = epipolar_line1(&f, &x2).unwrap();
            assert!(line2.signed_distance(&x2).abs() < 1e-7);
            assert!(line1.signed_distance(&x1).abs() < 1e-7);
            let (Epipole::Finite(e1), Epipole::Finite(e2)) = epipoles(&f).unwrap() else {
                panic!("these cameras see each other's centers at finite pixels");
            };
            assert!(line1.signed_distance(&e1).abs() < 1e-6 * (1.0 + e1.coords.norm()));
            assert!(line2.signed_distance(&e2).abs() < 1e-6 * (1.0 + e2.coords.norm()));
        }
    }

    #[test]
    fn the_epipole_has_no_line() {
        let mut random = Random::new(6);
        let (cam1, cam2) = random_cameras(&mut random);
        let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
        let Epipole::Finite(e1) = epipoles(&f).unwrap().0 else {
            panic!("finite epipole expected");
        };
        assert!(matches!(
            epipolar_line2(&f, &e1),
            Err(Error::Degenerate { .. })
        ));
        assert!(epipolar_line2(&f, &Point2::new(f64::NAN, 0.0)).is_err());
        assert!(epipolar_line2(&Matrix3::zeros(), &Point2::origin()).is_err());
    }
}
