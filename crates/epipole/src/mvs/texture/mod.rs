//! Texture of a mesh from the photos.

mod adjacency;
mod charts;
mod labels;
mod leveling;
mod mesh_texture;
mod options;
mod raster;
mod texturing;
mod visibility;

pub use mesh_texture::MeshTexture;
pub use options::TextureOptions;
pub use texturing::texture_mesh;
