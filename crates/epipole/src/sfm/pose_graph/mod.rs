//! Pose graphs: poses joined by measured relative poses, including loops.

mod any;
mod chordal;
mod information;
mod poses;
mod prior;

use crate::optim::{
    EdgeTerms, GraphProblem, GraphSystem, LmOptions, RobustLoss, Termination, minimize,
};
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};
use nalgebra::{SMatrix, SVector};

pub use any::PoseGraph;
pub use chordal::{RelativeRotation, average_rotations};
pub use poses::GraphPose;
pub use prior::PosePrior;

/// A measured relative pose between two vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge<T, const D: usize> {
    /// Index of the vertex where the edge starts.
    pub from: usize,
    /// Index of the vertex where the edge ends.
    pub to: usize,
    /// The pose of `to` in the frame of `from`.
    pub from_from_to: T,
    /// The inverse covariance Ω of the error: translation first, then rotation, then log scale.
    pub information: SMatrix<f64, D, D>,
}

/// Vertices and edges of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph<T, const D: usize> {
    /// Number of each vertex in its file.
    pub ids: Vec<u64>,
    /// `world_from_vertex` of each vertex.
    pub vertices: Vec<T>,
    /// The measurements.
    pub edges: Vec<Edge<T, D>>,
    /// Measurements of single vertices, such as from GPS.
    pub priors: Vec<PosePrior<T, D>>,
    /// Indices of fixed vertices. In a connected part of the graph without a fixed vertex or prior,
    /// the first vertex is fixed.
    pub fixed: Vec<usize>,
    /// Indices of the vertices that are points, such as landmarks: they have no rotation, and an
    /// edge to one measures only its position, with zero information for the rest.
    pub landmarks: Vec<usize>,
}

impl<T, const D: usize> Default for Graph<T, D> {
    fn default() -> Self {
        Self {
            ids: Vec::new(),
            vertices: Vec::new(),
            edges: Vec::new(),
            priors: Vec::new(),
            fixed: Vec::new(),
            landmarks: Vec::new(),
        }
    }
}

struct Problem<'a, T, const D: usize> {
    graph: &'a Graph<T, D>,
    pairs: Vec<(u32, u32)>,
    held: Vec<bool>,
    loss: RobustLoss,
}

impl<T: GraphPose<D>, const D: usize> GraphProblem<D> for Problem<'_, T, D> {
    type Parameters = Vec<T>;

    fn num_vertices(&self) -> usize {
        self.graph.vertices.len()
    }
    fn edges(&self) -> &[(u32, u32)] {
        &self.pairs
    }
    fn information(&self, edge: usize) -> &SMatrix<f64, D, D> {
        &self.graph.edges[edge].information
    }
    fn residual(&self, vertices: &Vec<T>, edge: usize) -> SVector<f64, D> {
        let edge = &self.graph.edges[edge];
        T::error(&vertices[edge.from], &vertices[edge.to], &edge.from_from_to)
    }
    fn linearize(&self, vertices: &Vec<T>, edge: usize) -> EdgeTerms<D> {
        let edge = &self.graph.edges[edge];
        T::linearize(&vertices[edge.from], &vertices[edge.to], &edge.from_from_to)
    }
    fn step(&self, from: &Vec<T>, step: &[SVector<f64, D>], into: &mut Vec<T>) {
        for (vertex, new) in into.iter_mut().enumerate() {
            *new = if self.held[vertex] {
                from[vertex]
            } else {
                from[vertex].plus(&step[vertex])
            };
        }
    }
    fn parameter_norm(&self, vertices: &Vec<T>) -> f64 {
        let sum: f64 = vertices.iter().map(|v| 1.0 + v.translation_sq()).sum();
        sum.sqrt()
    }
    fn loss(&self) -> RobustLoss {
        self.loss
    }
    fn is_held(&self, vertex: usize) -> bool {
        self.held[vertex]
    }
}

