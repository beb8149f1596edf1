//! A cache of job results: a book shows one result in many states, widths and sentences, and tests
//! repeat it.

use super::Figure;
use crate::contract::JobResult;
use crate::gallery;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A cache entry: the first caller computes, the others wait.
type Place = Arc<OnceLock<JobResult>>;

/// A thread-safe cache of job results.
///
/// ```
/// # fn main() -> Result<(), epipole_widgets::contract::Problem> {
/// use epipole_widgets::{Answers, Figure};
/// static ANSWERS: Answers = Answers::new();
/// for _ in 0..2 {
///     let mut figure = Figure::new("eight-point")?;
///     ANSWERS.finish(&mut figure); // computes once
///     assert!(figure.job().is_none());
/// }
/// # Ok(()) }
/// ```
#[derive(Debug, Default)]
pub struct Answers {
    /// Results by figure name and job key; figures of different names may use the same key.
    known: Mutex<BTreeMap<(&'static str, u64), Place>>,
}

impl Answers {
    /// Creates an empty cache.
    pub const fn new() -> Self {
        let known = Mutex::new(BTreeMap::new());
        Self { known }
    }

    /// Runs a figure's pending jobs, or takes their results from the cache.
    pub fn finish(&self, figure: &mut Figure) {
        figure.finish_job_by(|name, job| {
            let place = self.place(name, job.key());
            let answer = place.get_or_init(|| {
                gallery::compute(name, &job.request(), &mut |_| ControlFlow::Continue(()))
            });
            answer.clone()
        });
    }

    fn place(&self, name: &'static str, key: u64) -> Place {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        Place::clone(known.entry((name, key)).or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_ask_the_same_share_one_answer() {
        let answers = Answers::new();
        let asked = |noise: &str| {
            let mut figure = Figure::new("eight-point").unwrap();
            figure.apply(&[("noise".to_owned(), noise.to_owned())]);
            let key = figure.job().unwrap().key();
            answers.finish(&mut figure);
            assert!(figure.job().is_none());
            (key, figure.describe())
        };
        let (key, words) = asked("0.7");
        let place = answers.place("eight-point", key);
        assert!(place.get().is_some_and(Result::is_ok));
        assert_eq!(asked("0.7"), (key, words.clone()));
        assert!(Arc::ptr_eq(&place, &answers.place("eight-point", key)));
        assert_ne!(asked("1.9").1, words);
    }

    #[test]
    fn figures_of_two_names_keep_apart_what_they_ask_under_one_key() {
        let answers = Answers::new();
        let mut keys = Vec::new();
        for name in ["eight-point", "patch-match"] {
            let (mut figure, mut alone) = (Figure::new(name).unwrap(), Figure::new(name).unwrap());
            keys.push(figure.job().unwrap().key());
            answers.finish(&mut figure);
            alone.finish_job();
            assert_eq!(figure.describe(), alone.describe());
            assert_eq!(figure.readouts(), alone.readouts());
        }
        // Both figures request the same constant computation.
        assert_eq!(keys[0], keys[1]);
    }
}
