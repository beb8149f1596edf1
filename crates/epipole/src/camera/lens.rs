//! Lens distortion by any model.

use super::{Distortion, Division, Fisheye, Intrinsics, LensKind, RationalDistortion};
use crate::{Error, Result};
use nalgebra::{Matrix2x3, Point2, Vector3};

/// Lens distortion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Lens {
    /// Five coefficients, for ordinary lenses.
    Brown(Distortion),
    /// Eight coefficients, for wide-angle lenses.
    Rational(RationalDistortion),
    /// Four coefficients, for fields of view of 120° and more.
    Fisheye(Fisheye),
    /// One coefficient.
    Division(Division),
}

const NOT_FINITE: Error = Error::NotFinite {
    what: "every coefficient of the lens distortion",
};

/// Maximum number of coefficients of a model.
pub(crate) const MAX_COEFFICIENTS: usize = 8;

impl Lens {
    /// No distortion.
    pub const NONE: Self = Self::Brown(Distortion::NONE);

    /// Creates a lens from its coefficients, in OpenCV's order: k1, k2, p1, p2, k3 (Brown), then
    /// k4, k5, k6 (rational); k1 to k4 (fisheye). The division model, which OpenCV lacks, has only
    /// k.
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for another number of coefficients, [`Error::NotFinite`] for NaN and
    /// infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Lens, LensKind};
    /// let lens = Lens::from_coefficients(LensKind::Fisheye, &[0.01, 0.0, 0.0, 0.0])?;
    /// assert_eq!(lens.coefficients(), [0.01, 0.0, 0.0, 0.0]);
    /// # Ok(()) }
    /// ```
    pub fn from_coefficients(kind: LensKind, coefficients: &[f64]) -> Result<Self> {
        if coefficients.len() != kind.num_coefficients() {
            return Err(Error::SizeMismatch {
                what: "the lens model and its list of coefficients",
                first: kind.num_coefficients(),
                second: coefficients.len(),
            });
        }
        if coefficients.iter().any(|k| !k.is_finite()) {
            return Err(NOT_FINITE);
        }
        let mut all = [0.0; MAX_COEFFICIENTS];
        all[..coefficients.len()].copy_from_slice(coefficients);
        Ok(Self::of(kind, all))
    }

    /// Creates a lens from the first of these coefficients, as many as the model has.
    pub(crate) fn of(kind: LensKind, k: [f64; MAX_COEFFICIENTS]) -> Self {
        let brown = Distortion {
            k1: k[0],
            k2: k[1],
            p1: k[2],
            p2: k[3],
            k3: k[4],
        };
        match kind {
            LensKind::Brown => Self::Brown(brown),
            LensKind::Rational => Self::Rational(RationalDistortion {
                numerator: brown,
                denominator: [k[5], k[6], k[7]],
            }),
            LensKind::Fisheye => Self::Fisheye(Fisheye {
                coefficients: [k[0], k[1], k[2], k[3]],
            }),
            LensKind::Division => Self::Division(Division { k: k[0] }),
        }
    }

    /// Returns the model.
    pub fn kind(&self) -> LensKind {
        match self {
            Self::Brown(_) => LensKind::Brown,
            Self::Rational(_) => LensKind::Rational,
            Self::Fisheye(_) => LensKind::Fisheye,
            Self::Division(_) => LensKind::Division,
        }
    }

    /// Returns the coefficients, in OpenCV's order.
    pub fn coefficients(&self) -> Vec<f64> {
        self.numbers()[..self.kind().num_coefficients()].to_vec()
    }

