//! Seeded worlds with ground truth: ray-cast photographs, point clouds, camera paths.

mod body;
mod light;
mod noise;
mod paint;
mod render;
mod scene;
mod shading;
mod shape;
mod still_life;
mod texture;
mod wares;

pub use render::{Photograph, Sampling};
pub use scene::{Hit, Scene, Transfer};
pub use still_life::still_life_camera;
