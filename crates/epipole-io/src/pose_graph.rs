//! Pose graphs: the text format of g2o.

mod pose;
mod reader;
#[cfg(test)]
mod tests;
mod words;
mod writer;

use crate::{Error, Result};
use epipole::sfm::PoseGraph;
use nalgebra::{Isometry2, Isometry3, Similarity3};
use reader::{Reader, Shared, parse, parse_id};
use writer::write_graph;

/// A pose graph, and sentences on other parts of the file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ReadGraph {
    /// Poses, their relative measurements and priors.
    pub graph: PoseGraph,
    /// Sentences on parts that were left out.
    pub notes: Vec<String>,
}

/// Reads g2o's text format: `VERTEX_SE2` and `EDGE_SE2`, or `VERTEX_SE3:QUAT` and
/// `EDGE_SE3:QUAT`, or `VERTEX_SIM3:QUAT` and `EDGE_SIM3:QUAT`, and `FIX`.
///
/// Priors are `EDGE_PRIOR_SE2` and `EDGE_PRIOR_SE2_XY`, or `EDGE_SE3_PRIOR` with its
/// `PARAMS_SE3OFFSET` and `EDGE_SE3_XYZ_PRIOR`. Landmarks are `VERTEX_XY` with `EDGE_SE2_XY`, or
/// `VERTEX_TRACKXYZ` with `EDGE_SE3_TRACKXYZ` and its offset. Others, such as bearings, are left
/// out and listed in [`ReadGraph::notes`].
///
/// The similarities are an extension, `EDGE_SIM3_PRIOR` included: as SE(3), with the scale after
/// the quaternion and an information matrix of 7×7. Quaternions are written x, y, z, w and are
/// normalized here; information matrices are written as their upper triangles, row by row. Empty
/// lines, those that start with `#`, and other `PARAMS_…` are skipped.
///
/// # Errors
/// [`Error::Malformed`] with the line for unknown tags, mixed kinds, missing or surplus values,
/// values that are not finite, vertices that are duplicate, missing or of the other kind, missing
/// offsets, and information matrices that are not positive semi-definite; [`Error::Invalid`]
/// without vertices.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::pose_graph::read_g2o;
/// // Measured 1 ahead, placed 1.5 ahead, information 4: χ² = 0.5² · 4.
/// let read = read_g2o(
///     "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.5 0 0\nEDGE_SE2 0 1 1 0 0 4 0 0 4 0 4\n",
/// )?;
/// assert_eq!(read.graph.chi2(), 1.0);
/// # Ok(()) }
/// ```
pub fn read_g2o(text: &str) -> Result<ReadGraph> {
    let mut se2 = Reader::<Isometry2<f64>, 3>::new();
    let mut se3 = Reader::<Isometry3<f64>, 6>::new();
    let mut sim3 = Reader::<Similarity3<f64>, 7>::new();
    let mut shared = Shared::default();
    let mut num_left_out = 0;
    let mut kind = None;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let words: Vec<&str> = content.split_whitespace().collect();
        let Some((&tag, words)) = words.split_first() else {
            continue;
        };
        if tag == "PARAMS_SE3OFFSET" {
            let (ids, numbers) = parse(line, tag, words, 1, 7)?;
            let offset = pose::Written::<6>::read(&numbers);
            let offset = offset.map_err(|why| Error::at(line, why))?;
            shared.offsets.insert(ids[0], offset);
            continue;
        }
        // Other parameters belong to landmarks and cameras.
        if tag.starts_with('#') || tag.starts_with("PARAMS_") {
            continue;
        }
        if tag == "FIX" {
            for word in words {
                shared.fixed.push((line, parse_id(line, word)?));
            }
            continue;
        }
        let this = if se2.accept(line, tag, words)? {
            2
        } else if se3.accept(line, tag, words)? {
            3
        } else if sim3.accept(line, tag, words)? {
            7
        } else if words::is_of_landmark(tag) {
            match (tag.starts_with("VERTEX"), words.first()) {
                (true, Some(id)) => _ = shared.landmarks.insert(parse_id(line, id)?),
                _ => num_left_out += 1,
            }
            continue;
        } else {
            return Err(Error::at(line, words::unknown(tag)));
        };
        if *kind.get_or_insert(this) != this {
            let why = format!("“{tag}” is of another kind than the lines before");
            return Err(Error::at(line, why));
        }
    }
    let graph = match kind {
        Some(2) => PoseGraph::Se2(se2.finish(&shared)?),
        Some(3) => PoseGraph::Se3(se3.finish(&shared)?),
        Some(_) => PoseGraph::Sim3(sim3.finish(&shared)?),
        None => {
            return Err(epipole::Error::TooFew {
                what: "a pose graph from vertices",
                needed: 1,
                got: 0,
            }
            .into());
        }
    };
    let left_out = words::left_out(shared.landmarks.len(), num_left_out);
    Ok(ReadGraph {
        graph,
        notes: left_out.into_iter().collect(),
    })
}

/// Returns whether the first word of a text is g2o's, even if the rest is malformed.
pub fn is_g2o(text: &str) -> bool {
    let mut words = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    let first = words.find(|word| !word.starts_with('#'));
    let starts = ["VERTEX_", "EDGE_", "PARAMS_", "FIX"];
    first.is_some_and(|word| starts.iter().any(|start| word.starts_with(start)))
}

/// Writes g2o's text format; see [`read_g2o`].
pub fn write_g2o(graph: &PoseGraph) -> String {
    match graph {
        PoseGraph::Se2(graph) => write_graph(graph),
        PoseGraph::Se3(graph) => write_graph(graph),
        PoseGraph::Sim3(graph) => write_graph(graph),
    }
}
