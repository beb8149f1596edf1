//! Robust estimation of F, E, H and poses on scenes with known truth.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod bad_input;
mod configurations;
mod degenerate;
mod exact;
mod scene;
