//! Priors of single poses, as edges from a vertex for the world.

use super::{Edge, Graph, GraphPose};
use nalgebra::{SMatrix, Similarity3};

/// A measured pose of one vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct PosePrior<T, const D: usize> {
    /// Index of the vertex.
    pub vertex: usize,
    /// The measured pose.
    pub world_from_vertex: T,
    /// The inverse covariance Ω of the error, in the order of [`Edge::information`]. Zero for
    /// unmeasured components, such as the rotation in a GPS position.
    pub information: SMatrix<f64, D, D>,
}

impl<T: GraphPose<D>, const D: usize> Graph<T, D> {
    /// Returns the same problem without priors: each becomes an edge from an additional vertex,
    /// fixed at the identity. `None` without priors.
    pub(super) fn with_world(&self) -> Option<Self> {
        if self.priors.is_empty() {
            return None;
        }
        let world = self.vertices.len();
        let mut joined = self.clone();
        joined
            .ids
            .push(self.ids.iter().max().map_or(0, |id| id.wrapping_add(1)));
        joined
            .vertices
            .push(T::from_similarity(&Similarity3::identity()));
        joined.fixed.push(world);
        for prior in joined.priors.drain(..) {
            joined.edges.push(Edge {
                from: world,
                to: prior.vertex,
                from_from_to: prior.world_from_vertex,
                information: prior.information,
            });
        }
        Some(joined)
    }

    /// Copies the poses back from [`with_world`](Self::with_world).
    pub(super) fn take_vertices(&mut self, mut joined: Self) {
        joined.vertices.truncate(self.vertices.len());
        self.vertices = joined.vertices;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optim::{LmOptions, RobustLoss};
    use nalgebra::{Isometry2, Matrix3, Vector2, Vector3};

    fn at(x: f64, y: f64, yaw_rad: f64) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(x, y), yaw_rad)
    }

    /// Three poses in a row, measured 1 apart.
    fn row() -> Graph<Isometry2<f64>, 3> {
        let step = |from| Edge {
            from,
            to: from + 1,
            from_from_to: at(1.0, 0.0, 0.0),
            information: Matrix3::identity(),
        };
        Graph {
            ids: vec![0, 1, 2],
            vertices: vec![at(0.3, 0.2, 0.1), at(1.0, 0.4, -0.2), at(2.0, 0.0, 0.0)],
            edges: vec![step(0), step(1)],
            ..Graph::default()
        }
    }

    fn solve(mut graph: Graph<Isometry2<f64>, 3>) -> Graph<Isometry2<f64>, 3> {
        let options = LmOptions::default();
        graph
            .optimize(&options, RobustLoss::Trivial, &mut ())
            .unwrap();
        graph
    }

    #[test]
    fn a_prior_moves_the_whole_part() {
        let mut graph = row();
        let angle_rad = core::f64::consts::FRAC_PI_2;
        graph.priors.push(PosePrior {
            vertex: 1,
            world_from_vertex: at(5.0, 6.0, angle_rad),
            information: Matrix3::identity(),
        });
        for graph in [solve(graph.clone()), {
            graph.initialize(&mut ()).unwrap();
            graph
        }] {
            assert!(graph.chi2() < 1e-12, "{}", graph.chi2());
            assert_eq!((graph.vertices.len(), graph.priors.len()), (3, 1));
            let expected = [
                at(5.0, 5.0, angle_rad),
                at(5.0, 6.0, angle_rad),
                at(5.0, 7.0, angle_rad),
            ];
            for (found, expected) in graph.vertices.iter().zip(&expected) {
                let off = found.inv_mul(expected);
                assert!(off.translation.vector.norm() + off.rotation.angle().abs() < 1e-6);
            }
        }
    }

    #[test]
    fn positions_alone_rotate_the_row() {
        // Two positions 2.2 apart of poses measured 2 apart: with equal weights each of the four
        // errors is 0.05 along the row, and 0.1 at both ends of the positions balances it.
        let mut graph = row();
        let position = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
        for (vertex, y) in [(0, 10.0), (2, 12.2)] {
            graph.priors.push(PosePrior {
                vertex,
                world_from_vertex: at(4.0, y, 0.0),
                information: position,
            });
        }
        let graph = solve(graph);
        assert!(
            (graph.chi2() - 4.0 * 0.05 * 0.05).abs() < 1e-9,
            "{}",
            graph.chi2()
        );
        let middle = graph.vertices[1];
        assert!((middle.translation.vector - Vector2::new(4.0, 11.1)).norm() < 1e-6);
        assert!((middle.rotation.angle() - core::f64::consts::FRAC_PI_2).abs() < 1e-6);
    }

    #[test]
    fn one_position_leaves_the_rotation_and_fits() {
        let mut graph = row();
        graph.priors.push(PosePrior {
            vertex: 2,
            world_from_vertex: at(-3.0, 4.0, 0.0),
            information: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)),
        });
        let graph = solve(graph);
        assert!(graph.chi2() < 1e-12, "{}", graph.chi2());
        let place = graph.vertices[2].translation.vector;
        assert!((place - Vector2::new(-3.0, 4.0)).norm() < 1e-6);
    }

    #[test]
    fn a_prior_of_a_missing_vertex_is_refused() {
        let mut graph = row();
        graph.priors.push(PosePrior {
            vertex: 9,
            world_from_vertex: at(0.0, 0.0, 0.0),
            information: Matrix3::identity(),
        });
        let before = graph.vertices.clone();
        let options = LmOptions::default();
        assert!(
            graph
                .optimize(&options, RobustLoss::Trivial, &mut ())
                .is_err()
        );
        assert_eq!(graph.vertices, before);
    }
}
