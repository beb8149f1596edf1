//! The kinds of lens models.

/// The models of lenses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum LensKind {
    /// Five numbers, for usual lenses: [`Distortion`](super::Distortion).
    #[default]
    Brown,
    /// Eight numbers, for wide angles: [`RationalDistortion`](super::RationalDistortion).
    Rational,
    /// Four numbers, for views of 120° and more: [`Fisheye`](super::Fisheye).
    Fisheye,
    /// One number, where there is little to see of a lens that bends much:
    /// [`Division`](super::Division).
    Division,
}

impl LensKind {
    /// Number of coefficients of the model.
    pub fn num_coefficients(self) -> usize {
        match self {
            Self::Brown => 5,
            Self::Rational => 8,
            Self::Fisheye => 4,
            Self::Division => 1,
        }
    }

    /// Its name in files and results: brown, rational, fisheye or division.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brown => "brown",
            Self::Rational => "rational",
            Self::Fisheye => "fisheye",
            Self::Division => "division",
        }
    }
}
