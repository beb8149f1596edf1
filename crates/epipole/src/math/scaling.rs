//! Powers of two: exact scale factors.

use nalgebra::Vector3;

/// Returns a power of two within a factor of two of `|x|`, for any finite x; clamped at either end
/// of the number range.
///
/// Division by it is exact, so values whose squares would overflow or underflow can be scaled back
/// and forth without error.
#[inline]
pub(crate) fn power_of_two(x: f64) -> f64 {
    const EXPONENT_BITS: u64 = 0x7ff;
    let exponent = (x.to_bits() >> 52) & EXPONENT_BITS;
    // The extreme exponents are excluded so that the inverse is finite.
    f64::from_bits(exponent.clamp(1, EXPONENT_BITS - 2) << 52)
}

/// Returns the unit vector in a direction of any length; `None` for zero, NaN and infinities.
#[inline]
pub(crate) fn unit(vector: &Vector3<f64>) -> Option<Vector3<f64>> {
    let largest = vector.amax();
    if !(largest > 0.0 && vector.iter().all(|x| x.is_finite())) {
        return None;
    }
    let scaled = vector / power_of_two(largest);
    Some(scaled / scaled.norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn division_by_the_power_brings_near_one() {
        for x in [1.0, 1.999, 0.75, 640.0, 1e-300, 1e300, f64::MIN_POSITIVE] {
            let scaled = x / power_of_two(x);
            assert!((1.0..2.0).contains(&scaled), "{x}: {scaled}");
            assert_eq!(scaled * power_of_two(x), x);
            assert_eq!(power_of_two(-x), power_of_two(x));
        }
        assert!(f64::MAX / power_of_two(f64::MAX) < 4.0);
        assert!(5e-324 / power_of_two(5e-324) > 1e-16);
        assert!(power_of_two(0.0) > 0.0 && (1.0 / power_of_two(f64::MAX)).is_normal());
    }

    #[test]
    fn directions_of_any_length() {
        for length in [1.0, 1e-320, 1e-200, 1e200, 1e308] {
            let direction = unit(&(Vector3::new(0.0, -1.0, 1.0) * length)).unwrap();
            let half = 0.5_f64.sqrt();
            assert!((direction - Vector3::new(0.0, -half, half)).norm() < 1e-3);
            assert!((direction.norm() - 1.0).abs() < 1e-15);
        }
        for bad in [0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(unit(&Vector3::new(0.0, bad, 0.0)), None);
        }
        assert_eq!(unit(&Vector3::new(f64::NAN, 1.0, 0.0)), None);
    }
}
