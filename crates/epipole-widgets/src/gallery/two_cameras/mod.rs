//! `two-cameras`: two photographs of one point, seen from above, and the effect of a wrong match.

mod model;
mod view;
mod words;

pub(super) use view::TwoCamerasView as View;
