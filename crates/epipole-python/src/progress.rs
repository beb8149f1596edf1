//! Long computations: without the GIL, with a progress callback, stopped by Ctrl-C.

use crate::errors::OrRaise;
use crate::fork;
use epipole::progress::{Monitor, Status};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Interval between two looks at Python. Ctrl-C and the callback wait no longer than this.
const INTERVAL: Duration = Duration::from_millis(50);

/// Runs `work` without the GIL.
///
/// * `progress`: called with the stage in words and the completed share, at most every 50 ms
///
/// # Errors
/// The exception of the library's error, of `progress`, or of a signal (`KeyboardInterrupt`).
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&mut dyn Monitor) -> epipole::Result<T> + Send,
) -> PyResult<T> {
    let mut watch = Watch {
        callback: progress,
        last: None,
        raised: None,
    };
    let result = detach(py, || work(&mut watch));
    match watch.raised {
        Some(raised) => Err(raised),
        None => result.or_raise(),
    }
}

/// Runs `work` without the GIL and without progress: short work.
pub(crate) fn detach<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    fork::ensure_pool();
    py.detach(work)
}

/// Monitor that looks at Python from time to time.
struct Watch {
    callback: Option<Py<PyAny>>,
    last: Option<Instant>,
    raised: Option<PyErr>,
}

impl Watch {
    fn look(&self, status: Status) -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(callback) = &self.callback {
                callback.call1(py, (status.stage.words(), status.share))?;
            }
            Ok(())
        })
    }
}

impl Monitor for Watch {
    fn report(&mut self, status: Status) -> ControlFlow<()> {
        if self.last.is_some_and(|last| last.elapsed() < INTERVAL) {
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