    /// Returns the coefficients, in OpenCV's order; those that the model lacks are 0.
    fn numbers(&self) -> [f64; MAX_COEFFICIENTS] {
        let brown =
            |d: &Distortion, [k4, k5, k6]: [f64; 3]| [d.k1, d.k2, d.p1, d.p2, d.k3, k4, k5, k6];
        match self {
            Self::Brown(d) => brown(d, [0.0; 3]),
            Self::Rational(r) => brown(&r.numerator, r.denominator),
            Self::Fisheye(f) => {
                let [k1, k2, k3, k4] = f.coefficients;
                [k1, k2, k3, k4, 0.0, 0.0, 0.0, 0.0]
            }
            Self::Division(d) => [d.k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        }
    }

    /// Returns whether there is no distortion, as for a pinhole camera.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// # Errors
    /// [`Error::NotFinite`] for a coefficient that is NaN or infinite.
    pub(crate) fn check(&self) -> Result<()> {
        match self.numbers().iter().all(|k| k.is_finite()) {
            true => Ok(()),
            false => Err(NOT_FINITE),
        }
    }

    /// Adds to the first coefficients.
    pub(crate) fn moved(&self, by: &[f64]) -> Self {
        let mut numbers = self.numbers();
        for (number, by) in numbers.iter_mut().zip(by) {
            *number += by;
        }
        Self::of(self.kind(), numbers)
    }

    /// Returns the distorted position of a point of the camera frame, in units of the focal length.
    /// `None` if the lens does not see it: points behind the camera, except with a fisheye.
    ///
    /// ```
    /// use epipole::camera::{Distortion, Lens};
    /// use nalgebra::{Point2, Vector3};
    /// let lens = Lens::Brown(Distortion::NONE);
    /// assert_eq!(lens.project(&Vector3::new(1.0, 2.0, 4.0)), Some(Point2::new(0.25, 0.5)));
    /// assert_eq!(lens.project(&Vector3::new(1.0, 2.0, -4.0)), None);
    /// ```
    pub fn project(&self, x_in_cam: &Vector3<f64>) -> Option<Point2<f64>> {
        let flat = || (x_in_cam.z > 0.0).then(|| Point2::from(x_in_cam.xy() / x_in_cam.z));
        let distorted = match self {
            Self::Brown(d) => d.distort(&flat()?),
            Self::Rational(r) => r.distort(&flat()?),
            Self::Fisheye(f) => f.project(x_in_cam)?,
            Self::Division(d) => d.distort(&flat()?),
        };
        (distorted.x.is_finite() && distorted.y.is_finite()).then_some(distorted)
    }

    /// Projects a point of the camera frame, in units of the focal length; not finite if there is
    /// no image. A point behind the camera is mirrored through the center, except by a fisheye.
    #[inline]
    pub(crate) fn project_or_mirror(&self, p: &Vector3<f64>) -> Point2<f64> {
        match self {
            Self::Brown(d) => d.distort(&Point2::new(p.x / p.z, p.y / p.z)),
            _ => self.project_or_mirror_beyond_brown(p),
        }
    }

    /// Kept out of line: bundle adjustment inlines Brown's model into its inner loop.
    fn project_or_mirror_beyond_brown(&self, p: &Vector3<f64>) -> Point2<f64> {
        let flat = || Point2::new(p.x / p.z, p.y / p.z);
        match self {
            Self::Brown(d) => d.distort(&flat()),
            Self::Rational(r) => r.distort(&flat()),
            Self::Fisheye(f) => f.project(p).unwrap_or(Point2::new(f64::NAN, f64::NAN)),
            Self::Division(d) => d.distort(&flat()),
        }
    }

    /// Returns the pixel of a point of the camera frame for these intrinsics; `None` as for
    /// [`project`](Self::project).
    pub(crate) fn pixel(&self, k: &Intrinsics, x_in_cam: &Vector3<f64>) -> Option<Point2<f64>> {
        let bent = self.project(x_in_cam)?;
        let center = k.principal_point();
        let pixel = Point2::new(k.fu_px() * bent.x + center.x, k.fv_px() * bent.y + center.y);
        (pixel.x.is_finite() && pixel.y.is_finite()).then_some(pixel)
    }

    /// Returns the ray imaged at a position, in the camera frame, of any length.
    ///
    /// # Errors
    /// As [`Distortion::undistort`], [`RationalDistortion::undistort`] and [`Fisheye::ray`].
    pub fn ray(&self, distorted: &Point2<f64>) -> Result<Vector3<f64>> {
        let at_one = |ray: Point2<f64>| Vector3::new(ray.x, ray.y, 1.0);
        match self {
            Self::Brown(d) => d.undistort(distorted).map(at_one),
            Self::Rational(r) => r.undistort(distorted).map(at_one),
            Self::Fisheye(f) => f.ray(distorted),
            Self::Division(d) => d.undistort(distorted).map(at_one),
        }
    }

    /// Returns the lens after rotating its image clockwise by `quarters` times 90°, as
    /// [`Intrinsics::rotated`]: only tangential terms depend on direction.
    ///
    /// [`Intrinsics::rotated`]: super::Intrinsics::rotated
    ///
    /// ```
    /// use epipole::camera::{Distortion, Lens};
    /// use nalgebra::{Point2, Vector3};
    /// let lens = Lens::Brown(Distortion { k1: -0.1, p1: 0.01, p2: 0.02, ..Distortion::NONE });
    /// // The right side of the image is then at the bottom.
    /// let distorted = lens.project(&Vector3::new(0.3, 0.1, 1.0)).unwrap();
    /// let rotated = lens.rotated(1).project(&Vector3::new(-0.1, 0.3, 1.0)).unwrap();
    /// assert!((rotated - Point2::new(-distorted.y, distorted.x)).norm() < 1e-15);
    /// ```
    pub fn rotated(&self, quarters: u8) -> Self {
        let rotate_quarter = |d: &Distortion| {
            let mut rotated = *d;
            for _ in 0..quarters % 4 {
                // (p2, p1) is a direction of the image.
                (rotated.p2, rotated.p1) = (-rotated.p1, rotated.p2);
            }
            rotated
        };
        match self {
            Self::Brown(d) => Self::Brown(rotate_quarter(d)),
            Self::Rational(r) => Self::Rational(RationalDistortion {
                numerator: rotate_quarter(&r.numerator),
                denominator: r.denominator,
            }),
            Self::Fisheye(_) | Self::Division(_) => *self,
        }
    }

    /// Returns whether the lens sees a ray inside the fold of its model.
    pub fn is_visible(&self, x_in_cam: &Vector3<f64>) -> bool {
        let flat = Point2::from(x_in_cam.xy() / x_in_cam.z);
        match self {
            Self::Brown(d) => x_in_cam.z > 0.0 && d.is_visible(&flat),
            Self::Rational(r) => x_in_cam.z > 0.0 && flat.coords.norm_squared() < r.fold_sq(),
            Self::Fisheye(f) => f.is_visible(x_in_cam),
            Self::Division(d) => x_in_cam.z > 0.0 && d.is_visible(&flat),
        }
    }

    /// Returns the derivatives of [`project`](Self::project) by the point and by the coefficients,
    /// 0 for those that the model lacks.
    pub(crate) fn derivatives(
        &self,
        x_in_cam: &Vector3<f64>,
    ) -> (Matrix2x3<f64>, [[f64; MAX_COEFFICIENTS]; 2]) {
        let z = x_in_cam.z;
        let flat = Point2::from(x_in_cam.xy() / z);
        let flatten = Matrix2x3::new(1.0, 0.0, -flat.x, 0.0, 1.0, -flat.y) / z;
        let rational = match self {
            Self::Brown(numerator) => RationalDistortion {
                numerator: *numerator,
                denominator: [0.0; 3],
            },
            Self::Rational(rational) => *rational,
            Self::Fisheye(fisheye) => {
                let (by_point, by_four) = fisheye.derivatives(x_in_cam);
                let mut by_all = [[0.0; MAX_COEFFICIENTS]; 2];
                for (all, four) in by_all.iter_mut().zip(by_four) {
                    all[..4].copy_from_slice(&four);
                }
                return (by_point, by_all);
            }
            Self::Division(division) => {
                let by_k = division.by_k(&flat);
                let mut by_all = [[0.0; MAX_COEFFICIENTS]; 2];
                for (all, k) in by_all.iter_mut().zip(by_k) {
                    all[0] = k;
                }
                return (division.jacobian(&flat) * flatten, by_all);
            }
        };
        let bend = rational.jacobian(&flat);
        let mut by_coefficients = rational.by_coefficients(&flat);
        if self.kind() == LensKind::Brown {
            for row in &mut by_coefficients {
                row[5..].fill(0.0);
            }
        }
        (bend * flatten, by_coefficients)
    }
}

impl Default for Lens {
    fn default() -> Self {
        Self::NONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn lenses() -> [Lens; 4] {
        [
            Lens::of(
                LensKind::Brown,
                [-0.3, 0.1, 0.002, -0.001, -0.01, 0.0, 0.0, 0.0],
            ),
            Lens::of(
                LensKind::Rational,
                [0.4, -0.1, 0.002, -0.001, 0.01, 0.6, 0.05, 0.01],
            ),
            Lens::of(
                LensKind::Fisheye,
                [-0.02, 0.008, -0.004, 6e-4, 0.0, 0.0, 0.0, 0.0],
            ),
            Lens::of(
                LensKind::Division,
                [-0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            ),
        ]
    }

    #[test]
    fn derivatives_are_differences() {
        let mut random = Random::new(3);
        for lens in lenses() {
            let kind = lens.kind();
            let numbers = lens.coefficients();
            assert_eq!(Lens::from_coefficients(kind, &numbers).unwrap(), lens);
            for _ in 0..30 {
                let x = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)) + 2.0 * Vector3::z();
                let (by_point, by_k) = lens.derivatives(&x);
                let h = 1e-6;
                for axis in 0..3 {
                    let mut step = Vector3::zeros();
                    step[axis] = h;
                    let [up, down] = [x + step, x - step].map(|x| lens.project(&x).unwrap());
                    assert!((by_point.column(axis) - (up - down) / (2.0 * h)).norm() < 1e-8);
                }
                for k in 0..kind.num_coefficients() {
                    let [up, down] = [h, -h].map(|d| {
                        let mut moved = numbers.clone();
                        moved[k] += d;
                        Lens::from_coefficients(kind, &moved)
                            .unwrap()
                            .project(&x)
                            .unwrap()
                    });
                    let slope = (up - down) / (2.0 * h);
                    assert!((slope.x - by_k[0][k]).abs() + (slope.y - by_k[1][k]).abs() < 1e-8);
                }
                let ray = lens.ray(&lens.project(&x).unwrap()).unwrap();
                assert!(ray.normalize().cross(&x.normalize()).norm() < 1e-9);
                assert!(lens.is_visible(&x));
                assert_eq!(lens.project(&x), Some(lens.project_or_mirror(&x)));
            }
            assert!(!lens.is_visible(&-Vector3::z()));
            assert!(!lens.is_none() && lens.check().is_ok());
            assert!(lens.moved(&[f64::NAN]).check().is_err());
        }
    }

    /// A fisheye with zero coefficients is still no pinhole camera.
    #[test]
    fn only_a_fisheye_sees_behind_its_image_plane() {
        assert!(Lens::NONE.is_none() && !Lens::from(Fisheye::default()).is_none());
        let k = Intrinsics::centered(100.0, 200, 200).unwrap();
        let behind = Vector3::new(1.0, 0.0, -0.2);
        assert!(Lens::from(Fisheye::default()).pixel(&k, &behind).is_some());
        assert!(Lens::NONE.pixel(&k, &behind).is_none());
        assert!(
            Lens::from(Division { k: -0.1 })
                .pixel(&k, &behind)
                .is_none()
        );
    }

    #[test]
    fn bad_numbers_are_refused() {
        assert!(Lens::from_coefficients(LensKind::Brown, &[0.0; 4]).is_err());
        assert!(Lens::from_coefficients(LensKind::Fisheye, &[f64::NAN; 4]).is_err());
    }
}
