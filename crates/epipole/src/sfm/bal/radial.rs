//! Radial distortion of BAL cameras.

/// The distortion factor at a normalized point, and its derivatives.
pub(super) struct RadialTerms {
    pub(super) r_sq: f64,
    pub(super) factor: f64,
    /// ∂(factor p)/∂p.
    pub(super) jacobian: [[f64; 2]; 2],
}

#[inline]
pub(super) fn radial_terms(p: [f64; 2], k1: f64, k2: f64) -> RadialTerms {
    let [x, y] = p;
    let r_sq = x * x + y * y;
    let factor = 1.0 + r_sq * (k1 + r_sq * k2);
    let slope = 2.0 * (k1 + 2.0 * k2 * r_sq);
    RadialTerms {
        r_sq,
        factor,
        jacobian: [
            [factor + slope * x * x, slope * x * y],
            [slope * x * y, factor + slope * y * y],
        ],
    }
}
