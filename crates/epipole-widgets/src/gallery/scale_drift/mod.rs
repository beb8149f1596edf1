//! `scale-drift`: a drive around a block with one camera whose scale drifts, and what closing the
//! loop repairs.

mod answer;
mod closing;
mod drive;
mod knobs;
mod model;
mod plot;
mod request;
mod view;
mod words;

pub(crate) use view::ScaleDriftView as View;
