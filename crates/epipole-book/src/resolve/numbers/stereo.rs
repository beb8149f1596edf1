//! Numbers of the chapter on stereo.

use super::entry::Number::Real;
use super::entry::{Entry, sentence};
use epipole::stereo::depth_from_disparity;

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "stereo.disparity",
        parameters: &["left", "right"],
        summary: "difference of the columns, pixels",
        compute: |a| Ok(Real(a.get("left") - a.get("right"), 0)),
    },
    Entry {
        name: "stereo.depth",
        parameters: &["f", "b", "d"],
        summary: "depth from the disparity d, meters",
        compute: |a| {
            depth_from_disparity(a.get("f"), a.get("b"), a.get("d"))
                .map(|depth_m| Real(depth_m, 2))
                .map_err(sentence)
        },
    },
    Entry {
        name: "stereo.depth-error",
        parameters: &["f", "b", "z"],
        summary: "what one pixel of disparity costs at the depth z, Z² / (f B), meters",
        compute: |a| {
            let (focal_px, baseline_m, depth_m) = (a.get("f"), a.get("b"), a.get("z"));
            Ok(Real(depth_m * depth_m / (focal_px * baseline_m), 2))
        },
    },
];
