//! What figures have computed, for those that show many: a book shows the same computation in many states, widths
//! and sentences, and tests ask for it again and again.

use super::Figure;
use crate::contract::JobResult;
use crate::gallery;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A place for an answer: whoever comes first computes it, and others wait.
type Place = Arc<OnceLock<JobResult>>;

/// The answers of computations that were carried out, for any number of threads.
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
    /// By the figure's name and the key of what it asks: figures of two names may ask under one key.
    known: Mutex<BTreeMap<(&'static str, u64), Place>>,
}

impl Answers {
    /// Nothing is known.
    pub const fn new() -> Self {
        let known = Mutex::new(BTreeMap::new());
        Self { known }
    }

    /// Carries out what a figure waits for, or takes what another one of its name has computed.
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
        // Both ask one question that depends on nothing.
        assert_eq!(keys[0], keys[1]);
    }
}
