//! Any bytes give a value with finite numbers, or an error, never a panic.
//!
//! Each format starts from files that are right and damages them. A thousand cases a format run
//! with the tests, a million by `make fuzz-files`.

mod bytes;
mod clouds;
mod graphs;
mod photos;
mod texts;
