//! A lens as reconstruction carries it.

use super::wide::{WIDE, Wide};
use crate::camera::{
    Distortion, Division, Fisheye, Intrinsics, Lens, LensKind, MAX_COEFFICIENTS, RationalDistortion,
};
use crate::{Error, Result};
use core::fmt;
use nalgebra::{Matrix2x3, Point2, Vector3};

/// The lens of photographs, whichever model describes it: what a [`Lens`] is, made for reconstruction.
///
/// It is made [from](From) a lens of any model. Brown's is at hand always; what the other models need comes along with
/// one of them, so that a program which makes none has no code for it.
///
/// ```
/// use epipole::camera::{Distortion, Fisheye, LensKind};
/// use epipole::sfm::SfmLens;
/// let fisheye = SfmLens::from(Fisheye { coefficients: [0.01, 0.0, 0.0, 0.0] });
/// assert_eq!((fisheye.kind(), fisheye.coefficients()), (LensKind::Fisheye, &[0.01, 0.0, 0.0, 0.0][..]));
/// assert_eq!(SfmLens::from(Distortion::NONE), SfmLens::NONE);
/// ```
#[derive(Clone, Copy)]
pub struct SfmLens {
    kind: LensKind,
    /// In OpenCV's order; those that the model lacks are 0.
    numbers: [f64; MAX_COEFFICIENTS],
    /// `None` for Brown's model.
    wide: Option<&'static Wide>,
}

impl SfmLens {
    /// A lens that bends nothing.
    pub const NONE: Self = Self {
        kind: LensKind::Brown,
        numbers: [0.0; MAX_COEFFICIENTS],
        wide: None,
    };

    fn wide(kind: LensKind, coefficients: &[f64]) -> Self {
        let mut lens = Self {
            kind,
            wide: Some(&WIDE),
            ..Self::NONE
        };
        lens.numbers[..coefficients.len()].copy_from_slice(coefficients);
        lens
    }

    /// Which model it is.
    pub fn kind(&self) -> LensKind {
        self.kind
    }

    /// Its numbers, in OpenCV's order.
    pub fn coefficients(&self) -> &[f64] {
        &self.numbers[..self.kind.num_coefficients()]
    }

    /// The same for the rooms that take a [`Lens`].
    pub fn to_lens(&self) -> Lens {
        Lens::of(self.kind, self.numbers)
    }

    /// Whether it bends nothing: a pinhole camera's.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// # Errors
    /// [`Error::NotFinite`] for a coefficient that is NaN or infinite.
    pub(super) fn check(&self) -> Result<()> {
        match self.numbers.iter().all(|k| k.is_finite()) {
            true => Ok(()),
            false => Err(Error::NotFinite {
                what: "every coefficient of the lens distortion",
            }),
        }
    }

    /// What it needs beyond Brown's model.
    pub(super) fn beyond_brown(&self) -> Option<&'static Wide> {
        self.wide
    }

    /// The numbers of Brown's model; of another they say nothing.
    pub(super) fn brown(&self) -> Distortion {
        let [k1, k2, p1, p2, k3, ..] = self.numbers;
        Distortion { k1, k2, p1, p2, k3 }
    }

    /// With its first coefficients moved.
    pub(super) fn moved(&self, by: &[f64]) -> Self {
        let mut moved = *self;
        for (number, by) in moved.numbers.iter_mut().zip(by) {
            *number += by;
        }
        moved
    }

    /// Where a point of the camera frame is seen, in units of the focal length; not finite where it is not. A point
    /// behind is mirrored through the center, except by a fisheye.
    #[inline]
    pub(super) fn shown(&self, p: &Vector3<f64>) -> Point2<f64> {
        match self.wide {
            None => (self.brown()).distort(&Point2::new(p.x / p.z, p.y / p.z)),
            Some(wide) => (wide.shown)(self.kind, &self.numbers, p),
        }
    }

    /// The derivatives of [`shown`](Self::shown) by the point and by the coefficients, those that the model lacks 0.
    pub(super) fn derivatives(
        &self,
        wide: &Wide,
        p: &Vector3<f64>,
    ) -> (Matrix2x3<f64>, [[f64; MAX_COEFFICIENTS]; 2]) {
        (wide.derivatives)(self.kind, &self.numbers, p)
    }

    /// The pixel where a point of the camera frame is seen; `None` where the lens does not see it.
    pub(super) fn pixel(&self, k: &Intrinsics, p: &Vector3<f64>) -> Option<Point2<f64>> {
        if p.z <= 0.0 && self.kind != LensKind::Fisheye {
            return None;
        }
        let shown = self.shown(p);
        let center = k.principal_point();
        let pixel = Point2::new(
            k.fu_px() * shown.x + center.x,
            k.fv_px() * shown.y + center.y,
        );
        (pixel.x.is_finite() && pixel.y.is_finite()).then_some(pixel)
    }
}

