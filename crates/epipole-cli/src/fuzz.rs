//! Any file that people write or edit yields a result with finite numbers or an error, never a
//! panic. A thousand cases each, or `EPIPOLE_FUZZ_CASES`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../../epipole-io/src/damage.rs"]
mod damage;

use crate::commands::sfm::positions;
use crate::failure::Failure;
use damage::{config, damage_text, some_damage};
use proptest::prelude::*;
use std::path::Path;

const POSITIONS: &str = "# name\na.jpg 1 2 3\nb c.jpg -1.5 2e2 3 0.5\n17 1 2 3\n";

/// Returns whether the message of a failure names the file.
fn has_message(failure: &Failure) -> bool {
    let text = failure.to_string();
    text.contains("file") && text.len() > "file: ".len()
}

#[test]
fn the_texts_to_damage_are_right() {
    let path = Path::new("file");
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
    fn places(changes in some_damage()) {
        match positions::lines(&damage_text(POSITIONS, &changes), Path::new("file"), 5.0) {
            Ok(lines) => {
                for (name, line) in lines {
                    prop_assert!(!name.is_empty());
                    prop_assert!(line.numbers.iter().all(|x| x.is_finite()));
                    prop_assert!(line.sigma_m > 0.0 && line.sigma_m.is_finite());
                }
            }
            Err(failure) => prop_assert!(has_message(&failure), "{}", failure),
        }
    }
}
