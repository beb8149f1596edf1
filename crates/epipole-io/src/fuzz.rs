//! Any bytes give a value with finite numbers, or an error, never a panic.
//!
//! Each format starts from files that are right and damages them. A thousand cases a format run
//! with the tests; `EPIPOLE_FUZZ_CASES=1000000 cargo test --release -p epipole-io --lib fuzz` runs
//! a million.

mod clouds;
mod graphs;
mod photos;
mod texts;
