//! Closed-form intrinsics from homographies of planes.

use crate::camera::Intrinsics;
use crate::math::null_space::right_singular_vectors;
use crate::{Error, Result};
use nalgebra::{Matrix2, Matrix3, Point2, Vector2, Vector3};

const WHAT: &str = "the intrinsics from views of a plane";

/// Computes K without skew from homographies of a metric plane, in two or more views that are not
/// parallel.
///
/// Each homography `H = K [r1 r2 t]` gives two equations in the image of the absolute conic
/// `ω = K⁻ᵀ K⁻¹`, since r1 and r2 are orthogonal and equally long: `h1ᵀ ω h2 = 0` and
/// `h1ᵀ ω h1 = h2ᵀ ω h2`.
///
/// * `pixels_from_plane`: homographies from the plane, in any unit of length, to pixels
///
/// # Errors
/// [`Error::TooFew`] for fewer than two views (three in general position are needed for certainty),
/// [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if the views do not determine
/// K, for instance if all planes are parallel, or if with noise no camera has the conic ω.
///
/// Source: Zhang 2000, "A flexible new technique for camera calibration", §3.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::intrinsics_from_planes;
/// use nalgebra::{Matrix3, Rotation3, Vector3};
/// let k = Matrix3::new(700.0, 0.0, 320.0, 0.0, 650.0, 240.0, 0.0, 0.0, 1.0);
/// let views = [[0.5, 0.0, 0.1], [0.0, 0.6, 0.0], [-0.4, 0.3, 0.2]].map(|rotation_vector| {
///     let r = Rotation3::from_scaled_axis(Vector3::from(rotation_vector)).into_inner();
///     k * Matrix3::from_columns(&[r.column(0).into_owned(), r.column(1).into_owned(), Vector3::new(0.1, 0.2, 3.0)])
/// });
/// let found = intrinsics_from_planes(&views)?;
/// assert!((found.fu_px() - 700.0).abs() < 1e-6 && (found.principal_point().y - 240.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn intrinsics_from_planes(pixels_from_plane: &[Matrix3<f64>]) -> Result<Intrinsics> {
    if pixels_from_plane.len() < 2 {
        return Err(Error::TooFew {
            what: WHAT,
            needed: 2,
            got: pixels_from_plane.len(),
        });
    }
    let scale = typical_size(pixels_from_plane)?;
    let shrink = Matrix3::from_diagonal(&Vector3::new(1.0 / scale, 1.0 / scale, 1.0));
    let planes: Vec<_> = pixels_from_plane
        .iter()
        .map(|h| columns(&(shrink * h)))
        .collect();
    // The unknowns are b11, b22, b13, b23 and b33 of ω; b12 is the skew.
    let product = |a: &Vector3<f64>, b: &Vector3<f64>| {
        [
            a.x * b.x,
            a.y * b.y,
            a.x * b.z + a.z * b.x,
            a.y * b.z + a.z * b.y,
            a.z * b.z,
        ]
    };
    let (values, vectors) = right_singular_vectors(2 * planes.len(), |row| {
        let [h1, h2] = &planes[row / 2];
        if row % 2 == 0 {
            product(h1, h2)
        } else {
            let (one, two) = (product(h1, h1), product(h2, h2));
            core::array::from_fn(|i| one[i] - two[i])
        }
    });
    if values[3] <= 1e-9 * values[0] {
        return Err(Error::Degenerate {
            what: WHAT,
            why: "all planes are parallel",
        });
    }
    let [b11, b22, b13, b23, b33] = vectors[4];
    let (cu, cv) = (-b13 / b11, -b23 / b22);
    let rest = b33 + b13 * cu + b23 * cv;
    let (fu_sq, fv_sq) = (rest / b11, rest / b22);
    if !(fu_sq > 0.0 && fv_sq > 0.0) {
        return Err(Error::Degenerate {
            what: WHAT,
            why: "no camera sees the planes like that; noise or distortion is too large",
        });
    }
    Intrinsics::new(
        fu_sq.sqrt() * scale,
        fv_sq.sqrt() * scale,
        cu * scale,
        cv * scale,
    )
}

