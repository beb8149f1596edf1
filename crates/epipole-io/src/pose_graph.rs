//! Pose graphs: the text format of g2o.

use crate::{Error, Result};
use epipole::sfm::{Edge, Graph, PoseGraph};
use nalgebra::{
    Cholesky, Isometry2, Isometry3, Quaternion, SMatrix, Similarity3, Translation3, UnitQuaternion,
    Vector2,
};
use std::collections::BTreeMap;
use std::fmt::Write;

/// A pose in a file: tags and numbers.
trait Written<const D: usize>: Sized {
    const VERTEX: &'static str;
    const EDGE: &'static str;
    const NUMBERS: usize;
    fn read(numbers: &[f64]) -> std::result::Result<Self, &'static str>;
    fn write(&self, numbers: &mut Vec<f64>);
}

impl Written<3> for Isometry2<f64> {
    const VERTEX: &'static str = "VERTEX_SE2";
    const EDGE: &'static str = "EDGE_SE2";
    const NUMBERS: usize = 3;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        Ok(Isometry2::new(Vector2::new(n[0], n[1]), n[2]))
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.translation.vector.iter());
        numbers.push(self.rotation.angle());
    }
}

/// The rotation of a quaternion of any length but 0.
fn rotation(
    w: f64,
    x: f64,
    y: f64,
    z: f64,
) -> std::result::Result<UnitQuaternion<f64>, &'static str> {
    let mut quaternion = Quaternion::new(w, x, y, z);
    if !quaternion.norm().is_finite() {
        // Each number is finite, and their squares are not.
        quaternion /= quaternion.coords.amax();
    }
    UnitQuaternion::try_new(quaternion, 1e-6).ok_or("the quaternion is zero, so it is no rotation")
}

impl Written<6> for Isometry3<f64> {
    const VERTEX: &'static str = "VERTEX_SE3:QUAT";
    const EDGE: &'static str = "EDGE_SE3:QUAT";
    const NUMBERS: usize = 7;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        let rotation = rotation(n[6], n[3], n[4], n[5])?;
        Ok(Isometry3::from_parts(
            Translation3::new(n[0], n[1], n[2]),
            rotation,
        ))
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.translation.vector.iter());
        let q = &self.rotation;
        numbers.extend([q.i, q.j, q.k, q.w]);
    }
}

impl Written<7> for Similarity3<f64> {
    const VERTEX: &'static str = "VERTEX_SIM3:QUAT";
    const EDGE: &'static str = "EDGE_SIM3:QUAT";
    const NUMBERS: usize = 8;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        let isometry = <Isometry3<f64> as Written<6>>::read(&n[..7])?;
        if n[7] > 0.0 {
            Ok(Similarity3::from_isometry(isometry, n[7]))
        } else {
            Err("the scale is not greater than 0")
        }
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        Written::<6>::write(&self.isometry, numbers);
        numbers.push(self.scaling());
    }
}

/// The lines of one kind, read into a graph; edges are kept until all vertices are known.
struct Reader<T, const D: usize> {
    graph: Graph<T, D>,
    index: BTreeMap<u64, usize>,
    edges: Vec<(usize, u64, u64, T, SMatrix<f64, D, D>)>,
}

impl<T: Written<D>, const D: usize> Reader<T, D> {
    fn new() -> Self {
        Self {
            graph: Graph::default(),
            index: BTreeMap::new(),
            edges: Vec::new(),
        }
    }

