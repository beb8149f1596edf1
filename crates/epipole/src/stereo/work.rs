//! Distribution of work between threads, with progress and cancellation.

use crate::Result;
use crate::math::monitored::Reporter;
use crate::progress::{Monitor, Stage};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

const STAGE: Stage = Stage::DenseMatching;

/// Runs work on one thread.
pub(super) fn single<T>(
    monitor: &mut dyn Monitor,
    work: impl FnOnce(&mut Reporter) -> Result<T>,
) -> Result<T> {
    work(&mut Reporter::of_caller(
        STAGE,
        monitor,
        &AtomicBool::new(false),
        0.0..1.0,
    ))
}

/// Runs two independent pieces of work in parallel, if threads are available.
pub(super) fn in_two(
    monitor: &mut dyn Monitor,
    fractions: Range<f32>,
    first: impl FnOnce(&mut Reporter) -> Result<()>,
    second: impl FnOnce(&mut Reporter) -> Result<()> + Send,
) -> Result<()> {
    let canceled = &AtomicBool::new(false);
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 {
        let mut second_result = Ok(());
        let first_result = rayon::in_place_scope(|scope| {
            scope.spawn(|_| {
                second_result = second(&mut Reporter::of_other(STAGE, canceled));
            });
            first(&mut Reporter::of_caller(
                STAGE,
                monitor,
                canceled,
                fractions.clone(),
            ))
        });
        return first_result.and(second_result);
    }
    let middle = 0.5 * (fractions.start + fractions.end);
    first(&mut Reporter::of_caller(
        STAGE,
        &mut *monitor,
        canceled,
        fractions.start..middle,
    ))?;
    second(&mut Reporter::of_caller(
        STAGE,
        monitor,
        canceled,
        middle..fractions.end,
    ))
}

/// Rows of an image, divided between threads.
#[cfg_attr(
    not(feature = "parallel"),
    allow(dead_code, reason = "one thread does not cut its work into strips")
)]
pub(super) struct Strips {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Minimum number of rows of a strip to be worth a thread.
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
                            *result =
                                work(k * rows, strip, &mut Reporter::of_other(STAGE, canceled));
                        });
                    }
                    if let Some(((_, strip), result)) = mine {
                        *result = work(
                            0,
                            strip,
                            &mut Reporter::of_caller(STAGE, monitor, canceled, 0.0..1.0),
                        );
                    }
                });
                return results.into_iter().collect();
            }
        }
        work(
            0,
            values,
            &mut Reporter::of_caller(STAGE, monitor, canceled, 0.0..1.0),
        )
    }
}
