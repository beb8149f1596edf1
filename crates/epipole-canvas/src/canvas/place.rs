//! Places on the picture.

/// A place on the picture, CSS pixels.
pub type Place = (f64, f64);
