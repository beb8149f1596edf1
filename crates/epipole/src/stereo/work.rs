//! Dividing work between threads, telling how far it is, and stopping it.

use crate::progress::{Monitor, Stage, Status};
use crate::{Error, Result};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Progress callback of a worker: reports to the caller, or only checks for cancellation.
pub(super) struct Reporter<'a> {
    monitor: Option<&'a mut dyn Monitor>,
    canceled: &'a AtomicBool,
    shares: Range<f32>,
}

impl Reporter<'_> {
    /// Before step `done` of `all`.
    ///
    /// # Errors
    /// [`Error::Canceled`] if it is time to stop.
    #[inline(never)]
    pub(super) fn report(&mut self, done: usize, all: usize) -> Result<()> {
        if let (Some(monitor), true) = (&mut self.monitor, done.is_multiple_of(8)) {
            let part = done as f32 / all.max(1) as f32;
            let share = self.shares.start + (self.shares.end - self.shares.start) * part;
            let stage = Stage::DenseMatching;
            if monitor.report(Status { stage, share }).is_break() {
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

/// Work for one thread.
pub(super) fn alone<T>(
    monitor: &mut dyn Monitor,
    work: impl FnOnce(&mut Reporter) -> Result<T>,
) -> Result<T> {
    work(&mut Reporter {
        monitor: Some(monitor),
        canceled: &AtomicBool::new(false),
        shares: 0.0..1.0,
    })
}

/// Two pieces of work that do not depend on each other, side by side where there are threads.
pub(super) fn in_two(
    monitor: &mut dyn Monitor,
    shares: Range<f32>,
    first: impl FnOnce(&mut Reporter) -> Result<()>,
    second: impl FnOnce(&mut Reporter) -> Result<()> + Send,
) -> Result<()> {
    let canceled = &AtomicBool::new(false);
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 {
        let mut second_result = Ok(());
        let first_result = rayon::in_place_scope(|scope| {
            scope.spawn(|_| {
                second_result = second(&mut Reporter {
                    monitor: None,
                    canceled,
                    shares: 0.0..1.0,
                });
            });
            first(&mut Reporter {
                monitor: Some(monitor),
                canceled,
                shares: shares.clone(),
            })
        });
        return first_result.and(second_result);
    }
    let middle = 0.5 * (shares.start + shares.end);
    first(&mut Reporter {
        monitor: Some(&mut *monitor),
        canceled,
        shares: shares.start..middle,
    })?;
    second(&mut Reporter {
        monitor: Some(monitor),
        canceled,
        shares: middle..shares.end,
    })
}

/// Rows of an image, divided between threads.
#[cfg_attr(
    not(feature = "parallel"),
    allow(dead_code, reason = "one thread does not cut its work into strips")
)]
pub(super) struct Strips {
    pub(super) width: usize,
    pub(super) height: usize,
    /// A strip of fewer rows is not worth a thread.
    pub(super) least_rows: usize,
}

impl Strips {
    /// Calls `work` with the first row and the values of each strip.
    pub(super) fn run(
        &self,
        values: &mut [f32],
        monitor: &mut dyn Monitor,
        work: impl Fn(usize, &mut [f32], &mut Reporter) -> Result<()> + Sync,
    ) -> Result<()> {
        let canceled = &AtomicBool::new(false);
        #[cfg(feature = "parallel")]
        {
            let num_strips = rayon::current_num_threads().min(self.height / self.least_rows.max(1));
            if num_strips > 1 {
                let rows = self.height.div_ceil(num_strips);
                let work = &work;
                let mut strips = values.chunks_mut(rows * self.width).enumerate();
                let mut results = vec![Ok(()); num_strips];
                let mut slots = results.iter_mut();
                rayon::in_place_scope(|scope| {
                    let mine = strips.next().zip(slots.next());
                    for ((k, strip), result) in strips.zip(slots) {
                        scope.spawn(move |_| {
                            *result = work(
                                k * rows,
                                strip,
                                &mut Reporter {
                                    monitor: None,
                                    canceled,
                                    shares: 0.0..1.0,
                                },
                            );
                        });
                    }
                    if let Some(((_, strip), result)) = mine {
                        *result = work(
                            0,
                            strip,
                            &mut Reporter {
                                monitor: Some(monitor),
                                canceled,
                                shares: 0.0..1.0,
                            },
                        );
                    }
                });
                return results.into_iter().collect();
            }
        }
        work(
            0,
            values,
            &mut Reporter {
                monitor: Some(monitor),
                canceled,
                shares: 0.0..1.0,
            },
        )
    }
}
