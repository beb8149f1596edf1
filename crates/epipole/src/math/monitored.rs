//! Loops over independent items, with progress reports and cancellation.
//!
//! The caller's thread processes items like the others and reports before each. Each item is
//! computed by one thread from the same inputs, so the bits do not depend on the number of threads.

use crate::progress::{Monitor, Stage, Status};
use crate::{Error, Result};
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Number of items of [`map`] between two reports; small, because options can make an item slow.
const CHUNK: usize = 4;

/// Calls `job(n, reporter)` once for each n below `count`, in any order. A long job may report
/// progress itself, and fails only if its reporter does.
///
/// Compiled once, since Rayon's loops are large.
///
/// # Errors
/// [`Error::Canceled`]: some calls were then skipped.
pub(crate) fn for_each(
    count: usize,
    stage: Stage,
    monitor: &mut dyn Monitor,
    job: &(dyn Fn(usize, &mut Reporter) -> Result<()> + Sync),
) -> Result<()> {
    let (next, canceled) = (AtomicUsize::new(0), AtomicBool::new(false));
    let take = || {
        let n = next.fetch_add(1, Ordering::Relaxed);
        (n < count && !canceled.load(Ordering::Relaxed)).then_some(n)
    };
    let mut own_fraction = || {
        while let Some(n) = take() {
            let [from, to] = [n, n + 1].map(|n| n as f32 / count as f32);
            let mut reporter = Reporter::of_caller(stage, &mut *monitor, &canceled, from..to);
            reporter.report(0, 1)?;
            job(n, &mut reporter)?;
        }
        Ok(())
    };
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 && count > 1 {
        return rayon::in_place_scope(|scope| {
            for _ in 1..rayon::current_num_threads().min(count) {
                scope.spawn(|_| {
                    let mut reporter = Reporter::of_other(stage, &canceled);
                    while let Some(n) = take() {
                        if job(n, &mut reporter).is_err() {
                            return;
                        }
                    }
                });
            }
            own_fraction()
        });
    }
    own_fraction()
}

/// Calls `f(index of the first item, chunk)` for consecutive chunks of `chunk_len` items, such as
/// the rows of an image.
///
/// # Errors
/// [`Error::Canceled`].
pub(crate) fn for_each_chunk<T: Send>(
    items: &mut [T],
    chunk_len: usize,
    stage: Stage,
    monitor: &mut dyn Monitor,
    f: impl Fn(usize, &mut [T]) + Sync,
) -> Result<()> {
    let chunk_len = chunk_len.max(1);
    let chunks: Vec<Mutex<&mut [T]>> = items.chunks_mut(chunk_len).map(Mutex::new).collect();
    for_each(chunks.len(), stage, monitor, &|n, _| {
        // Never blocks: each chunk is locked once.
        if let Ok(mut chunk) = chunks[n].lock() {
            f(n * chunk_len, &mut chunk);
        }
        Ok(())
    })
}

/// Returns `f` of each item, in the order of the items.
///
/// # Errors
/// [`Error::Canceled`].
pub(crate) fn map<T: Sync, U: Send>(
    items: &[T],
    stage: Stage,
    monitor: &mut dyn Monitor,
    f: impl Fn(&T) -> U + Sync,
) -> Result<Vec<U>> {
    map_with(items, || (), stage, monitor, |(), item| f(item))
}

/// Runs [`map`] with memory that calls reuse; results must not depend on its content.
///
/// # Errors
/// [`Error::Canceled`].
pub(crate) fn map_with<T: Sync, U: Send, S: Send>(
    items: &[T],
    memory: impl Fn() -> S + Sync,
    stage: Stage,
    monitor: &mut dyn Monitor,
    f: impl Fn(&mut S, &T) -> U + Sync,
) -> Result<Vec<U>> {
    let mut results: Vec<Option<U>> = Vec::new();
    results.resize_with(items.len(), || None);
    let unused: Mutex<Vec<S>> = Mutex::new(Vec::new());
    for_each_chunk(&mut results, CHUNK, stage, monitor, |first, results| {
        let found = unused.lock().ok().and_then(|mut unused| unused.pop());
        let mut memory = found.unwrap_or_else(&memory);
        for (result, item) in results.iter_mut().zip(&items[first..]) {
            *result = Some(f(&mut memory, item));
        }
        if let Ok(mut unused) = unused.lock() {
            unused.push(memory);
        }
    })?;
    Ok(results.into_iter().flatten().collect())
}

