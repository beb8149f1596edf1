//! Ctrl-C asks the work to end with what it has; a second one ends it at once.

use epipole::progress::Status;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Warning about interrupted work.
pub(crate) const ENDED_EARLY: &str = "ended early; the result is what there was";

/// The exit status of a program that Ctrl-C ended, as shells tell it.
const ENDED: i32 = 130;

/// Listens for Ctrl-C from now on.
pub(crate) fn listen() {
    // Without a handler Ctrl-C ends the program at once, which is what it does everywhere.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::SeqCst) {
            std::process::exit(ENDED);
        }
        eprintln!("ending with what there is; press Ctrl-C again to end at once");
    });
}

/// Whether Ctrl-C was pressed.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// Monitor that shows nothing and cancels after Ctrl-C.
pub(crate) fn watch(_: Status) -> ControlFlow<()> {
    match requested() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}
