//! Questions: long computations, their answers, and the state of both in a model.
//!
//! A figure's `question.rs` defines the computation ([`Question`]); its model holds a
//! [`Computation`] and returns it from [`Model::asking`](crate::contract::Model::asking). Answers
//! of a worker are validated before use.

use crate::contract::{Asking, Job, JobResult, Problem, Progress};
#[cfg(test)]
use crate::contract::{Declared, Event};
use epipole::Error;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::cell::OnceCell;
use std::ops::ControlFlow;

/// All inputs of a long computation.
pub(crate) trait Question: PartialEq + Serialize + DeserializeOwned + 'static {
    /// Result of the computation.
    type Answer: Serialize + DeserializeOwned + 'static;

    /// Status shown while it runs, such as "Looking for corners".
    const LABEL: &'static str;

    /// Start of the message if it fails, such as "There are no corners".
    const FAILED: &'static str;

    /// Runs the computation, a function of the question alone.
    ///
    /// # Errors
    /// A message in lower case without a period, or [`Error::Canceled`].
    fn answer(&self, progress: Progress<'_>) -> Result<Self::Answer, Problem>;

    /// Returns whether an answer is valid for the question: of the right size, without NaN.
    fn fits(&self, answer: &Self::Answer) -> bool;
}

/// Runs a serialized question: the `compute` of a model.
pub(crate) fn carry_out<Q: Question>(request: &[u8], progress: Progress<'_>) -> JobResult {
    let unreadable = |_| Error::Degenerate {
        what: "the question of a figure",
        why: "it cannot be read",
    };
    let question: Q = postcard::from_bytes(request).map_err(unreadable)?;
    let answer = question.answer(progress)?;
    Ok(postcard::to_allocvec(&answer).unwrap_or_default())
}

/// Reports the fraction done. Returns an error if the answer is no longer needed.
///
/// # Errors
/// [`Error::Canceled`].
pub(crate) fn tell(progress: Progress<'_>, share: f64) -> Result<(), Error> {
    match progress(share) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Canceled),
    }
}

/// A pending question.
struct Out<Q> {
    question: Q,
    key: OnceCell<u64>,
}

/// State of a question: pending, answered or failed.
pub(crate) struct Computation<Q: Question> {
    out: Option<Out<Q>>,
    known: Option<(Q, Q::Answer)>,
    problem: Option<String>,
    version: u64,
}

impl<Q: Question> Default for Computation<Q> {
    fn default() -> Self {
        Self {
            out: None,
            known: None,
            problem: None,
            version: 0,
        }
    }
}

impl<Q: Question> Computation<Q> {
    /// Creates a state with this question pending.
    pub(crate) fn of(question: Q) -> Self {
        let mut asked = Self::default();
        asked.ask(question);
        asked
    }

    /// Requests the answer, unless it is known. The last answer remains until the new one arrives.
    pub(crate) fn ask(&mut self, question: Q) {
        self.problem = None;
        if self
            .out
            .as_ref()
            .is_some_and(|out| out.question == question)
        {
            return;
        }
        let is_known = self.known.as_ref().is_some_and(|known| known.0 == question);
        self.out = (!is_known).then_some(Out {
            question,
            key: OnceCell::new(),
        });
    }

    /// Sets a message why no question can be asked.
    pub(crate) fn refuse(&mut self, sentence: impl Into<String>) {
        self.forget();
        self.problem = Some(sentence.into());
    }

    /// Discards question and answer, for example after a change of subject.
    pub(crate) fn forget(&mut self) {
        (self.out, self.known, self.problem) = (None, None, None);
        self.version += 1;
    }

    /// Returns the last answer, possibly to an earlier question than the pending one.
    pub(crate) fn answer(&self) -> Option<&Q::Answer> {
        self.known.as_ref().map(|(_, answer)| answer)
    }

    /// Returns the last answer with its question.
    pub(crate) fn answered(&self) -> Option<(&Q, &Q::Answer)> {
        self.known
            .as_ref()
            .map(|(question, answer)| (question, answer))
    }

    /// Returns the text in place of an answer: the problem, or the status.
    pub(crate) fn stand_in(&self) -> &str {
        self.problem().unwrap_or(Q::LABEL)
    }

    /// Returns the same as a sentence.
    pub(crate) fn sentence(&self) -> String {
        self.problem()
            .map_or_else(|| format!("{}.", Q::LABEL), str::to_owned)
    }

    /// Returns the text in place of a missing number.
    pub(crate) fn missing(&self) -> &'static str {
        if self.is_waiting() { "…" } else { "–" }
    }

    /// Returns the error message, if the last question failed.
    pub(crate) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// Returns whether a question is pending.
    pub(crate) fn is_waiting(&self) -> bool {
        self.out.is_some()
    }

    /// Returns a version number of the answer, for the caches of views.
    pub(crate) fn version(&self) -> u64 {
        self.version
    }
}

