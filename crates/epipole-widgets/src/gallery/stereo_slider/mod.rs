//! `stereo-slider`: depth from disparity, and the depth error caused by a pixel of error.

mod model;
mod rig;
mod view;
mod words;

pub(crate) use view::StereoSliderView as View;
