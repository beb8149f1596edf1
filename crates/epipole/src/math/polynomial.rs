//! Real roots of polynomials. Coefficients run from the constant term upwards.

/// Real roots of `c[0] + c[1] x + c[2] x²`; returns how many were written to the front of `roots`.
///
/// A double root counts once or twice, depending on rounding.
pub(crate) fn quadratic_roots(c: [f64; 3], roots: &mut [f64; 2]) -> usize {
    let [c0, c1, c2] = c;
    if c2 == 0.0 {
        if c1 == 0.0 {
            return 0;
        }
        roots[0] = -c0 / c1;
        return usize::from(roots[0].is_finite());
    }
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant < 0.0 || !discriminant.is_finite() {
        return 0;
    }
    // The sum that does not cancel, then the other root from the product of both.
    let sum = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let mut count = 0;
    for root in [sum / c2, if sum == 0.0 { sum } else { c0 / sum }] {
        if root.is_finite() {
            roots[count] = root;
            count += 1;
        }
    }
    count
}

/// Real roots of `c[0] + c[1] x + c[2] x² + c[3] x³`; returns how many were written.
///
/// Source: Newton's method from beyond the extrema, where it converges without overshooting; then
/// a quadratic for the others.
pub(crate) fn cubic_roots(c: [f64; 4], roots: &mut [f64; 3]) -> usize {
    let largest = c.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if c[3].abs() <= 1e-14 * largest {
        let mut two = [0.0; 2];
        let count = quadratic_roots([c[0], c[1], c[2]], &mut two);
        roots[..count].copy_from_slice(&two[..count]);
        return count;
    }
    let (p, q, r) = (c[2] / c[3], c[1] / c[3], c[0] / c[3]);
    let Some(first) = monic_cubic_root(p, q, r) else {
        return 0;
    };
    roots[0] = first;
    // x³ + p x² + q x + r = (x − first)(x² + b x + d). Dividing out a large root loses less from
    // the constant term upwards, a small one from the leading term downwards.
    let (b, d) = if first * first * first.abs() > r.abs() && first != 0.0 {
        let d = -r / first;
        ((d - q) / first, d)
    } else {
        (p + first, q + first * (p + first))
    };
    let (mut two, mut count) = ([0.0; 2], 1);
    let others = quadratic_roots([d, b, 1.0], &mut two);
    for &root in &two[..others] {
        // One Newton step removes the error of the division.
        let value = ((root + p) * root + q) * root + r;
        let slope = (3.0 * root + 2.0 * p) * root + q;
        let step = value / slope;
        roots[count] = if step.abs() < 1e-3 * (1.0 + root.abs()) {
            root - step
        } else {
            root
        };
        count += 1;
    }
    count
}

/// One real root of `x³ + p x² + q x + r`: the outermost one on the side where only one is.
pub(crate) fn monic_cubic_root(p: f64, q: f64, r: f64) -> Option<f64> {
    let center = -p / 3.0;
    let value_at_center = ((center + p) * center + q) * center + r;
    let spread = p * p - 3.0 * q;
    // Beyond the extremum on the far side of the center the cubic is monotone and convex (or
    // concave) up to the root.
    let mut x = if spread > 0.0 {
        let reach = 2.0 / 3.0 * spread.sqrt();
        // If the extremum lies across zero, the root is between the center and the point as far
        // from the center as the reach; else it is beyond.
        let start = center - reach.copysign(value_at_center);
        let value = ((start + p) * start + q) * start + r;
        if value == 0.0 {
            return Some(start);
        }
        if (value > 0.0) == (value_at_center > 0.0) {
            // The single root is further out; the sum of magnitudes bounds it.
            let shift = libm::cbrt(value_at_center.abs()) * 1.26 + reach;
            center - shift.copysign(value_at_center)
        } else {
            start
        }
    } else {
        center - libm::cbrt(value_at_center)
    };
    for _ in 0..60 {
        let value = ((x + p) * x + q) * x + r;
        let slope = (3.0 * x + 2.0 * p) * x + q;
        if value == 0.0 || slope == 0.0 {
            break;
        }
        let next = x - value / slope;
        if !next.is_finite() {
            return None;
        }
        let done = (next - x).abs() <= 4.0 * f64::EPSILON * next.abs();
        x = next;
        if done {
            break;
        }
    }
    x.is_finite().then_some(x)
}

