//! Elimination of points: the reduced system of the cameras, and back-substitution of the points.

use super::{BundleProblem, SchurSystem};
use crate::math::parallel::for_each;
use crate::optim::fixed::damping_scale;

impl<const C: usize, const S: usize, B: BundleProblem<C, S>> SchurSystem<'_, C, S, B> {
    /// Computes `V⁻¹` of every point, and its products.
    pub(super) fn invert_point_blocks(&mut self, damping: f64) {
        let width = self.width;
        for_each(&mut self.points, |_, block| {
            let mut damped = block.hessian;
            for i in 0..3 {
                damped[i][i] = damp(damped[i][i], damping);
            }
            // A point whose block is singular even with damping does not move.
            block.inverse = invert_symmetric(&damped).unwrap_or([[0.0; 3]; 3]);
            for i in 0..3 {
                block.solved_gradient[i] = 0.0;
                for k in 0..3 {
                    block.solved_gradient[i] += block.inverse[i][k] * block.gradient[k];
                }
            }
            for group in &mut block.groups {
                for i in 0..3 {
                    group.solved[i] = [0.0; S];
                    for k in 0..3 {
                        for s in 0..width {
                            group.solved[i][s] += block.inverse[i][k] * group.with_point[k][s];
                        }
                    }
                }
            }
        });
        let points = &self.points;
        for_each(&mut self.couplings, |_, coupling| {
            let inverse = &points[coupling.point as usize].inverse;
            for k in 0..3 {
                for c in 0..C {
                    coupling.solved[k][c] = inverse[k][0] * coupling.cross[0][c]
                        + inverse[k][1] * coupling.cross[1][c]
                        + inverse[k][2] * coupling.cross[2][c];
                }
            }
        });
    }

    /// Computes `U − W V⁻¹ Wᵀ` and its right side, camera by camera.
    pub(super) fn reduce(&mut self, damping: f64) {
        let (couplings, points, starts, of_camera) = (
            &self.couplings,
            &self.points,
            &self.point_starts,
            &self.camera_couplings,
        );
        let of_group = self.width;
        for_each(&mut self.cameras, |c, block| {
            let width = (c + 1) * C;
            block.rows.fill(0.0);
            for i in 0..C {
                block.rows[i * width + c * C..(i + 1) * width].copy_from_slice(&block.hessian[i]);
                block.rows[i * width + c * C + i] = damp(block.hessian[i][i], damping);
            }
            block.reduced_with_shared.clone_from(&block.with_shared);
            block.reduced_gradient = block.gradient;
            for &position in &of_camera[c] {
                let coupling = &couplings[position as usize];
                let p = coupling.point as usize;
                let point = &points[p];
                for k in 0..3 {
                    for i in 0..C {
                        block.reduced_gradient[i] -= coupling.solved[k][i] * point.gradient[k];
                    }
                    for group in &point.groups {
                        let reduced = &mut block.reduced_with_shared[group.group as usize];
                        for s in 0..of_group {
                            for i in 0..C {
                                reduced[s][i] -= group.with_point[k][s] * coupling.solved[k][i];
                            }
                        }
                    }
                }
                for other in &couplings[starts[p]..starts[p + 1]] {
                    let column = other.camera as usize * C;
                    if column >= width {
                        continue;
                    }
                    for i in 0..C {
                        let target: &mut [f64; C] = (&mut block.rows
                            [i * width + column..i * width + column + C])
                            .try_into()
                            .expect("a slice of C numbers");
                        let (x, y, z) = (
                            coupling.solved[0][i],
                            coupling.solved[1][i],
                            coupling.solved[2][i],
                        );
                        for j in 0..C {
                            target[j] -= x * other.cross[0][j]
                                + y * other.cross[1][j]
                                + z * other.cross[2][j];
                        }
                    }
                }
            }
        });
        let groups_start = self.cameras.len() * C;
        let size = self.right.len();
        for (c, block) in self.cameras.iter().enumerate() {
            let width = (c + 1) * C;
            for i in 0..C {
                let row = (c * C + i) * size;
                self.reduced[row..row + width]
                    .copy_from_slice(&block.rows[i * width..(i + 1) * width]);
                self.right[c * C + i] = -block.reduced_gradient[i];
            }
            for (g, with_shared) in block.reduced_with_shared.iter().enumerate() {
                for s in 0..of_group {
                    let row = (groups_start + g * of_group + s) * size + c * C;
                    self.reduced[row..row + C].copy_from_slice(&with_shared[s]);
                }
            }
        }
        self.reduce_groups(damping, groups_start);
    }

    /// Computes the rows of the groups, from `groups_start` on, without their coupling to cameras.
    fn reduce_groups(&mut self, damping: f64, groups_start: usize) {
        let (size, width) = (self.right.len(), self.width);
        for (g, block) in self.groups.iter().enumerate() {
            for s in 0..width {
                let place = groups_start + g * width + s;
                let row = &mut self.reduced[place * size..(place + 1) * size];
                row[groups_start..].fill(0.0);
                row[groups_start + g * width..][..width]
                    .copy_from_slice(&block.hessian[s][..width]);
                row[place] = damp(block.hessian[s][s], damping);
                self.right[place] = block.gradient[s];
            }
        }
        for point in &self.points {
            for a in &point.groups {
                let first = groups_start + a.group as usize * width;
                for s in 0..width {
                    for k in 0..3 {
                        self.right[first + s] -= a.with_point[k][s] * point.solved_gradient[k];
                    }
                }
                // Only the lower triangle is used.
                for b in point.groups.iter().filter(|b| b.group <= a.group) {
                    let column = groups_start + b.group as usize * width;
                    for s in 0..width {
                        let row = &mut self.reduced[(first + s) * size + column..][..width];
                        for k in 0..3 {
                            for q in 0..width {
                                row[q] -= a.with_point[k][s] * b.solved[k][q];
                            }
                        }
                    }
                }
            }
        }
        for right in &mut self.right[groups_start..] {
            *right = -*right;
        }
    }

    pub(super) fn substitute_back(&mut self) {
        for (c, delta) in self.delta.cameras.iter_mut().enumerate() {
            delta.copy_from_slice(&self.right[c * C..(c + 1) * C]);
        }
        let groups_start = self.cameras.len() * C;
        for (g, delta) in self.delta.shared.iter_mut().enumerate() {
            let width = self.width;
            delta[..width].copy_from_slice(&self.right[groups_start + g * width..][..width]);
        }
        let (couplings, points, starts) = (&self.couplings, &self.points, &self.point_starts);
        let (cameras, shared) = (&self.delta.cameras, &self.delta.shared);
        let of_group = self.width;
        for_each(&mut self.delta.points, |p, delta| {
            let block = &points[p];
            let mut right = block.gradient;
            for coupling in &couplings[starts[p]..starts[p + 1]] {
                let camera = &cameras[coupling.camera as usize];
                for k in 0..3 {
                    for c in 0..C {
                        right[k] += coupling.cross[k][c] * camera[c];
                    }
                }
            }
            for group in &block.groups {
                let shared = &shared[group.group as usize];
                for k in 0..3 {
                    for s in 0..of_group {
                        right[k] += group.with_point[k][s] * shared[s];
                    }
                }
            }
            for i in 0..3 {
                delta[i] = -(block.inverse[i][0] * right[0]
                    + block.inverse[i][1] * right[1]
                    + block.inverse[i][2] * right[2]);
            }
        });
    }
}

