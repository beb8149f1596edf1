//! Number of threads of the library, chosen for a block of Python.

use crate::register::{classes, functions};
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::cell::RefCell;
use std::sync::Arc;

/// Maximum number of threads of a block.
const MAX_THREADS: usize = 1024;

thread_local! {
    /// Pools of the blocks that this thread has entered, innermost last.
    static ENTERED: RefCell<Vec<Arc<ThreadPool>>> = const { RefCell::new(Vec::new()) };
}

/// Returns the pool of the innermost block.
pub(crate) fn pool() -> Option<Arc<ThreadPool>> {
    ENTERED.with_borrow(|pools| pools.last().cloned())
}

/// Leaves all blocks: their threads do not exist in a forked process.
pub(crate) fn forget_pools() {
    // Dropping a pool would wait for its threads.
    ENTERED.with_borrow_mut(|pools| pools.drain(..).for_each(std::mem::forget));
}

/// Block with a number of threads, created by `epipole.threads`.
#[pyclass(frozen, module = "epipole")]
pub(crate) struct Threads(Arc<ThreadPool>);

#[pymethods]
impl Threads {
    fn __enter__(&self) {
        ENTERED.with_borrow_mut(|pools| pools.push(self.0.clone()));
    }

    #[pyo3(signature = (*_exception))]
    fn __exit__(&self, _exception: &Bound<'_, PyTuple>) -> PyResult<()> {
        let left = ENTERED.with_borrow_mut(|pools| {
            let place = pools.iter().rposition(|pool| Arc::ptr_eq(pool, &self.0))?;
            Some(pools.remove(place))
        });
        match left {
            Some(_) => Ok(()),
            None => Err(PyRuntimeError::new_err(
                "the block was entered by another thread of Python",
            )),
        }
    }

    fn __repr__(&self) -> String {
        format!("threads({})", self.0.current_num_threads())
    }
}

/// Limits the number of threads for calls inside a `with` block, in the current Python thread.
///
/// Results do not depend on the number of threads.
///
/// Parameters
/// ----------
/// count : int
///     1 to 1024.
///
/// Returns
/// -------
/// Threads
///
/// Raises
/// ------
/// ValueError
///     If ``count`` is outside 1 to 1024.
/// OSError
///     If the system cannot start more threads.
///
/// Examples
/// --------
/// >>> with epipole.threads(1):
/// ...     epipole.num_threads()
/// 1
#[pyfunction]
fn threads(count: usize) -> PyResult<Threads> {
    if !(1..=MAX_THREADS).contains(&count) {
        let message = format!("count must be 1 to {MAX_THREADS}, but is {count}");
        return Err(PyValueError::new_err(message));
    }
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    let pool = pool.map_err(|error| PyOSError::new_err(format!("count is {count}: {error}")))?;
    Ok(Threads(Arc::new(pool)))
}

/// Returns the number of threads that calls use.
///
/// Returns
/// -------
/// int
///     Set by the enclosing `epipole.threads`, else by `RAYON_NUM_THREADS`, else by the number of
///     cores.
#[pyfunction]
fn num_threads() -> usize {
    pool().map_or_else(rayon::current_num_threads, |pool| {
        pool.current_num_threads()
    })
}

pub(crate) fn register(package: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(package: Threads);
    functions!(package: threads, num_threads);
    Ok(())
}
