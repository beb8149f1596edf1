//! Triangle mesh from depth maps.

mod blocks;
mod meshing;
mod options;
mod pieces;
mod signed_distance;
mod surface;
mod surface_nets;

pub use meshing::mesh_depth_maps;
pub use options::MeshOptions;
pub use surface::Mesh;
