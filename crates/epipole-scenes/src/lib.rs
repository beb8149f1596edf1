//! Photographs of still lifes with ground truth: exact depth, exact rays, exact correspondences.
//!
//! * [`Scene`]: a furnished room. [`Scene::still_life`] is a table by a window,
//!   [`Scene::long_table`] a hall with one movable object, [`Scene::studio`] a mug that moves and
//!   grows. A scene provides photographs with exact depth ([`Scene::render`]), exact rays
//!   ([`Scene::cast`]) and exact correspondences between any two cameras ([`Scene::transfer`]).
//! * [`Photograph::reproject`]: a photograph warped to another camera.
//!
//! A photograph is made in three steps. Surfaces are *painted* once into mipmapped textures. Light
//! is *baked* once into maps: the part of the window visible from each point of a surface, and how
//! open its surroundings are. A pixel then needs one ray, one texture look-up and one light
//! look-up; edges get eight more rays.
//!
//! Geometry is exact (`f64`, closed form or iterated to convergence), shading is `f32`. Pixels use
//! only the mathematical functions of `libm`, and depend on neither threads nor the platform.
//!
//! Each module uses only those listed before it:
//!
//! | module | contents |
//! |---|---|
//! | `shape` | cuboids, lathes and rings, with ray intersection |
//! | `paint` | noise, textures, and all painted surfaces |
//! | `objects` | bodies: a shape with its paint; objects on tables and walls |
//! | `light` | a window, soft light, and maps of both |
//! | `scene` | bodies with their light, rays through them |
//! | `sets` | the three scenes |
//! | `rendering` | rendering and reprojection |

mod detail;
mod gradual;
mod light;
mod objects;
mod paint;
mod rendering;
mod scene;
mod sets;
mod shape;

pub use rendering::reproject::{Moved, Reprojected};
pub use rendering::{Photograph, Sampling};
pub use scene::Scene;
pub use scene::rays::{Hit, Transfer};
pub use sets::{
    MovableKind, MovableObject, long_table_camera, still_life_camera, still_life_cloth,
    still_life_landscape,
};
