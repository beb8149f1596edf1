//! `window-search`: the cost of one window along its row, and the subpixel minimum.

mod model;
mod search;
mod view;
mod words;

pub(super) use view::WindowSearchView as View;
