//! Pose graphs, with poses as rows of numbers.

use super::pose_rows::Row;
use super::wrapper::{give_index_rows, give_indices, index_rows, indices, require_equal, wrapper};
use crate::arrays::{as_array, vectors};
use crate::images::{elements, wrong_shape};
use crate::optim::termination;
use crate::record::record;
use crate::{options, progress};
use epipole::nalgebra::{SMatrix, SVector};
use epipole::sfm::{self, Edge, Graph, PosePrior};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Poses joined by measured relative poses.
///
/// A pose is a row of an array: (x, y, angle) in the plane, (x, y, z, qw, qx, qy, qz) in space, and
/// the same followed by a scale for similarities.
///
/// Parameters
/// ----------
/// kind : {"se2", "se3", "sim3"}
/// vertices : array_like, shape (V, 3), (V, 7) or (V, 8)
///     ``world_from_vertex`` of each vertex.
/// edges : array_like of int, shape (E, 2)
///     Indices of the vertices where each edge starts and ends.
/// measurements : array_like, shape (E, 3), (E, 7) or (E, 8)
///     Pose of the end in the frame of the start.
/// information : array_like, shape (E, D, D), optional
///     Inverse covariances of translation, rotation, log scale: D is 3, 6 or 7. Identities by
///     default.
/// fixed : array_like of int, optional
///     Vertices held fixed. In a connected part without one, the first vertex is held.
/// ids : array_like of int, shape (V,), optional
///     Number of each vertex in a file.
/// landmarks : array_like of int, optional
///     Vertices that are points without rotation: edges to them have an information of 0 for the
///     rotation.
/// prior_vertices : array_like of int, shape (P,), optional
///     Vertices whose poses are measured, for example by a GPS receiver.
/// priors : array_like, shape (P, 3), (P, 7) or (P, 8), optional
///     Measured ``world_from_vertex``.
/// prior_information : array_like, shape (P, D, D), optional
///     Inverse covariances of the priors. Identities by default.
///
/// Raises
/// ------
/// ValueError
///     If ``kind`` is unknown, a vertex index is out of range, the length of a quaternion is not 1,
///     or a scale is not above 0.
#[pyclass(frozen, module = "epipole.sfm")]
pub(crate) struct PoseGraph(pub(crate) sfm::PoseGraph);

wrapper!(
    PoseGraph: kind, vertices, edges, measurements, information, fixed, ids, landmarks,
    prior_vertices, priors, prior_information
);

/// Arguments of the constructor.
struct Parts<'a, 'py> {
    vertices: &'a Bound<'py, PyAny>,
    edges: Vec<[usize; 2]>,
    measurements: &'a Bound<'py, PyAny>,
    information: Option<&'a Bound<'py, PyAny>>,
    fixed: Vec<usize>,
    ids: Option<Vec<usize>>,
    landmarks: Vec<usize>,
    prior_vertices: Vec<usize>,
    priors: Option<&'a Bound<'py, PyAny>>,
    prior_information: Option<&'a Bound<'py, PyAny>>,
}

impl Parts<'_, '_> {
    fn graph<T: Row, const N: usize, const D: usize>(self) -> PyResult<Graph<T, D>> {
        let poses = |name: &str, value: &Bound<'_, PyAny>| {
            let rows: Vec<SVector<f64, N>> = vectors::<N>(name, value)?;
            rows.iter()
                .map(|row| T::read(row.as_slice()))
                .collect::<PyResult<Vec<T>>>()
        };
        let vertices = poses("vertices", self.vertices)?;
        let measurements = poses("measurements", self.measurements)?;
        let count = self.edges.len();
        require_equal(("edges", count), ("measurements", measurements.len()))?;
        let information = information_of::<D>("information", "E", self.information, count)?;
        require_equal(("edges", count), ("information", information.len()))?;
        let prior_count = self.prior_vertices.len();
        let measured =
            (self.priors).map_or_else(|| Ok(Vec::new()), |rows| poses("priors", rows))?;
        require_equal(("prior_vertices", prior_count), ("priors", measured.len()))?;
        let name = "prior_information";
        let prior_information =
            information_of::<D>(name, "P", self.prior_information, prior_count)?;
        require_equal(
            ("prior_vertices", prior_count),
            (name, prior_information.len()),
        )?;
        let used = self.edges.iter().flatten().chain(&self.fixed);
        let mut used = used.chain(&self.landmarks).chain(&self.prior_vertices);
        if let Some(index) = used.find(|&&index| index >= vertices.len()) {
            return Err(PyValueError::new_err(format!(
                "edges, fixed, landmarks and prior_vertices must have indices of vertices, but there is \
                 {index} for {} vertices",
                vertices.len()
            )));
        }
        let priors = (self.prior_vertices.into_iter().zip(measured)).zip(prior_information);
        let ids = match self.ids {
            Some(ids) => ids.into_iter().map(|id| id as u64).collect(),
            None => (0..vertices.len() as u64).collect::<Vec<_>>(),
        };
        require_equal(("vertices", vertices.len()), ("ids", ids.len()))?;
        let edges = self.edges.into_iter().zip(measurements).zip(information);
        Ok(Graph {
            ids,
            vertices,
            edges: edges
                .map(|(([from, to], from_from_to), information)| Edge {
                    from,
                    to,
                    from_from_to,
                    information,
                })
                .collect(),
            priors: priors
                .map(|((vertex, world_from_vertex), information)| PosePrior {
                    vertex,
                    world_from_vertex,
                    information,
                })
                .collect(),
            fixed: self.fixed,
            landmarks: self.landmarks,
        })
    }
}

