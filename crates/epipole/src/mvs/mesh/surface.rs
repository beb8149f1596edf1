//! A surface of triangles.

use crate::stereo::PointCloud;

/// A surface of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertices with normals and colors.
    pub vertices: PointCloud,
    /// Indices of the vertices, counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}
