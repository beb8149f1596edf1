//! `three-rays`: three rays that nearly intersect, and the singular values of their equations.

mod model;
mod view;
mod words;

pub(super) use view::ThreeRaysView as View;
