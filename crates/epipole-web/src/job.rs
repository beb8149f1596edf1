//! Long computations, for a worker without figures.

use epipole_widgets::gallery;
use std::ops::ControlFlow;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Callback for a computation's progress.
    pub type Listener;

    /// Reports the fraction done, 0 to 1.
    #[wasm_bindgen(method, structural)]
    fn progress(this: &Listener, share: f64);
}

/// Runs a computation for which a figure of this name waits. Terminating its worker cancels it.
///
/// # Errors
/// A message for the reader.
#[wasm_bindgen]
pub fn compute(name: &str, request: &[u8], listener: &Listener) -> Result<Vec<u8>, String> {
    let mut report = |share: f64| {
        listener.progress(share);
        ControlFlow::Continue(())
    };
    gallery::compute(name, request, &mut report).map_err(|problem| problem.to_string())
}
