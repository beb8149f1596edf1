//! Tests of the command line as one program, so that what they share is compiled once.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod basics;
mod board;
mod calibrate;
mod camera_files;
mod common;
mod compare;
mod depth;
mod features;
mod field;
mod geometry;
mod known_camera;
mod lenses;
mod localize;
mod matches;
mod models;
mod mvs;
mod odometry;
mod optimize;
mod pairs;
mod photos;
mod pnp;
mod positions;
mod rig;
mod sfm;
mod stitch;
mod triangulate;
