//! Any file that people write or edit gives an answer or an error, never a panic, and every number
//! in the answer is finite. As for the formats of the core: a thousand cases each, or
//! `EPIPOLE_FUZZ_CASES`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../../epipole/tests/all/fuzz_formats/damage.rs"]
mod damage;

use crate::commands::sfm::positions;
use crate::failure::Failure;
use crate::{lens, rows};
use damage::{config, damage_text, some_damage};
use proptest::prelude::*;
use std::path::Path;

const CAMERA: &str = r#"{ "image": { "width": 640, "height": 480 },
 "k": [ 532.8 , 532.9 , 342.5 , 233.9 ],
 "distortion": { "model": "brown", "coefficients": [ -0.28 , 0.03 , 0.001 , -0.0001 , 0.1 ] },
 "right": { "image": { "width": 640, "height": 480 }, "k": [ 530 , 531 , 320 , 240 ],
 "distortion": { "model": "fisheye", "coefficients": [ 0.1 , 0 , 0 , 0 ] } },
 "stereo": { "right_from_left": { "rotation": [ 1 , 0 , 0 , 0 , 1 , 0 , 0 , 0 , 1 ], "translation": [ -0.1 , 0.01 , 2e-3 ] } } }
"#;
const MATCHES: &str = "# u1 v1 u2 v2\n1 2 3 4\n1e2, -2.5, 3 , 4 # and more\n\n10 20 30.25 40 7\n";
const POSITIONS: &str = "# name\na.jpg 1 2 3\nb c.jpg -1.5 2e2 3 0.5\n17 1 2 3\n";

/// Whether a failure has a message that names the file.
fn is_told(failure: &Failure) -> bool {
    let text = failure.to_string();
    text.contains("file") && text.len() > "file: ".len()
}

#[test]
fn the_texts_to_damage_are_right() {
    let path = Path::new("file");
    assert!(lens::parse(CAMERA, path, false).is_ok() && lens::parse(CAMERA, path, true).is_ok());
    assert!(lens::parse_rig(CAMERA, path).is_ok());
    assert_eq!(rows::parse(MATCHES, path, 4).unwrap().len(), 3);
    let lines = positions::lines(POSITIONS, path, 5.0).unwrap();
    assert_eq!(lines["b c.jpg"].sigma_m, 0.5);
    assert_eq!(
        (lines["17"].numbers, lines["17"].sigma_m),
        ([1.0, 2.0, 3.0], 5.0)
    );
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn cameras(changes in some_damage(), is_right: bool) {
        match lens::parse(&damage_text(CAMERA, &changes), Path::new("file"), is_right) {
            Ok(camera) => {
                prop_assert!(camera.intrinsics.fu_px().is_finite() && camera.intrinsics.fv_px() > 0.0);
                prop_assert!(camera.lens.coefficients().iter().all(|k| k.is_finite()));
            }
            Err(failure) => prop_assert!(is_told(&failure), "{}", failure),
        }
    }

    #[test]
    fn rigs(changes in some_damage()) {
        match lens::parse_rig(&damage_text(CAMERA, &changes), Path::new("file")) {
            Ok((_, right_from_left)) => {
                prop_assert!(right_from_left.to_matrix().iter().all(|x| x.is_finite()));
            }
            Err(failure) => prop_assert!(is_told(&failure), "{}", failure),
        }
    }

    #[test]
    fn matches(changes in some_damage(), columns in 2..6_usize) {
        match rows::parse(&damage_text(MATCHES, &changes), Path::new("file"), columns) {
            Ok(rows) => {
                let is_whole = |row: &Vec<f64>| row.len() == columns && !row.iter().any(|x| x.is_nan());
                prop_assert!(rows.iter().all(is_whole));
            }
            Err(failure) => prop_assert!(is_told(&failure), "{}", failure),
        }
    }

    #[test]
    fn places(changes in some_damage()) {
        match positions::lines(&damage_text(POSITIONS, &changes), Path::new("file"), 5.0) {
            Ok(lines) => {
                for (name, line) in lines {
                    prop_assert!(!name.is_empty());
                    prop_assert!(line.numbers.iter().all(|x| x.is_finite()));
                    prop_assert!(line.sigma_m > 0.0 && line.sigma_m.is_finite());
                }
            }
            Err(failure) => prop_assert!(is_told(&failure), "{}", failure),
        }
    }
}
