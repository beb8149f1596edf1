//! Positions on the picture.

/// A position on the picture, CSS pixels.
pub type Place = (f64, f64);

/// A position, device pixels.
pub(super) type At = (f32, f32);
