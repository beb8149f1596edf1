//! Numbers of the chapter on matching.

use super::entry::Number::Real;
use super::entry::{Entry, sentence};
use epipole::feature::{Descriptors, Keypoint, describe_patches, nearest_few, nearest_two};
use epipole::imaging::gray_from_values;

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "matching.patch-distance",
        parameters: &["a", "b", "c", "d", "e", "f", "g", "h", "normalized"],
        summary: "distance of the 2 × 2 patches (a, b, c, d) and (e, f, g, h), of gray values or normalized",
        compute: |a| {
            let [first, second] = [["a", "b", "c", "d"], ["e", "f", "g", "h"]]
                .map(|names| names.map(|name| a.get(name) as f32).to_vec());
            let described = |values: Vec<f32>| match a.count("normalized")? {
                0 => Descriptors::from_floats(4, values).map_err(sentence),
                _ => {
                    let image = gray_from_values(2, 2, values).map_err(sentence)?;
                    let middle = [Keypoint::at(0.5, 0.5, 1.0)];
                    describe_patches(&image, &middle, 2, 1.0, &mut ()).map_err(sentence)
                }
            };
            let query = described(first)?.get(0).unwrap_or_default();
            let found = nearest_few(&query, &described(second)?, 1).map_err(sentence)?;
            let distance = found.first().map_or(f64::NAN, |(_, far)| f64::from(*far));
            Ok(Real(distance, 1))
        },
    },
    Entry {
        name: "matching.ratio",
        parameters: &["d1", "d2"],
        summary: "distance of the nearest over that of the second nearest",
        compute: |a| {
            let list = |values| Descriptors::from_floats(1, values).map_err(sentence);
            let second = list(vec![a.get("d1") as f32, -a.get("d2") as f32])?;
            let nearest = nearest_two(&list(vec![0.0])?, &second, &mut ()).map_err(sentence)?[0];
            let second = nearest.second_distance.unwrap_or(f32::NAN);
            Ok(Real(f64::from(nearest.distance) / f64::from(second), 3))
        },
    },
];
