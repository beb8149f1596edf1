//! Textures of meshes.

use image::RgbImage;
use nalgebra::Point2;

/// The texture of a [`Mesh`](crate::mvs::Mesh): one image, and a pixel of it for each corner of
/// each triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshTexture {
    /// The image. Black where no triangle needs it.
    pub image: RgbImage,
    /// Pixels of the corners of each triangle, in the order of its vertices; pixel centers at
    /// integers.
    pub corners: Vec<[Point2<f32>; 3]>,
}
