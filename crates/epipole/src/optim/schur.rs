//! Bundle adjustment's normal equations: points are eliminated, the cameras' reduced system is
//! solved densely.

mod elimination;
mod problem;

use super::cholesky;
use super::fixed::damping_scale;
use super::levenberg_marquardt::{DampedStep, Linearization, System};
use super::parallel::{for_each, sum};

pub use problem::{BundleProblem, BundleStep, ObservationTerms};

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
