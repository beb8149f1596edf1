//! Any file that people write or edit gives an answer or an error, never a panic, and every number
//! in the answer is finite. As for the formats of the core: a thousand cases each, or
//! `EPIPOLE_FUZZ_CASES`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../../epipole-io/src/damage.rs"]
mod damage;

use crate::commands::sfm::positions;
use crate::failure::Failure;
use crate::rows;
use damage::{config, damage_text, some_damage};
use proptest::prelude::*;
use std::path::Path;

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