/// The degree that [`real_roots`] is for.
pub(crate) const DEGREE: usize = 10;

/// All real roots of a polynomial of degree 10, in ascending order; returns how many were written.
///
/// Roots closer together than about 1e-9 of their size may be reported as one.
///
/// Source: Sturm's theorem; the sequence as in Hook & McAree 1990, "Using Sturm sequences to
/// bracket real roots of polynomial equations" (Graphics Gems).
pub(crate) fn real_roots(c: &[f64; DEGREE + 1], roots: &mut [f64; DEGREE]) -> usize {
    let largest = c.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if c[DEGREE].abs() <= 1e-300 || !largest.is_finite() {
        return 0;
    }
    let mut monic = [0.0; DEGREE + 1];
    for i in 0..=DEGREE {
        monic[i] = c[i] / c[DEGREE];
        if !monic[i].is_finite() {
            return 0;
        }
    }
    let sequence = Sturm::new(&monic);
    let bound = root_bound(&monic);
    let (below, above) = (sequence.changes(-bound), sequence.changes(bound));
    let mut finder = Finder {
        polynomial: &monic,
        sequence: &sequence,
        roots,
        count: 0,
    };
    if below > above {
        finder.isolate(-bound, bound, below, above, 0);
    }
    finder.count
}

/// Every real root is smaller in size: `2 max |c[i]|^(1/(n−i))`, each power rounded up to a power
/// of two, so that no logarithm is needed.
///
/// Source: Fujiwara 1916.
fn root_bound(monic: &[f64; DEGREE + 1]) -> f64 {
    let mut exponent = -200;
    for i in 0..DEGREE {
        if monic[i] != 0.0 {
            // |c| < 2^size.
            let size = ((monic[i].to_bits() >> 52) & 0x7ff) as i32 - 1022;
            let power = (DEGREE - i) as i32;
            exponent = exponent.max((size + power - 1).div_euclid(power));
        }
    }
    f64::from_bits(((exponent.min(1000) + 1 + 1023) as u64) << 52)
}

/// The Sturm sequence: the polynomial, its derivative, then negated remainders.
struct Sturm {
    terms: [[f64; DEGREE + 1]; DEGREE + 1],
    degrees: [usize; DEGREE + 1],
    len: usize,
}

impl Sturm {
    fn new(monic: &[f64; DEGREE + 1]) -> Self {
        let mut terms = [[0.0; DEGREE + 1]; DEGREE + 1];
        let mut degrees = [0; DEGREE + 1];
        terms[0] = *monic;
        degrees[0] = DEGREE;
        for i in 1..=DEGREE {
            terms[1][i - 1] = monic[i] * i as f64;
        }
        degrees[1] = DEGREE - 1;
        let mut len = 2;
        while len <= DEGREE && degrees[len - 1] > 0 {
            let (head, tail) = terms.split_at_mut(len);
            let (a, b) = (&head[len - 2], &head[len - 1]);
            let (deg_a, deg_b) = (degrees[len - 2], degrees[len - 1]);
            let mut rest = *a;
            let inverse = 1.0 / b[deg_b];
            let mut size_before: f64 = 0.0;
            for i in (deg_b..=deg_a).rev() {
                let quotient = rest[i] * inverse;
                for j in 0..deg_b {
                    let part = quotient * b[j];
                    rest[i - deg_b + j] -= part;
                    size_before = size_before.max(part.abs());
                }
                rest[i] = 0.0;
            }
            for x in &rest[..deg_b] {
                size_before = size_before.max(x.abs());
            }
            // Leading coefficients that are rounding noise are zero: the last two terms share
            // a factor.
            let mut degree = deg_b - 1;
            while degree > 0 && rest[degree].abs() <= 1e-15 * size_before {
                degree -= 1;
            }
            let size = rest[..=degree].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            if size <= 1e-15 * size_before || !size.is_finite() {
                break;
            }
            let shrink = -1.0 / size;
            for (target, value) in tail[0].iter_mut().zip(&rest[..=degree]) {
                *target = value * shrink;
            }
            degrees[len] = degree;
            len += 1;
        }
        Self {
            terms,
            degrees,
            len,
        }
    }

