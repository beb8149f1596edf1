//! Bundle adjustment's normal equations: points are eliminated, the cameras' reduced system is
//! solved densely.
//!
//! The file is long because the blocks of one linear system belong together.

use super::cholesky;
use super::fixed::damping_scale;
use super::levenberg_marquardt::{DampedStep, Linearization, System};
use super::loss::RobustLoss;
use super::parallel::{for_each, sum};

/// One observation linearized: residual and Jacobians with respect to its camera (`C` degrees of
/// freedom), what all cameras share (`S`), and its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObservationTerms<const C: usize, const S: usize> {
    /// Predicted minus observed.
    pub residual: [f64; 2],
    /// ∂r/∂camera.
    pub camera: [[f64; C]; 2],
    /// ∂r/∂shared.
    pub shared: [[f64; S]; 2],
    /// ∂r/∂point.
    pub point: [[f64; 3]; 2],
}

/// Steps of all blocks, as the Schur complement solves for them.
#[derive(Debug, Clone, PartialEq)]
pub struct BundleStep<const C: usize, const S: usize> {
    /// One a camera.
    pub cameras: Vec<[f64; C]>,
    /// What all cameras share.
    pub shared: [f64; S],
    /// One a point.
    pub points: Vec<[f64; 3]>,
}

/// A problem of cameras and points, where every residual has one of each.
pub trait BundleProblem<const C: usize, const S: usize>: Sync {
    /// Cameras, shared quantities and points.
    type Parameters: Clone + Sync;

    /// The number of cameras.
    fn num_cameras(&self) -> usize;
    /// The number of points.
    fn num_points(&self) -> usize;
    /// Camera and point of each observation; both must be in range.
    fn observations(&self) -> &[(u32, u32)];
    /// The residual of one observation.
    fn residual(&self, parameters: &Self::Parameters, observation: usize) -> [f64; 2];
    /// The residual of one observation with its Jacobians.
    fn linearize(
        &self,
        parameters: &Self::Parameters,
        observation: usize,
    ) -> ObservationTerms<C, S>;
    /// `from ⊞ step`.
    fn step(&self, from: &Self::Parameters, step: &BundleStep<C, S>, into: &mut Self::Parameters);
    /// The length of the parameters, for the relative step test.
    fn parameter_norm(&self, parameters: &Self::Parameters) -> f64;
    /// The loss of every residual.
    fn loss(&self) -> RobustLoss;
    /// Which degrees of freedom of a camera are held fixed.
    fn held_camera(&self, _camera: usize) -> [bool; C] {
        [false; C]
    }
    /// Which shared quantities are held fixed.
    fn held_shared(&self) -> [bool; S] {
        [false; S]
    }
    /// Whether a point is held fixed.
    fn held_point(&self, _point: usize) -> bool {
        false
    }
}

#[derive(Clone)]
struct CameraBlock<const C: usize, const S: usize> {
    /// Lower triangle of `Σ JcᵀJc`.
    hessian: [[f64; C]; C],
    with_shared: [[f64; C]; S],
    gradient: [f64; C],
    /// This camera's rows of the reduced system, up to and including its own block.
    rows: Vec<f64>,
    reduced_with_shared: [[f64; C]; S],
    reduced_gradient: [f64; C],
}

#[derive(Clone)]
struct PointBlock<const S: usize> {
    hessian: [[f64; 3]; 3],
    with_shared: [[f64; S]; 3],
    gradient: [f64; 3],
    inverse: [[f64; 3]; 3],
    /// `V⁻¹` times `with_shared`.
    solved_shared: [[f64; S]; 3],
    /// `V⁻¹` times the gradient.
    solved_gradient: [f64; 3],
    shared_hessian: [[f64; S]; S],
    shared_gradient: [f64; S],
}