/// Computes the focal lengths for a known principal point: with only two unknowns a single view
/// suffices, and noise has less effect.
///
/// # Errors
/// As [`intrinsics_from_planes`]; a single view parallel to the image does not determine them.
pub(super) fn focals_from_planes(
    pixels_from_plane: &[Matrix3<f64>],
    center: &Point2<f64>,
) -> Result<Intrinsics> {
    let scale = typical_size(pixels_from_plane)?;
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    #[rustfmt::skip]
    let shift = Matrix3::new(
        1.0 / scale, 0.0, -center.x / scale,
        0.0, 1.0 / scale, -center.y / scale,
        0.0, 0.0, 1.0,
    );
    for homography in pixels_from_plane {
        let [h1, h2] = columns(&(shift * homography));
        for (row, known) in [
            (Vector2::new(h1.x * h2.x, h1.y * h2.y), h1.z * h2.z),
            (
                Vector2::new(h1.x * h1.x - h2.x * h2.x, h1.y * h1.y - h2.y * h2.y),
                h1.z * h1.z - h2.z * h2.z,
            ),
        ] {
            normal += row * row.transpose();
            right -= row * known;
        }
    }
    let open = Error::Degenerate {
        what: WHAT,
        why: "all planes are parallel to the image, or noise is too large",
    };
    let separate = normal.try_inverse().map(|inverse| inverse * right);
    let [fu_sq, fv_sq] = match separate {
        Some(w) if w.x > 0.0 && w.y > 0.0 => [1.0 / w.x, 1.0 / w.y],
        // Square pixels leave one unknown.
        _ => {
            let w = (right.x + right.y) / normal.sum();
            if !(w > 0.0 && w.is_finite()) {
                return Err(open);
            }
            [1.0 / w; 2]
        }
    };
    Intrinsics::new(
        fu_sq.sqrt() * scale,
        fv_sq.sqrt() * scale,
        center.x,
        center.y,
    )
}

/// Returns the first two columns of H, scaled to a common length of one, so that all views have
/// equal weight.
fn columns(homography: &Matrix3<f64>) -> [Vector3<f64>; 2] {
    let columns = [homography.column(0), homography.column(1)];
    let length = (columns[0].norm_squared() + columns[1].norm_squared()).sqrt();
    columns.map(|column| column / length)
}

/// Returns the typical distance of the planes' origins from pixel (0, 0), pixels, for scaling
/// coordinates to about 1.
fn typical_size(homographies: &[Matrix3<f64>]) -> Result<f64> {
    let mut sum = 0.0;
    for h in homographies {
        if !h.iter().all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "a homography from a plane",
            });
        }
        sum += libm::hypot(h[(0, 2)] / h[(2, 2)], h[(1, 2)] / h[(2, 2)]);
    }
    let mean = sum / homographies.len() as f64;
    Ok(if mean.is_finite() { mean.max(1.0) } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Rotation3;

    fn view(k: &Intrinsics, rotation_vector: Vector3<f64>, t: Vector3<f64>) -> Matrix3<f64> {
        let r = Rotation3::from_scaled_axis(rotation_vector).into_inner();
        k.matrix() * Matrix3::from_columns(&[r.column(0).into(), r.column(1).into(), t])
    }

    #[test]
    fn random_views_give_the_camera() {
        let mut random = Random::new(1);
        for trial in 0..200 {
            let k = Intrinsics::new(
                random.uniform(300.0, 3000.0),
                random.uniform(300.0, 3000.0),
                random.uniform(200.0, 900.0),
                random.uniform(100.0, 700.0),
            )
            .unwrap();
            let views: Vec<_> = (0..3 + trial % 5)
                .map(|_| {
                    let rotation_vector = Vector3::from_fn(|_, _| random.uniform(-0.7, 0.7));
                    let t = Vector3::new(random.normal(), random.normal(), 5.0);
                    view(&k, rotation_vector, t) * random.uniform(-2.0, 2.0)
                })
                .collect();
            let found = intrinsics_from_planes(&views).unwrap();
            assert!((found.matrix() - k.matrix()).norm() < 1e-5 * k.matrix().norm());
            let found = focals_from_planes(&views, &k.principal_point()).unwrap();
            assert!((found.matrix() - k.matrix()).norm() < 1e-7 * k.matrix().norm());
        }
    }

    #[test]
    fn views_that_leave_it_open_are_refused() {
        let k = Intrinsics::centered(600.0, 640, 480).unwrap();
        let rotation_vector = Vector3::new(0.3, -0.2, 0.1);
        let at = |x: f64| view(&k, rotation_vector, Vector3::new(x, 0.0, 4.0 + x));
        let parallel = [at(0.0), at(0.5), at(1.0), at(-0.4)];
        for views in [&parallel[..], &parallel[..1], &[Matrix3::zeros(); 3]] {
            assert!(intrinsics_from_planes(views).is_err());
        }
        let nan = [Matrix3::from_element(f64::NAN); 3];
        assert!(matches!(
            intrinsics_from_planes(&nan),
            Err(Error::NotFinite { .. })
        ));
        let frontal = view(&k, Vector3::zeros(), Vector3::z());
        assert!(focals_from_planes(&[frontal], &k.principal_point()).is_err());
    }
}
