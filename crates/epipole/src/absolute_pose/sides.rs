//! Distances of three points along their rays, from the sides of their triangle.

/// Maximum number of Newton steps: four or five suffice unless two solutions are about to merge.
const MAX_STEPS: usize = 8;

/// Maximum angle between a solution and a ray, radians: far above rounding, far below relevance.
const MAX_ROTATION: f64 = 1e-11;

/// Runs Newton's method on the three equations of the sides; returns false without a solution.
///
/// * `versines`: `1 − cos θ` of the angles between the rays
///
/// Near a double solution, or one that has just become complex, steps may lead anywhere, so the
/// distances with the smallest residual are kept.
#[inline]
pub(super) fn polish(d: &mut [f64; 3], sides_sq: [f64; 3], versines: [f64; 3]) -> bool {
    let [a01, a02, a12] = sides_sq;
    let [c01, c02, c12] = versines;
    let tolerance = 1e-15 * (a01 + a02 + a12);
    let (mut best, mut least, mut fits) = (*d, f64::INFINITY, false);
    for _ in 0..=MAX_STEPS {
        let [x, y, z] = *d;
        // x² + y² − 2xy cos θ
        let (xy, xz, yz) = (x - y, x - z, y - z);
        let r0 = xy * xy + 2.0 * x * y * c01 - a01;
        let r1 = xz * xz + 2.0 * x * z * c02 - a02;
        let r2 = yz * yz + 2.0 * y * z * c12 - a12;
        let off = r0.abs() + r1.abs() + r2.abs();
        if off < least {
            (best, least) = (*d, off);
            fits = within(r0, a01, x * x + y * y)
                && within(r1, a02, x * x + z * z)
                && within(r2, a12, y * y + z * z);
        }
        if off <= tolerance {
            break;
        }
        // Half the Jacobian: [p q 0; r 0 s; 0 t w].
        let (p, q) = (xy + y * c01, x * c01 - xy);
        let (r, s) = (xz + z * c02, x * c02 - xz);
        let (t, w) = (yz + z * c12, y * c12 - yz);
        let determinant = -(p * s * t + q * r * w);
        let factor = 0.5 / determinant;
        if !factor.is_finite() {
            break;
        }
        // Cramer's rule, for J δ = −r.
        let dx = (-s * t * r0 - q * w * r1 + q * s * r2) * factor;
        let dy = (-r * w * r0 + p * w * r1 - p * s * r2) * factor;
        let dz = (r * t * r0 - p * t * r1 - q * r * r2) * factor;
        *d = [x - dx, y - dy, z - dz];
    }
    *d = best;
    fits
}

/// Returns whether the ends of a side are on their rays: an error r of the squared side a² is an
/// error of r/(2a) of the side, or an angle of r/(2ad) at distance d.
#[inline(always)]
fn within(r: f64, side_sq: f64, depths_sq: f64) -> bool {
    r * r <= MAX_ROTATION * MAX_ROTATION * side_sq * depths_sq
}
