//! Widgets that several panels use.

pub(crate) mod cloud;
pub(crate) mod controls;
pub(crate) mod empty;
mod ground;
pub(crate) mod lasso;
pub(crate) mod look;
mod marks;
pub(crate) mod menu;
pub(crate) mod photo;
pub(crate) mod pick;
pub(crate) mod scene;
mod shade;
mod steer;
pub(crate) mod strips;
mod through;
pub(crate) mod verdict;

pub(crate) use marks::{dense_anchor, has_dense, observations, vertex_anchor};
