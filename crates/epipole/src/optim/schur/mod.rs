//! Normal equations of bundle adjustment: points are eliminated, the cameras' reduced system is
//! solved densely.

mod elimination;
mod problem;

use super::cholesky;
use super::fixed::damping_scale;
use super::levenberg_marquardt::{DampedStep, Linearization, System};
use crate::math::parallel::{for_each, sum};

pub(crate) use problem::{BundleProblem, BundleStep, ObservationTerms, PriorTerms};

#[derive(Clone)]
struct CameraBlock<const C: usize, const S: usize> {
    /// Lower triangle of `Σ JcᵀJc`.
    hessian: [[f64; C]; C],
    /// Coupling with every group.
    with_shared: Vec<[[f64; C]; S]>,
    gradient: [f64; C],
    /// This camera's rows of the reduced system, up to and including its diagonal block.
    rows: Vec<f64>,
    reduced_with_shared: Vec<[[f64; C]; S]>,
    reduced_gradient: [f64; C],
}

/// A point and a group that sees it.
#[derive(Clone)]
struct GroupOfPoint<const S: usize> {
    group: u32,
    /// `JpᵀJs`.
    with_point: [[f64; S]; 3],
    /// `V⁻¹ JpᵀJs`.
    solved: [[f64; S]; 3],
    hessian: [[f64; S]; S],
    gradient: [f64; S],
}

#[derive(Clone)]
struct PointBlock<const S: usize> {
    hessian: [[f64; 3]; 3],
    gradient: [f64; 3],
    inverse: [[f64; 3]; 3],
    /// `V⁻¹` times the gradient.
    solved_gradient: [f64; 3],
    /// Groups that see the point, in order of appearance.
    groups: Vec<GroupOfPoint<S>>,
}

/// Sums over the observations of a group by its shared parameters.
#[derive(Clone)]
struct GroupBlock<const S: usize> {
    hessian: [[f64; S]; S],
    gradient: [f64; S],
}

/// Blocks of an observation, including √ρ'.
#[derive(Clone)]
struct Coupling<const C: usize, const S: usize> {
    camera: u32,
    point: u32,
    /// Index among the groups of its point, if there are any.
    group_of_point: u32,
    terms: ObservationTerms<C, S>,
    /// `JpᵀJc`.
    cross: [[f64; C]; 3],
    /// `V⁻¹ JpᵀJc`.
    solved: [[f64; C]; 3],
}

/// Minimum damping: without a gauge the reduced system of the cameras is singular.
const LEAST_DAMPING: f64 = 1e-12;

/// The [`System`] of a [`BundleProblem`].
///
/// With the damped blocks U (cameras), V (points, 3×3 each) and the coupling W, the cameras' steps
/// solve `(U − W V⁻¹ Wᵀ) δc = −(gc − W V⁻¹ gp)`; then `δp = −V⁻¹ (gp + Wᵀ δc)`. The shared
/// parameters of groups follow the cameras in this system.
///
/// Cameras and points without observations do not move.
///
/// Source: Triggs et al. 2000, "Bundle adjustment — a modern synthesis", §6.1.
pub(crate) struct SchurSystem<'a, const C: usize, const S: usize, B: BundleProblem<C, S>> {
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
    groups: Vec<GroupBlock<S>>,
    /// Number of shared parameters that are free; the rest are fixed.
    width: usize,
    reduced: Vec<f64>,
    right: Vec<f64>,
    delta: BundleStep<C, S>,
}

