//! The clock of the programs that scripts set beside peers. With `RAYON_NUM_THREADS=1` times are
//! those that the process had a processor, where Linux tells it, so that other work on the machine
//! disturbs less; else those that passed.

use std::time::Instant;

/// Milliseconds since some fixed moment.
pub(crate) fn now(start: &Instant) -> f64 {
    // The scheduler brings its count up to date when a thread gives way.
    std::thread::yield_now();
    let one_thread = std::env::var("RAYON_NUM_THREADS").is_ok_and(|n| n == "1");
    // The one worker is a thread of its own, so that all threads of the process count.
    let on_processor = || -> Option<f64> {
        let mut nanoseconds = 0.0;
        for task in std::fs::read_dir("/proc/self/task").ok()? {
            let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
            nanoseconds += text.split(' ').next()?.parse::<f64>().ok()?;
        }
        Some(nanoseconds)
    };
    match on_processor().filter(|_| one_thread) {
        Some(nanoseconds) => nanoseconds * 1e-6,
        None => start.elapsed().as_secs_f64() * 1e3,
    }
}
