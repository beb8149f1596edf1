//! `disparity-map`: dense disparity of a rendered pair, beside the ground truth.

mod model;
mod question;
mod view;
mod words;

pub(crate) use view::DisparityMapView as View;
