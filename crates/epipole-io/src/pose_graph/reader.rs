//! Reader of g2o's text format.

use super::pose::Written;
use super::words::no_number;
use crate::{Error, Result};
use epipole::sfm::{Edge, Graph, PosePrior};
use nalgebra::{Cholesky, Isometry3, SMatrix};
use std::collections::{BTreeMap, BTreeSet};

/// The kind of a line.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Vertex,
    Edge,
    Prior,
    /// A prior of the position alone.
    Position,
    Landmark,
    /// A landmark in the frame of a pose.
    Sighting,
}

impl Kind {
    fn of<T: Written<D>, const D: usize>(tag: &str) -> Option<Self> {
        let kinds = [
            (T::VERTEX, Self::Vertex),
            (T::EDGE, Self::Edge),
            (T::PRIOR, Self::Prior),
            (T::POSITION, Self::Position),
            (T::LANDMARK, Self::Landmark),
            (T::SIGHTING, Self::Sighting),
        ];
        kinds
            .iter()
            .find(|(name, _)| *name == tag)
            .map(|&(_, kind)| kind)
    }

    /// Returns the counts of IDs, numbers of the pose and rows of the information matrix.
    fn counts<T: Written<D>, const D: usize>(self) -> [usize; 3] {
        let of_offset = usize::from(T::HAS_OFFSET);
        match self {
            Self::Vertex => [1, T::ORIGIN.len(), 0],
            Self::Edge => [2, T::ORIGIN.len(), D],
            Self::Prior => [1 + of_offset, T::ORIGIN.len(), D],
            Self::Position => [1 + of_offset, T::NUM_AXES, T::NUM_AXES],
            Self::Landmark => [1, T::NUM_AXES, 0],
            Self::Sighting => [2 + of_offset, T::NUM_AXES, T::NUM_AXES],
        }
    }
}

/// A measurement whose vertices may follow in the file.
struct Measurement<T, const D: usize> {
    line: usize,
    kind: Kind,
    ids: [u64; 3],
    pose: T,
    information: SMatrix<f64, D, D>,
}

/// Lines that apply to poses of every kind.
#[derive(Default)]
pub(super) struct Shared {
    /// Line and vertex of each `FIX`.
    pub(super) fixed: Vec<(usize, u64)>,
    /// `PARAMS_SE3OFFSET`: `vertex_from_sensor`.
    pub(super) offsets: BTreeMap<u64, Isometry3<f64>>,
    /// IDs of unsupported landmarks.
    pub(super) landmarks: BTreeSet<u64>,
}

/// Reader of the lines of one kind of poses into a graph.
pub(super) struct Reader<T, const D: usize> {
    graph: Graph<T, D>,
    index: BTreeMap<u64, usize>,
    measurements: Vec<Measurement<T, D>>,
}

impl<T: Written<D>, const D: usize> Reader<T, D> {
    pub(super) fn new() -> Self {
        Self {
            graph: Graph::default(),
            index: BTreeMap::new(),
            measurements: Vec::new(),
        }
    }

    /// Reads a vertex or a measurement; false if the tag belongs to another kind.
    pub(super) fn accept(&mut self, line: usize, tag: &str, words: &[&str]) -> Result<bool> {
        let Some(kind) = Kind::of::<T, D>(tag) else {
            return Ok(false);
        };
        let [num_ids, num_numbers, rank] = kind.counts::<T, D>();
        let (ids, numbers) = parse(
            line,
            tag,
            words,
            num_ids,
            num_numbers + rank * (rank + 1) / 2,
        )?;
        let mut of_pose = T::ORIGIN.to_vec();
        of_pose[..num_numbers].copy_from_slice(&numbers[..num_numbers]);
        let pose = T::read(&of_pose).map_err(|why| Error::at(line, why))?;
        if matches!(kind, Kind::Vertex | Kind::Landmark) {
            let next = self.graph.vertices.len();
            if self.index.insert(ids[0], next).is_some() {
                return Err(Error::at(line, format!("vertex {} is there twice", ids[0])));
            }
            if kind == Kind::Landmark {
                self.graph.landmarks.push(next);
            }
            self.graph.ids.push(ids[0]);
            self.graph.vertices.push(pose);
            return Ok(true);
        }
        let information = symmetric(&numbers[num_numbers..], rank);
        if !is_positive_semidefinite(&information) {
            let why = "the information matrix is not positive semi-definite";
            return Err(Error::at(line, why));
        }
        if matches!(kind, Kind::Edge | Kind::Sighting) && ids[0] == ids[1] {
            let why = format!("the edge joins vertex {} with itself", ids[0]);
            return Err(Error::at(line, why));
        }
        self.measurements.push(Measurement {
            line,
            kind,
            ids,
            pose,
            information,
        });
        Ok(true)
    }

