//! Markers of the methods and the color of the uncertainty region.

use crate::canvas::Shape;
use crate::theme::Role;

/// Color of the uncertainty region.
pub(super) const REGION: Role = Role::Series(3);
/// Marker of each method.
pub(super) const SHAPES: [Shape; 4] = [Shape::Cross, Shape::Plus, Shape::Triangle, Shape::Diamond];
/// All estimates are of one kind; their shapes tell them apart.
pub(super) const METHOD_ROLE: Role = Role::Ink;
