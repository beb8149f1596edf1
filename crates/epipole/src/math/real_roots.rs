//! Real roots of polynomials of degree ten. Coefficients run from the constant term upwards.

use super::polynomial::quadratic_roots;

/// Degree of the polynomials of [`real_roots`].
pub(crate) const DEGREE: usize = 10;

/// Rounding error of a polynomial with exact coefficients at a double root, relative to the sum of
/// its terms' magnitudes.
#[cfg(test)]
const ROUNDING: f64 = 1e-14;

/// Maximum number of steps: Newton's method takes about six; bisection takes one for each power of
/// two between the ends and a root near zero.
const MAX_STEPS: usize = 1200;

/// Relative size of the last step to a root.
const LAST: f64 = 4.0 * f64::EPSILON;
/// Relative size of Newton's last step to a root of a derivative: the remaining error is its
/// square, and the effect on an extremum's value the square of that.
const LAST_OF_DERIVATIVES: f64 = 1e-6;

/// Finds all real roots of a polynomial of degree at most 10, in ascending order; returns the
/// number written.
///
/// Roots are found regardless of the sizes of the others: those with |x| ≤ 1 are sought in the
/// polynomial, the others as inverses of roots of the reversed one, each at its own scale. Roots
/// closer together than about 1e-7 of their size may be reported as one.
///
/// * `noise`: maximum value of an extremum, relative to the sum of its terms' magnitudes, to count
///   as a root, as errors of the coefficients may hide a double root there. At least 1e-14
///
/// Source: Yuksel 2022, "High-performance polynomial root finding for graphics", §3 (between roots
/// of the derivative a polynomial is monotone).
pub(crate) fn real_roots(c: &[f64; DEGREE + 1], noise: f64, roots: &mut [f64; DEGREE]) -> usize {
    let largest = c.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 || !c.iter().all(|x| x.is_finite()) {
        return 0;
    }
    let inner = c.map(|x| x / largest);
    let mut outer = inner;
    outer.reverse();
    // The same values for both, so that a root near an end is on exactly one side.
    let at_ends = [-1.0, 1.0].map(|x| value(&inner, DEGREE, x));
    let (near, far) = (
        roots_within(&inner, at_ends, noise),
        roots_within(&outer, at_ends, noise),
    );
    let mut count = 0;
    let mut push = |root: f64| {
        if count < DEGREE && root.is_finite() {
            roots[count] = root;
            count += 1;
        }
    };
    let inverse = |y: &f64| 1.0 / y;
    let touched = |end: f64, at_end: f64| {
        at_end == 0.0
            || at_end.abs() <= noise * size_of_terms(&inner, end)
                && !near
                    .slice()
                    .iter()
                    .chain(far.slice())
                    .any(|x| (x - end).abs() < 1e-6)
    };
    far.slice()
        .iter()
        .rev()
        .filter(|y| **y < 0.0)
        .map(inverse)
        .for_each(&mut push);
    if touched(-1.0, at_ends[0]) {
        push(-1.0);
    }
    near.slice().iter().for_each(|x| push(*x));
    if touched(1.0, at_ends[1]) {
        push(1.0);
    }
    far.slice()
        .iter()
        .rev()
        .filter(|y| **y > 0.0)
        .map(inverse)
        .for_each(&mut push);
    count
}

/// A short list of numbers in ascending order.
#[derive(Clone, Copy)]
struct Ascending {
    numbers: [f64; DEGREE],
    len: usize,
}

impl Ascending {
    fn push(&mut self, x: f64) {
        if self.len < DEGREE {
            self.numbers[self.len] = x;
            self.len += 1;
        }
    }

    fn slice(&self) -> &[f64] {
        &self.numbers[..self.len]
    }
}

/// A polynomial, with zeros for missing powers.
type Row = [f64; DEGREE + 1];

