//! `window-shift`: the change of a window when shifted, and its estimate by the structure tensor.

mod measure;
mod model;
mod view;
mod words;

pub use model::WindowShift;
pub use view::WindowShiftView as View;
