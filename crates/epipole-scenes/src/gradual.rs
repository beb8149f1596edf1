//! Values that are computed once: on first use, or before it in small steps.

use std::fmt;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// A value `T`, with the partial state `P` of its computation.
///
/// Each call passes the work: `work(&mut part, amount)` does this amount and returns the value once
/// it is complete. The value does not depend on how the work is divided.
pub(crate) struct Gradual<P, T> {
    whole: OnceLock<T>,
    part: Mutex<P>,
}

impl<P: Default, T> Gradual<P, T> {
    pub(crate) fn new() -> Self {
        Self {
            whole: OnceLock::new(),
            part: Mutex::default(),
        }
    }

    /// Returns the value, after computing the remaining work.
    pub(crate) fn get(&self, work: impl Fn(&mut P, usize) -> Option<T>) -> &T {
        self.whole.get_or_init(|| {
            // Other threads do not see a partial state that was taken, so threads never wait for
            // each other.
            let mut part = std::mem::take(&mut *self.lock());
            loop {
                if let Some(whole) = work(&mut part, usize::MAX) {
                    return whole;
                }
            }
        })
    }

    /// Does some of the work; false once nothing is left.
    pub(crate) fn advance(&self, amount: usize, work: impl Fn(&mut P, usize) -> Option<T>) -> bool {
        if self.whole.get().is_some() {
            return false;
        }
        let Some(whole) = work(&mut self.lock(), amount) else {
            return true;
        };
        // Another thread may have finished the same value meanwhile.
        let _ = self.whole.set(whole);
        false
    }

    fn lock(&self) -> MutexGuard<'_, P> {
        self.part.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<P, T> fmt::Debug for Gradual<P, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_there = self.whole.get().is_some();
        write!(f, "Gradual({})", if is_there { "whole" } else { "part" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts to ten.
    fn count(part: &mut Vec<usize>, amount: usize) -> Option<Vec<usize>> {
        let end = part.len().saturating_add(amount).min(10);
        part.extend(part.len()..end);
        (end == 10).then(|| std::mem::take(part))
    }

    #[test]
    fn pieces_make_the_same_whole() {
        let (at_once, in_pieces, mixed) = (Gradual::new(), Gradual::new(), Gradual::new());
        let whole = at_once.get(count).clone();
        assert_eq!(whole, (0..10).collect::<Vec<_>>());
        let num_steps = (1..100).find(|_| !in_pieces.advance(3, count));
        assert_eq!(num_steps, Some(4));
        assert_eq!(in_pieces.get(count), &whole);
        assert!(mixed.advance(7, count));
        assert_eq!(mixed.get(count), &whole);
        assert!(!mixed.advance(7, count));
    }
}
