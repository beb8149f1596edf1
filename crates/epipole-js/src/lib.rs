//! The core for JavaScript: functions of plain data, by name.
//!
//! A call reads its arguments ([`argument`], [`options`]), computes, and gives plain data
//! ([`answer`]); [`functions`] declares it. Files are named for the modules of the core. Each part
//! is a cargo feature and a WebAssembly module of its own. The same table gives the calls, the type
//! declarations in `web/vision/src/api.ts`, and the native results that tests compare bit for bit.

pub mod answer;
pub mod argument;
pub mod bridge;
pub mod fault;
pub mod functions;
pub mod options;
pub mod pairs;
pub mod types;
pub mod value;

#[cfg(feature = "absolute_pose")]
mod absolute_pose;
#[cfg(feature = "epipolar")]
mod epipolar;
#[cfg(feature = "homography")]
mod homography;
#[cfg(feature = "synthetic")]
mod synthetic;
#[cfg(feature = "epipolar")]
mod triangulation;

use epipole::progress::Monitor;
use fault::{Fault, Result};
use functions::{Function, Signature};
use types::Types;
use value::Value;

/// Functions of one file.
#[derive(Debug)]
pub struct Group {
    /// Part that the file belongs to.
    pub part: &'static str,
    /// Its functions.
    pub functions: &'static [Function],
}

/// Functions of the parts of this build.
pub const GROUPS: &[Group] = &[
    #[cfg(feature = "homography")]
    Group {
        part: "homography",
        functions: homography::FUNCTIONS,
    },
    #[cfg(feature = "epipolar")]
    Group {
        part: "epipolar",
        functions: epipolar::FUNCTIONS,
    },
    #[cfg(feature = "epipolar")]
    Group {
        part: "epipolar",
        functions: triangulation::FUNCTIONS,
    },
    #[cfg(feature = "absolute_pose")]
    Group {
        part: "absolute_pose",
        functions: absolute_pose::FUNCTIONS,
    },
    #[cfg(feature = "synthetic")]
    Group {
        part: "synthetic",
        functions: synthetic::FUNCTIONS,
    },
];

/// Signatures of [`GROUPS`], in the same order.
pub fn signatures(types: &mut Types) -> Vec<Vec<Signature>> {
    vec![
        #[cfg(feature = "homography")]
        homography::signatures(types),
        #[cfg(feature = "epipolar")]
        epipolar::signatures(types),
        #[cfg(feature = "epipolar")]
        triangulation::signatures(types),
        #[cfg(feature = "absolute_pose")]
        absolute_pose::signatures(types),
        #[cfg(feature = "synthetic")]
        synthetic::signatures(types),
    ]
}

/// Calls a function by its name in JavaScript.
///
/// # Errors
/// The error to throw.
pub fn call(name: &str, given: &[Value], monitor: &mut dyn Monitor) -> Result<Value> {
    let function = GROUPS
        .iter()
        .flat_map(|group| group.functions)
        .find(|function| value::camel(function.name) == name)
        .ok_or_else(|| Fault::of_type(format!("there is no function {name}")))?;
    (function.call)(given, monitor)
}
