//! Conversions from the models of lenses.

use super::{Distortion, Division, Fisheye, Lens, RationalDistortion};

impl From<Distortion> for Lens {
    fn from(distortion: Distortion) -> Self {
        Self::Brown(distortion)
    }
}

impl From<RationalDistortion> for Lens {
    fn from(rational: RationalDistortion) -> Self {
        Self::Rational(rational)
    }
}

impl From<Fisheye> for Lens {
    fn from(fisheye: Fisheye) -> Self {
        Self::Fisheye(fisheye)
    }
}

impl From<Division> for Lens {
    fn from(division: Division) -> Self {
        Self::Division(division)
    }
}
