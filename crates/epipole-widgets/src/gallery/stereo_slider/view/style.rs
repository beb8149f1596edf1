//! Color of uncertainty.

use crate::theme::Role;

/// Depths and pixels within the uncertainty of a match.
pub(super) const UNCERTAIN: Role = Role::Series(3);
