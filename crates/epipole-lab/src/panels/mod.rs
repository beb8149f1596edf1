//! What is seen, in egui. A panel asks the project and sends it events; it computes nothing but layout.

mod app;
mod cloud;
mod features;
mod host;
mod knobs;
mod look;
mod marks;
mod matches;
mod measure;
mod photo;
mod photographs;
mod reconstruction;
mod two_views;
mod work;

pub use app::{App, prepare};
pub use host::{Arrival, Host, Report, WorkId};