impl<Q: Question> Asking for Computation<Q> {
    fn job(&self) -> Option<&dyn Job> {
        self.out.as_ref().map(|out| out as &dyn Job)
    }

    fn take(&mut self, result: JobResult) -> bool {
        let Some(Out { question, .. }) = self.out.take() else {
            return false;
        };
        let read = |bytes: Vec<u8>| -> Option<Q::Answer> {
            let answer = postcard::from_bytes(&bytes).ok()?;
            question.fits(&answer).then_some(answer)
        };
        match result.map(read) {
            Ok(Some(answer)) => {
                self.known = Some((question, answer));
                self.version += 1;
                return true;
            }
            Ok(None) => self.problem = Some(format!("{}: the answer cannot be read.", Q::FAILED)),
            Err(problem) => self.problem = Some(format!("{}: {problem}.", Q::FAILED)),
        }
        false
    }
}

impl<Q: Question> Job for Out<Q> {
    fn label(&self) -> &'static str {
        Q::LABEL
    }

    fn key(&self) -> u64 {
        *self.key.get_or_init(|| {
            postcard::serialize_with_flavor(&self.question, Fnv(0xcbf2_9ce4_8422_2325))
                .unwrap_or_default()
        })
    }

    fn request(&self) -> Vec<u8> {
        postcard::to_allocvec(&self.question).unwrap_or_default()
    }
}

/// A writer that only computes the FNV-1a hash.
struct Fnv(u64);

impl postcard::ser_flavors::Flavor for Fnv {
    type Output = u64;

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<u64> {
        Ok(self.0)
    }
}

/// Answers all questions of a model at once.
#[cfg(test)]
pub(crate) fn settle<M: Declared>(model: &mut M) {
    while let Some(job) = model.job() {
        let result = (M::COMPUTE)(&job.request(), &mut |_| ControlFlow::Continue(()));
        model.job_done(result);
    }
}

/// Creates a model, applies events and answers all its questions.
#[cfg(test)]
pub(crate) fn settled<M: Declared>(events: &[Event]) -> M {
    let mut model = M::new();
    for event in events {
        model.update(event).unwrap();
    }
    settle(&mut model);
    model
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct Half(f64);

    impl Question for Half {
        type Answer = f64;
        const LABEL: &'static str = "Halving";
        const FAILED: &'static str = "There is no half";

        fn answer(&self, progress: Progress<'_>) -> Result<f64, Problem> {
            tell(progress, 0.5)?;
            Ok(self.0 / 2.0)
        }

        fn fits(&self, answer: &f64) -> bool {
            answer.is_finite()
        }
    }

    fn settle(asked: &mut Computation<Half>) -> bool {
        let request = asked.job().unwrap().request();
        let result = carry_out::<Half>(&request, &mut |_| ControlFlow::Continue(()));
        asked.take(result)
    }

    #[test]
    fn a_question_is_out_until_it_is_answered() {
        let mut asked = Computation::of(Half(3.0));
        let key = asked.job().unwrap().key();
        assert!(asked.is_waiting() && asked.answer().is_none());
        assert!(settle(&mut asked) && !asked.is_waiting());
        assert_eq!(asked.answered(), Some((&Half(3.0), &1.5)));
        // A known answer is not requested again, and remains during a new question.
        asked.ask(Half(3.0));
        assert!(asked.job().is_none());
        asked.ask(Half(5.0));
        assert_ne!(asked.job().unwrap().key(), key);
        assert_eq!(asked.answer(), Some(&1.5));
        // A question with a known answer cancels the pending one.
        asked.ask(Half(3.0));
        assert!(!asked.is_waiting());
        let version = asked.version();
        asked.forget();
        assert!(asked.answer().is_none() && asked.version() > version);
    }

    #[test]
    fn what_is_no_answer_is_a_sentence() {
        let nonsense = Ok(vec![1, 2]);
        let not_a_number = postcard::to_allocvec(&f64::NAN).unwrap();
        let ended = Err(Problem::Elsewhere {
            sentence: "the worker has gone".to_owned(),
        });
        for (result, sentence) in [
            (nonsense, "There is no half: the answer cannot be read."),
            (
                Ok(not_a_number),
                "There is no half: the answer cannot be read.",
            ),
            (ended, "There is no half: the worker has gone."),
        ] {
            let mut asked = Computation::of(Half(1.0));
            assert!(!asked.take(result));
            assert_eq!(asked.problem(), Some(sentence));
            assert!(!asked.is_waiting() && !asked.take(Ok(Vec::new())));
        }
        assert!(carry_out::<Half>(&[], &mut |_| ControlFlow::Continue(())).is_err());
        let request = Computation::of(Half(1.0)).job().unwrap().request();
        assert!(carry_out::<Half>(&request, &mut |_| ControlFlow::Break(())).is_err());
        let mut asked = Computation::of(Half(1.0));
        asked.refuse("Choose a number.");
        assert_eq!(
            (asked.problem(), asked.is_waiting()),
            (Some("Choose a number."), false)
        );
    }
}
