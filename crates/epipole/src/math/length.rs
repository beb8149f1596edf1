//! Fast vector lengths.

use nalgebra::SVector;

/// Returns the length of a vector, with the same bits as nalgebra's `norm`.
///
/// `norm` takes its square root from `libm`, as all transcendental functions here do, which
/// computes it bit by bit in WebAssembly. Square roots are correctly rounded everywhere, so the
/// processor's instruction gives the same result.
///
/// ```
/// use epipole::math::length;
/// assert_eq!(length(&epipole::nalgebra::Vector2::new(3.0, 4.0)), 5.0);
/// ```
#[inline]
pub fn length<const N: usize>(vector: &SVector<f64, N>) -> f64 {
    vector.norm_squared().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::{Vector2, Vector3};

    #[test]
    fn it_is_the_norm_to_the_last_bit() {
        let mut random = Random::new(11);
        for trial in 0..20_000 {
            let scale = libm::exp2(f64::from(trial % 600) - 300.0);
            let vector = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)) * scale;
            assert_eq!(length(&vector).to_bits(), vector.norm().to_bits());
            let flat = Vector2::new(vector.x, vector.z);
            assert_eq!(length(&flat).to_bits(), flat.norm().to_bits());
        }
        assert_eq!(length(&Vector3::zeros()), 0.0);
        assert_eq!(length(&Vector2::new(3.0, f64::INFINITY)), f64::INFINITY);
        assert!(length(&Vector2::new(f64::NAN, 1.0)).is_nan());
    }
}
