//! Photographs of a scene, and their reprojection.

mod film;
mod outline;
mod render;
pub(crate) mod reproject;
mod shading;
mod view;

use image::{ImageBuffer, Luma, RgbImage};

/// Quality of rendering.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// One ray per pixel, coarse textures and light, for small pictures during a drag. The first
    /// draft takes milliseconds, the first sharp photograph of a scene half a second.
    Draft,
    /// Smooth edges and textures.
    Full,
}

/// A rendered picture with its ground truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Photograph {
    /// The picture, sRGB.
    pub image: RgbImage,
    /// Depth along the optical axis at every pixel center, meters; finite everywhere, since a room
    /// has walls.
    pub depth_m: ImageBuffer<Luma<f32>, Vec<f32>>,
}

impl Photograph {
    /// Creates a black picture with depth 0, for [`Scene::render_rows`](crate::Scene::render_rows).
    pub fn blank(width: u32, height: u32) -> Self {
        Self {
            image: RgbImage::new(width, height),
            depth_m: ImageBuffer::new(width, height),
        }
    }
}
