//! Long computations, for a worker without figures.

use epipole_widgets::gallery;
use std::ops::ControlFlow;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Receiver of a computation's progress.
    pub type Listener;

    /// Called with the share that is done, 0 to 1.
    #[wasm_bindgen(method, structural)]
    fn progress(this: &Listener, share: f64);
}

/// Carries out a computation that a figure of this name waits for. To end it early, end its worker.
///
/// # Errors
/// A sentence for the reader.
#[wasm_bindgen]
pub fn compute(name: &str, request: &[u8], listener: &Listener) -> Result<Vec<u8>, String> {
    let mut report = |share: f64| {
        listener.progress(share);
        ControlFlow::Continue(())
    };
    gallery::compute(name, request, &mut report).map_err(|problem| problem.to_string())
}
