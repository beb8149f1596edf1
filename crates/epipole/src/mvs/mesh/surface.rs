//! Triangle meshes.

use crate::stereo::PointCloud;

/// A triangle mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertices with normals and colors.
    pub vertices: PointCloud,
    /// Indices of the vertices, counterclockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}
