//! Widgets that several panels use.

pub(crate) mod cloud;
pub(crate) mod controls;
pub(crate) mod look;
mod marks;
pub(crate) mod menu;
pub(crate) mod photo;
mod steer;
pub(crate) mod strips;

pub(crate) use marks::observations;
