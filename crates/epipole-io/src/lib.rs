//! Readers and writers of the file formats of multi-view geometry.
//!
//! Each format has a source file with its reader, its writer and the reference of its definition.
//! Functions take and return bytes or text; callers open files. Values are converted to the
//! conventions of [`epipole`]: pixel centers at integers, `cam_from_world`, x right, y down, z
//! forward.

#![cfg_attr(
    not(feature = "cameras"),
    allow(dead_code, reason = "some parts serve cameras and models only")
)]

pub mod bundle;
mod bytes;
#[cfg(feature = "cameras")]
pub mod camera;
pub mod cloud;
#[cfg(feature = "cameras")]
mod colmap;
#[cfg(test)]
mod damage;
pub mod depth_map;
pub mod disparity;
mod error;
#[cfg(test)]
mod fuzz;
#[cfg(feature = "cameras")]
mod gltf;
pub mod matches;
#[cfg(feature = "cameras")]
pub mod mesh;
#[cfg(feature = "cameras")]
pub mod model;
#[cfg(feature = "photos")]
pub mod photo;
pub mod pose_graph;
mod rotation;
#[cfg(test)]
mod shared;
mod table;
mod text;
mod tokens;
pub mod trajectory;
#[cfg(feature = "cameras")]
mod tree;

pub use error::{Error, Result};

/// The examples of the package's README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