    /// Reads a vertex or an edge; false if the tag is another kind's.
    fn accept(&mut self, line: usize, tag: &str, words: &[&str]) -> Result<bool> {
        let triangle = D * (D + 1) / 2;
        let (num_ids, num_numbers) = if tag == T::VERTEX {
            (1, T::NUMBERS)
        } else if tag == T::EDGE {
            (2, T::NUMBERS + triangle)
        } else {
            return Ok(false);
        };
        if words.len() != num_ids + num_numbers {
            return Err(Error::at(
                line,
                format!(
                    "{tag} needs {} values, but has {}",
                    num_ids + num_numbers,
                    words.len()
                ),
            ));
        }
        let mut ids = [0; 2];
        for (id, word) in ids.iter_mut().zip(&words[..num_ids]) {
            *id = parse_id(line, word)?;
        }
        let mut numbers = Vec::with_capacity(num_numbers);
        for word in &words[num_ids..] {
            match word.parse::<f64>() {
                Ok(value) if value.is_finite() => numbers.push(value),
                _ => return Err(Error::at(line, no_number(word))),
            }
        }
        let pose = T::read(&numbers[..T::NUMBERS]).map_err(|why| Error::at(line, why))?;
        if num_ids == 1 {
            if self
                .index
                .insert(ids[0], self.graph.vertices.len())
                .is_some()
            {
                return Err(Error::at(line, format!("vertex {} is there twice", ids[0])));
            }
            self.graph.ids.push(ids[0]);
            self.graph.vertices.push(pose);
        } else {
            let mut information = SMatrix::zeros();
            let mut upper = numbers[T::NUMBERS..].iter();
            for i in 0..D {
                for j in i..D {
                    let value = upper.next().copied().unwrap_or(0.0);
                    information[(i, j)] = value;
                    information[(j, i)] = value;
                }
            }
            if !is_positive_semidefinite(&information) {
                let why = "the information matrix is not positive semi-definite";
                return Err(Error::at(line, why));
            }
            if ids[0] == ids[1] {
                let why = format!("the edge joins vertex {} with itself", ids[0]);
                return Err(Error::at(line, why));
            }
            self.edges.push((line, ids[0], ids[1], pose, information));
        }
        Ok(true)
    }

    fn finish(self, fixed: &[(usize, u64)]) -> Result<Graph<T, D>> {
        let mut graph = self.graph;
        let find = |line: usize, id: u64| {
            self.index
                .get(&id)
                .copied()
                .ok_or_else(|| Error::at(line, format!("there is no vertex {id}")))
        };
        for (line, from, to, pose, information) in self.edges {
            graph.edges.push(Edge {
                from: find(line, from)?,
                to: find(line, to)?,
                from_from_to: pose,
                information,
            });
        }
        for &(line, id) in fixed {
            graph.fixed.push(find(line, id)?);
        }
        Ok(graph)
    }
}

fn no_number(word: &str) -> String {
    let has_point = word.replacen(',', ".", 1).parse::<f64>();
    match word.contains(',') && has_point.is_ok_and(f64::is_finite) {
        true => format!("“{word}” has a decimal comma, where g2o has a point"),
        false => format!("“{word}” is not a finite number"),
    }
}

/// Why a tag is not read.
fn unknown(tag: &str) -> String {
    if tag.contains("PRIOR") {
        return format!(
            "“{tag}” is a prior of one pose, which is not supported: fix the vertex by FIX, or measure it by an edge from a \
             vertex that is fixed"
        );
    }
    if ["XY", "POINT", "LANDMARK", "LINE", "PLANE"]
        .iter()
        .any(|one| tag.contains(one))
    {
        return format!(
            "“{tag}” is of a landmark, but only poses are optimized: remove the lines of landmarks"
        );
    }
    match tag {
        "VERTEX2" | "EDGE2" | "VERTEX3" | "EDGE3" => {
            format!("“{tag}” is of TORO's format: convert the file to g2o")
        }
        _ => format!("the tag “{tag}” is not known"),
    }
}

fn parse_id(line: usize, word: &str) -> Result<u64> {
    word.parse()
        .map_err(|_| Error::at(line, format!("“{word}” is not the number of a vertex")))
}

/// Whether all eigenvalues are at least about zero.
fn is_positive_semidefinite<const D: usize>(matrix: &SMatrix<f64, D, D>) -> bool {
    let largest = (0..D).map(|i| matrix[(i, i)]).fold(0.0, f64::max);
    let mut shifted = *matrix;
    for i in 0..D {
        shifted[(i, i)] += 1e-9 * largest + f64::MIN_POSITIVE;
    }
    Cholesky::new(shifted).is_some()
}