/// An observation's blocks, √ρ' included.
#[derive(Clone)]
struct Coupling<const C: usize, const S: usize> {
    camera: u32,
    point: u32,
    terms: ObservationTerms<C, S>,
    /// `JpᵀJc`.
    cross: [[f64; C]; 3],
    /// `V⁻¹ JpᵀJc`.
    solved: [[f64; C]; 3],
}

/// Least damping: the reduced system of cameras without a gauge is singular.
const LEAST_DAMPING: f64 = 1e-12;

/// The [`System`] of a [`BundleProblem`].
///
/// With the damped blocks U (cameras), V (points, 3×3 each) and W between them, the cameras'
/// steps solve `(U − W V⁻¹ Wᵀ) δc = −(gc − W V⁻¹ gp)`; then `δp = −V⁻¹ (gp + Wᵀ δc)`.
///
/// Cameras without observations and points without any stay where they are.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis", §6.1.
pub struct SchurSystem<'a, const C: usize, const S: usize, B: BundleProblem<C, S>> {
    problem: &'a B,
    /// Original observation numbers, sorted by point.
    order: Vec<u32>,
    couplings: Vec<Coupling<C, S>>,
    /// Couplings of point p: `point_starts[p]..point_starts[p + 1]`.
    point_starts: Vec<usize>,
    /// Positions of the couplings of each camera.
    camera_couplings: Vec<Vec<u32>>,
    cameras: Vec<CameraBlock<C, S>>,
    points: Vec<PointBlock<S>>,
    shared_hessian: [[f64; S]; S],
    shared_gradient: [f64; S],
    reduced: Vec<f64>,
    right: Vec<f64>,
    delta: BundleStep<C, S>,
}

impl<'a, const C: usize, const S: usize, B: BundleProblem<C, S>> SchurSystem<'a, C, S, B> {
    /// Sorts the observations and makes room for all blocks.
    pub fn new(problem: &'a B) -> Self {
        let (num_cameras, num_points) = (problem.num_cameras(), problem.num_points());
        let observations = problem.observations();
        let mut order: Vec<u32> = (0..observations.len() as u32).collect();
        order.sort_by_key(|&o| (observations[o as usize].1, o));
        let mut point_starts = vec![0; num_points + 1];
        for &(_, point) in observations {
            point_starts[point as usize + 1] += 1;
        }
        for p in 0..num_points {
            point_starts[p + 1] += point_starts[p];
        }
        let mut camera_couplings = vec![Vec::new(); num_cameras];
        let couplings = order
            .iter()
            .enumerate()
            .map(|(position, &o)| {
                let (camera, point) = observations[o as usize];
                camera_couplings[camera as usize].push(position as u32);
                Coupling {
                    camera,
                    point,
                    terms: ObservationTerms {
                        residual: [0.0; 2],
                        camera: [[0.0; C]; 2],
                        shared: [[0.0; S]; 2],
                        point: [[0.0; 3]; 2],
                    },
                    cross: [[0.0; C]; 3],
                    solved: [[0.0; C]; 3],
                }
            })
            .collect();
        let cameras = (0..num_cameras)
            .map(|camera| CameraBlock {
                hessian: [[0.0; C]; C],
                with_shared: [[0.0; C]; S],
                gradient: [0.0; C],
                rows: vec![0.0; C * C * (camera + 1)],
                reduced_with_shared: [[0.0; C]; S],
                reduced_gradient: [0.0; C],
            })
            .collect();
        let point = PointBlock {
            hessian: [[0.0; 3]; 3],
            with_shared: [[0.0; S]; 3],
            gradient: [0.0; 3],
            inverse: [[0.0; 3]; 3],
            solved_shared: [[0.0; S]; 3],
            solved_gradient: [0.0; 3],
            shared_hessian: [[0.0; S]; S],
            shared_gradient: [0.0; S],
        };
        let size = num_cameras * C + S;
        Self {
            problem,
            order,
            couplings,
            point_starts,
            camera_couplings,
            cameras,
            points: vec![point; num_points],
            shared_hessian: [[0.0; S]; S],
            shared_gradient: [0.0; S],
            reduced: vec![0.0; size * size],
            right: vec![0.0; size],
            delta: BundleStep {
                cameras: vec![[0.0; C]; num_cameras],
                shared: [0.0; S],
                points: vec![[0.0; 3]; num_points],
            },
        }
    }

