//! `two-cameras`: two photographs of one point, in a top view, and the effect of a wrong match.

mod model;
mod view;
mod words;

pub(super) use view::TwoCamerasView as View;
