//! Point clouds with colors, normals and confidences.

use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::images::colors;
use crate::output::{Bytes, Floats, Numbers, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::stereo::PointCloud;

structs! {
    /// Points in space: entry k of each array belongs to point k; optional arrays may be empty.
    struct Points as PointCloud {
        /// Positions, interleaved.
        points: Numbers,
        /// Colors, 3 bytes each.
        colors: Bytes,
        /// Unit normals, interleaved.
        normals: Numbers,
        /// Number of photos that agree on each point.
        confidences: Floats,
    }
}

/// A point cloud as plain arrays.
pub(crate) struct Cloud(pub(crate) PointCloud);

impl Output for Cloud {
    fn typescript(types: &mut Types) -> String {
        Points::typescript(types)
    }

    fn into_value(self) -> Value {
        let Self(cloud) = self;
        let normals = cloud.normals.iter().flat_map(|n| [n.x, n.y, n.z]);
        let points = Points {
            points: Numbers::of_points(&cloud.points),
            normals: Numbers(normals.collect()),
            colors: Bytes(cloud.colors.into_flattened()),
            confidences: Floats(cloud.confidences),
        };
        points.into_value()
    }
}

impl Argument for Cloud {
    fn typescript(types: &mut Types) -> String {
        let points = Vectors::<3>::typescript(types);
        types.interface(
            "PointCloudLike",
            "Points in space: entry k of each array belongs to point k.",
            &[
                ("points", &points, "Positions."),
                (
                    "colors?",
                    "Uint8Array | Uint8ClampedArray",
                    "Colors, 3 bytes each.",
                ),
                ("normals?", &points, "Unit normals."),
                (
                    "confidences?",
                    "ArrayLike<number>",
                    "Number of photos that agree on each point.",
                ),
            ],
        );
        "PointCloudLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = ["points", "colors", "normals", "confidences"];
        check_keys(name, value, &keys)?;
        let points = entry::<Vectors<3>>(name, value, "points")?.points();
        let colors = colors(name, value, "point")?.unwrap_or_default();
        let normals = entry::<Option<Vectors<3>>>(name, value, "normals")?;
        let normals = normals.map_or(Vec::new(), |list| list.0);
        let confidences = entry::<Option<Vectors<1>>>(name, value, "confidences")?;
        let confidences = confidences.map_or(Vec::new(), |list| list.0);
        for (key, got) in [
            ("colors", colors.len()),
            ("normals", normals.len()),
            ("confidences", confidences.len()),
        ] {
            if got != 0 && got != points.len() {
                return Err(Fault::of_range(format!(
                    "{name}.{key} must have {} entries, as many as points, but has {got}",
                    points.len()
                )));
            }
        }
        Ok(Self(PointCloud {
            points,
            colors,
            normals,
            confidences: confidences.iter().map(|value| value[0] as f32).collect(),
        }))
    }
}
