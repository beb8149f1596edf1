//! Poses as rows of numbers.

use epipole::nalgebra::{
    Isometry2, Isometry3, Quaternion, Similarity3, Translation3, UnitQuaternion, Vector2,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Pose as a row of numbers.
pub(super) trait Row: Copy {
    /// Reads a row.
    fn read(row: &[f64]) -> PyResult<Self>;
    /// Appends the numbers of the row.
    fn give(&self, row: &mut Vec<f64>);
}

impl Row for Isometry2<f64> {
    fn read(row: &[f64]) -> PyResult<Self> {
        Ok(Self::new(Vector2::new(row[0], row[1]), row[2]))
    }

    fn give(&self, row: &mut Vec<f64>) {
        let t = self.translation.vector;
        row.extend([t.x, t.y, self.rotation.angle()]);
    }
}

impl Row for Isometry3<f64> {
    fn read(row: &[f64]) -> PyResult<Self> {
        let q = Quaternion::new(row[3], row[4], row[5], row[6]);
        if (q.norm() - 1.0).abs() > 1e-6 {
            return Err(PyValueError::new_err(format!(
                "quaternions must have length 1, but one has length {}",
                q.norm()
            )));
        }
        let translation = Translation3::new(row[0], row[1], row[2]);
        // Keep the bits of an exact unit quaternion.
        let rotation = if (q.norm_squared() - 1.0).abs() < 1e-14 {
            UnitQuaternion::new_unchecked(q)
        } else {
            UnitQuaternion::new_normalize(q)
        };
        Ok(Self::from_parts(translation, rotation))
    }

    fn give(&self, row: &mut Vec<f64>) {
        let (t, q) = (self.translation.vector, self.rotation.quaternion());
        row.extend([t.x, t.y, t.z, q.w, q.i, q.j, q.k]);
    }
}

impl Row for Similarity3<f64> {
    fn read(row: &[f64]) -> PyResult<Self> {
        if row[7].is_nan() || row[7] <= 0.0 {
            let message = format!("scales must be greater than 0, but one is {}", row[7]);
            return Err(PyValueError::new_err(message));
        }
        Ok(Self::from_isometry(Isometry3::read(row)?, row[7]))
    }

    fn give(&self, row: &mut Vec<f64>) {
        self.isometry.give(row);
        row.push(self.scaling());
    }
}
