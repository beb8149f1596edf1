//! `two-cameras`: two photographs of one point from above, and what a wrong match does.

mod model;
mod view;
mod words;

pub(super) use view::TwoCamerasView as View;
