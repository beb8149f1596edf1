//! Seeded worlds with ground truth: ray-cast photographs, point clouds, camera paths.
//!
//! * [`Scene`]: a furnished room. [`Scene::still_life`] is a table by a window,
//!   [`Scene::long_table`] a hall with one thing that moves, [`Scene::studio`] a mug that moves and
//!   grows. A scene gives photographs with exact
//!   depth ([`Scene::render`]), exact rays ([`Scene::cast`]) and exact correspondences between
//!   any two cameras ([`Scene::transfer`]).
//! * [`TwoViewProblem`] and [`MultiViewProblem`]: random points seen by known cameras, with noise
//!   and outliers of a known size.
//!
//! A photograph is made in three steps. Surfaces are *painted* once into textures, with their
//! smaller copies for distant views. Light is *baked* once into maps: the part of the window that
//! each place of a surface sees, and how open its surroundings are. A pixel then needs one ray,
//! one look into the texture and one into the light; edges get eight rays more.
//!
//! Geometry is exact (`f64`, closed form or iterated to convergence), shading is `f32`. No
//! function outside of `libm` and nothing that depends on threads or the platform touches a pixel.

mod body;
mod gradual;
mod light;
mod long_table;
mod noise;
mod paint;
mod render;
mod reproject;
mod scene;
mod shading;
mod shape;
mod still_life;
mod studio;
mod texture;
mod view;
mod wares;
mod worlds;

pub use long_table::{MovableKind, MovableObject, long_table_camera};
pub use render::{Photograph, Sampling};
pub use reproject::{Moved, Reprojected};
pub use scene::{Hit, Scene, Transfer};
pub use still_life::still_life_camera;
pub use worlds::{
    MultiViewProblem, MultiViewProblemOptions, Path, Sighting, Structure, TwoViewProblem,
    TwoViewProblemOptions,
};
