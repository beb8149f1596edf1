//! Bridge between the figures and a page.
//!
//! A page creates one [`Figure`] for each figure that it shows. Events are calls with plain
//! arguments; controls, handles, readouts and challenges are returned as JSON; a drawn frame is
//! read in place from WebAssembly's memory. Everything here also runs natively, so that a script of
//! events can be replayed on both sides and the outputs compared byte by byte.
//!
//! The crate is built as two modules, one for each feature, so that a page need not load code that
//! only workers run: `figures` contains everything that a page calls, `jobs` only the long
//! computations.

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
