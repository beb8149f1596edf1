//! The authors' vocabulary.

pub(crate) mod blocks;
pub(crate) mod expand;
pub(crate) mod gallery;
pub(crate) mod operate;
pub mod quiz;
pub(crate) mod small;
