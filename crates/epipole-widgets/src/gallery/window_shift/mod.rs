//! `window-shift`: how much a window changes when it is shifted, and what the structure tensor
//! says about it.

mod measure;
mod model;
mod view;
mod words;

pub use model::WindowShift;
pub use view::WindowShiftView as View;
