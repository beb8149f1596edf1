//! State of each step: done, open, or failed.

use crate::project::{Project, Step};
use crate::tasks::AnyQuery;
use std::collections::{BTreeMap, BTreeSet};

/// State of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepState {
    /// All outputs are available.
    Done,
    /// An output failed.
    Failed,
}

impl Project {
    /// Returns the states of the steps that are done or have failed.
    pub fn step_states(&self) -> BTreeMap<Step, StepState> {
        let missing = self.missing().into_iter().map(|missing| missing.query);
        let missing = missing.filter(|query| !query.is_settled(self));
        let missing: BTreeSet<Step> = missing.map(AnyQuery::step).collect();
        let feeds = |step: &&Step| !matches!(**step, Step::Calibrate | Step::TwoViews);
        let first_missing = missing.iter().find(feeds);
        let is_open = |step: Step| {
            let lacks_input = first_missing.is_some_and(|first| *first < step);
            missing.contains(&step) || (lacks_input && step != Step::Calibrate)
        };
        let mut states = BTreeMap::new();
        for query in AnyQuery::all(self) {
            let step = query.step();
            let Some(key) = query.key(self) else { continue };
            if self.cache.failure(key).is_some() {
                states.insert(step, StepState::Failed);
            } else if !is_open(step) && (query.is_settled(self) || self.imported.contains_key(&key))
            {
                states.entry(step).or_insert(StepState::Done);
            }
        }
        if self.document.has_measures() {
            states.insert(Step::Measure, StepState::Done);
        }
        states
    }
}