impl<'a, const C: usize, const S: usize, B: BundleProblem<C, S>> SchurSystem<'a, C, S, B> {
    /// Sorts the observations and allocates all blocks.
    pub(crate) fn new(problem: &'a B) -> Self {
        let (num_cameras, num_points) = (problem.num_cameras(), problem.num_points());
        let num_groups = problem.num_groups();
        let observations = problem.observations();
        let mut point_starts = vec![0; num_points + 1];
        for &(_, point) in observations {
            point_starts[point as usize + 1] += 1;
        }
        for p in 0..num_points {
            point_starts[p + 1] += point_starts[p];
        }
        // Observations by point, in their original order for each point.
        let mut order = vec![0; observations.len()];
        let mut next = point_starts.clone();
        for (o, &(_, point)) in observations.iter().enumerate() {
            let place = &mut next[point as usize];
            order[*place] = o as u32;
            *place += 1;
        }
        let mut camera_couplings = vec![Vec::new(); num_cameras];
        let point = PointBlock {
            hessian: [[0.0; 3]; 3],
            gradient: [0.0; 3],
            inverse: [[0.0; 3]; 3],
            solved_gradient: [0.0; 3],
            groups: Vec::new(),
        };
        let mut points: Vec<PointBlock<S>> = vec![point; num_points];
        let couplings = order
            .iter()
            .enumerate()
            .map(|(position, &o)| {
                let (camera, point) = observations[o as usize];
                camera_couplings[camera as usize].push(position as u32);
                let group_of_point = match num_groups {
                    0 => 0,
                    _ => place_of(
                        problem.group(o as usize) as u32,
                        &mut points[point as usize].groups,
                    ),
                };
                Coupling {
                    camera,
                    point,
                    group_of_point: group_of_point as u32,
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
                with_shared: vec![[[0.0; C]; S]; num_groups],
                gradient: [0.0; C],
                rows: vec![0.0; C * C * (camera + 1)],
                reduced_with_shared: vec![[[0.0; C]; S]; num_groups],
                reduced_gradient: [0.0; C],
            })
            .collect();
        let held_shared = problem.held_shared();
        let width = S - held_shared.iter().rev().take_while(|held| **held).count();
        let size = num_cameras * C + num_groups * width;
        Self {
            problem,
            order,
            couplings,
            point_starts,
            camera_couplings,
            cameras,
            points,
            groups: vec![GroupBlock::nothing(); num_groups],
            width,
            reduced: vec![0.0; size * size],
            right: vec![0.0; size],
            delta: BundleStep {
                cameras: vec![[0.0; C]; num_cameras],
                shared: vec![[0.0; S]; num_groups],
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
        let (couplings, starts, width) = (&self.couplings, &self.point_starts, self.width);
        for_each(&mut self.points, |p, block| {
            block.hessian = [[0.0; 3]; 3];
            block.gradient = [0.0; 3];
            for group in &mut block.groups {
                *group = GroupOfPoint::nothing(group.group);
            }
            for coupling in &couplings[starts[p]..starts[p + 1]] {
                let terms = &coupling.terms;
                for row in 0..2 {
                    let point = &terms.point[row];
                    for i in 0..3 {
                        block.gradient[i] += point[i] * terms.residual[row];
                        for j in 0..3 {
                            block.hessian[i][j] += point[i] * point[j];
                        }
                    }
                    if let Some(group) = block.groups.get_mut(coupling.group_of_point as usize) {
                        let shared = &terms.shared[row][..width];
                        group.add(point, shared, terms.residual[row]);
                    }
                }
            }
        });
        self.groups.fill(GroupBlock::nothing());
        for group in self.points.iter().flat_map(|point| &point.groups) {
            let block = &mut self.groups[group.group as usize];
            for s in 0..width {
                block.gradient[s] += group.gradient[s];
                for q in 0..width {
                    block.hessian[s][q] += group.hessian[s][q];
                }
            }
        }
    }

    fn sum_camera_blocks(&mut self, parameters: &B::Parameters) {
        let (couplings, of_camera) = (&self.couplings, &self.camera_couplings);
        let (points, problem, width) = (&self.points, self.problem, self.width);
        for_each(&mut self.cameras, |c, block| {
            block.hessian = [[0.0; C]; C];
            block.with_shared.fill([[0.0; C]; S]);
            block.gradient = [0.0; C];
            for &position in &of_camera[c] {
                let coupling = &couplings[position as usize];
                let terms = &coupling.terms;
                let groups = &points[coupling.point as usize].groups;
                for row in 0..2 {
                    block.add(&terms.camera[row], terms.residual[row]);
                    if let Some(group) = groups.get(coupling.group_of_point as usize) {
                        let with_shared = &mut block.with_shared[group.group as usize];
                        for s in 0..width {
                            for i in 0..C {
                                with_shared[s][i] += terms.shared[row][s] * terms.camera[row][i];
                            }
                        }
                    }
                }
            }
            let Some(prior) = problem.prior(parameters, c) else {
                return;
            };
            let root = problem.prior_loss().weight(sum_sq(&prior.residual)).sqrt();
            let held = problem.held_camera(c);
            for row in 0..3 {
                let camera = core::array::from_fn(|i| match held[i] {
                    true => 0.0,
                    false => prior.camera[row][i] * root,
                });
                block.add(&camera, prior.residual[row] * root);
            }
        });
    }

    /// Returns the variances of the free shared parameters of all groups, in order, for residuals
    /// of variance 1; after a successful [`solve`](System::solve).
    pub(crate) fn shared_variances(&self) -> Vec<f64> {
        let size = self.right.len();
        let start = self.cameras.len() * C;
        // Shared parameters are last, so `(L₂₂ L₂₂ᵀ)⁻¹` is their block of the inverse.
        let column = |of: usize| {
            let mut solved = vec![0.0; size - start];
            for row in of..size {
                let mut value = f64::from(u8::from(row == of));
                for k in of..row {
                    value -= self.reduced[row * size + k] * solved[k - start];
                }
                solved[row - start] = value / self.reduced[row * size + row];
            }
            solved.iter().map(|x| x * x).sum()
        };
        (start..size).map(column).collect()
    }

    /// Returns the predicted decrease and the squared length of the step.
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
        for (delta, block) in self.delta.shared.iter().zip(&self.groups) {
            for s in 0..self.width {
                add(delta[s], block.gradient[s], block.hessian[s][s]);
            }
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
        self.sum_camera_blocks(parameters);
        let mut gradient_max: f64 = 0.0;
        let mut finite = true;
        let mut look = |g: f64| {
            finite &= g.is_finite();
            gradient_max = gradient_max.max(g.abs());
        };
        for block in &self.cameras {
            block.gradient.iter().for_each(|&g| look(g));
        }
        for block in &self.groups {
            block.gradient.iter().for_each(|&g| look(g));
        }
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
        let sum_of = sum(problem.observations().len(), |o| {
            let [u, v] = problem.residual(parameters, o);
            loss.rho(u * u + v * v)
        });
        let prior_loss = problem.prior_loss();
        let known: f64 = (0..problem.num_cameras())
            .filter_map(|camera| problem.prior(parameters, camera))
            .map(|prior| prior_loss.rho(sum_sq(&prior.residual)))
            .sum();
        0.5 * (sum_of + known)
    }
}

impl<const C: usize, const S: usize> CameraBlock<C, S> {
    /// Adds a row of a Jacobian with its residual.
    #[inline]
    fn add(&mut self, camera: &[f64; C], residual: f64) {
        for i in 0..C {
            self.gradient[i] += camera[i] * residual;
            for j in 0..C {
                self.hessian[i][j] += camera[i] * camera[j];
            }
        }
    }
}

impl<const S: usize> GroupOfPoint<S> {
    fn nothing(group: u32) -> Self {
        Self {
            group,
            with_point: [[0.0; S]; 3],
            solved: [[0.0; S]; 3],
            hessian: [[0.0; S]; S],
            gradient: [0.0; S],
        }
    }

    /// Adds a row of both Jacobians with its residual.
    #[inline]
    fn add(&mut self, point: &[f64; 3], shared: &[f64], residual: f64) {
        for i in 0..3 {
            for (sum, by) in self.with_point[i].iter_mut().zip(shared) {
                *sum += point[i] * by;
            }
        }
        for (s, by) in shared.iter().enumerate() {
            self.gradient[s] += by * residual;
            for (sum, other) in self.hessian[s].iter_mut().zip(shared) {
                *sum += by * other;
            }
        }
    }
}

impl<const S: usize> GroupBlock<S> {
    fn nothing() -> Self {
        Self {
            hessian: [[0.0; S]; S],
            gradient: [0.0; S],
        }
    }
}

/// Returns the index of a group among those of a point; adds new groups.
fn place_of<const S: usize>(group: u32, groups: &mut Vec<GroupOfPoint<S>>) -> usize {
    let place = groups.iter().position(|known| known.group == group);
    place.unwrap_or_else(|| {
        groups.push(GroupOfPoint::nothing(group));
        groups.len() - 1
    })
}

fn sum_sq(residual: &[f64; 3]) -> f64 {
    residual.iter().map(|x| x * x).sum()
}
