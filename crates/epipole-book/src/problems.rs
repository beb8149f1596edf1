//! Problems of the content, with their locations. A build collects all of them before it fails.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A line of a content file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, relative to the project.
    pub file: PathBuf,
    /// Line, from 1.
    pub line: usize,
}

impl Place {
    /// Creates the location of a line, from 1, in a file.
    pub fn new(file: impl AsRef<Path>, line: usize) -> Place {
        Place {
            file: file.as_ref().to_path_buf(),
            line,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file.display(), self.line)
    }
}

/// A problem that an author has to fix.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Problem {
    /// Location in the author's file.
    pub place: Place,
    /// Description of the problem and its remedy.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

/// Problems found so far, shared by all stages of a build.
#[derive(Debug, Default)]
pub struct Problems(Mutex<Vec<Problem>>);

impl Problems {
    /// Adds a problem to the list.
    pub fn report(&self, place: Place, message: impl Into<String>) {
        let mut list = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        list.push(Problem {
            place,
            message: message.into(),
        });
    }

    /// Returns every problem once, sorted by file and line.
    pub fn sorted(&self) -> Vec<Problem> {
        let mut list = self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        list.sort();
        list.dedup();
        list
    }
}

/// Joins names for a message: `a, b, c`, or `none` if there are none.
pub fn name_list<S: AsRef<str>>(known: &[S]) -> String {
    if known.is_empty() {
        return "none".to_owned();
    }
    known
        .iter()
        .map(AsRef::as_ref)
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_sorted_by_place_and_reported_once() {
        let problems = Problems::default();
        problems.report(Place::new("b.md", 2), "second");
        problems.report(Place::new("a.md", 9), "first");
        problems.report(Place::new("b.md", 2), "second");
        let all: Vec<String> = problems.sorted().iter().map(ToString::to_string).collect();
        assert_eq!(all, ["a.md:9: first", "b.md:2: second"]);
    }
}
