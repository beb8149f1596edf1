//! Any bytes yield a value with finite numbers or an error, never a panic.
//!
//! Tests of each format damage valid files. The tests run a thousand cases per format, `make
//! fuzz-files` a million.

mod bytes;
mod clouds;
mod graphs;
mod photos;
mod texts;
