//! `kernel-stepper`: a small window over enlarged pixels, with the products, their sum and the
//! output.

mod kernel;
mod model;
mod pixels;
mod view;
mod words;

pub(super) use view::KernelStepperView as View;
