//! `disparity-map`: dense disparity of a rendered pair, beside the truth.

mod answer;
mod model;
mod view;

pub(crate) use view::DisparityMapView as View;
