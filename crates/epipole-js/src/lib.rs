//! The core for JavaScript: functions with plain data, called by name.
//!
//! A call reads its arguments ([`argument`], [`options`]), computes, and returns plain data
//! ([`output`]); [`functions`] declares it. Files have the names of the core's modules. Each part
//! is a cargo feature and a WebAssembly module; larger parts contain smaller ones. The same table
//! defines the calls, the type declarations in `web/vision/src/api.ts`, and the native results that
//! tests compare bit for bit.

pub mod argument;
pub mod bridge;
pub mod fault;
pub mod functions;
pub mod options;
pub mod output;
pub mod pairs;
pub mod types;
pub mod value;

#[cfg(feature = "geometry")]
mod absolute_pose;
#[cfg(feature = "images")]
mod calibration;
#[cfg(feature = "geometry")]
mod camera;
#[cfg(feature = "geometry")]
mod epipolar;
#[cfg(feature = "images")]
mod feature;
#[cfg(feature = "homography")]
mod homography;
#[cfg(feature = "images")]
pub mod images;
#[cfg(feature = "images")]
mod imaging;
#[cfg(feature = "all")]
mod math;
#[cfg(feature = "all")]
mod mvs;
#[cfg(feature = "all")]
mod optim;
#[cfg(feature = "geometry")]
mod robust;
#[cfg(feature = "all")]
mod sfm;
#[cfg(feature = "images")]
mod stereo;
#[cfg(feature = "all")]
mod stitch;
#[cfg(feature = "geometry")]
mod synthetic;
#[cfg(feature = "geometry")]
mod triangulation;
#[cfg(feature = "geometry")]
mod two_view;

use epipole::progress::Monitor;
use fault::{Fault, Result};
use functions::{Function, Signature};
use types::Types;
use value::Value;

/// Parts, smallest first, each with the larger parts that contain it; these are the features of
/// `Cargo.toml`.
pub const PARTS: &[(&str, &[&str])] = &[
    ("homography", &["geometry", "all"]),
    ("geometry", &["all"]),
    ("images", &["all"]),
    ("all", &[]),
];

/// Functions of one file.
#[derive(Debug)]
pub struct Group {
    /// Smallest part that contains the file.
    pub part: &'static str,
    /// Its functions.
    pub functions: &'static [Function],
}

/// Functions of the parts in this build.
pub const GROUPS: &[Group] = &[
    #[cfg(feature = "homography")]
    Group {
        part: "homography",
        functions: homography::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: camera::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: homography::calibrated::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: epipolar::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: triangulation::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: absolute_pose::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: robust::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: two_view::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: two_view::degeneracy::FUNCTIONS,
    },
    #[cfg(feature = "geometry")]
    Group {
        part: "geometry",
        functions: synthetic::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: imaging::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: imaging::pyramid::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: feature::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: feature::window::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: stereo::FUNCTIONS,
    },
    #[cfg(feature = "images")]
    Group {
        part: "images",
        functions: calibration::undistort::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: calibration::board::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: calibration::calibrate::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::two_view_reconstruction::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::bundle::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::photos::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::reconstruction::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::pose_graph::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::features::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::tracks::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::known_poses::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::odometry::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::scene::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::unregistered::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::alignment::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: sfm::loops::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: mvs::view::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: mvs::depth_map::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: mvs::mesh::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: stitch::FUNCTIONS,
    },
    #[cfg(feature = "all")]
    Group {
        part: "all",
        functions: math::FUNCTIONS,
    },
];

/// Returns the signatures of [`GROUPS`], in the same order.
pub fn signatures(types: &mut Types) -> Vec<Vec<Signature>> {
    vec![
        #[cfg(feature = "homography")]
        homography::signatures(types),
        #[cfg(feature = "geometry")]
        camera::signatures(types),
        #[cfg(feature = "geometry")]
        homography::calibrated::signatures(types),
        #[cfg(feature = "geometry")]
        epipolar::signatures(types),
        #[cfg(feature = "geometry")]
        triangulation::signatures(types),
        #[cfg(feature = "geometry")]
        absolute_pose::signatures(types),
        #[cfg(feature = "geometry")]
        robust::signatures(types),
        #[cfg(feature = "geometry")]
        two_view::signatures(types),
        #[cfg(feature = "geometry")]
        two_view::degeneracy::signatures(types),
        #[cfg(feature = "geometry")]
        synthetic::signatures(types),
        #[cfg(feature = "images")]
        imaging::signatures(types),
        #[cfg(feature = "images")]
        imaging::pyramid::signatures(types),
        #[cfg(feature = "images")]
        feature::signatures(types),
        #[cfg(feature = "images")]
        feature::window::signatures(types),
        #[cfg(feature = "images")]
        stereo::signatures(types),
        #[cfg(feature = "images")]
        calibration::undistort::signatures(types),
        #[cfg(feature = "all")]
        calibration::board::signatures(types),
        #[cfg(feature = "all")]
        calibration::calibrate::signatures(types),
        #[cfg(feature = "all")]
        sfm::two_view_reconstruction::signatures(types),
        #[cfg(feature = "all")]
        sfm::bundle::signatures(types),
        #[cfg(feature = "all")]
        sfm::photos::signatures(types),
        #[cfg(feature = "all")]
        sfm::reconstruction::signatures(types),
        #[cfg(feature = "all")]
        sfm::pose_graph::signatures(types),
        #[cfg(feature = "all")]
        sfm::features::signatures(types),
        #[cfg(feature = "all")]
        sfm::tracks::signatures(types),
        #[cfg(feature = "all")]
        sfm::known_poses::signatures(types),
        #[cfg(feature = "all")]
        sfm::odometry::signatures(types),
        #[cfg(feature = "all")]
        sfm::scene::signatures(types),
        #[cfg(feature = "all")]
        sfm::unregistered::signatures(types),
        #[cfg(feature = "all")]
        sfm::alignment::signatures(types),
        #[cfg(feature = "all")]
        sfm::loops::signatures(types),
        #[cfg(feature = "all")]
        mvs::view::signatures(types),
        #[cfg(feature = "all")]
        mvs::depth_map::signatures(types),
        #[cfg(feature = "all")]
        mvs::mesh::signatures(types),
        #[cfg(feature = "all")]
        stitch::signatures(types),
        #[cfg(feature = "all")]
        math::signatures(types),
    ]
}

/// Calls a function by its JavaScript name.
///
/// # Errors
/// The error to throw.
pub fn call(name: &str, values: &[Value], monitor: &mut dyn Monitor) -> Result<Value> {
    let function = GROUPS
        .iter()
        .flat_map(|group| group.functions)
        .find(|function| value::camel(function.name) == name)
        .ok_or_else(|| Fault::of_type(format!("there is no function {name}")))?;
    (function.call)(values, monitor)
}
