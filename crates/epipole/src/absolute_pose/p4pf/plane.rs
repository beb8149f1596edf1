//! Four points on a plane: what is seen of them gives the ratios of their depths.

use nalgebra::{Vector2, Vector3, Vector4};

/// Points on a line have no such share in what the others say.
const NO_SHARE: f64 = 1e-9;

/// The depths of four points on a plane, the first of which is 1; `None` if three of them lie on a
/// line, or one would be behind the camera.
///
/// From `Σ bᵢ Xᵢ = 0` with `Σ bᵢ = 0` follows `Σ bᵢ zᵢ (uᵢ, vᵢ, 1) = 0`: three equations for the
/// ratios of four depths, whatever the focal length.
///
/// * `pixels`: about the principal point
/// * `relation`: the multiples of the sides from the first point to the others that vanish together
pub(super) fn depth_ratios(
    pixels: &[Vector2<f64>; 4],
    relation: &Vector3<f64>,
) -> Option<Vector4<f64>> {
    let b = Vector4::new(-relation.sum(), relation.x, relation.y, relation.z);
    let m = pixels.map(|p| Vector3::new(p.x, p.y, 1.0));
    // The null vector of a 3 × 4 matrix is made of its minors.
    let minor = |i: usize, j: usize, k: usize| m[i].dot(&m[j].cross(&m[k]));
    let null = Vector4::new(
        minor(1, 2, 3),
        -minor(0, 2, 3),
        minor(0, 1, 3),
        -minor(0, 1, 2),
    );
    let is_whole = |v: &Vector4<f64>| v.iter().all(|x| x.abs() > NO_SHARE * v.amax());
    // A plane that is seen from the side is a line.
    if !(is_whole(&b) && is_whole(&null) && null.amax() > NO_SHARE) {
        return None;
    }
    let depths = null.component_div(&b);
    let depths = depths / depths[0];
    depths.iter().all(|z| *z > 0.0).then_some(depths)
}
