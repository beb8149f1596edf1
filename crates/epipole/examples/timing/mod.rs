//! Timing of work that can be repeated, for the programs that scripts set beside peers.

mod clock;

use clock::now;
use std::time::Instant;

/// Run times of some work, and its last result.
pub(crate) struct Timed<T> {
    pub(crate) median_ms: f64,
    pub(crate) least_ms: f64,
    pub(crate) last: T,
}

/// Work that takes longer needs no run to warm up, no batch, and no more rounds than were asked
/// for.
const SLOW_MS: f64 = 1000.0;

/// Times `work` in rounds: at least three, unless it is slow.
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
