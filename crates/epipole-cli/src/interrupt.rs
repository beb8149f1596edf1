//! Ctrl-C asks the work to end with what it has; a second one ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);
static UNSTOPPABLE: AtomicBool = AtomicBool::new(false);

/// The exit status of a program that Ctrl-C ended, as shells tell it.
const ENDED: i32 = 130;

/// Listens for Ctrl-C from now on.
pub(crate) fn listen() {
    // Without a handler Ctrl-C ends the program at once, which is what it does everywhere.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::SeqCst) || UNSTOPPABLE.load(Ordering::SeqCst) {
            std::process::exit(ENDED);
        }
        eprintln!("ending with what there is; press Ctrl-C again to end at once");
    });
}

/// Whether Ctrl-C was pressed.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// Does work that cannot be asked to end early: as long as it lasts, Ctrl-C ends the program.
///
/// # Errors
/// [`epipole::Error::Canceled`] if Ctrl-C was pressed before.
pub(crate) fn unstoppable<T>(work: impl FnOnce() -> T) -> epipole::Result<T> {
    // In this order, and the other one in the handler: a signal between the two lines is seen by
    // one of them at least.
    UNSTOPPABLE.store(true, Ordering::SeqCst);
    if requested() {
        return Err(epipole::Error::Canceled);
    }
    let result = work();
    UNSTOPPABLE.store(false, Ordering::SeqCst);
    Ok(result)
}
