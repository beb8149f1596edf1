//! The bridge between the figures and a page.
//!
//! A page holds one [`Figure`] for each figure that it shows. Events go in as calls with plain
//! arguments; controls, handles, readouts and challenges come out as JSON; a drawn frame is read
//! where it lies in WebAssembly's memory. Everything here also runs natively, so that a script
//! of events can be played on both sides and the answers compared letter by letter.
//!
//! It becomes two modules, one for each feature, so that a page need not load what only workers
//! run: `figures` has everything that a page calls, `jobs` the long computations alone.

#[cfg(feature = "figures")]
mod figure;
#[cfg(feature = "jobs")]
mod job;
#[cfg(feature = "figures")]
mod json;
mod panic;

#[cfg(feature = "figures")]
pub use figure::{Figure, figures};
#[cfg(feature = "jobs")]
pub use job::{Listener, compute};
pub use panic::{start, take_panic};