/// Evaluates a polynomial of at most this degree by Estrin's scheme: a chain of four dependent
/// sums, where Horner's scheme has ten.
#[inline(always)]
fn value(c: &Row, degree: usize, x: f64) -> f64 {
    let x2 = x * x;
    let four = |i: usize| (c[i] + c[i + 1] * x) + (c[i + 2] + c[i + 3] * x) * x2;
    if degree < 4 {
        return four(0);
    }
    let x4 = x2 * x2;
    let eight = four(0) + four(4) * x4;
    if degree < 8 {
        return eight;
    }
    eight + ((c[8] + c[9] * x) + c[10] * x2) * (x4 * x4)
}

#[cfg(test)]
pub(super) fn value_and_slope(c: &[f64], x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for c in c.iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    (value, slope)
}

pub(super) fn size_of_terms(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x.abs() + c.abs())
}

/// Returns the roots in (−1, 1), given the values at its ends.
fn roots_within(c: &Row, at_ends: [f64; 2], noise: f64) -> Ascending {
    // The derivatives: row k has degree 10 − k.
    let mut derivatives: [Row; DEGREE - 1] = [[0.0; DEGREE + 1]; DEGREE - 1];
    derivatives[0] = *c;
    for k in 1..DEGREE - 1 {
        for i in 1..=DEGREE + 1 - k {
            derivatives[k][i - 1] = derivatives[k - 1][i] * i as f64;
        }
    }
    let none = Ascending {
        numbers: [0.0; DEGREE],
        len: 0,
    };
    let [c0, c1, c2, ..] = derivatives[DEGREE - 2];
    let mut two = [0.0; 2];
    let num_roots = quadratic_roots([c0, c1, c2], &mut two);
    two[..num_roots].sort_by(f64::total_cmp);
    let mut extrema = none;
    for x in &two[..num_roots] {
        if x.abs() < 1.0 {
            extrema.push(*x);
        }
    }
    for k in (1..DEGREE - 2).rev() {
        let [c, slope] = [&derivatives[k], &derivatives[k + 1]];
        let at_ends = [-1.0, 1.0].map(|x| value(c, DEGREE - k, x));
        let mut crossings = none;
        monotone_parts(c, DEGREE - k, at_ends, &extrema, |from, to| {
            if from.1 == 0.0 {
                crossings.push(from.0);
            } else if from.1 * to.1 < 0.0 {
                crossings.push(root_between(
                    c,
                    slope,
                    DEGREE - k,
                    LAST_OF_DERIVATIVES,
                    from,
                    to,
                ));
            }
        });
        extrema = crossings;
    }
    let mut roots = none;
    // Whether there is a root to the left of an extremum.
    let mut crossed = true;
    monotone_parts(c, DEGREE, at_ends, &extrema, |from, to| {
        let crosses = from.1 * to.1 < 0.0;
        let is_extremum = from.0 > -1.0;
        if from.1 == 0.0 && is_extremum
            || !crossed && !crosses && from.1.abs() <= noise * size_of_terms(c, from.0)
        {
            roots.push(from.0);
        }
        if crosses {
            roots.push(root_between(c, &derivatives[1], DEGREE, LAST, from, to));
        }
        crossed = crosses;
    });
    roots
}

/// Visits the parts of [−1, 1] between extrema: passes both ends and the values there.
#[inline(always)]
fn monotone_parts(
    c: &Row,
    degree: usize,
    at_ends: [f64; 2],
    extrema: &Ascending,
    mut part: impl FnMut((f64, f64), (f64, f64)),
) {
    let mut from = (-1.0, at_ends[0]);
    for &x in extrema.slice() {
        let to = (x, value(c, degree, x));
        part(from, to);
        from = to;
    }
    part(from, (1.0, at_ends[1]));
}

