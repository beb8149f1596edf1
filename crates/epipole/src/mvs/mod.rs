//! Multi-view stereo: dense depth maps, point clouds and meshes from photos with known cameras.
//!
//! 1. [`prepare_views`] undistorts the photos of a [`Reconstruction`](crate::sfm::Reconstruction),
//!    downscales them, and chooses the neighbors and the depth range of each: an [`MvsView`].
//! 2. [`estimate_depth_maps`] estimates a depth and a normal for each pixel by PatchMatch, coarse
//!    to fine, and keeps those that neighbors confirm: a [`DepthMap`].
//! 3. [`fuse_depth_maps`] fuses them to a point cloud with normals, colors and confidences,
//!    [`mesh_depth_maps`] to a triangle mesh: a [`Mesh`].
//!
//! ```
//! # fn main() -> Result<(), epipole::Error> {
//! use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
//! use epipole::image::{Rgb, RgbImage};
//! use epipole::mvs::{MeshOptions, MvsOptions, prepare_views};
//! use epipole::mvs::{estimate_depth_maps, fuse_depth_maps, mesh_depth_maps};
//! use epipole::nalgebra::Point3;
//! use epipole::sfm::{Reconstruction, ScenePoint, TrackElement};
//! // A wall at a depth of 2, seen from positions 0.1 apart: f B / Z = 5 pixels.
//! let wall = |u: u32, v: u32| {
//!     let (u, v) = (f64::from(u), f64::from(v));
//!     let waves = libm::sin(0.61 * u + 0.13 * v) + libm::sin(0.29 * u - 0.47 * v)
//!         + libm::sin(0.011 * u * u + 0.83 * v);
//!     Rgb([(128.0 + 40.0 * waves) as u8; 3])
//! };
//! let photo = |n: u32| RgbImage::from_fn(72, 54, move |u, v| wall(u + 5 * n, v));
//! let photos: Vec<RgbImage> = (0..3).map(photo).collect();
//! let camera = Camera::pinhole(Intrinsics::centered(100.0, 72, 54)?, 72, 54);
//! let posed = |n: u32| PosedCamera {
//!     camera,
//!     cam_from_world: RigidTransform::translation(-0.1 * f64::from(n), 0.0, 0.0),
//! };
//! let point = |n: u32| ScenePoint {
//!     position: Point3::new(0.1 * f64::from(n), 0.0, 2.0),
//!     color: [0; 3],
//!     track: (0..3).map(|image| TrackElement { image, keypoint: 0 }).collect(),
//!     error_px: 0.0,
//! };
//! let known = Reconstruction {
//!     cameras: (0..3).map(|n| Some(posed(n))).collect(),
//!     points: (0..5).map(point).collect(),
//!     ..Reconstruction::default()
//! };
//!
//! let options = MvsOptions::default();
//! let views = prepare_views(&known, &photos, &options, &mut ())?;
//! let maps = estimate_depth_maps(&views, &options, &mut ())?;
//! assert!((maps[1].depth.get_pixel(36, 27).0[0] - 2.0).abs() < 0.02);
//! let cloud = fuse_depth_maps(&views, &maps, &options, &mut ())?;
//! assert!(cloud.normals[cloud.points.len() / 2].z < -0.9);
//! let mesh = mesh_depth_maps(&views, &maps, &MeshOptions::default(), &mut ())?;
//! assert!(mesh.triangles.len() > 500);
//! # Ok(()) }
//! ```
//!
//! Source: Galliani, Lasinger & Schindler 2015, "Massively parallel multiview stereopsis by surface
//! normal diffusion"; Schönberger et al. 2016, "Pixelwise view selection for unstructured
//! multi-view stereo"; Xu & Tao 2019, "Multi-scale geometric consistency guided multi-view stereo".

mod consistency;
mod depth_map;
mod depth_maps;
mod field;
mod fusion;
mod hypothesis_cost;
mod level;
mod mesh;
mod neighbors;
mod options;
mod pair;
mod patch;
mod plane;
mod sweep;
mod texture;
mod views;

pub use depth_map::DepthMap;
pub use depth_maps::estimate_depth_maps;
pub use fusion::fuse_depth_maps;
pub use mesh::{Mesh, MeshOptions, mesh_depth_maps};
pub use options::MvsOptions;
pub use texture::{MeshTexture, TextureOptions, texture_mesh};
pub use views::{MvsView, prepare_views};