/// Returns a diagonal entry with its damping; 1 for a parameter without influence, so that it does
/// not move.
#[inline]
fn damp(curvature: f64, damping: f64) -> f64 {
    if curvature > 0.0 {
        curvature + damping * damping_scale(curvature)
    } else {
        1.0
    }
}

/// Inverts a symmetric positive definite 3×3 matrix; `None` if it is not one.
fn invert_symmetric(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    // Scaled to unit diagonal, so that the singularity test does not depend on units.
    let mut scale = [0.0; 3];
    for i in 0..3 {
        scale[i] = 1.0 / m[i][i].sqrt();
    }
    let a = m[1][0] * scale[1] * scale[0];
    let b = m[2][0] * scale[2] * scale[0];
    let c = m[2][1] * scale[2] * scale[1];
    let cofactor = [
        [1.0 - c * c, b * c - a, a * c - b],
        [b * c - a, 1.0 - b * b, a * b - c],
        [a * c - b, a * b - c, 1.0 - a * a],
    ];
    let determinant = cofactor[0][0] + a * cofactor[0][1] + b * cofactor[0][2];
    if !(determinant > 1e-15 && determinant.is_finite()) {
        return None;
    }
    let mut inverse = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            inverse[i][j] = cofactor[i][j] / determinant * scale[i] * scale[j];
            if !inverse[i][j].is_finite() {
                return None;
            }
        }
    }
    Some(inverse)
}
