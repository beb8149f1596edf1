//! `path-costs`: semi-global matching at one pixel, path by path.

mod costs;
mod model;
mod view;
mod words;

pub(super) use view::PathCostsView as View;
