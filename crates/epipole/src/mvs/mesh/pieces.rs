//! Connected pieces of a mesh.

use super::surface::Mesh;
use crate::stereo::PointCloud;

/// Removes pieces with fewer triangles, and vertices without triangles.
pub(super) fn without_small(mesh: &Mesh, min_triangles: usize) -> Mesh {
    let mut parents: Vec<u32> = (0..mesh.vertices.points.len() as u32).collect();
    for &[a, b, c] in &mesh.triangles {
        for other in [b, c] {
            let (first, second) = (root(&mut parents, a), root(&mut parents, other));
            // The smaller index is the root.
            parents[first.max(second) as usize] = first.min(second);
        }
    }
    let mut counts = vec![0usize; parents.len()];
    for &[a, ..] in &mesh.triangles {
        counts[root(&mut parents, a) as usize] += 1;
    }
    let mut large = Mesh::default();
    let mut places: Vec<Option<u32>> = vec![None; parents.len()];
    for triangle in &mesh.triangles {
        if counts[root(&mut parents, triangle[0]) as usize] < min_triangles {
            continue;
        }
        let triangle = triangle.map(|vertex| {
            *places[vertex as usize]
                .get_or_insert_with(|| push(&mut large.vertices, &mesh.vertices, vertex as usize))
        });
        large.triangles.push(triangle);
    }
    large
}

/// Appends a vertex of another cloud. Returns its index.
fn push(to: &mut PointCloud, from: &PointCloud, vertex: usize) -> u32 {
    to.points.push(from.points[vertex]);
    to.normals.push(from.normals[vertex]);
    to.colors.push(from.colors[vertex]);
    to.points.len() as u32 - 1
}

/// Returns the root of a vertex; shortens the path to it.
fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let parent = parents[vertex as usize];
        parents[vertex as usize] = parents[parent as usize];
        vertex = parent;
    }
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Vector3};

    #[test]
    fn small_pieces_are_left_out() {
        let vertices = PointCloud {
            points: (0..8)
                .map(|n| Point3::new(f64::from(n), 0.0, 0.0))
                .collect(),
            normals: vec![Vector3::z(); 8],
            colors: (0..8).map(|n| [n; 3]).collect(),
            confidences: Vec::new(),
        };
        let mesh = Mesh {
            vertices,
            triangles: vec![[0, 1, 2], [7, 6, 5], [5, 4, 7]],
        };
        let large = without_small(&mesh, 2);
        assert_eq!(large.triangles, [[0, 1, 2], [2, 3, 0]]);
        let colors: Vec<u8> = large.vertices.colors.iter().map(|color| color[0]).collect();
        assert_eq!(colors, [7, 6, 5, 4]);
        assert_eq!(without_small(&mesh, 3), Mesh::default());
        assert_eq!(without_small(&mesh, 1).vertices.points.len(), 7);
    }
}
