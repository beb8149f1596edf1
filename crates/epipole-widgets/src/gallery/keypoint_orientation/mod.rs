//! `keypoint-orientation`: the gradient histogram that determines a keypoint's orientation.

mod gradients;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::KeypointOrientationView as View;
