//! Processes created by `os.fork`, such as the workers of `multiprocessing`.
//!
//! The threads of the library's pool do not exist in the child, which would wait for them forever.
//! Each thread of the child therefore computes alone, in a pool of its own.

use crate::threads;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether this process was created by a fork.
static IS_CHILD: AtomicBool = AtomicBool::new(false);

/// Gives the current thread of a forked process a pool of its own. Does nothing elsewhere.
///
/// The forking thread already has one; other threads get one when they start work.
pub(crate) fn ensure_pool() {
    if !IS_CHILD.load(Ordering::Relaxed) || rayon::current_thread_index().is_some() {
        return;
    }
    let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    // Fails only for threads of a pool. This one belongs to its pool until it ends.
    if let Ok(pool) = pool.build() {
        std::mem::forget(pool);
    }
}

#[pyfunction]
fn _after_fork() {
    IS_CHILD.store(true, Ordering::Relaxed);
    threads::forget_pools();
    ensure_pool();
}

/// Registers a hook for children of this process.
pub(crate) fn register(package: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = package.py();
    let os = py.import("os")?;
    // Windows has no fork.
    if !os.hasattr("register_at_fork")? {
        return Ok(());
    }
    let options = PyDict::new(py);
    options.set_item("after_in_child", wrap_pyfunction!(_after_fork, package)?)?;
    os.call_method("register_at_fork", (), Some(&options))?;
    Ok(())
}
