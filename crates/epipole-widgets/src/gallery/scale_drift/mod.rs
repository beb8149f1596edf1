//! `scale-drift`: a drive around a block with one camera whose scale drifts, and what closing the
//! loop repairs.

mod drive;
mod model;
mod question;
mod view;
mod words;

pub(crate) use view::ScaleDriftView as View;