fn write_graph<T: Written<D>, const D: usize>(graph: &Graph<T, D>) -> String {
    let mut text = String::new();
    let mut numbers = Vec::new();
    // Writing to a string cannot fail.
    for (id, vertex) in graph.ids.iter().zip(&graph.vertices) {
        let _ = write!(text, "{} {id}", T::VERTEX);
        numbers.clear();
        vertex.write(&mut numbers);
        for value in &numbers {
            let _ = write!(text, " {value}");
        }
        text.push('\n');
    }
    for &vertex in &graph.fixed {
        let _ = writeln!(text, "FIX {}", graph.ids[vertex]);
    }
    for edge in &graph.edges {
        let (from, to) = (graph.ids[edge.from], graph.ids[edge.to]);
        let _ = write!(text, "{} {from} {to}", T::EDGE);
        numbers.clear();
        edge.from_from_to.write(&mut numbers);
        for i in 0..D {
            for j in i..D {
                numbers.push(edge.information[(i, j)]);
            }
        }
        for value in &numbers {
            let _ = write!(text, " {value}");
        }
        text.push('\n');
    }
    text
}

/// Reads g2o's text format: `VERTEX_SE2` and `EDGE_SE2`, or `VERTEX_SE3:QUAT` and
/// `EDGE_SE3:QUAT`, or `VERTEX_SIM3:QUAT` and `EDGE_SIM3:QUAT`, and `FIX`.
///
/// The similarities are an extension: as SE(3), with the scale after the quaternion and an
/// information matrix of 7×7. Quaternions are written x, y, z, w and are normalized here;
/// information matrices are written as their upper triangles, row by row. Empty lines, those
/// that start with `#`, and `PARAMS_…` are skipped.
///
/// # Errors
/// [`Error::Malformed`] with the line for unknown tags, priors, landmarks, mixed kinds, missing
/// or surplus values, values that are not finite, vertices that are there twice or not at all,
/// and information matrices that are not positive semi-definite; [`Error::Invalid`] without
/// vertices.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::pose_graph::read_g2o;
/// // Measured 1 ahead, placed 1.5 ahead, information 4: χ² = 0.5² · 4.
/// let graph = read_g2o(
///     "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.5 0 0\nEDGE_SE2 0 1 1 0 0 4 0 0 4 0 4\n",
/// )?;
/// assert_eq!(graph.chi2(), 1.0);
/// # Ok(()) }
/// ```
pub fn read_g2o(text: &str) -> Result<PoseGraph> {
    let mut se2 = Reader::<Isometry2<f64>, 3>::new();
    let mut se3 = Reader::<Isometry3<f64>, 6>::new();
    let mut sim3 = Reader::<Similarity3<f64>, 7>::new();
    let mut fixed = Vec::new();
    let mut kind = None;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let words: Vec<&str> = content.split_whitespace().collect();
        let Some((&tag, words)) = words.split_first() else {
            continue;
        };
        // Only priors and landmarks have parameters, and those lines are refused.
        if tag.starts_with('#') || tag.starts_with("PARAMS_") {
            continue;
        }
        if tag == "FIX" {
            for word in words {
                fixed.push((line, parse_id(line, word)?));
            }
            continue;
        }
        let this = if se2.accept(line, tag, words)? {
            2
        } else if se3.accept(line, tag, words)? {
            3
        } else if sim3.accept(line, tag, words)? {
            7
        } else {
            return Err(Error::at(line, unknown(tag)));
        };
        if *kind.get_or_insert(this) != this {
            let why = format!("“{tag}” is of another kind than the lines before");
            return Err(Error::at(line, why));
        }
    }
    let graph = match kind {
        Some(2) => PoseGraph::Se2(se2.finish(&fixed)?),
        Some(3) => PoseGraph::Se3(se3.finish(&fixed)?),
        Some(_) => PoseGraph::Sim3(sim3.finish(&fixed)?),
        None => {
            return Err(epipole::Error::TooFew {
                what: "a pose graph from vertices",
                needed: 1,
                got: 0,
            }
            .into());
        }
    };
    Ok(graph)
}

