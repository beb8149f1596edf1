//! `flow-window`: one equation per pixel of a window for its motion, and the motion that satisfies
//! them best.

mod flow;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::FlowWindowView as View;
