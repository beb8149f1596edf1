//! Challenges: goals for the reader to reach by operating the figure.

use super::event::Event;
use serde::Serialize;

/// A goal with its check and one solution.
///
/// A test asserts for every challenge that the default state fails it and the solution solves it.
pub struct Challenge<M> {
    /// Permanent name.
    pub id: &'static str,
    /// The goal as a request to the reader.
    pub goal: &'static str,
    /// Hint for a reader who is stuck.
    pub hint: &'static str,
    /// One sentence on why the solution works: the lesson of the challenge.
    pub why: &'static str,
    /// Whether the current state reaches the goal.
    pub check: fn(&M) -> bool,
    /// Events that lead from the default state to the goal.
    pub solution: fn() -> Vec<Event>,
}

/// A challenge with whether it is solved now.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[cfg_attr(test, ts(rename = "Challenge"))]
pub struct ChallengeStatus {
    /// Permanent name.
    pub id: &'static str,
    /// The goal as a request to the reader.
    pub goal: &'static str,
    /// A nudge for a reader who is stuck.
    pub hint: &'static str,
    /// Why that reaches it, in one sentence.
    pub why: &'static str,
    /// Whether the present state reaches the goal.
    pub solved: bool,
}