    fn linearize_observations(&mut self, parameters: &B::Parameters) {
        let (problem, order) = (self.problem, &self.order);
        let loss = problem.loss();
        let held_shared = problem.held_shared();
        for_each(&mut self.couplings, |position, coupling| {
            let mut terms = problem.linearize(parameters, order[position] as usize);
            let [u, v] = terms.residual;
            let root = loss.weight(u * u + v * v).sqrt();
            let held_camera = problem.held_camera(coupling.camera as usize);
            let held_point = problem.held_point(coupling.point as usize);
            for row in 0..2 {
                terms.residual[row] *= root;
                for (j, held) in terms.camera[row].iter_mut().zip(held_camera) {
                    *j = if held { 0.0 } else { *j * root };
                }
                for (j, held) in terms.shared[row].iter_mut().zip(held_shared) {
                    *j = if held { 0.0 } else { *j * root };
                }
                for j in &mut terms.point[row] {
                    *j = if held_point { 0.0 } else { *j * root };
                }
            }
            for k in 0..3 {
                for c in 0..C {
                    coupling.cross[k][c] = terms.point[0][k] * terms.camera[0][c]
                        + terms.point[1][k] * terms.camera[1][c];
                }
            }
            coupling.terms = terms;
        });
    }

    fn sum_point_blocks(&mut self) {
        let (couplings, starts) = (&self.couplings, &self.point_starts);
        for_each(&mut self.points, |p, block| {
            block.hessian = [[0.0; 3]; 3];
            block.with_shared = [[0.0; S]; 3];
            block.gradient = [0.0; 3];
            block.shared_hessian = [[0.0; S]; S];
            block.shared_gradient = [0.0; S];
            for coupling in &couplings[starts[p]..starts[p + 1]] {
                let terms = &coupling.terms;
                for row in 0..2 {
                    let (point, shared) = (&terms.point[row], &terms.shared[row]);
                    for i in 0..3 {
                        block.gradient[i] += point[i] * terms.residual[row];
                        for j in 0..3 {
                            block.hessian[i][j] += point[i] * point[j];
                        }
                        for s in 0..S {
                            block.with_shared[i][s] += point[i] * shared[s];
                        }
                    }
                    for s in 0..S {
                        block.shared_gradient[s] += shared[s] * terms.residual[row];
                        for q in 0..S {
                            block.shared_hessian[s][q] += shared[s] * shared[q];
                        }
                    }
                }
            }
        });
        self.shared_hessian = [[0.0; S]; S];
        self.shared_gradient = [0.0; S];
        for block in &self.points {
            for s in 0..S {
                self.shared_gradient[s] += block.shared_gradient[s];
                for q in 0..S {
                    self.shared_hessian[s][q] += block.shared_hessian[s][q];
                }
            }
        }
    }

    fn sum_camera_blocks(&mut self) {
        let (couplings, of_camera) = (&self.couplings, &self.camera_couplings);
        for_each(&mut self.cameras, |c, block| {
            block.hessian = [[0.0; C]; C];
            block.with_shared = [[0.0; C]; S];
            block.gradient = [0.0; C];
            for &position in &of_camera[c] {
                let terms = &couplings[position as usize].terms;
                for row in 0..2 {
                    let camera = &terms.camera[row];
                    for i in 0..C {
                        block.gradient[i] += camera[i] * terms.residual[row];
                        for j in 0..C {
                            block.hessian[i][j] += camera[i] * camera[j];
                        }
                    }
                    for s in 0..S {
                        for i in 0..C {
                            block.with_shared[s][i] += terms.shared[row][s] * camera[i];
                        }
                    }
                }
            }
        });
    }

