//! Tests of the Lab as one program, so that the core and the toolkit are linked once.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../common/mod.rs"]
mod common;

mod all_views;
mod bad_files;
mod bad_scenes;
mod calibrate;
mod camera_files;
mod editing;
mod figures;
mod figures_kept;
mod fuzz;
mod imported;
mod known_poses;
mod page_mirror;
mod panels;
mod pictures;
mod sample;
mod saving;
mod stop;
mod told;
mod words;
