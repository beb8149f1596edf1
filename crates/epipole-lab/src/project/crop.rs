//! Box that limits the model.

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// Box that limits the model of one reconstruction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CropBox {
    /// Key of its reconstruction; in the frame of another one it would be meaningless.
    pub of: u64,
    /// Component of the reconstruction.
    pub component: u32,
    /// Origin of the frame of the box, in the world.
    pub origin: [f64; 3],
    /// Rotation from the world to the frame of the box, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Lowest coordinates in the frame of the box.
    pub low: [f64; 3],
    /// Highest coordinates.
    pub high: [f64; 3],
}

impl CropBox {
    /// Whether its numbers are finite, its sides positive and its rotation is one.
    pub fn is_valid(&self) -> bool {
        let sides = self.low.iter().zip(&self.high);
        let norm = nalgebra::Vector4::from(self.rotation).norm();
        let numbers = (self.origin.iter()).chain(&self.low).chain(&self.high);
        numbers.chain(&self.rotation).all(|x| x.is_finite())
            && sides.into_iter().all(|(low, high)| low < high)
            && (norm - 1.0).abs() < 1e-6
    }

    /// Returns the rotation from the world to the frame of the box.
    pub fn matrix(&self) -> Matrix3<f64> {
        let [i, j, k, w] = self.rotation;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        *rotation.to_rotation_matrix().matrix()
    }

    /// Returns a function that tells whether a point is inside.
    pub fn inside(&self) -> impl Fn([f64; 3]) -> bool + 'static {
        let (matrix, origin) = (self.matrix(), Vector3::from(self.origin));
        let (low, high) = (self.low, self.high);
        move |place| {
            let at = matrix * (Vector3::from(place) - origin);
            (0..3).all(|axis| low[axis] <= at[axis] && at[axis] <= high[axis])
        }
    }

    /// Returns the ends of its twelve edges in the world.
    pub fn edges(&self) -> [[Point3<f64>; 2]; 12] {
        let (matrix, origin) = (self.matrix().transpose(), Point3::from(self.origin));
        let corner = |bits: usize| {
            let side = |axis: usize| match bits >> axis & 1 {
                0 => self.low[axis],
                _ => self.high[axis],
            };
            origin + matrix * Vector3::new(side(0), side(1), side(2))
        };
        std::array::from_fn(|edge| {
            let (axis, others) = (edge / 4, edge % 4);
            let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
            let from = (others & 1) << b | (others >> 1) << c;
            [corner(from), corner(from | 1 << axis)]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_what_is_between_its_sides() {
        // A quarter rotation about z: x of the box is y of the world.
        let half = core::f64::consts::FRAC_1_SQRT_2;
        let crop = CropBox {
            of: 0,
            component: 0,
            origin: [1.0, 0.0, 0.0],
            rotation: [0.0, 0.0, -half, half],
            low: [0.0, -1.0, -1.0],
            high: [5.0, 1.0, 1.0],
        };
        assert!(crop.is_valid());
        let inside = crop.inside();
        assert!(inside([1.0, 4.9, 0.0]) && inside([1.9, 0.1, -0.9]));
        assert!(!inside([1.0, 5.1, 0.0]) && !inside([1.0, -0.1, 0.0]));
        assert!(!inside([f64::NAN, 1.0, 0.0]));
        let length: f64 = (crop.edges().iter()).map(|[a, b]| (b - a).norm()).sum();
        assert!((length - 4.0 * (5.0 + 2.0 + 2.0)).abs() < 1e-9, "{length}");
        let flat = CropBox {
            high: [5.0, -1.0, 1.0],
            ..crop
        };
        let unbounded = CropBox {
            low: [f64::NEG_INFINITY; 3],
            ..crop
        };
        let skewed = CropBox {
            rotation: [0.0; 4],
            ..crop
        };
        assert!(![flat, unbounded, skewed].iter().any(CropBox::is_valid));
    }
}