    /// `V⁻¹` of every point, and what is multiplied by it.
    fn invert_point_blocks(&mut self, damping: f64) {
        for_each(&mut self.points, |_, block| {
            let mut damped = block.hessian;
            for i in 0..3 {
                damped[i][i] = damp(damped[i][i], damping);
            }
            // A point whose block is singular even when damped stays where it is.
            block.inverse = invert_symmetric(&damped).unwrap_or([[0.0; 3]; 3]);
            for i in 0..3 {
                block.solved_gradient[i] = 0.0;
                block.solved_shared[i] = [0.0; S];
                for k in 0..3 {
                    block.solved_gradient[i] += block.inverse[i][k] * block.gradient[k];
                    for s in 0..S {
                        block.solved_shared[i][s] += block.inverse[i][k] * block.with_shared[k][s];
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

    /// `U − W V⁻¹ Wᵀ` and its right side, camera by camera.
    fn reduce(&mut self, damping: f64) {
        let (couplings, points, starts, of_camera) = (
            &self.couplings,
            &self.points,
            &self.point_starts,
            &self.camera_couplings,
        );
        for_each(&mut self.cameras, |c, block| {
            let width = (c + 1) * C;
            block.rows.fill(0.0);
            for i in 0..C {
                block.rows[i * width + c * C..(i + 1) * width].copy_from_slice(&block.hessian[i]);
                block.rows[i * width + c * C + i] = damp(block.hessian[i][i], damping);
            }
            block.reduced_with_shared = block.with_shared;
            block.reduced_gradient = block.gradient;
            for &position in &of_camera[c] {
                let coupling = &couplings[position as usize];
                let p = coupling.point as usize;
                let point = &points[p];
                for k in 0..3 {
                    for i in 0..C {
                        block.reduced_gradient[i] -= coupling.solved[k][i] * point.gradient[k];
                    }
                    for s in 0..S {
                        for i in 0..C {
                            block.reduced_with_shared[s][i] -=
                                point.with_shared[k][s] * coupling.solved[k][i];
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
        let num_cameras = self.cameras.len();
        let size = num_cameras * C + S;
        for (c, block) in self.cameras.iter().enumerate() {
            let width = (c + 1) * C;
            for i in 0..C {
                let row = (c * C + i) * size;
                self.reduced[row..row + width]
                    .copy_from_slice(&block.rows[i * width..(i + 1) * width]);
                self.right[c * C + i] = -block.reduced_gradient[i];
            }
            for s in 0..S {
                let row = (num_cameras * C + s) * size + c * C;
                self.reduced[row..row + C].copy_from_slice(&block.reduced_with_shared[s]);
            }
        }
        for s in 0..S {
            let row = num_cameras * C + s;
            let mut gradient = self.shared_gradient[s];
            let mut hessian = self.shared_hessian[s];
            hessian[s] = damp(hessian[s], damping);
            for point in &self.points {
                for k in 0..3 {
                    gradient -= point.with_shared[k][s] * point.solved_gradient[k];
                    for q in 0..S {
                        hessian[q] -= point.with_shared[k][s] * point.solved_shared[k][q];
                    }
                }
            }
            self.right[row] = -gradient;
            self.reduced[row * size + num_cameras * C..(row + 1) * size].copy_from_slice(&hessian);
        }
    }

    fn substitute_back(&mut self) {
        for (c, delta) in self.delta.cameras.iter_mut().enumerate() {
            delta.copy_from_slice(&self.right[c * C..(c + 1) * C]);
        }
        let shared_start = self.cameras.len() * C;
        self.delta
            .shared
            .copy_from_slice(&self.right[shared_start..]);
        let (couplings, points, starts) = (&self.couplings, &self.points, &self.point_starts);
        let (cameras, shared) = (&self.delta.cameras, &self.delta.shared);
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
            for k in 0..3 {
                for s in 0..S {
                    right[k] += block.with_shared[k][s] * shared[s];
                }
            }
            for i in 0..3 {
                delta[i] = -(block.inverse[i][0] * right[0]
                    + block.inverse[i][1] * right[1]
                    + block.inverse[i][2] * right[2]);
            }
        });
    }

    /// Predicted decrease and squared length of the step.
    fn measure(&self, damping: f64) -> (f64, f64) {
        let (mut predicted, mut norm_sq) = (0.0, 0.0);
        let mut add = |delta: f64, gradient: f64, curvature: f64| {
            if curvature > 0.0 {
                predicted += delta * (damping * damping_scale(curvature) * delta - gradient);
            }
            norm_sq += delta * delta;
        };
        for (delta, block) in self.delta.cameras.iter().zip(&self.cameras) {
            for i in 0..C {
                add(delta[i], block.gradient[i], block.hessian[i][i]);
            }
        }
        for s in 0..S {
            add(
                self.delta.shared[s],
                self.shared_gradient[s],
                self.shared_hessian[s][s],
            );
        }
        for (delta, block) in self.delta.points.iter().zip(&self.points) {
            for i in 0..3 {
                add(delta[i], block.gradient[i], block.hessian[i][i]);
            }
        }
        (0.5 * predicted, norm_sq)
    }
}

/// A diagonal entry with its damping; 1 where nothing depends on the parameter, so that it stays.
#[inline]
fn damp(curvature: f64, damping: f64) -> f64 {
    if curvature > 0.0 {
        curvature + damping * damping_scale(curvature)
    } else {
        1.0
    }
}

/// The inverse of a symmetric positive definite 3×3 matrix, `None` if it is not one.
fn invert_symmetric(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    // Scaled to a unit diagonal, so that the test for singularity does not depend on units.
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

impl<const C: usize, const S: usize, B: BundleProblem<C, S>> System for SchurSystem<'_, C, S, B> {
    type Parameters = B::Parameters;

    fn linearize(&mut self, parameters: &B::Parameters) -> Linearization {
        self.linearize_observations(parameters);
        self.sum_point_blocks();
        self.sum_camera_blocks();
        let mut gradient_max: f64 = 0.0;
        let mut finite = true;
        let mut look = |g: f64| {
            finite &= g.is_finite();
            gradient_max = gradient_max.max(g.abs());
        };
        for block in &self.cameras {
            block.gradient.iter().for_each(|&g| look(g));
        }
        self.shared_gradient.iter().for_each(|&g| look(g));
        for block in &self.points {
            block.gradient.iter().for_each(|&g| look(g));
        }
        Linearization {
            cost: self.cost(parameters),
            gradient_max: if finite { gradient_max } else { f64::NAN },
            parameter_norm: self.problem.parameter_norm(parameters),
        }
    }

    fn solve(&mut self, damping: f64) -> Option<DampedStep> {
        let damping = damping.max(LEAST_DAMPING);
        self.invert_point_blocks(damping);
        self.reduce(damping);
        let size = self.right.len();
        if !cholesky::factorize(&mut self.reduced, size) {
            return None;
        }
        cholesky::solve(&self.reduced, size, &mut self.right);
        self.substitute_back();
        let (predicted_decrease, norm_sq) = self.measure(damping);
        Some(DampedStep {
            predicted_decrease,
            norm: norm_sq.sqrt(),
        })
    }

    fn step(&self, from: &B::Parameters, into: &mut B::Parameters) {
        self.problem.step(from, &self.delta, into);
    }

    fn cost(&mut self, parameters: &B::Parameters) -> f64 {
        let problem = self.problem;
        let loss = problem.loss();
        0.5 * sum(problem.observations().len(), |o| {
            let [u, v] = problem.residual(parameters, o);
            loss.rho(u * u + v * v)
        })
    }
}
