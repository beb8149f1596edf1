//! Long computations: without the GIL, with a progress callback, interruptible by Ctrl-C.

use crate::errors::OrRaise;
use crate::options::{self, Options};
use crate::{fork, threads};
use epipole::progress::{Monitor, Stage, Status};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPool;
use std::ops::ControlFlow;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Interval between clock readings, each of which costs as much as a RANSAC sample.
const TICK: Duration = Duration::from_millis(1);
/// Maximum number of reports between clock readings.
const MAX_STRIDE: u32 = 256;

/// Interval between checks of signals and the callback, hence their maximum delay.
const INTERVAL: Duration = Duration::from_millis(50);

/// Runs `work` without the GIL.
///
/// * `progress`: called with the name of the stage and the completed fraction, at most every 50 ms
///
/// # Errors
/// The exception of the library's error, of `progress`, or of a signal (`KeyboardInterrupt`).
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&mut dyn Monitor) -> epipole::Result<T> + Send,
) -> PyResult<T> {
    let signal = Mutex::new(None);
    let mut watch = Watch {
        callback: progress,
        stage: None,
        skipped: 0,
        stride: 1,
        clock: Instant::now(),
        last: None,
        raised: None,
        signal: &signal,
    };
    fork::ensure_pool();
    let result = py.detach(|| match threads::pool() {
        None => work(&mut watch),
        Some(pool) => spawn(&pool, &signal, || work(&mut watch)),
    });
    // Work that ended before its first report still propagates a signal.
    match watch.raised.or_else(|| lock(&signal).take()) {
        Some(raised) => Err(raised),
        None => result.or_raise(),
    }
}

/// Reads keyword options, and runs `work` with them as [`run`] does.
///
/// # Errors
/// As [`options::read`] and [`run`].
pub(crate) fn run_with<O: Options, T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
    work: impl FnOnce(&O, &mut dyn Monitor) -> epipole::Result<T> + Send,
) -> PyResult<T> {
    let options = options::read(options)?;
    run(py, progress, |monitor| work(&options, monitor))
}

/// Runs `work` in a pool, and meanwhile checks for signals, which only this thread receives.
fn spawn<T: Send>(
    pool: &ThreadPool,
    signal: &Mutex<Option<PyErr>>,
    work: impl FnOnce() -> T + Send,
) -> T {
    let mut result = None;
    let (done, ended) = channel::<()>();
    pool.in_place_scope(|scope| {
        scope.spawn(|_| {
            // Also dropped by a panic.
            let _done = done;
            result = Some(work());
        });
        while ended.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
            if let Err(raised) = Python::attach(|py| py.check_signals()) {
                *lock(signal) = Some(raised);
            }
        }
    });
    // A panic in the scope has resumed in this thread.
    result.expect("the scope waits for its work")
}

fn lock(signal: &Mutex<Option<PyErr>>) -> MutexGuard<'_, Option<PyErr>> {
    signal.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs short work without the GIL and without progress.
pub(crate) fn detach<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    fork::ensure_pool();
    py.detach(|| match threads::pool() {
        None => work(),
        Some(pool) => pool.install(work),
    })
}

/// Runs short work without the GIL in this thread, without a pool.
pub(crate) fn release<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    py.detach(work)
}

/// Monitor that calls Python at intervals.
struct Watch<'a> {
    callback: Option<Py<PyAny>>,
    /// Stage of the last report.
    stage: Option<Stage>,
    /// Number of reports since the last clock reading, and between two readings.
    skipped: u32,
    stride: u32,
    /// Time of the last clock reading.
    clock: Instant,
    /// Time of the last call to Python.
    last: Option<Instant>,
    raised: Option<PyErr>,
    /// Exception of a signal, received by Python's thread.
    signal: &'a Mutex<Option<PyErr>>,
}

impl Watch<'_> {
    /// Reads the clock, if enough reports of a stage have passed.
    fn time(&mut self, stage: Stage) -> Option<Instant> {
        if self.stage != Some(stage) {
            (self.stage, self.stride) = (Some(stage), 1);
        }
        self.skipped += 1;
        if self.skipped < self.stride {
            return None;
        }
        let now = Instant::now();
        self.stride = if now - self.clock < TICK {
            MAX_STRIDE.min(2 * self.stride)
        } else {
            1
        };
        (self.skipped, self.clock) = (0, now);
        Some(now)
    }

    fn look(&self, status: Status) -> PyResult<()> {
        if let Some(raised) = lock(self.signal).take() {
            return Err(raised);
        }
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(callback) = &self.callback {
                callback.call1(py, (status.stage.words(), status.fraction))?;
            }
            Ok(())
        })
    }
}

impl Monitor for Watch<'_> {
    fn report(&mut self, status: Status) -> ControlFlow<()> {
        let Some(now) = self.time(status.stage) else {
            return ControlFlow::Continue(());
        };
        if self.last.is_some_and(|last| now - last < INTERVAL) {
            return ControlFlow::Continue(());
        }
        let looked = self.look(status);
        self.last = Some(Instant::now());
        match looked {
            Ok(()) => ControlFlow::Continue(()),
            Err(raised) => {
                self.raised = Some(raised);
                ControlFlow::Break(())
            }
        }
    }
}
