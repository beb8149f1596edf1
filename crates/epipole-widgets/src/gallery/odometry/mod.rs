//! `odometry`: the path of a camera from the corners that were followed through its frames.

mod corners;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::OdometryView as View;