/// Writes g2o's text format; see [`read_g2o`].
pub fn write_g2o(graph: &PoseGraph) -> String {
    match graph {
        PoseGraph::Se2(graph) => write_graph(graph),
        PoseGraph::Se3(graph) => write_graph(graph),
        PoseGraph::Sim3(graph) => write_graph(graph),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SE2: &str =
        "VERTEX_SE2 5 0 0 0\nVERTEX_SE2 9 1.5 0 0.25\nFIX 5\nEDGE_SE2 5 9 1 0 0 4 0.5 0 3 0 2\n";
    const SE3: &str = "# comment\n\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 3 0 0 0 -2\nEDGE_SE3:QUAT 0 1 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";

    #[test]
    fn what_is_written_is_read_back() {
        for text in [SE2, SE3] {
            let graph = read_g2o(text).unwrap();
            let again = read_g2o(&write_g2o(&graph)).unwrap();
            assert_eq!(graph.size(), again.size());
            assert!((graph.chi2() - again.chi2()).abs() < 1e-15);
        }
        let PoseGraph::Se2(graph) = read_g2o(SE2).unwrap() else {
            panic!("a planar graph");
        };
        assert_eq!((graph.ids, graph.fixed), (vec![5, 9], vec![0]));
        assert_eq!(graph.edges[0].information[(1, 0)], 0.5);
        let PoseGraph::Se3(graph) = read_g2o(SE3).unwrap() else {
            panic!("a spatial graph");
        };
        assert!(graph.chi2() < 1e-15);
    }

    #[test]
    fn quaternions_may_be_as_long_as_numbers_are() {
        let text = "VERTEX_SE3:QUAT 0 0 0 0 0 0 1.5e300 -1.5e300\n";
        let PoseGraph::Se3(graph) = read_g2o(text).unwrap() else {
            panic!("a spatial graph");
        };
        let turn = graph.vertices[0].rotation;
        assert!((turn.angle() - core::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let text = write_g2o(&PoseGraph::Se3(graph));
        assert!(read_g2o(&text).is_ok(), "{text}");
    }

    #[test]
    fn similarities_have_their_own_tags() {
        let mut graph = Graph::<Similarity3<f64>, 7> {
            ids: vec![0, 1],
            vertices: vec![Similarity3::identity(); 2],
            edges: Vec::new(),
            fixed: vec![],
        };
        graph.vertices[1] = Similarity3::from_isometry(Isometry3::translation(1.0, 2.0, 3.0), 2.0);
        graph.edges.push(Edge {
            from: 0,
            to: 1,
            from_from_to: graph.vertices[1],
            information: SMatrix::identity(),
        });
        let text = write_g2o(&PoseGraph::Sim3(graph.clone()));
        assert_eq!(read_g2o(&text).unwrap(), PoseGraph::Sim3(graph));
        assert!(read_g2o("VERTEX_SIM3:QUAT 0 0 0 0 0 0 0 1 -2\n").is_err());
    }

    #[test]
    fn malformed_texts_name_the_line() {
        for (bad, line, why) in [
            ("VERTEX_SE2 0 0 0\n", 1, "needs 4"),
            ("VERTEX_SE2 0 0 0 inf\n", 1, "finite"),
            ("VERTEX_SE2 -1 0 0 0\n", 1, "number of a vertex"),
            ("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 0 0 0\n", 2, "twice"),
            (
                "VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n",
                2,
                "another kind",
            ),
            ("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0\n", 1, "zero"),
            ("SOMETHING 1 2\n", 1, "not known"),
            ("VERTEX_XY 1 2 3\n", 1, "landmark"),
            ("VERTEX3 1 0 0 0 0 0 0\n", 1, "TORO"),
            (
                "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\nEDGE_SE3_PRIOR 1 0 5 0 0 0 0 0 1\n",
                2,
                "a prior of one pose",
            ),
            ("VERTEX_SE2 0 0,5 0 0\n", 1, "“0,5” has a decimal comma"),
            (
                "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 7 1 0 0 4 0 0 4 0 4\n",
                2,
                "no vertex 7",
            ),
            (
                "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 1 0 0 4 0 0 4 0 4\n",
                2,
                "itself",
            ),
            (
                "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 4 9 0 4 0 4\n",
                2,
                "semi-definite",
            ),
            ("VERTEX_SE2 0 0 0 0\nFIX 3\n", 2, "no vertex 3"),
        ] {
            match read_g2o(bad) {
                Err(Error::Malformed {
                    line: got,
                    message: said,
                }) => {
                    assert_eq!(got, Some(line), "{bad:?}");
                    assert!(said.contains(why), "{said}");
                }
                other => panic!("{bad:?} gave {other:?}"),
            }
        }
        assert!(matches!(
            read_g2o("\n"),
            Err(Error::Invalid(epipole::Error::TooFew { .. }))
        ));
    }
}
