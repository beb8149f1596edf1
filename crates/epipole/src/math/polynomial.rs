//! Real roots of quadratics and cubics. Coefficients run from the constant term upwards.

/// Finds the real roots of `c[0] + c[1] x + c[2] x²`; returns the number written to `roots`.
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
    // The root whose sum does not cancel, then the other one from the product of both.
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

/// Finds the real roots of `c[0] + c[1] x + c[2] x² + c[3] x³`; returns the number written.
///
/// Source: Newton's method from beyond the extrema, where it converges without overshooting; then a
/// quadratic for the other roots.
pub(crate) fn cubic_roots(c: [f64; 4], roots: &mut [f64; 3]) -> usize {
    let (p, q, r) = (c[2] / c[3], c[1] / c[3], c[0] / c[3]);
    // Cubes of the coefficients must not overflow.
    let largest = p.abs().max(q.abs()).max(r.abs());
    if c[3] == 0.0 || largest > 1e100 {
        let mut two = [0.0; 2];
        let count = quadratic_roots([c[0], c[1], c[2]], &mut two);
        roots[..count].copy_from_slice(&two[..count]);
        return count;
    }
    let Some(first) = monic_cubic_root(p, q, r) else {
        return 0;
    };
    roots[0] = first;
    // x³ + p x² + q x + r = (x − first)(x² + b x + d). Dividing out a large root is more accurate
    // from the constant term upwards, a small one from the leading term downwards.
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

/// Returns a real root of `x³ + p x² + q x + r`: the outermost one on the side with only one root.
pub(crate) fn monic_cubic_root(p: f64, q: f64, r: f64) -> Option<f64> {
    let center = -p / 3.0;
    let value_at_center = ((center + p) * center + q) * center + r;
    let spread = p * p - 3.0 * q;
    // Beyond the extremum on the far side of the center the cubic is monotone and convex (or
    // concave) up to the root.
    let mut x = if spread > 0.0 {
        let reach = 2.0 / 3.0 * spread.sqrt();
        // If the extremum is across zero, the root is between the center and the point at the
        // distance of the reach from it; otherwise it is beyond.
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

#[cfg(test)]
pub(super) mod tests {
    use super::super::real_roots::{size_of_terms, value_and_slope};
    use super::*;
    use crate::math::random::Random;

    /// Coefficients of Π (x − root), times quadratics without real roots.
    pub(in crate::math) fn expand(real: &[f64], complex: &[(f64, f64)]) -> Vec<f64> {
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
                // Close roots lose precision.
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
    fn cubics_lose_no_root_over_twelve_decades() {
        let mut random = Random::new(3);
        let (mut lost, mut judged) = (0, 0);
        for trial in 0..100_000 {
            let mut size = || libm::pow(10.0, random.uniform(-6.0, 6.0));
            let sizes = [size(), size(), size()];
            let mut sign = || if random.below(2) == 0 { -1.0 } else { 1.0 };
            let mut real: Vec<f64> = sizes.iter().map(|s| s * sign()).collect();
            let mut pairs = vec![];
            if trial % 2 == 0 {
                real.truncate(1);
                let angle = random.uniform(0.0, core::f64::consts::PI);
                pairs.push((sizes[1] * libm::cos(angle), sizes[1] * libm::sin(angle)));
            }
            real.sort_by(f64::total_cmp);
            let c = expand(&real, &pairs);
            let c = [c[0], c[1], c[2], c[3]];
            let bound = |x: f64| 1e-14 * size_of_terms(&c, x) / value_and_slope(&c, x).1.abs();
            let ill_posed = (real.windows(2))
                .any(|w| w[1] - w[0] < 20.0 * (bound(w[0]) + bound(w[1])))
                || pairs.iter().any(|(re, im)| *im < 1e-5 * re.abs());
            if ill_posed {
                continue;
            }
            judged += 1;
            let mut roots = [0.0; 3];
            let count = cubic_roots(c, &mut roots);
            let near = |truth: &f64| {
                roots[..count]
                    .iter()
                    .any(|root| (root - truth).abs() <= bound(*truth))
            };
            if count != real.len() || !real.iter().all(near) {
                lost += 1;
                if lost < 20 {
                    println!("{real:?} {pairs:?}: {:?}", &roots[..count]);
                }
            }
        }
        assert!(lost == 0 && judged > 90_000, "{lost} of {judged}");
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
}
