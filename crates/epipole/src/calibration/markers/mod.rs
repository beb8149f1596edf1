//! Square markers: ArUco and AprilTag.

mod bits;
mod codes;
mod detect;
mod dictionary;
mod outline;
mod quads;

pub use detect::{Marker, MarkerOptions, detect_markers};
pub use dictionary::MarkerDictionary;
