//! Readers and writers of the files that multi-view geometry is stored in.
//!
//! Every format is a file of this crate, with its reader, its writer and the source of its
//! definition. Functions take and return bytes or text: opening files is the caller's part. Values
//! are converted to the conventions of [`epipole`]: pixel centers at integers, `cam_from_world`,
//! x right, y down, z forward.

mod bytes;
pub mod camera;
pub mod cloud;
mod colmap;
#[cfg(test)]
#[expect(
    dead_code,
    reason = "shared with the tests of the core, which damage texts, too"
)]
#[path = "../../epipole/tests/all/fuzz_formats/damage.rs"]
mod damage;
mod error;
#[cfg(test)]
mod fuzz;
pub mod matches;
pub mod model;
mod rotation;
mod table;
mod text;
pub mod trajectory;
mod tree;

pub use error::{Error, Result};
