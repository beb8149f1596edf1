//! `lens-bend`: a lens bends straight lines, and the right coefficients straighten them.

mod model;
mod view;
mod words;

pub(super) use view::LensBendView as View;
