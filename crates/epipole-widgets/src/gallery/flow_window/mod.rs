//! `flow-window`: one equation per pixel of a window for its motion, and the motion they agree on.

mod flow;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::FlowWindowView as View;
