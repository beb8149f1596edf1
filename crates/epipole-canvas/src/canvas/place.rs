//! Places on the picture.

/// A place on the picture, CSS pixels.
pub type Place = (f64, f64);

/// A place, device pixels.
pub(super) type At = (f32, f32);