/// Returns the root between two positions with different signs: Newton's method, with bisection if
/// it would leave the interval or is slow.
///
/// * `derivative`: derivative of the polynomial `c`
/// * `last_of_newton`: relative size of the last Newton step
fn root_between(
    c: &Row,
    derivative: &Row,
    degree: usize,
    last_of_newton: f64,
    (mut low, at_low): (f64, f64),
    (mut high, _): (f64, f64),
) -> f64 {
    let mut x = 0.5 * (low + high);
    let mut last_step = high - low;
    for _ in 0..MAX_STEPS {
        let (value, slope) = (value(c, degree, x), value(derivative, degree - 1, x));
        if value == 0.0 {
            return x;
        }
        if (value > 0.0) == (at_low > 0.0) {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let is_quick = (newton - x).abs() <= 0.5 * last_step;
        let (next, enough) = if newton > low && newton < high && is_quick {
            (newton, last_of_newton)
        } else {
            (0.5 * (low + high), LAST)
        };
        let step = (next - x).abs();
        if step <= enough * next.abs() || next <= low || next >= high {
            return next;
        }
        last_step = step;
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::super::polynomial::tests::expand;
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn roots_of_degree_ten() {
        let mut random = Random::new(7);
        for trial in 0..500 {
            let num_real = 2 * (trial % 6);
            let mut real: Vec<f64> = (0..num_real).map(|_| random.uniform(-4.0, 4.0)).collect();
            real.sort_by(f64::total_cmp);
            if real.windows(2).any(|w| w[1] - w[0] < 0.05) {
                continue;
            }
            let complex: Vec<_> = (0..(10 - num_real) / 2)
                .map(|_| (random.uniform(-3.0, 3.0), random.uniform(0.3, 3.0)))
                .collect();
            let c = expand(&real, &complex);
            let scale = random.uniform(-100.0, 100.0);
            let coefficients = core::array::from_fn(|i| c[i] * scale);
            let mut roots = [0.0; 10];
            let count = real_roots(&coefficients, ROUNDING, &mut roots);
            assert_eq!(count, num_real, "{real:?} {:?}", &roots[..count]);
            for (found, truth) in roots.iter().zip(&real) {
                assert!((found - truth).abs() < 1e-6, "{real:?} {roots:?}");
            }
        }
    }

    /// Finds real roots of any size next to complex pairs: every root within the accuracy that its
    /// condition allows, no more and no fewer. Polynomials whose roots may merge when the
    /// coefficients are rounded are skipped.
    fn lost_over_twelve_decades(trials: usize, seed: u64) -> (usize, usize) {
        let mut random = Random::new(seed);
        let (mut lost, mut judged) = (0, 0);
        for _ in 0..trials {
            let num_pairs = random.below(6);
            let mut size = || libm::pow(10.0, random.uniform(-6.0, 6.0));
            let pair_sizes: Vec<f64> = (0..num_pairs).map(|_| size()).collect();
            let sizes: Vec<f64> = (0..DEGREE - 2 * num_pairs).map(|_| size()).collect();
            let mut pair = |size: &f64| {
                let angle = random.uniform(0.0, core::f64::consts::PI);
                (size * libm::cos(angle), size * libm::sin(angle))
            };
            let pairs: Vec<_> = pair_sizes.iter().map(&mut pair).collect();
            let mut sign = || if random.below(2) == 0 { -1.0 } else { 1.0 };
            let mut real: Vec<f64> = sizes.iter().map(|s| s * sign()).collect();
            real.sort_by(f64::total_cmp);
            let c = expand(&real, &pairs);
            let c: [f64; DEGREE + 1] = core::array::from_fn(|i| c[i]);
            let bound = |x: f64| {
                let slope = value_and_slope(&c, x).1.abs();
                2e-14 * size_of_terms(&c, x) / slope
            };
            let ill_posed = real
                .windows(2)
                .any(|w| (w[1] - w[0]) < 20.0 * (bound(w[0]) + bound(w[1])))
                || pairs.iter().any(|(re, im)| *im < 1e-5 * re.abs());
            if ill_posed {
                continue;
            }
            judged += 1;
            let mut roots = [0.0; DEGREE];
            let count = real_roots(&c, ROUNDING, &mut roots);
            let all = count == real.len()
                && real
                    .iter()
                    .zip(&roots)
                    .all(|(truth, found)| (found - truth).abs() <= bound(*truth));
            if !all {
                lost += 1;
                println!("{real:?} {pairs:?}: {:?}", &roots[..count]);
            }
        }
        (lost, judged)
    }

    #[test]
    fn no_root_is_lost_over_twelve_decades() {
        let (lost, judged) = lost_over_twelve_decades(10_000, 1);
        assert!(lost == 0 && judged > 9_000, "{lost} of {judged}");
    }

    #[test]
    #[ignore = "half a minute: to be run by hand after changes"]
    fn no_root_is_lost_of_a_million_polynomials() {
        let (lost, judged) = lost_over_twelve_decades(1_000_000, 2);
        println!("{judged} judged, {lost} lost");
        assert!(lost == 0, "{lost} of {judged}");
    }

    /// The first polynomial, with integer coefficients and a root at the end of a part, is from
    /// COLMAP's src/colmap/math/polynomial_test.cc
    /// (FindPolynomialRootsCompanionMatrixZeroSolution), 10 x⁴ − 5 x³ + 3 x² − 3 x, times (x² +
    /// 1)³; the other one has a distant root.
    #[test]
    fn roots_that_were_lost() {
        let mut roots = [0.0; DEGREE];
        let whole = [
            0.0, -3.0, 3.0, -14.0, 19.0, -24.0, 39.0, -18.0, 33.0, -5.0, 10.0,
        ];
        assert_eq!(real_roots(&whole, ROUNDING, &mut roots), 2);
        assert!(
            roots[0] == 0.0 && (roots[1] - 0.692_438).abs() < 1e-6,
            "{roots:?}"
        );
        let truth = [-2.673, -1.355, 2.890, 811_458.0];
        let c = expand(&truth, &[(0.5, 1.2), (-2.0, 0.7), (3.0, 3.0)]);
        assert_eq!(
            real_roots(&core::array::from_fn(|i| c[i]), ROUNDING, &mut roots),
            4
        );
        for (found, truth) in roots.iter().zip(truth) {
            assert!((found / truth - 1.0).abs() < 1e-9, "{roots:?}");
        }
    }

    /// Single and double roots at ±1, where the two halves of the search meet.
    #[test]
    fn roots_at_one() {
        let mut roots = [0.0; DEGREE];
        for (real, different) in [
            (vec![1.0, -1.0, 2.0, -0.5], 4),
            (vec![1.0, 1.0, 3.0, -3.0], 3),
            (vec![-1.0, -1.0, 0.0, 7.0], 3),
        ] {
            let c = expand(&real, &[(0.3, 1.0), (-1.0, 2.0), (2.0, 0.5)]);
            let count = real_roots(&core::array::from_fn(|i| c[i]), ROUNDING, &mut roots);
            assert!(
                (different..=4).contains(&count),
                "{real:?}: {:?}",
                &roots[..count]
            );
            for truth in real {
                let near = |x: &f64| (x - truth).abs() < 1e-6;
                assert!(
                    roots[..count].iter().any(near),
                    "{truth}: {:?}",
                    &roots[..count]
                );
            }
        }
    }

    #[test]
    fn degenerate_polynomials_end() {
        let mut roots = [0.0; 10];
        assert_eq!(real_roots(&[0.0; 11], ROUNDING, &mut roots), 0);
        assert_eq!(real_roots(&[f64::NAN; 11], ROUNDING, &mut roots), 0);
        let mut power = [0.0; 11];
        power[10] = 1.0;
        assert!(real_roots(&power, ROUNDING, &mut roots) <= 10);
        // 1e-90 x⁹ − 1: of odd degree, with one distant root.
        let mut lower = [0.0; 11];
        (lower[0], lower[9]) = (-1.0, 1e-90);
        assert_eq!(real_roots(&lower, ROUNDING, &mut roots), 1);
        assert!((roots[0] - 1e10).abs() < 1.0);
        // (x² − 1)⁵: roots of multiplicity five.
        let c = expand(
            &[1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
            &[],
        );
        assert!(real_roots(&core::array::from_fn(|i| c[i]), ROUNDING, &mut roots) <= 10);
    }
}
