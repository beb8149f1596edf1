//! Depth ratios of four coplanar points.

use nalgebra::{Vector2, Vector3, Vector4};

/// Minimum relative coefficient of a point: with a smaller one the other three are collinear.
const NO_WEIGHT: f64 = 1e-9;

/// Returns the depths of four coplanar points, relative to the first; `None` if three of them are
/// collinear, or one would be behind the camera.
///
/// From `Σ bᵢ Xᵢ = 0` with `Σ bᵢ = 0` follows `Σ bᵢ zᵢ (uᵢ, vᵢ, 1) = 0`: three equations for the
/// ratios of four depths, whatever the focal length.
///
/// * `pixels`: pixels relative to the principal point
/// * `relation`: linear relation of the sides from the first point to the others
pub(super) fn depth_ratios(
    pixels: &[Vector2<f64>; 4],
    relation: &Vector3<f64>,
) -> Option<Vector4<f64>> {
    let b = Vector4::new(-relation.sum(), relation.x, relation.y, relation.z);
    let m = pixels.map(|p| Vector3::new(p.x, p.y, 1.0));
    // The null vector of a 3 × 4 matrix consists of its minors.
    let minor = |i: usize, j: usize, k: usize| m[i].dot(&m[j].cross(&m[k]));
    let null = Vector4::new(
        minor(1, 2, 3),
        -minor(0, 2, 3),
        minor(0, 1, 3),
        -minor(0, 1, 2),
    );
    let is_whole = |v: &Vector4<f64>| v.iter().all(|x| x.abs() > NO_WEIGHT * v.amax());
    // A plane seen edge-on is a line.
    if !(is_whole(&b) && is_whole(&null) && null.amax() > NO_WEIGHT) {
        return None;
    }
    let depths = null.component_div(&b);
    let depths = depths / depths[0];
    depths.iter().all(|z| *z > 0.0).then_some(depths)
}
