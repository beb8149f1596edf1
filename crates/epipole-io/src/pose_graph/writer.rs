//! Writer of g2o's text format.

use super::pose::Written;
use epipole::sfm::Graph;
use nalgebra::SMatrix;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Appends a line: tag, numbers of vertices, numbers.
fn write_line(text: &mut String, tag: &str, ids: &[u64], numbers: &[f64]) {
    text.push_str(tag);
    // Writing to a string cannot fail.
    for id in ids {
        let _ = write!(text, " {id}");
    }
    for number in numbers {
        let _ = write!(text, " {number}");
    }
    text.push('\n');
}

/// Appends the upper triangle of the first rows and columns of a matrix, row by row.
fn push_upper<const D: usize>(numbers: &mut Vec<f64>, matrix: &SMatrix<f64, D, D>, rank: usize) {
    for i in 0..rank {
        numbers.extend((i..rank).map(|j| matrix[(i, j)]));
    }
}

pub(super) fn write_graph<T: Written<D>, const D: usize>(graph: &Graph<T, D>) -> String {
    let mut text = String::new();
    let mut numbers = Vec::new();
    let landmarks: BTreeSet<usize> = graph.landmarks.iter().copied().collect();
    if T::HAS_OFFSET && !(graph.priors.is_empty() && landmarks.is_empty()) {
        text.push_str("PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n");
    }
    for (index, (&id, vertex)) in graph.ids.iter().zip(&graph.vertices).enumerate() {
        numbers.clear();
        vertex.write(&mut numbers);
        match landmarks.contains(&index) {
            true => write_line(&mut text, T::LANDMARK, &[id], &numbers[..T::NUM_AXES]),
            false => write_line(&mut text, T::VERTEX, &[id], &numbers),
        }
    }
    for &vertex in &graph.fixed {
        write_line(&mut text, "FIX", &[graph.ids[vertex]], &[]);
    }
    for edge in &graph.edges {
        numbers.clear();
        edge.from_from_to.write(&mut numbers);
        let ids = [graph.ids[edge.from], graph.ids[edge.to], 0];
        if landmarks.contains(&edge.to) {
            numbers.truncate(T::NUM_AXES);
            push_upper(&mut numbers, &edge.information, T::NUM_AXES);
            let num_ids = 2 + usize::from(T::HAS_OFFSET);
            write_line(&mut text, T::SIGHTING, &ids[..num_ids], &numbers);
        } else {
            push_upper(&mut numbers, &edge.information, D);
            write_line(&mut text, T::EDGE, &ids[..2], &numbers);
        }
    }
    for prior in &graph.priors {
        numbers.clear();
        prior.world_from_vertex.write(&mut numbers);
        push_upper(&mut numbers, &prior.information, D);
        let ids = [graph.ids[prior.vertex], 0];
        let num_ids = 1 + usize::from(T::HAS_OFFSET);
        write_line(&mut text, T::PRIOR, &ids[..num_ids], &numbers);
    }
    text
}
