//! Points and cameras in space, drawn on the processor: a point cloud of millions that one turns.
//!
//! Every pixel keeps the depth and the number of the point that it shows, so a click finds a point
//! without a search. No figure uses this room, so a page of figures does not carry it.
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

pub use frame::{Frame, Look};
pub use orbit::Orbit;
pub use picture::Picture;

/// What is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Places and colors.
    pub points: Vec<([f32; 3], [u8; 3])>,
    /// Lines, such as the edges of a camera's frustum.
    pub lines: Vec<Line>,
    /// Photographs that stand in the space.
    pub pictures: Vec<Picture>,
}

/// A line between two places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where it begins.
    pub from: [f32; 3],
    /// Where it ends.
    pub to: [f32; 3],
    /// Its color.
    pub color: [u8; 3],
}
