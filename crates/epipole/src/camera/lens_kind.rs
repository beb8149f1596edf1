//! Kinds of lens models.

/// Lens model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum LensKind {
    /// Five coefficients, for ordinary lenses: [`Distortion`](super::Distortion).
    #[default]
    Brown,
    /// Eight coefficients, for wide-angle lenses:
    /// [`RationalDistortion`](super::RationalDistortion).
    Rational,
    /// Four coefficients, for fields of view of 120° and more: [`Fisheye`](super::Fisheye).
    Fisheye,
    /// One coefficient, for strong distortion with little data: [`Division`](super::Division).
    Division,
}

impl LensKind {
    /// Returns the number of coefficients of the model.
    pub fn num_coefficients(self) -> usize {
        match self {
            Self::Brown => 5,
            Self::Rational => 8,
            Self::Fisheye => 4,
            Self::Division => 1,
        }
    }

    /// Returns the name in files and results: brown, rational, fisheye or division.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brown => "brown",
            Self::Rational => "rational",
            Self::Fisheye => "fisheye",
            Self::Division => "division",
        }
    }
}
