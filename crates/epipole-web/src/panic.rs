//! Message of a panic, for the page to show and log.

use std::cell::RefCell;
use wasm_bindgen::prelude::wasm_bindgen;

thread_local! {
    static LAST: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Runs once after a page has loaded the module.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.to_string();
        LAST.with(|last| {
            // If the previous message is being read, this one is dropped rather than panicking
            // again.
            if let Ok(mut last) = last.try_borrow_mut() {
                *last = Some(message);
            }
        });
    }));
}

/// Returns and clears the message of the last panic, which a page reads after a call has trapped.
#[wasm_bindgen]
pub fn take_panic() -> Option<String> {
    LAST.with(|last| last.try_borrow_mut().ok().and_then(|mut last| last.take()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_of_a_panic_is_told_once() {
        let before = std::panic::take_hook();
        start();
        let result = std::panic::catch_unwind(|| panic!("the rays are parallel"));
        std::panic::set_hook(before);
        assert!(result.is_err());
        assert!(take_panic().is_some_and(|message| message.contains("the rays are parallel")));
        assert_eq!(take_panic(), None);
    }
}