    pub(super) fn finish(self, shared: &Shared) -> Result<Graph<T, D>> {
        let mut graph = self.graph;
        let landmarks: BTreeSet<usize> = graph.landmarks.iter().copied().collect();
        let find = |line: usize, id: u64| {
            self.index
                .get(&id)
                .copied()
                .ok_or_else(|| Error::at(line, format!("there is no vertex {id}")))
        };
        // A pose, or a landmark.
        let find_kind = |line: usize, id: u64, is_landmark: bool| {
            let vertex = find(line, id)?;
            match (landmarks.contains(&vertex), is_landmark) {
                (true, false) => Err(Error::at(
                    line,
                    format!("vertex {id} is a landmark, no pose"),
                )),
                (false, true) => Err(Error::at(
                    line,
                    format!("vertex {id} is a pose, no landmark"),
                )),
                _ => Ok(vertex),
            }
        };
        let offset = |line: usize, id: u64| {
            let offset = shared.offsets.get(&id);
            offset.ok_or_else(|| Error::at(line, format!("there is no line PARAMS_SE3OFFSET {id}")))
        };
        for measured in self.measurements {
            let Measurement {
                line,
                kind,
                ids,
                pose,
                information,
            } = measured;
            if matches!(kind, Kind::Edge | Kind::Sighting) {
                let is_sighting = kind == Kind::Sighting;
                let (from_from_to, information) = match T::HAS_OFFSET && is_sighting {
                    true => pose.relative_to_vertex(information, offset(line, ids[2])?),
                    false => (pose, information),
                };
                check_finite(line, &from_from_to, &information)?;
                graph.edges.push(Edge {
                    from: find_kind(line, ids[0], false)?,
                    to: find_kind(line, ids[1], is_sighting)?,
                    from_from_to,
                    information,
                });
                continue;
            }
            // As in g2o, a position prior is that of the vertex, regardless of the offset.
            let (world_from_vertex, information) = if T::HAS_OFFSET && kind == Kind::Prior {
                let (pose, information) = pose.without_offset(information, offset(line, ids[1])?);
                check_finite(line, &pose, &information)?;
                if !is_positive_semidefinite(&information) {
                    let why = "the offset is too far for the information matrix";
                    return Err(Error::at(line, why));
                }
                (pose, information)
            } else {
                (pose, information)
            };
            graph.priors.push(PosePrior {
                vertex: find_kind(line, ids[0], false)?,
                world_from_vertex,
                information,
            });
        }
        for &(line, id) in &shared.fixed {
            if !shared.landmarks.contains(&id) {
                graph.fixed.push(find(line, id)?);
            }
        }
        Ok(graph)
    }
}

/// # Errors
/// [`Error::Malformed`] if finite numbers overflowed.
fn check_finite<T: Written<D>, const D: usize>(
    line: usize,
    pose: &T,
    information: &SMatrix<f64, D, D>,
) -> Result<()> {
    let mut numbers = Vec::new();
    pose.write(&mut numbers);
    match numbers.iter().chain(information).all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(Error::at(
            line,
            "a number is too large to shift it by the offset",
        )),
    }
}

/// Reads IDs, then finite numbers, and nothing else.
pub(super) fn parse(
    line: usize,
    tag: &str,
    words: &[&str],
    num_ids: usize,
    num_numbers: usize,
) -> Result<([u64; 3], Vec<f64>)> {
    let needed = num_ids + num_numbers;
    if words.len() != needed {
        let why = format!("{tag} needs {needed} values, but has {}", words.len());
        return Err(Error::at(line, why));
    }
    let mut ids = [0; 3];
    for (id, word) in ids.iter_mut().zip(&words[..num_ids]) {
        *id = parse_id(line, word)?;
    }
    let number = |word: &&str| match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(Error::at(line, no_number(word))),
    };
    let numbers = words[num_ids..].iter().map(number).collect::<Result<_>>()?;
    Ok((ids, numbers))
}

pub(super) fn parse_id(line: usize, word: &str) -> Result<u64> {
    word.parse()
        .map_err(|_| Error::at(line, format!("“{word}” is not the number of a vertex")))
}

/// Returns a matrix from the upper triangle of its first `rank` rows and columns, row by row.
fn symmetric<const D: usize>(upper: &[f64], rank: usize) -> SMatrix<f64, D, D> {
    let mut matrix = SMatrix::zeros();
    let mut upper = upper.iter();
    for i in 0..rank {
        for j in i..rank {
            let value = upper.next().copied().unwrap_or(0.0);
            matrix[(i, j)] = value;
            matrix[(j, i)] = value;
        }
    }
    matrix
}

/// Returns whether all eigenvalues are non-negative up to rounding.
fn is_positive_semidefinite<const D: usize>(matrix: &SMatrix<f64, D, D>) -> bool {
    let largest = (0..D).map(|i| matrix[(i, i)]).fold(0.0, f64::max);
    let mut shifted = *matrix;
    for i in 0..D {
        shifted[(i, i)] += 1e-9 * largest + f64::MIN_POSITIVE;
    }
    Cholesky::new(shifted).is_some()
}
