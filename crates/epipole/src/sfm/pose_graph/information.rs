//! Information matrices of measurements: symmetric, without negative eigenvalues.

use crate::{Error, Result};
use nalgebra::{DMatrix, SMatrix};

/// Rounding error of a file with six digits, relative to the largest entry.
const TOLERANCE: f64 = 1e-5;

/// Names of an information matrix and its properties in messages.
pub(super) struct Names {
    matrix: &'static str,
    asymmetry: &'static str,
    eigenvalue: &'static str,
}

/// Names for the matrix of an edge.
pub(super) const OF_EDGE: Names = Names {
    matrix: "the information matrix of an edge",
    asymmetry: "the largest difference between the information matrix of an edge and its transpose",
    eigenvalue: "the smallest eigenvalue of the information matrix of an edge",
};

/// Names for the matrix of a prior.
pub(super) const OF_PRIOR: Names = Names {
    matrix: "the information matrix of a prior",
    asymmetry: "the largest difference between the information matrix of a prior and its transpose",
    eigenvalue: "the smallest eigenvalue of the information matrix of a prior",
};

/// Checks an information matrix.
///
/// # Errors
/// [`Error::NotFinite`]; [`Error::OutOfRange`] if it is asymmetric or has a negative eigenvalue,
/// which would reward large errors.
pub(super) fn check<const D: usize>(matrix: &SMatrix<f64, D, D>, names: &Names) -> Result<()> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Err(Error::NotFinite { what: names.matrix });
    }
    let rounding = TOLERANCE * matrix.amax();
    let asymmetry = (matrix - matrix.transpose()).amax();
    if asymmetry > rounding {
        return Err(Error::OutOfRange {
            what: names.asymmetry,
            requirement: "0",
            value: asymmetry,
        });
    }
    // Most matrices are definite, and Cholesky takes a tenth of the time of the eigenvalues.
    if matrix.cholesky().is_some() {
        return Ok(());
    }
    let entries = DMatrix::from_column_slice(D, D, matrix.as_slice());
    let smallest = entries.symmetric_eigenvalues().min();
    if smallest < -rounding {
        return Err(Error::OutOfRange {
            what: names.eigenvalue,
            requirement: "0 or more",
            value: smallest,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3, matrix};

    fn sentence(matrix: Matrix3<f64>) -> String {
        check(&matrix, &OF_PRIOR).unwrap_err().to_string()
    }

    #[test]
    fn definite_and_semidefinite_matrices_pass() {
        let position = Matrix3::from_diagonal(&Vector3::new(4.0, 4.0, 0.0));
        let printed = matrix![44.7214, 0.0, 0.0; 0.0, 44.7214, 0.0; 0.0, 0.0, -1e-5];
        for good in [Matrix3::identity(), Matrix3::zeros(), position, printed] {
            assert_eq!(check(&good, &OF_EDGE), Ok(()));
        }
    }

    #[test]
    fn others_are_refused_with_their_cause() {
        let negative = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -3.0));
        assert_eq!(
            sentence(negative),
            "the smallest eigenvalue of the information matrix of a prior must be 0 or more, but is -3"
        );
        let mut asymmetric = Matrix3::identity();
        asymmetric[(0, 2)] = 0.5;
        assert_eq!(
            sentence(asymmetric),
            "the largest difference between the information matrix of a prior and its transpose must be 0, but is 0.5"
        );
        let nan = Matrix3::from_element(f64::NAN);
        assert!(sentence(nan).starts_with("the information matrix of a prior"));
    }
}
