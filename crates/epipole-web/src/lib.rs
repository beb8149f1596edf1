//! The bridge between the figures and a page.
//!
//! A page holds one [`Figure`] for each figure that it shows. Events go in as calls with plain
//! arguments; controls, handles, readouts and challenges come out as JSON; a drawn frame is read
//! where it lies in WebAssembly's memory. Everything here also runs natively, so that a script
//! of events can be played on both sides and the answers compared letter by letter.

mod figure;
mod job;
mod panic;
mod snapshot;

pub use figure::{Figure, figures};
pub use job::{Listener, compute};
pub use panic::{start, take_panic};
