//! Robust estimation of F, E, H and poses on scenes with known truth.

mod bad_input;
mod configurations;
mod degenerate;
mod exact;
mod scene;
