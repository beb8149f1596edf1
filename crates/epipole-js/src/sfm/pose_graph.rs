//! Pose graphs, and rotations of views from those between pairs.

use crate::argument::{Argument, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::{NoOptions, Options, Setting};
use crate::output::{Numbers, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::RigidTransform;
use epipole::nalgebra::SMatrix;
use epipole::optim::{LmOptions, RobustLoss, Termination};
use epipole::sfm::{self, Edge, Graph, PoseGraphReport, RelativeRotation};

structs! {
    /// Pose graph after its optimization.
    struct OptimizedGraph as OptimizedGraph {
        /// Poses of the vertices.
        world_from_vertex: Vec<RigidTransform>,
        /// Report of the optimization.
        report: PoseGraphReport,
    }

    /// Rotations of views that agree best with those between pairs of them.
    struct AveragedRotations as AveragedRotations {
        /// Rotation of each view, with a translation of 0. The first view of each connected part
        /// has the identity.
        view_from_world: Vec<RigidTransform>,
        /// Angle by which each measurement is off, radians.
        errors_rad: Numbers,
    }
}

records! {
    /// Report of the optimization of a pose graph.
    PoseGraphReport as PoseGraphReport {
        /// Sum of squared errors in standard deviations at the start.
        initial_chi2: f64,
        /// The same at the end; large where measurements contradict each other.
        final_chi2: f64,
        /// Number of steps tried.
        iterations: usize,
        /// Reason for the end of the loop.
        termination: Termination,
        /// Number of connected parts, each with a vertex that stays where it is.
        num_components: usize,
    }
}

/// Measured pose of a vertex in the frame of another.
struct Measured(Edge<RigidTransform, 6>);

impl Argument for Measured {
    fn typescript(types: &mut Types) -> String {
        let transform = <RigidTransform as Argument>::typescript(types);
        let matrix = <SMatrix<f64, 6, 6> as Argument>::typescript(types);
        types.interface(
            "PoseGraphEdge",
            "Measured pose of a vertex in the frame of another.",
            &[
                (
                    "from",
                    "number",
                    "Index of the vertex where the edge starts.",
                ),
                ("to", "number", "Index of the vertex where the edge ends."),
                (
                    "fromFromTo",
                    &transform,
                    "Pose of `to` in the frame of `from`.",
                ),
                (
                    "information?",
                    &matrix,
                    "Inverse covariance, 6 x 6, translation first. The identity if not given.",
                ),
            ],
        );
        "PoseGraphEdge".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["from", "to", "fromFromTo", "information"])?;
        let information = entry::<Option<SMatrix<f64, 6, 6>>>(name, value, "information")?;
        Ok(Self(Edge {
            from: entry::<u32>(name, value, "from")? as usize,
            to: entry::<u32>(name, value, "to")? as usize,
            from_from_to: entry(name, value, "fromFromTo")?,
            information: information.unwrap_or_else(SMatrix::identity),
        }))
    }
}

/// Measured rotation between two views.
struct MeasuredRotation(RelativeRotation);

impl Argument for MeasuredRotation {
    fn typescript(types: &mut Types) -> String {
        let transform = <RigidTransform as Argument>::typescript(types);
        types.interface(
            "RelativeRotation",
            "Measured rotation between two views.",
            &[
                ("from", "number", "Index of the first view."),
                ("to", "number", "Index of the second view."),
                (
                    "toFromFrom",
                    &transform,
                    "Rotation from the frame of the first view to that of the second.",
                ),
            ],
        );
        "RelativeRotation".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["from", "to", "toFromFrom"])?;
        let measured: RigidTransform = entry(name, value, "toFromFrom")?;
        Ok(Self(RelativeRotation {
            from: entry::<u32>(name, value, "from")? as usize,
            to: entry::<u32>(name, value, "to")? as usize,
            to_from_from: measured.rotation,
        }))
    }
}

/// Maximum number of vertices: more would exhaust the memory of a page.
const MAX_VERTICES: u32 = 1 << 20;

/// Rejects counts that would exhaust the memory of a page.
pub(crate) fn count(name: &str, value: u32) -> Result<usize> {
    match value <= MAX_VERTICES {
        true => Ok(value as usize),
        false => Err(Fault::of_range(format!(
            "{name} must be at most {MAX_VERTICES}, but is {value}"
        ))),
    }
}

/// Returns the given loss, or the square.
pub(super) fn loss(loss: Option<Setting<RobustLoss>>) -> RobustLoss {
    loss.map_or(RobustLoss::Trivial, |loss| loss.0)
}

functions! {
    /// Poses of vertices that agree best with the measured poses between pairs of them, loops
    /// included. The width of the loss is in standard deviations. Without `worldFromVertex`, the
    /// start follows from the edges of `numVertices` vertices.
    fn optimize_pose_graph(
        edges: Vec<Measured>, num_vertices: u32, world_from_vertex: Option<Vec<RigidTransform>>,
        loss: Option<Setting<RobustLoss>>, options: Options<LmOptions>; monitor
    ) -> OptimizedGraph {
        let starts_from_edges = world_from_vertex.is_none();
        let count = self::count("numVertices", num_vertices)?;
        let vertices = match world_from_vertex {
            Some(value) if value.len() != count => {
                return Err(Fault::of_range(format!(
                    "worldFromVertex must have {count} poses, one for each vertex, but has {}",
                    value.len()
                )));
            }
            Some(value) => value,
            None => vec![RigidTransform::identity(); count],
        };
        let mut graph = Graph {
            vertices,
            edges: edges.into_iter().map(|edge| edge.0).collect(),
            ..Graph::default()
        };
        if starts_from_edges {
            graph.initialize(monitor)?;
        }
        let report = graph.optimize(&options.0, self::loss(loss), monitor)?;
        OptimizedGraph { world_from_vertex: graph.vertices, report }
    }

    /// Rotations of `numViews` views that agree best with measured rotations between pairs of them.
    /// The width of the loss is in radians.
    fn average_rotations(
        measured: Vec<MeasuredRotation>, num_views: u32, loss: Option<Setting<RobustLoss>>,
        options: NoOptions; monitor
    ) -> AveragedRotations {
        let NoOptions = options;
        let count = self::count("numViews", num_views)?;
        let measured: Vec<_> = measured.into_iter().map(|one| one.0).collect();
        let (rotations, errors) = sfm::average_rotations(
            count, &measured, self::loss(loss), monitor,
        )?;
        let pose = |rotation| RigidTransform::from_parts(Default::default(), rotation);
        AveragedRotations {
            view_from_world: rotations.into_iter().map(pose).collect(),
            errors_rad: Numbers(errors),
        }
    }
}
