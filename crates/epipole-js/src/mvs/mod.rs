//! Multi-view stereo: depth maps, point clouds and meshes from photos with known cameras.

pub(crate) mod cloud;
pub(crate) mod depth_map;
pub(crate) mod mesh;
pub(crate) mod view;
