//! `track`: corners tracked from frame to frame by Lucas-Kanade, with their true positions.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::TrackView as View;
