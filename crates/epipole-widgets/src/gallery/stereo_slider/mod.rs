//! `stereo-slider`: two photographs in a row, the disparity between them, and the depth it gives.

mod model;
mod view;

pub(super) use view::StereoSliderView;
