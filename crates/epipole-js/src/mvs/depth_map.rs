//! Depth and normal of each pixel, and their fusion to a cloud.

use super::cloud::Cloud;
use crate::argument::{Argument, Vectors, check_keys, entry, not};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Bytes, Floats, Output, structs};
use crate::stereo::Disparity;
use crate::types::Types;
use crate::value::Value;
use epipole::imaging::GrayImage32;
use epipole::mvs::{self, DepthMap, MvsOptions, MvsView};

structs! {
    /// Depth and normal of each pixel of a view, row by row.
    struct Map as DepthMap {
        /// Depth along the optical axis, in the unit of the reconstruction; NaN if unknown.
        depth: GrayImage32,
        /// Unit normals in the camera's frame, towards the camera, 3 numbers each; 0 without depth.
        normals: Floats,
        /// Number of photos that agree on the depth, including this one; 0 without depth.
        num_views: Bytes,
    }
}

impl Output for DepthMap {
    fn typescript(types: &mut Types) -> String {
        Map::typescript(types)
    }

    fn into_value(self) -> Value {
        let normals = self.normals.iter().flat_map(|n| [n.x, n.y, n.z]);
        let map = Map {
            normals: Floats(normals.collect()),
            num_views: Bytes(self.num_views),
            depth: self.depth,
        };
        map.into_value()
    }
}

impl Argument for DepthMap {
    fn typescript(types: &mut Types) -> String {
        <Self as Output>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["depth", "normals", "numViews"])?;
        let depth = entry::<Disparity>(name, value, "depth")?.0.into_image();
        let normals = entry::<Vectors<3>>(name, value, "normals")?.0;
        let Value::Bytes(num_views) = value.get("numViews") else {
            let key = format!("{name}.numViews");
            return Err(not(&key, "a Uint8Array", value.get("numViews")));
        };
        let count = depth.as_raw().len();
        for (key, got) in [("normals", normals.len()), ("numViews", num_views.len())] {
            if got != count {
                return Err(Fault::of_range(format!(
                    "{name}.{key} must have {count} entries, one for each pixel, but has {got}"
                )));
            }
        }
        Ok(Self {
            depth,
            normals: normals.iter().map(|normal| normal.cast()).collect(),
            num_views: num_views.clone(),
        })
    }
}

functions! {
    /// Depth and normal of each pixel of each view by PatchMatch, where enough views agree.
    fn estimate_depth_maps(
        views: Vec<MvsView>, options: Options<MvsOptions>; monitor
    ) -> Vec<DepthMap> {
        mvs::estimate_depth_maps(&views, &options.0, monitor)?
    }

    /// Point cloud of depth maps, with normals, colors and confidences.
    fn fuse_depth_maps(
        views: Vec<MvsView>, maps: Vec<DepthMap>, options: Options<MvsOptions>; monitor
    ) -> Cloud {
        Cloud(mvs::fuse_depth_maps(&views, &maps, &options.0, monitor)?)
    }
}
