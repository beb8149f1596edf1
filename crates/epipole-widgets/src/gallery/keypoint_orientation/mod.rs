//! `keypoint-orientation`: the histogram of gradients that gives a keypoint its orientation.

mod gradients;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::KeypointOrientationView as View;
