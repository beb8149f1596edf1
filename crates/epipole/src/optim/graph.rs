//! Problems on a graph, where each residual joins two vertices.

use super::fixed::damping_scale;
use super::levenberg_marquardt::{DampedStep, Linearization, System};
use super::loss::RobustLoss;
use super::sparse::BlockCholesky;
use crate::math::parallel::{for_each, sum};
use nalgebra::{SMatrix, SVector};

/// A linearized edge: the residual of `D` components and its Jacobians by the vertices at its two
/// ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeTerms<const D: usize> {
    /// e.
    pub residual: SVector<f64, D>,
    /// ∂e/∂δ for the start vertex.
    pub from: SMatrix<f64, D, D>,
    /// ∂e/∂δ for the end vertex.
    pub to: SMatrix<f64, D, D>,
}

/// A least-squares problem `½ Σ ρ(eᵀ Ω e)` over the edges of a graph whose vertices have `D`
/// degrees of freedom each.
pub(crate) trait GraphProblem<const D: usize>: Sync {
    /// All vertices.
    type Parameters: Clone + Sync;

    /// Returns the number of vertices.
    fn num_vertices(&self) -> usize;
    /// Returns the vertices that each edge joins; both must be in range and differ.
    fn edges(&self) -> &[(u32, u32)];
    /// Returns Ω of an edge, symmetric and positive semi-definite.
    fn information(&self, edge: usize) -> &SMatrix<f64, D, D>;
    /// Returns the residual of an edge.
    fn residual(&self, parameters: &Self::Parameters, edge: usize) -> SVector<f64, D>;
    /// Returns the residual of an edge with its Jacobians.
    fn linearize(&self, parameters: &Self::Parameters, edge: usize) -> EdgeTerms<D>;
    /// Writes `from ⊞ step`, with one step per vertex.
    fn step(&self, from: &Self::Parameters, step: &[SVector<f64, D>], into: &mut Self::Parameters);
    /// Returns the length of the parameters, for the relative step test.
    fn parameter_norm(&self, parameters: &Self::Parameters) -> f64;
    /// Returns the loss of every edge, applied to `eᵀ Ω e`.
    fn loss(&self) -> RobustLoss {
        RobustLoss::Trivial
    }
    /// Returns whether a vertex is held fixed.
    fn is_held(&self, vertex: usize) -> bool;
}

/// Minimum damping: less changes no bit of a well-conditioned matrix.
const LEAST_DAMPING: f64 = 1e-15;

/// The [`System`] of a [`GraphProblem`]: sparse Cholesky in minimum-degree order.
pub(crate) struct GraphSystem<'a, const D: usize, G: GraphProblem<D>> {
    problem: &'a G,
    terms: Vec<EdgeTerms<D>>,
    gradient: Vec<SVector<f64, D>>,
    diagonal: Vec<SMatrix<f64, D, D>>,
    crossed: Vec<SMatrix<f64, D, D>>,
    factor: BlockCholesky<D>,
    delta: Vec<SVector<f64, D>>,
}

impl<'a, const D: usize, G: GraphProblem<D>> GraphSystem<'a, D, G> {
    /// Computes the elimination order and allocates all blocks.
    pub(crate) fn new(problem: &'a G) -> Self {
        let (num_vertices, edges) = (problem.num_vertices(), problem.edges());
        let terms = EdgeTerms {
            residual: SVector::zeros(),
            from: SMatrix::zeros(),
            to: SMatrix::zeros(),
        };
        Self {
            problem,
            terms: vec![terms; edges.len()],
            gradient: vec![SVector::zeros(); num_vertices],
            diagonal: vec![SMatrix::zeros(); num_vertices],
            crossed: vec![SMatrix::zeros(); edges.len()],
            factor: BlockCholesky::new(num_vertices, edges),
            delta: vec![SVector::zeros(); num_vertices],
        }
    }
}

impl<const D: usize, G: GraphProblem<D>> System for GraphSystem<'_, D, G> {
    type Parameters = G::Parameters;

    fn linearize(&mut self, parameters: &G::Parameters) -> Linearization {
        let problem = self.problem;
        for_each(&mut self.terms, |edge, terms| {
            *terms = problem.linearize(parameters, edge);
        });
        self.gradient.fill(SVector::zeros());
        self.diagonal.fill(SMatrix::zeros());
        let loss = problem.loss();
        for (edge, &(a, b)) in problem.edges().iter().enumerate() {
            let (a, b) = (a as usize, b as usize);
            let terms = &self.terms[edge];
            let information = problem.information(edge);
            let squared = terms.residual.dot(&(information * terms.residual));
            let weighted = information * loss.weight(squared);
            let from = terms.from.tr_mul(&weighted);
            let to = terms.to.tr_mul(&weighted);
            let free = (!problem.is_held(a), !problem.is_held(b));
            if free.0 {
                self.gradient[a] += from * terms.residual;
                self.diagonal[a] += from * terms.from;
            }
            if free.1 {
                self.gradient[b] += to * terms.residual;
                self.diagonal[b] += to * terms.to;
            }
            self.crossed[edge] = if free.0 && free.1 {
                from * terms.to
            } else {
                SMatrix::zeros()
            };
        }
        let mut gradient_max: f64 = 0.0;
        for g in self.gradient.iter().flat_map(|g| g.iter()) {
            if !g.is_finite() {
                gradient_max = f64::NAN;
                break;
            }
            gradient_max = gradient_max.max(g.abs());
        }
        Linearization {
            cost: self.cost(parameters),
            gradient_max,
            parameter_norm: problem.parameter_norm(parameters),
        }
    }

    fn solve(&mut self, damping: f64) -> Option<DampedStep> {
        let damping = damping.max(LEAST_DAMPING);
        self.factor.clear();
        for (vertex, block) in self.diagonal.iter().enumerate() {
            let mut damped = *block;
            for i in 0..D {
                // A held vertex, or one without edges, does not move.
                damped[(i, i)] = if block[(i, i)] > 0.0 {
                    block[(i, i)] + damping * damping_scale(block[(i, i)])
                } else {
                    1.0
                };
            }
            self.factor.add_diagonal(vertex, &damped);
        }
        for (&(a, b), block) in self.problem.edges().iter().zip(&self.crossed) {
            self.factor.add(a as usize, b as usize, block);
        }
        if !self.factor.factorize() {
            return None;
        }
        for (delta, gradient) in self.delta.iter_mut().zip(&self.gradient) {
            *delta = -gradient;
        }
        self.factor.solve(&mut self.delta);
        let (mut predicted, mut norm_sq) = (0.0, 0.0);
        for ((delta, gradient), block) in self.delta.iter().zip(&self.gradient).zip(&self.diagonal)
        {
            for i in 0..D {
                if block[(i, i)] > 0.0 {
                    let scale = damping * damping_scale(block[(i, i)]);
                    predicted += delta[i] * (scale * delta[i] - gradient[i]);
                }
                norm_sq += delta[i] * delta[i];
            }
        }
        Some(DampedStep {
            predicted_decrease: 0.5 * predicted,
            norm: norm_sq.sqrt(),
        })
    }

    fn step(&self, from: &G::Parameters, into: &mut G::Parameters) {
        self.problem.step(from, &self.delta, into);
    }

    fn cost(&mut self, parameters: &G::Parameters) -> f64 {
        let problem = self.problem;
        let loss = problem.loss();
        0.5 * sum(problem.edges().len(), |edge| {
            let e = problem.residual(parameters, edge);
            loss.rho(e.dot(&(problem.information(edge) * e)))
        })
    }
}