/// Report of the optimization of a pose graph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseGraphReport {
    /// `Σ eᵀ Ω e` at the start.
    pub initial_chi2: f64,
    /// `Σ eᵀ Ω e` at the end. It stays large where measurements contradict each other.
    pub final_chi2: f64,
    /// Steps tried.
    pub iterations: usize,
    /// Why the loop ended.
    pub termination: Termination,
    /// Number of connected parts; priors connect all parts that have one.
    pub num_components: usize,
}

impl<T: GraphPose<D>, const D: usize> Graph<T, D> {
    /// Returns `χ² = Σ eᵀ Ω e` over all edges and priors.
    pub fn chi2(&self) -> f64 {
        if let Some(joined) = self.with_world() {
            return joined.chi2();
        }
        let mut sum = 0.0;
        for edge in &self.edges {
            let (a, b) = (&self.vertices[edge.from], &self.vertices[edge.to]);
            let e = T::error(a, b, &edge.from_from_to);
            sum += e.dot(&(edge.information * e));
        }
        sum
    }

    /// Moves the vertices to minimize `Σ ρ(eᵀ Ω e)`, in place.
    ///
    /// The search starts with almost no damping and tolerates at least three steps in a row that
    /// raise the cost, whatever the options: damping would slow the correction of long, gradual
    /// bends.
    ///
    /// * `loss`: robust to wrong loop closures; width in standard deviations
    /// * `monitor`: notified before the first step and after each, in the only stage,
    ///   [`Stage::PoseGraph`]
    ///
    /// # Errors
    /// [`Error::TooFew`] without edges and priors, [`Error::OutOfRange`] if an edge joins missing
    /// vertices or a vertex with itself, for an information matrix that is asymmetric or has a
    /// negative eigenvalue, or for a loss that [`RobustLoss::check`] rejects, [`Error::NotFinite`]
    /// for NaN and infinities, [`Error::Canceled`]; the graph is then the best found so far.
    ///
    /// Source: Grisetti, Kümmerle, Stachniss & Burgard 2010, "A tutorial on graph-based SLAM".
    pub fn optimize(
        &mut self,
        options: &LmOptions,
        loss: RobustLoss,
        monitor: &mut dyn Monitor,
    ) -> Result<PoseGraphReport> {
        self.check(loss)?;
        if let Some(mut joined) = self.with_world() {
            let report = joined.optimize(options, loss, monitor);
            self.take_vertices(joined);
            return report;
        }
        let pairs: Vec<(u32, u32)> = self
            .edges
            .iter()
            .map(|edge| (edge.from as u32, edge.to as u32))
            .collect();
        let (held, num_components) = self.held();
        let mut vertices = self.vertices.clone();
        let problem = Problem {
            graph: self,
            pairs,
            held,
            loss,
        };
        let initial_chi2 = self.chi2();
        let mut system = GraphSystem::new(&problem);
        let options = LmOptions {
            initial_damping: options.initial_damping.min(1e-12),
            patience: options.patience.max(3),
            ..*options
        };
        let mut step = Part::new(monitor, 0.0, 1.0).of_stage(Stage::PoseGraph);
        let report = minimize(&mut system, &mut vertices, &options, &mut step);
        if matches!(report, Ok(_) | Err(Error::Canceled)) {
            self.vertices = vertices;
        }
        let report = report?;
        Ok(PoseGraphReport {
            initial_chi2,
            final_chi2: self.chi2(),
            iterations: report.iterations,
            termination: report.termination,
            num_components,
        })
    }