impl Default for SfmLens {
    fn default() -> Self {
        Self::NONE
    }
}

impl PartialEq for SfmLens {
    fn eq(&self, other: &Self) -> bool {
        (self.kind, self.numbers) == (other.kind, other.numbers)
    }
}

impl fmt::Debug for SfmLens {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SfmLens")
            .field("kind", &self.kind)
            .field("coefficients", &self.coefficients())
            .finish()
    }
}

impl From<Distortion> for SfmLens {
    fn from(d: Distortion) -> Self {
        Self {
            numbers: [d.k1, d.k2, d.p1, d.p2, d.k3, 0.0, 0.0, 0.0],
            ..Self::NONE
        }
    }
}

impl From<RationalDistortion> for SfmLens {
    fn from(r: RationalDistortion) -> Self {
        Self::wide(LensKind::Rational, &Lens::Rational(r).coefficients())
    }
}

impl From<Fisheye> for SfmLens {
    fn from(fisheye: Fisheye) -> Self {
        Self::wide(LensKind::Fisheye, &fisheye.coefficients)
    }
}

impl From<Division> for SfmLens {
    fn from(division: Division) -> Self {
        Self::wide(LensKind::Division, &[division.k])
    }
}

impl From<Lens> for SfmLens {
    fn from(lens: Lens) -> Self {
        match lens {
            Lens::Brown(lens) => lens.into(),
            Lens::Rational(lens) => lens.into(),
            Lens::Fisheye(lens) => lens.into(),
            Lens::Division(lens) => lens.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_comes_and_goes_with_its_numbers() {
        for (kind, count) in [
            (LensKind::Brown, 5),
            (LensKind::Rational, 8),
            (LensKind::Fisheye, 4),
            (LensKind::Division, 1),
        ] {
            let numbers: Vec<f64> = (1..=count).map(|i| 0.01 * f64::from(i)).collect();
            let lens = Lens::from_coefficients(kind, &numbers).unwrap();
            let carried = SfmLens::from(lens);
            assert_eq!(carried.coefficients(), numbers);
            assert_eq!((carried.kind(), carried.to_lens()), (kind, lens));
            assert_eq!(carried.beyond_brown().is_none(), kind == LensKind::Brown);
            assert!(!carried.is_none() && carried.check().is_ok());
            let p = Vector3::new(0.3, -0.2, 0.9);
            assert_eq!(Some(carried.shown(&p)), lens.project(&p));
            assert!(carried.moved(&[f64::NAN]).check().is_err());
        }
        // Straight lines stay straight, but a fisheye without coefficients is not a pinhole camera.
        assert!(!SfmLens::from(Fisheye::default()).is_none());
        let k = Intrinsics::centered(100.0, 200, 200).unwrap();
        let beside = Vector3::new(1.0, 0.0, -0.2);
        assert!(
            SfmLens::from(Fisheye::default())
                .pixel(&k, &beside)
                .is_some()
        );
        assert!(SfmLens::NONE.pixel(&k, &beside).is_none());
        assert!(
            SfmLens::from(Division { k: -0.1 })
                .pixel(&k, &beside)
                .is_none()
        );
    }
}
