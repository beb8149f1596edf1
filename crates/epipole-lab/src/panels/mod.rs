//! The user interface, in egui. A panel reads the project and sends it events; it computes only
//! layout.

mod about;
mod app;
mod bar;
mod calibrate;
mod cloud;
mod depth;
mod depth_words;
mod export;
mod features;
mod host;
mod intake;
mod keeping;
mod knobs;
mod look;
mod marks;
mod matches;
mod measure;
mod menu;
mod photo;
mod photographs;
mod reconstruction;
mod steer;
mod steps;
mod strips;
mod two_views;
mod videos;
mod work;

pub use about::About;
pub use app::{App, prepare, wear};
pub use host::{Arrival, Host, Kept, Report, WorkId};