    /// Sign changes of the sequence at x.
    fn changes(&self, x: f64) -> usize {
        let mut changes = 0;
        let mut previous = 0.0;
        for (term, &degree) in self.terms[..self.len].iter().zip(&self.degrees) {
            let mut value = term[degree];
            for i in (0..degree).rev() {
                value = value * x + term[i];
            }
            if value != 0.0 {
                changes += usize::from(previous * value.signum() < 0.0);
                previous = value.signum();
            }
        }
        changes
    }
}

struct Finder<'a> {
    polynomial: &'a [f64; DEGREE + 1],
    sequence: &'a Sturm,
    roots: &'a mut [f64; DEGREE],
    count: usize,
}

impl Finder<'_> {
    /// Halves an interval until each part has one root.
    fn isolate(&mut self, low: f64, high: f64, at_low: usize, at_high: usize, depth: usize) {
        let inside = at_low.saturating_sub(at_high);
        if inside == 0 || self.count == DEGREE {
            return;
        }
        if inside == 1
            && let Some(root) = self.refine(low, high)
        {
            self.roots[self.count] = root;
            self.count += 1;
            return;
        }
        let middle = 0.5 * (low + high);
        if depth > 60 || middle <= low || middle >= high {
            self.roots[self.count] = middle;
            self.count += 1;
            return;
        }
        let at_middle = self.sequence.changes(middle);
        self.isolate(low, middle, at_low, at_middle, depth + 1);
        self.isolate(middle, high, at_middle, at_high, depth + 1);
    }

    fn value_and_slope(&self, x: f64) -> (f64, f64) {
        let (mut value, mut slope) = (1.0, 0.0);
        for i in (0..DEGREE).rev() {
            slope = slope * x + value;
            value = value * x + self.polynomial[i];
        }
        (value, slope)
    }

    /// Newton's method, with bisection where it would leave the interval. `None` if the ends have
    /// equal signs, because a double root or rounding misled the count.
    fn refine(&self, mut low: f64, mut high: f64) -> Option<f64> {
        let (at_low, _) = self.value_and_slope(low);
        let (at_high, _) = self.value_and_slope(high);
        if at_low == 0.0 {
            return Some(low);
        }
        if (at_low > 0.0) == (at_high > 0.0) {
            return (at_high == 0.0).then_some(high);
        }
        let mut x = 0.5 * (low + high);
        for _ in 0..80 {
            let (value, slope) = self.value_and_slope(x);
            if value == 0.0 {
                return Some(x);
            }
            if (value > 0.0) == (at_low > 0.0) {
                low = x;
            } else {
                high = x;
            }
            let newton = x - value / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - x).abs() <= 1e-15 * next.abs() {
                return Some(next);
            }
            x = next;
        }
        Some(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Coefficients of Π (x − root) times pairs without real roots.
    fn expand(real: &[f64], complex: &[(f64, f64)]) -> Vec<f64> {
        let mut c = vec![1.0];
        let mut multiply = |factor: &[f64]| {
            let mut product = vec![0.0; c.len() + factor.len() - 1];
            for (i, a) in c.iter().enumerate() {
                for (j, b) in factor.iter().enumerate() {
                    product[i + j] += a * b;
                }
            }
            c = product;
        };
        for root in real {
            multiply(&[-root, 1.0]);
        }
        for (re, im) in complex {
            multiply(&[re * re + im * im, -2.0 * re, 1.0]);
        }
        c
    }

    #[test]
    fn cubics_with_one_and_three_roots() {
        let mut random = Random::new(1);
        for _ in 0..2000 {
            let mut root = || random.uniform(-5.0, 5.0) * libm::exp(random.uniform(-3.0, 3.0));
            let (mut three, one, pair) = ([root(), root(), root()], root(), (root(), root()));
            three.sort_by(f64::total_cmp);
            let mut found = [0.0; 3];
            let c = expand(&three, &[]);
            assert_eq!(
                cubic_roots([c[0], c[1], c[2], c[3]], &mut found),
                3,
                "{three:?}"
            );
            found.sort_by(f64::total_cmp);
            let size = three[0].abs().max(three[2].abs());
            for (f, t) in found.iter().zip(three) {
                // Neighbouring roots lose digits.
                let gap = three
                    .iter()
                    .filter(|&&o| o != t)
                    .map(|o| (o - t).abs())
                    .fold(size, f64::min);
                assert!(
                    (f - t).abs() < 1e-11 * size * size / gap,
                    "{found:?} {three:?}"
                );
            }
            let c = expand(&[one], &[pair]);
            let count = cubic_roots([c[0], c[1], c[2], c[3]], &mut found);
            assert!((1..=3).contains(&count));
            let near = found[..count]
                .iter()
                .map(|f| (f - one).abs())
                .fold(f64::INFINITY, f64::min);
            let size = one.abs() + pair.0.abs() + pair.1.abs();
            let gap = (one - pair.0).abs() + pair.1.abs();
            assert!(near < 1e-10 * size * size / gap, "{found:?} {one} {pair:?}");
        }
    }

    #[test]
    fn special_cubics() {
        let mut roots = [0.0; 3];
        assert_eq!(cubic_roots([-8.0, 0.0, 0.0, 1.0], &mut roots), 1);
        assert!((roots[0] - 2.0).abs() < 1e-14);
        assert!(cubic_roots([0.0, 0.0, 0.0, 1.0], &mut roots) >= 1);
        assert!(roots[0].abs() < 1e-7);
        assert_eq!(cubic_roots([2.0, -3.0, 1.0, 0.0], &mut roots), 2);
        assert_eq!(cubic_roots([0.0; 4], &mut roots), 0);
        assert_eq!(cubic_roots([f64::NAN, 1.0, 1.0, 1.0], &mut roots), 0);
        // (x − 1)² (x + 2)
        let count = cubic_roots([2.0, -3.0, 0.0, 1.0], &mut roots);
        assert!(roots[..count].iter().any(|r| (r + 2.0).abs() < 1e-12));
    }

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
            let count = real_roots(&coefficients, &mut roots);
            assert_eq!(count, num_real, "{real:?} {:?}", &roots[..count]);
            for (found, truth) in roots.iter().zip(&real) {
                assert!((found - truth).abs() < 1e-6, "{real:?} {roots:?}");
            }
        }
    }

    #[test]
    fn degenerate_polynomials_end() {
        let mut roots = [0.0; 10];
        assert_eq!(real_roots(&[0.0; 11], &mut roots), 0);
        assert_eq!(real_roots(&[f64::NAN; 11], &mut roots), 0);
        let mut power = [0.0; 11];
        power[10] = 1.0;
        assert!(real_roots(&power, &mut roots) <= 10);
        // (x² − 1)⁵: roots of multiplicity five.
        let c = expand(
            &[1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
            &[],
        );
        assert!(real_roots(&core::array::from_fn(|i| c[i]), &mut roots) <= 10);
    }
}
