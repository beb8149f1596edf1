//! Software rendering of points and cameras in 3D: point clouds of millions that the user rotates.
//!
//! Every pixel keeps the depth and the index of its point, so a click needs no search. Figures do
//! not use this module, so their pages do not include it.
//!
//! ```
//! use epipole_canvas::cloud::{Frame, Look, Orbit, Scene};
//! let scene = Scene { points: vec![([0.0, 0.0, 0.0], [255, 0, 0])], ..Scene::default() };
//! let orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
//! let mut frame = Frame::default();
//! frame.draw(&scene, &orbit, (64, 48), &Look::default());
//! assert_eq!(frame.pick(32.0, 24.0, 3), Some(0));
//! ```

mod frame;
mod orbit;
mod outermost;
mod perspective;
mod picture;
mod surface;

pub use frame::{Frame, Look};
pub use orbit::Orbit;
pub use picture::Picture;

/// Content of a 3D view.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Positions and colors of points.
    pub points: Vec<([f32; 3], [u8; 3])>,
    /// Index of the first vertex: from it on, points are vertices of triangles, and are drawn only
    /// in coarse pictures.
    pub first_vertex: usize,
    /// Vertices of each triangle, as indices from the first vertex.
    pub triangles: Vec<[u32; 3]>,
    /// Lines, such as the edges of a camera's frustum.
    pub lines: Vec<Line>,
    /// Photographs in the scene.
    pub pictures: Vec<Picture>,
}

/// A line between two points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Start.
    pub from: [f32; 3],
    /// End.
    pub to: [f32; 3],
    /// Its color.
    pub color: [u8; 3],
}
