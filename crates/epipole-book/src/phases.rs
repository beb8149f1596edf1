//! Phases of a build, displayed as a bar in a terminal and as lines with durations in a log.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The phases of a build so far.
pub struct Phases {
    display: Display,
    done: Mutex<Vec<(&'static str, Duration)>>,
}

enum Display {
    Nothing,
    Lines,
    Bar,
}

/// Steps of a phase.
pub struct Steps(Option<ProgressBar>);

impl Steps {
    /// Counts one step as done.
    pub fn done(&self) {
        if let Some(bar) = &self.0 {
            bar.inc(1);
        }
    }
}

impl Phases {
    /// Shows nothing.
    pub fn silent() -> Phases {
        Phases::shown_as(Display::Nothing)
    }

    /// Shows phases on standard error.
    pub fn on_stderr() -> Phases {
        Phases::shown_as(match std::io::stderr().is_terminal() {
            true => Display::Bar,
            false => Display::Lines,
        })
    }

    fn shown_as(display: Display) -> Phases {
        Phases {
            display,
            done: Mutex::default(),
        }
    }

    /// Runs a phase. `count` is its number of steps; 0 if they are not counted.
    pub fn run<T>(&self, name: &'static str, count: usize, work: impl FnOnce(&Steps) -> T) -> T {
        let bar = matches!(self.display, Display::Bar).then(|| bar(name, count));
        let steps = Steps(bar);
        let result = self.beside(name, || work(&steps));
        if let Some(bar) = &steps.0 {
            bar.finish_and_clear();
        }
        result
    }

    /// Runs a phase concurrently with others, without a bar.
    pub fn beside<T>(&self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        let time = start.elapsed();
        if let Display::Lines = self.display {
            eprintln!("{name}: {:.1} s", time.as_secs_f64());
        }
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        done.push((name, time));
        result
    }

    /// Returns a table of all phases with their durations in seconds. Concurrent ones overlap.
    pub fn timings(&self) -> String {
        let done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        done.iter()
            .map(|(name, time)| format!("{:8.2} s  {name}\n", time.as_secs_f64()))
            .collect()
    }
}

fn bar(name: &'static str, count: usize) -> ProgressBar {
    let (bar, style) = match count {
        0 => (ProgressBar::new_spinner(), "{spinner} {msg} {elapsed}"),
        count => (
            ProgressBar::new(count as u64),
            "{bar:30} {pos}/{len} {msg} {elapsed}",
        ),
    };
    let style = ProgressStyle::with_template(style);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(name);
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_listed_with_their_seconds() {
        let phases = Phases::silent();
        assert_eq!(phases.run("read", 0, |_| 3), 3);
        phases.run("draw", 2, Steps::done);
        let timings = phases.timings();
        let names: Vec<&str> = timings.lines().map(|line| &line[12..]).collect();
        assert_eq!(names, ["read", "draw"]);
    }
}
