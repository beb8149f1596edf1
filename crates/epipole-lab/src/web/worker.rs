//! Entry point of a worker.

use crate::tasks::{Progress, compute};
use std::cell::RefCell;
use std::ops::ControlFlow;
use wasm_bindgen::prelude::wasm_bindgen;

thread_local! {
    static LAST_PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
}

#[wasm_bindgen]
extern "C" {
    /// Callbacks for a computation's progress.
    pub type Listener;

    /// Reports the progress, 0 to 1, and the current stage.
    #[wasm_bindgen(method, structural)]
    fn progress(this: &Listener, share: f32, words: &str);

    /// Reports an intermediate result.
    #[wasm_bindgen(method, structural, js_name = soFar)]
    fn so_far(this: &Listener, answer: Vec<u8>);
}

/// Runs once after a worker has loaded the module.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.to_string();
        LAST_PANIC.with(|last| {
            if let Ok(mut last) = last.try_borrow_mut() {
                *last = Some(message);
            }
        });
    }));
}

/// Returns the message of the last panic, once.
#[wasm_bindgen]
pub fn take_panic() -> Option<String> {
    LAST_PANIC.with(|last| last.try_borrow_mut().ok().and_then(|mut last| last.take()))
}

/// Runs a request of the Lab. Terminating its worker cancels it.
///
/// # Errors
/// A message for the reader.
#[wasm_bindgen(js_name = compute)]
pub fn carry_out(request: &[u8], listener: &Listener) -> Result<Vec<u8>, String> {
    compute(request, &mut |progress| {
        match progress {
            Progress::Share(share, words) => listener.progress(share, words),
            Progress::Partial(bytes) => listener.so_far(bytes),
        }
        ControlFlow::Continue(())
    })
}
