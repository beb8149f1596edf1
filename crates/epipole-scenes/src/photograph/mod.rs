//! Photographs of a scene, and what they look like from elsewhere.

mod film;
mod outline;
mod render;
pub(crate) mod reproject;
mod shading;
mod view;

use image::{ImageBuffer, Luma, RgbImage};

/// How carefully to render.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// One ray a pixel, coarse textures and light: for small pictures while something is dragged. The
    /// first one takes milliseconds, where the first sharp photograph of a scene takes half a second.
    Draft,
    /// Smooth edges and textures.
    Full,
}

/// A rendered picture with its ground truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Photograph {
    /// The picture, sRGB.
    pub image: RgbImage,
    /// Depth along the optical axis at every pixel center, meters; finite everywhere, since a
    /// room has walls.
    pub depth_m: ImageBuffer<Luma<f32>, Vec<f32>>,
}

impl Photograph {
    /// A black picture at depth 0, to be filled by [`Scene::render_rows`](crate::Scene::render_rows).
    pub fn blank(width: u32, height: u32) -> Self {
        Self {
            image: RgbImage::new(width, height),
            depth_m: ImageBuffer::new(width, height),
        }
    }
}
