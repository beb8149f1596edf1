//! `scale-drift`: a drive around a block with one camera, whose scale drifts, and the effect of
//! loop closure.

mod drive;
mod model;
mod question;
mod view;
mod words;

pub(crate) use view::ScaleDriftView as View;
