//! What the programs share that scripts set beside peers. With `RAYON_NUM_THREADS=1` times are those
//! that the process had a processor, where Linux tells it, so that other work on the machine
//! disturbs less; else those that passed.

use std::time::Instant;

/// Milliseconds since some fixed moment.
fn now(start: &Instant) -> f64 {
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

/// How long some work took, and what it gave the last time.
pub(crate) struct Timed<T> {
    pub(crate) median_ms: f64,
    pub(crate) least_ms: f64,
    pub(crate) last: T,
}

/// Work that takes longer needs no run to warm up, no batch, and no more rounds than were asked for.
const SLOW_MS: f64 = 1000.0;

/// Times work in rounds, at least three of what is not slow.
pub(crate) fn timed<T>(rounds: usize, mut work: impl FnMut() -> T) -> Timed<T> {
    let start = Instant::now();
    let before = now(&start);
    let mut last = work();
    let first = now(&start) - before;
    if first > SLOW_MS {
        let mut times = vec![first];
        for _ in 1..rounds {
            let before = now(&start);
            last = std::hint::black_box(work());
            times.push(now(&start) - before);
        }
        return summary(times, last);
    }
    // The processor's clock moves in steps of milliseconds, so short work is timed in batches.
    let before = now(&start);
    last = work();
    let one = (now(&start) - before).max(start.elapsed().as_secs_f64() * 2e2);
    let batch = (100.0 / one).clamp(1.0, 1000.0) as usize;
    let mut times: Vec<f64> = Vec::new();
    for _ in 0..rounds.div_ceil(batch).max(3) {
        let before = now(&start);
        for _ in 0..batch {
            last = std::hint::black_box(work());
        }
        times.push((now(&start) - before) / batch as f64);
    }
    summary(times, last)
}

fn summary<T>(mut times: Vec<f64>, last: T) -> Timed<T> {
    times.sort_by(f64::total_cmp);
    Timed {
        median_ms: times[times.len() / 2],
        least_ms: times[0],
        last,
    }
}
