//! Roots of a polynomial between −1 and 1, from its Chebyshev coefficients.

use super::pencil::DEGREE;

/// Number of bisections to full precision.
const HALVINGS: usize = 60;

/// Maximum value of an extremum, relative to the largest coefficient, to count as a double root.
const TOUCHES: f64 = 1e-9;

/// Coefficients of degree up to [`DEGREE`], from the constant term upwards.
type Series = [f64; DEGREE + 1];

/// Returns all roots in (−1, 1), in ascending order: between roots of the derivative a polynomial
/// is monotone.
pub(super) fn roots_within(series: &Series) -> Vec<f64> {
    if !series.iter().all(|c| c.is_finite()) {
        return Vec::new();
    }
    let mut derivatives = vec![*series];
    for degree in (2..=DEGREE).rev() {
        let last = derivatives[derivatives.len() - 1];
        derivatives.push(derivative(&last, degree));
    }
    let mut ends = Vec::new();
    for series in derivatives.iter().rev() {
        ends = roots_between(series, &ends);
    }
    ends
}

/// Evaluates by Clenshaw's recurrence.
fn value(series: &Series, x: f64) -> f64 {
    let (mut first, mut second) = (0.0, 0.0);
    for c in series[1..].iter().rev() {
        (first, second) = (2.0 * x * first - second + c, first);
    }
    x * first - second + series[0]
}

fn derivative(series: &Series, degree: usize) -> Series {
    let mut d = [0.0; DEGREE + 1];
    for k in (0..degree).rev() {
        let above = if k + 2 <= DEGREE { d[k + 2] } else { 0.0 };
        d[k] = above + 2.0 * (k + 1) as f64 * series[k + 1];
    }
    d[0] *= 0.5;
    d
}

/// Returns the roots of a series whose extrema are given.
fn roots_between(series: &Series, extrema: &[f64]) -> Vec<f64> {
    let size = series.iter().fold(0.0_f64, |size, c| size.max(c.abs()));
    let mut roots = Vec::new();
    let (mut low, mut at_low) = (-1.0, value(series, -1.0));
    for high in extrema.iter().copied().chain([1.0]) {
        let at_high = value(series, high);
        if at_low * at_high < 0.0 {
            roots.push(root(series, [low, high], at_low));
        } else if high < 1.0 && at_high.abs() < TOUCHES * size {
            roots.push(high);
        }
        (low, at_low) = (high, at_high);
    }
    roots
}

fn root(series: &Series, [mut low, mut high]: [f64; 2], at_low: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if value(series, middle) * at_low > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// T₁₅ has its roots at the cosines of odd multiples of π/30.
    #[test]
    fn the_roots_of_a_chebyshev_polynomial_are_cosines() {
        let mut series = [0.0; DEGREE + 1];
        series[DEGREE] = 1.0;
        let roots = roots_within(&series);
        assert_eq!(roots.len(), DEGREE);
        for (i, root) in roots.iter().rev().enumerate() {
            let angle = core::f64::consts::PI * (2 * i + 1) as f64 / 30.0;
            assert!((root - libm::cos(angle)).abs() < 1e-14);
        }
        // x² + 1 has none; T₂ = 2 x² − 1 with a constant of 2 more is twice that, and NaN has none
        // either.
        let mut none = [0.0; DEGREE + 1];
        (none[0], none[2]) = (3.0, 1.0);
        assert!(roots_within(&none).is_empty());
        assert!(roots_within(&[f64::NAN; DEGREE + 1]).is_empty());
    }
}
