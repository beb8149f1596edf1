//! Pose graph of a kind that is known only at run time.

use super::{Graph, PoseGraphReport};
use crate::Result;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use nalgebra::{Isometry2, Isometry3, Similarity3};

/// Pose graph of any kind, as read from a file.
#[derive(Debug, Clone, PartialEq)]
pub enum PoseGraph {
    /// Poses in the plane.
    Se2(Graph<Isometry2<f64>, 3>),
    /// Poses in space.
    Se3(Graph<Isometry3<f64>, 6>),
    /// Poses in space with a scale each, for trajectories whose scale drifts.
    Sim3(Graph<Similarity3<f64>, 7>),
}

impl PoseGraph {
    /// Returns `χ² = Σ eᵀ Ω e` over all edges and priors.
    pub fn chi2(&self) -> f64 {
        match self {
            PoseGraph::Se2(graph) => graph.chi2(),
            PoseGraph::Se3(graph) => graph.chi2(),
            PoseGraph::Sim3(graph) => graph.chi2(),
        }
    }

    /// Initializes the vertices from the measurements alone: see [`Graph::initialize`].
    ///
    /// # Errors
    /// As [`Graph::initialize`].
    pub fn initialize(&mut self, monitor: &mut dyn Monitor) -> Result<()> {
        match self {
            PoseGraph::Se2(graph) => graph.initialize(monitor),
            PoseGraph::Se3(graph) => graph.initialize(monitor),
            PoseGraph::Sim3(graph) => graph.initialize(monitor),
        }
    }

    /// Moves the vertices to minimize `Σ ρ(eᵀ Ω e)`: see [`Graph::optimize`].
    ///
    /// # Errors
    /// As [`Graph::optimize`].
    pub fn optimize(
        &mut self,
        options: &LmOptions,
        loss: RobustLoss,
        monitor: &mut dyn Monitor,
    ) -> Result<PoseGraphReport> {
        match self {
            PoseGraph::Se2(graph) => graph.optimize(options, loss, monitor),
            PoseGraph::Se3(graph) => graph.optimize(options, loss, monitor),
            PoseGraph::Sim3(graph) => graph.optimize(options, loss, monitor),
        }
    }

    /// Returns the number of priors.
    pub fn num_priors(&self) -> usize {
        match self {
            PoseGraph::Se2(graph) => graph.priors.len(),
            PoseGraph::Se3(graph) => graph.priors.len(),
            PoseGraph::Sim3(graph) => graph.priors.len(),
        }
    }

    /// Returns the number of landmarks among the vertices.
    pub fn num_landmarks(&self) -> usize {
        match self {
            PoseGraph::Se2(graph) => graph.landmarks.len(),
            PoseGraph::Se3(graph) => graph.landmarks.len(),
            PoseGraph::Sim3(graph) => graph.landmarks.len(),
        }
    }

    /// Returns the numbers of vertices, of landmarks among them, and of edges.
    pub fn size(&self) -> (usize, usize) {
        match self {
            PoseGraph::Se2(graph) => (graph.vertices.len(), graph.edges.len()),
            PoseGraph::Se3(graph) => (graph.vertices.len(), graph.edges.len()),
            PoseGraph::Sim3(graph) => (graph.vertices.len(), graph.edges.len()),
        }
    }
}
