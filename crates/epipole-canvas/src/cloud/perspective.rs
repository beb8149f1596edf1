//! Perspective of all views.

/// Focal length, relative to the shorter side of the picture.
pub(super) const FOCAL: f64 = 1.2;
/// Depth of the near plane, relative to the size of the scene.
pub(super) const NEAREST: f64 = 1e-3;
