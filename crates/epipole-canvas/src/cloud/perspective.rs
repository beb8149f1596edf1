//! Perspective of every view of a space.

/// Focal length over the shorter side of the picture.
pub(super) const FOCAL: f64 = 1.2;
/// Depth over the size of the scene below which nothing is seen.
pub(super) const NEAREST: f64 = 1e-3;