/// Reads inverse covariances; `count` identities if none are given.
fn information_of<const D: usize>(
    name: &str,
    count_letter: &str,
    value: Option<&Bound<'_, PyAny>>,
    count: usize,
) -> PyResult<Vec<SMatrix<f64, D, D>>> {
    value.map_or_else(
        || Ok(vec![SMatrix::identity(); count]),
        |value| matrices::<D>(name, count_letter, value),
    )
}

fn matrices<const D: usize>(
    name: &str,
    count_letter: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<Vec<SMatrix<f64, D, D>>> {
    let expected = format!("({count_letter}, {D}, {D})");
    let array = as_array(name, value, &expected)?;
    match *array.shape() {
        [_, rows, columns] if rows == D && columns == D => {}
        _ => return Err(wrong_shape(name, &expected, &array)?),
    }
    let numbers: Vec<f64> = elements(&array, "float64")?;
    Ok(numbers
        .chunks_exact(D * D)
        .map(SMatrix::from_row_slice)
        .collect())
}

fn table<'py, T: Row>(
    py: Python<'py>,
    poses: impl Iterator<Item = T>,
    columns: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let mut numbers = Vec::new();
    poses.for_each(|pose| pose.give(&mut numbers));
    let count = numbers.len() / columns;
    PyArray1::from_vec(py, numbers).reshape([count, columns])
}

fn give_information<'py, const D: usize>(
    py: Python<'py>,
    matrices: impl ExactSizeIterator<Item = SMatrix<f64, D, D>>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let count = matrices.len();
    let numbers = matrices.flat_map(|matrix| matrix.transpose().as_slice().to_vec());
    PyArray1::from_vec(py, numbers.collect()).reshape([count, D, D])
}

/// Evaluates an expression for the graph of each kind.
macro_rules! each {
    ($graph:expr, |$name:ident, $columns:ident| $value:expr) => {
        match $graph {
            sfm::PoseGraph::Se2($name) => {
                let $columns = 3;
                $value
            }
            sfm::PoseGraph::Se3($name) => {
                let $columns = 7;
                $value
            }
            sfm::PoseGraph::Sim3($name) => {
                let $columns = 8;
                $value
            }
        }
    };
}

