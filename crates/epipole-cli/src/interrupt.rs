//! Ctrl-C: the first ends the work with the result so far, the second ends the program.

use epipole::progress::Status;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Warning about interrupted work.
pub(crate) const ENDED_EARLY: &str = "ended early; the result is what there was";

/// Exit status of shells for a program ended by Ctrl-C.
const ENDED: i32 = 130;

/// Listens for Ctrl-C from now on.
pub(crate) fn listen() {
    // Without a handler Ctrl-C ends the program at once, an acceptable fallback.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::SeqCst) {
            std::process::exit(ENDED);
        }
        eprintln!("ending with what there is; press Ctrl-C again to end at once");
    });
}

/// Returns whether Ctrl-C was pressed.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// Cancels after Ctrl-C; a monitor that shows nothing.
pub(crate) fn watch(_: Status) -> ControlFlow<()> {
    match requested() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}
