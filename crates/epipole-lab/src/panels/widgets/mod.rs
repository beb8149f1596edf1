//! Widgets that several panels use.

mod camera_view;
pub(crate) mod cloud;
pub(crate) mod controls;
pub(crate) mod empty;
mod ground;
mod lasso;
pub(crate) mod look;
mod marks;
pub(crate) mod menu;
pub(crate) mod photo;
pub(crate) mod pick;
mod scene;
pub(crate) mod scene_inputs;
pub(crate) mod selection;
mod shade;
mod steer;
pub(crate) mod strips;
mod through;
pub(crate) mod verdict;

pub(crate) use marks::{dense_anchor, has_dense, observations, vertex_anchor};