#[pymethods]
impl PoseGraph {
    #[new]
    #[pyo3(signature = (
        kind, vertices, edges, measurements, information=None, fixed=None, ids=None,
        landmarks=None, prior_vertices=None, priors=None, prior_information=None
    ))]
    #[allow(clippy::too_many_arguments, reason = "the parts of a graph")]
    fn new(
        kind: &str,
        vertices: &Bound<'_, PyAny>,
        edges: &Bound<'_, PyAny>,
        measurements: &Bound<'_, PyAny>,
        information: Option<&Bound<'_, PyAny>>,
        fixed: Option<&Bound<'_, PyAny>>,
        ids: Option<&Bound<'_, PyAny>>,
        landmarks: Option<&Bound<'_, PyAny>>,
        prior_vertices: Option<&Bound<'_, PyAny>>,
        priors: Option<&Bound<'_, PyAny>>,
        prior_information: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let of_vertices = |name: &str, value: Option<&Bound<'_, PyAny>>| {
            value.map_or_else(|| Ok(Vec::new()), |value| indices(name, value))
        };
        let parts = Parts {
            vertices,
            edges: index_rows::<2>("edges", edges)?,
            measurements,
            information,
            fixed: of_vertices("fixed", fixed)?,
            landmarks: of_vertices("landmarks", landmarks)?,
            prior_vertices: of_vertices("prior_vertices", prior_vertices)?,
            priors,
            prior_information,
            ids: ids.map(|ids| indices("ids", ids)).transpose()?,
        };
        Ok(Self(match kind {
            "se2" => sfm::PoseGraph::Se2(parts.graph::<_, 3, 3>()?),
            "se3" => sfm::PoseGraph::Se3(parts.graph::<_, 7, 6>()?),
            "sim3" => sfm::PoseGraph::Sim3(parts.graph::<_, 8, 7>()?),
            _ => {
                return Err(PyValueError::new_err(format!(
                    "kind must be \"se2\", \"se3\" or \"sim3\", but is \"{kind}\""
                )));
            }
        }))
    }

    /// "se2", "se3" or "sim3".
    #[getter]
    fn kind(&self) -> &'static str {
        match self.0 {
            sfm::PoseGraph::Se2(_) => "se2",
            sfm::PoseGraph::Se3(_) => "se3",
            sfm::PoseGraph::Sim3(_) => "sim3",
        }
    }

    /// ``world_from_vertex`` of each vertex, shape (V, 3), (V, 7) or (V, 8).
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        each!(&self.0, |graph, columns| table(
            py,
            graph.vertices.iter().copied(),
            columns
        ))
    }

    /// Vertices where each edge starts and ends, int64 of shape (E, 2).
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        each!(&self.0, |graph, _columns| {
            give_index_rows(py, graph.edges.iter().map(|edge| [edge.from, edge.to]))
        })
    }

    /// Pose of the end in the frame of the start of each edge, shape (E, 3), (E, 7) or (E, 8).
    #[getter]
    fn measurements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        each!(&self.0, |graph, columns| {
            table(
                py,
                graph.edges.iter().map(|edge| edge.from_from_to),
                columns,
            )
        })
    }

    /// Inverse covariances of the measurements, shape (E, D, D).
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        each!(&self.0, |graph, _columns| {
            give_information(py, graph.edges.iter().map(|edge| edge.information))
        })
    }

    /// Vertices whose poses are measured, int64 of shape (P,).
    #[getter]
    fn prior_vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        each!(&self.0, |graph, _columns| {
            PyArray1::from_iter(py, graph.priors.iter().map(|prior| prior.vertex as i64))
        })
    }

    /// Measured ``world_from_vertex`` of these vertices, shape (P, 3), (P, 7) or (P, 8).
    #[getter]
    fn priors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        each!(&self.0, |graph, columns| {
            let poses = graph.priors.iter().map(|prior| prior.world_from_vertex);
            table(py, poses, columns)
        })
    }

    /// Inverse covariances of these measurements, shape (P, D, D).
    #[getter]
    fn prior_information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        each!(&self.0, |graph, _columns| {
            give_information(py, graph.priors.iter().map(|prior| prior.information))
        })
    }

    /// Vertices held fixed, int64 array.
    #[getter]
    fn fixed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        each!(&self.0, |graph, _columns| give_indices(py, &graph.fixed))
    }

    /// Vertices that are points without rotation, int64 array.
    #[getter]
    fn landmarks<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        each!(&self.0, |graph, _columns| give_indices(
            py,
            &graph.landmarks
        ))
    }

    /// Number of each vertex in a file, int64 of shape (V,).
    #[getter]
    fn ids<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        each!(&self.0, |graph, _columns| {
            PyArray1::from_iter(py, graph.ids.iter().map(|&id| id as i64))
        })
    }

    /// Returns the sum of the squared errors, weighted by their information.
    fn chi2(&self) -> f64 {
        self.0.chi2()
    }

    /// Returns the numbers of vertices and edges.
    fn size(&self) -> (usize, usize) {
        self.0.size()
    }

    /// Returns a graph with vertices computed from the measurements alone.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Returns
    /// -------
    /// PoseGraph
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are no edges and no priors.
    /// epipole.DegenerateError
    ///     If a vertex depends on measurements without weight.
    /// ValueError
    ///     If an edge joins a vertex with itself, or an information matrix is asymmetric or has a
    ///     negative eigenvalue.
    #[pyo3(signature = (*, progress=None))]
    fn initialize(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<Self> {
        let mut graph = self.0.clone();
        progress::run(py, progress, |monitor| graph.initialize(monitor))?;
        Ok(Self(graph))
    }

    /// Returns the graph with the smallest sum of squared errors.
    ///
    /// Parameters
    /// ----------
    /// loss : str or dict, optional
    ///     ``"trivial"`` or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"``
    ///     likewise.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : LmOptions
    ///     ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
    ///     ``initial_damping``, ``patience``.
    ///
    /// Returns
    /// -------
    /// graph : PoseGraph
    /// report : PoseGraphReport
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are no edges and no priors.
    /// ValueError
    ///     If an edge joins a vertex with itself, an information matrix is asymmetric or has a
    ///     negative eigenvalue, or a loss width is not above 0.
    #[pyo3(signature = (*, loss=None, progress=None, **options))]
    fn optimize(
        &self,
        py: Python<'_>,
        loss: Option<&Bound<'_, PyAny>>,
        progress: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Self, PoseGraphReport)> {
        let loss = options::loss(loss)?;
        let mut graph = self.0.clone();
        let report = progress::run_with(py, progress, options, |options, monitor| {
            graph.optimize(options, loss, monitor)
        })?;
        Ok((Self(graph), report.into()))
    }
}

record! {
    /// Report of the optimization of a pose graph.
    "epipole.sfm" PoseGraphReport {
        /// Initial sum of the weighted squared errors.
        initial_chi2: f64,
        /// Final sum of the weighted squared errors.
        final_chi2: f64,
        /// Number of steps tried.
        iterations: usize,
        /// Reason the loop ended, as in `epipole.optim.LmReport`.
        termination: String,
        /// Number of connected parts.
        num_components: usize,
    }
}

impl From<sfm::PoseGraphReport> for PoseGraphReport {
    fn from(report: sfm::PoseGraphReport) -> Self {
        Self {
            initial_chi2: report.initial_chi2,
            final_chi2: report.final_chi2,
            iterations: report.iterations,
            termination: termination(report.termination),
            num_components: report.num_components,
        }
    }
}
