//! Panoramas: stitching of photos from one position, or of one plane.
//!
//! [`find_overlap`] verifies the matches of two photos by a homography. [`estimate_panorama`]
//! estimates the rotations of all photos with a common focal length, [`chain_homographies`] their
//! positions on a plane. [`render_panorama`] blends the photos on a [`Surface`].
//!
//! Source: Brown & Lowe 2007, "Automatic panoramic image stitching using invariant features".

mod blend;
mod canvas;
mod flat;
mod gains;
mod jacobian;
mod layer;
mod level;
mod overlap;
mod panorama;
mod render;
mod rotations;
mod surface;
mod tree;

pub use flat::chain_homographies;
pub use overlap::{Overlap, OverlapOptions, find_overlap};
pub use panorama::{Panorama, estimate_panorama};
pub use render::{Blend, RenderOptions, render_panorama};
pub use surface::Surface;
