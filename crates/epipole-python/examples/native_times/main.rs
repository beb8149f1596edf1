//! Times of functions of the library on the data of `tests/peers/time_calls.py`, which compares
//! them with calls from Python. Reads names of functions, and answers each with seconds.

mod geometry;
mod images;
mod scenes;

use std::collections::BTreeMap;
use std::hint::black_box;
use std::io::Write;
use std::time::{Duration, Instant};

type Outcome = epipole::Result<()>;

/// Least number of timed calls of a function.
const MIN_CALLS: usize = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let budget_s: f64 = std::env::args()
        .nth(1)
        .ok_or("the seconds for each function are missing")?
        .parse()?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut timers = Timers::default();
    geometry::add(&mut timers)?;
    images::add(&mut timers)?;
    scenes::add(&mut timers)?;
    for name in std::io::stdin().lines() {
        let name = name?;
        let timer = timers.0.get_mut(name.as_str());
        let timer = timer.ok_or_else(|| format!("no function is named {name}"))?;
        let seconds = pool.install(|| timer(Duration::from_secs_f64(budget_s)));
        println!("{seconds:e}");
        std::io::stdout().flush()?;
    }
    Ok(())
}

/// Timer of each function: the seconds of its shortest call.
#[derive(Default)]
struct Timers(BTreeMap<&'static str, Box<dyn FnMut(Duration) -> f64 + Send>>);

impl Timers {
    /// Adds a function. Other processes disturb its shortest call least. Results are dropped
    /// between the calls, as from Python.
    fn add<T>(&mut self, name: &'static str, mut call: impl FnMut() -> T + Send + 'static) {
        let timer = move |budget: Duration| {
            let begin = Instant::now();
            let (mut shortest, mut calls) = (f64::INFINITY, 0);
            while calls < MIN_CALLS || begin.elapsed() < budget {
                let start = Instant::now();
                let result = black_box(call());
                shortest = shortest.min(start.elapsed().as_secs_f64());
                drop(result);
                calls += 1;
            }
            shortest
        };
        self.0.insert(name, Box::new(timer));
    }
}

/// Data for all functions of a group, until the process ends.
fn keep<T>(data: T) -> &'static T {
    Box::leak(Box::new(data))
}
