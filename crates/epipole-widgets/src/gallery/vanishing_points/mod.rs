//! `vanishing-points`: parallel edges meet on the horizon, and two perpendicular directions
//! determine the focal length.

mod model;
mod view;
mod words;

pub(super) use view::VanishingPointsView as View;