    fn check(&self, loss: RobustLoss) -> Result<()> {
        loss.check()?;
        if self.edges.is_empty() && self.priors.is_empty() {
            return Err(Error::TooFew {
                what: "the optimization of a pose graph from edges",
                needed: 1,
                got: 0,
            });
        }
        let count = self.vertices.len();
        for edge in &self.edges {
            if edge.from >= count || edge.to >= count || edge.from == edge.to {
                return Err(Error::OutOfRange {
                    what: "an end of an edge",
                    requirement: "the index of another vertex",
                    value: edge.to.max(edge.from) as f64,
                });
            }
            if !edge.from_from_to.is_finite() {
                return Err(Error::NotFinite {
                    what: "a measurement of a pose graph",
                });
            }
            information::check(&edge.information, &information::OF_EDGE)?;
        }
        for prior in &self.priors {
            if !prior.world_from_vertex.is_finite() {
                return Err(Error::NotFinite {
                    what: "a prior of a pose graph",
                });
            }
            information::check(&prior.information, &information::OF_PRIOR)?;
        }
        let of_priors: Vec<usize> = self.priors.iter().map(|prior| prior.vertex).collect();
        for (what, vertices) in [
            ("a fixed vertex", &self.fixed),
            ("a landmark", &self.landmarks),
            ("the vertex of a prior", &of_priors),
        ] {
            if let Some(&vertex) = vertices.iter().find(|&&vertex| vertex >= count) {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "the index of an existing vertex",
                    value: vertex as f64,
                });
            }
        }
        if !self.vertices.iter().all(GraphPose::is_finite) {
            return Err(Error::NotFinite {
                what: "a vertex of a pose graph",
            });
        }
        Ok(())
    }

    /// Returns whether each vertex is a point.
    fn is_landmark(&self) -> Vec<bool> {
        let mut is_landmark = vec![false; self.vertices.len()];
        for &vertex in &self.landmarks {
            is_landmark[vertex] = true;
        }
        is_landmark
    }

    /// Returns which vertices are held, and the number of connected parts.
    fn held(&self) -> (Vec<bool>, usize) {
        let mut parts = crate::math::UnionFind::new(self.vertices.len());
        for edge in &self.edges {
            parts.join(edge.from, edge.to);
        }
        let mut held = vec![false; self.vertices.len()];
        let mut anchored = vec![false; self.vertices.len()];
        for &vertex in &self.fixed {
            held[vertex] = true;
            anchored[parts.root(vertex)] = true;
        }
        let mut num_components = 0;
        let mut counted = vec![false; self.vertices.len()];
        // A landmark would fix the position of its part, but not the rotation.
        let is_landmark = self.is_landmark();
        let (landmarks, poses): (Vec<_>, Vec<_>) =
            (0..self.vertices.len()).partition(|&vertex| is_landmark[vertex]);
        for vertex in poses.into_iter().chain(landmarks) {
            let root = parts.root(vertex);
            if !anchored[root] {
                held[vertex] = true;
                anchored[root] = true;
            }
            if !counted[root] {
                counted[root] = true;
                num_components += 1;
            }
        }
        (held, num_components)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::{Isometry2, Isometry3, Similarity3};
    use nalgebra::{Vector2, Vector3};

    /// A circle of poses, each measured from the one before, and the last from the first.
    fn circle<T: GraphPose<D>, const D: usize>(
        count: usize,
        step: T,
        times: impl Fn(&T, &T) -> T,
        identity: T,
    ) -> Graph<T, D> {
        let mut graph = Graph {
            ids: (0..count as u64).collect(),
            vertices: vec![identity],
            edges: Vec::new(),
            ..Graph::default()
        };
        for i in 1..count {
            let next = times(&graph.vertices[i - 1], &step);
            graph.vertices.push(next);
        }
        for i in 0..count {
            graph.edges.push(Edge {
                from: i,
                to: (i + 1) % count,
                from_from_to: step,
                information: SMatrix::identity(),
            });
        }
        graph
    }

    #[test]
    fn a_loop_that_closes_is_straightened() {
        let angle_rad = std::f64::consts::TAU / 12.0;
        let step = Isometry3::new(
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(0.0, 0.0, angle_rad),
        );
        let mut graph = circle(12, step, |a, b| a * b, Isometry3::identity());
        let truth = graph.vertices.clone();
        let mut random = Random::new(42);
        for vertex in graph.vertices.iter_mut().skip(1) {
            *vertex = vertex.plus(&SVector::<f64, 6>::from_fn(|_, _| 0.1 * random.normal()));
        }
        let options = LmOptions {
            cost_tolerance: 0.0,
            ..LmOptions::default()
        };
        let report = graph
            .optimize(&options, RobustLoss::Trivial, &mut ())
            .unwrap();
        assert!(
            report.initial_chi2 > 0.1 && report.final_chi2 < 1e-18,
            "{report:?}"
        );
        assert_eq!(graph.vertices[0], truth[0]);
        for (got, want) in graph.vertices.iter().zip(&truth) {
            assert!((got.translation.vector - want.translation.vector).norm() < 1e-8);
        }
    }

    #[test]
    fn drift_of_scale_is_spread_over_the_loop() {
        // Every step seems 2 % longer than the one before, but the loop contradicts this.
        let angle_rad = std::f64::consts::TAU / 30.0;
        let true_step = Similarity3::new(
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(0.0, 0.0, angle_rad),
            1.0,
        );
        let drifting = Similarity3::new(
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(0.0, 0.0, angle_rad),
            1.02,
        );
        let mut graph = circle(30, drifting, |a, b| a * b, Similarity3::identity());
        let truth: Graph<_, 7> = circle(30, true_step, |a, b| a * b, Similarity3::identity());
        graph.edges[29].from_from_to = true_step;
        // The loop closure measures the scale of the last pose relative to the first.
        graph.edges[29].information *= 1e4;
        let error_of = |graph: &Graph<Similarity3<f64>, 7>| {
            let mut sum = 0.0;
            for (a, b) in graph.vertices.iter().zip(&truth.vertices) {
                sum += (a.isometry.translation.vector - b.isometry.translation.vector).norm();
            }
            sum / 30.0
        };
        let before = error_of(&graph);
        let report = graph
            .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
            .unwrap();
        let after = error_of(&graph);
        assert!(report.termination.is_converged(), "{report:?}");
        assert!(after < 0.5 * before, "{before} to {after}");
    }

    #[test]
    fn landmarks_are_places_of_points() {
        // A pose a step ahead; both see two points, whose initial values are wrong.
        let at = |x: f64, y: f64| Isometry2::new(Vector2::new(x, y), 0.0);
        let points = [at(2.0, 1.0), at(1.0, -2.0)];
        let truth = Isometry2::new(Vector2::new(1.0, 0.5), 0.4);
        let position = SMatrix::<f64, 3, 3>::from_diagonal(&SVector::from([4.0, 4.0, 0.0]));
        let measure = |from: usize, pose: &Isometry2<f64>, to: usize| Edge {
            from,
            to,
            from_from_to: Isometry2::from_parts(
                (pose.inv_mul(&points[to])).translation,
                nalgebra::UnitComplex::identity(),
            ),
            information: position,
        };
        let identity = Isometry2::identity();
        let mut graph = Graph {
            ids: vec![7, 8, 0, 1],
            vertices: vec![at(9.0, 9.0), at(-3.0, 0.0), identity, at(0.2, 0.1)],
            edges: vec![
                measure(2, &identity, 0),
                measure(2, &identity, 1),
                measure(3, &truth, 0),
                measure(3, &truth, 1),
            ],
            landmarks: vec![0, 1],
            ..Graph::default()
        };
        graph.edges.push(Edge {
            from: 2,
            to: 3,
            from_from_to: truth,
            information: SMatrix::identity(),
        });
        let options = LmOptions::default();
        for starts_from_edges in [false, true] {
            let mut graph = graph.clone();
            if starts_from_edges {
                graph.initialize(&mut ()).unwrap();
                assert!(graph.chi2() < 1e-20, "{}", graph.chi2());
            }
            let report = (graph.optimize(&options, RobustLoss::Trivial, &mut ())).unwrap();
            assert_eq!(report.num_components, 1);
            assert!(report.final_chi2 < 1e-12, "{report:?}");
            // The first pose is fixed, not the first vertex.
            assert_eq!(graph.vertices[2], identity);
            for (found, point) in graph.vertices.iter().zip(&points) {
                assert!((found.translation.vector - point.translation.vector).norm() < 1e-6);
                assert_eq!(found.rotation.angle(), 0.0);
            }
            assert!((graph.vertices[3].rotation.angle() - 0.4).abs() < 1e-6);
        }
        graph.landmarks.push(4);
        assert!(graph.initialize(&mut ()).is_err());
    }

    #[test]
    fn contradictory_loops_still_give_a_report() {
        let step = Isometry2::new(Vector2::new(1.0, 0.0), 0.0);
        let mut graph = circle(4, step, |a, b| a * b, Isometry2::identity());
        // The last edge measures the fourth pose at the start.
        let report = graph
            .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
            .unwrap();
        // Each edge bears a quarter of the gap of 4: χ² = 4 · 1².
        assert!((report.initial_chi2 - 16.0).abs() < 1e-12);
        assert!((report.final_chi2 - 4.0).abs() < 1e-6, "{report:?}");
        assert!(report.termination.is_converged());
    }

    #[test]
    fn a_robust_loss_survives_a_wrong_loop() {
        let angle_rad = std::f64::consts::TAU / 12.0;
        let step = Isometry2::new(Vector2::new(1.0, 0.0), angle_rad);
        let mut graph = circle(12, step, |a, b| a * b, Isometry2::identity());
        let truth = graph.vertices.clone();
        graph.edges.push(Edge {
            from: 2,
            to: 9,
            from_from_to: Isometry2::new(Vector2::new(9.0, 9.0), 1.0),
            information: SMatrix::identity(),
        });
        let loss = RobustLoss::Cauchy { width: 0.1 };
        graph
            .optimize(&LmOptions::default(), loss, &mut ())
            .unwrap();
        for (got, want) in graph.vertices.iter().zip(&truth) {
            assert!((got.translation.vector - want.translation.vector).norm() < 0.02);
        }
    }

    #[test]
    fn separate_parts_are_counted_and_anchored() {
        let step = Isometry2::new(Vector2::new(1.0, 0.0), 0.1);
        let mut graph = circle(5, step, |a, b| a * b, Isometry2::identity());
        let other = circle(
            4,
            step,
            |a, b| a * b,
            Isometry2::new(Vector2::new(50.0, 0.0), 0.3),
        );
        for edge in &other.edges {
            graph.edges.push(Edge {
                from: edge.from + 5,
                to: edge.to + 5,
                ..edge.clone()
            });
        }
        graph.vertices.extend(&other.vertices);
        graph.vertices.push(Isometry2::identity());
        let report = graph
            .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
            .unwrap();
        assert_eq!(report.num_components, 3);
        assert_eq!(graph.vertices[5], other.vertices[0]);
        assert!(report.final_chi2 <= report.initial_chi2);
    }

    #[test]
    fn bad_graphs_are_refused() {
        let step = Isometry2::new(Vector2::new(1.0, 0.0), 0.1);
        let good = circle(5, step, |a, b| a * b, Isometry2::identity());
        let attempt = |graph: &Graph<_, 3>| {
            graph
                .clone()
                .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
        };
        assert!(attempt(&good).is_ok());
        let mut bad = good.clone();
        bad.edges[1].to = 9;
        assert!(matches!(attempt(&bad), Err(Error::OutOfRange { .. })));
        let mut bad = good.clone();
        bad.edges[1].information[(0, 0)] = f64::NAN;
        assert!(matches!(attempt(&bad), Err(Error::NotFinite { .. })));
        let mut bad = good.clone();
        bad.edges.clear();
        assert!(matches!(attempt(&bad), Err(Error::TooFew { .. })));
    }
}
