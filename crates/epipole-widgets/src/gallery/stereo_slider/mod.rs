//! `stereo-slider`: depth from disparity, and what a pixel of error costs.

mod model;
mod rig;
mod view;
mod words;

pub(crate) use view::StereoSliderView as View;