/// Progress of one of several threads in a loop: the caller's thread reports to the monitor, the
/// others only see whether it canceled.
pub(crate) struct Reporter<'a> {
    stage: Stage,
    monitor: Option<&'a mut dyn Monitor>,
    canceled: &'a AtomicBool,
    fractions: Range<f32>,
}

impl<'a> Reporter<'a> {
    /// Creates the reporter of the caller's thread, whose progress goes from `fractions[0]` to
    /// `fractions[1]`.
    pub(crate) fn of_caller(
        stage: Stage,
        monitor: &'a mut dyn Monitor,
        canceled: &'a AtomicBool,
        fractions: Range<f32>,
    ) -> Self {
        Self {
            stage,
            monitor: Some(monitor),
            canceled,
            fractions,
        }
    }

    /// Creates the reporter of another thread.
    #[cfg_attr(
        not(feature = "parallel"),
        allow(dead_code, reason = "one thread has no others")
    )]
    pub(crate) fn of_other(stage: Stage, canceled: &'a AtomicBool) -> Self {
        Self {
            stage,
            monitor: None,
            canceled,
            fractions: 0.0..1.0,
        }
    }

    /// Reports before step `done` of `all`; only every eighth report is passed on.
    ///
    /// # Errors
    /// [`Error::Canceled`] if the computation should stop.
    #[inline(never)]
    pub(crate) fn report(&mut self, done: usize, all: usize) -> Result<()> {
        if let (Some(monitor), true) = (&mut self.monitor, done.is_multiple_of(8)) {
            let part = done as f32 / all.max(1) as f32;
            let fraction =
                self.fractions.start + (self.fractions.end - self.fractions.start) * part;
            let stage = self.stage;
            if monitor.report(Status { stage, fraction }).is_break() {
                self.canceled.store(true, Ordering::Relaxed);
            }
        }
        if self.canceled.load(Ordering::Relaxed) {
            Err(Error::Canceled)
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    #[test]
    fn every_item_is_visited_once_and_in_place() {
        for count in [0, 1, 3, 4, 5, 257, 1000] {
            let indices: Vec<usize> = (0..count).collect();
            let mapped = map(&indices, Stage::Filtering, &mut (), |&n| n + 1).unwrap();
            assert!(mapped.iter().enumerate().all(|(n, item)| *item == n + 1));
            let mut firsts = vec![0; count];
            let mut last = 0.0;
            let mut watch = |status: Status| {
                assert!(status.fraction >= last && status.fraction < 1.0);
                last = status.fraction;
                ControlFlow::Continue(())
            };
            for_each_chunk(&mut firsts, 3, Stage::Filtering, &mut watch, |first, c| {
                c.fill(first);
            })
            .unwrap();
            assert!((firsts.iter().enumerate()).all(|(n, first)| *first == n - n % 3));
        }
    }

    #[test]
    fn a_canceled_loop_stops_in_every_thread() {
        let mut reports = 0;
        let mut watch = |_| {
            reports += 1;
            match reports {
                3 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        };
        let visited = AtomicUsize::new(0);
        let count = 1 << 20;
        let outcome = for_each(count, Stage::Filtering, &mut watch, &|_, _| {
            visited.fetch_add(1, Ordering::Relaxed);
            std::thread::yield_now();
            Ok(())
        });
        assert_eq!((outcome, reports), (Err(Error::Canceled), 3));
        assert!(visited.into_inner() < count);
    }
}
