//! Lines of the paths and of their scales.

use crate::canvas::Stroke;
use crate::theme::Role;

/// Ground truth.
pub(super) const TRUTH: Stroke = Stroke::solid(Role::Truth, 1.75).dotted();
/// Odometry, before loop closure.
pub(super) const BEFORE: Stroke = Stroke::solid(Role::Series(1), 1.75).dashed();
/// Path after loop closure.
pub(super) const AFTER: Stroke = Stroke::solid(Role::Best, 2.25);
