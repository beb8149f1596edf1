//! `vanishing-points`: parallel edges meet on the horizon, and two right-angled ones tell the focal
//! length.

mod model;
mod view;
mod words;

pub(super) use view::VanishingPointsView as View;
