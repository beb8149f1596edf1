//! Reports of refinements.

use crate::output::{Output, records};
use crate::types::Types;
use crate::value::Value;
use epipole::optim::{Iteration, LmReport, Termination};

records! {
    /// Result of a Levenberg-Marquardt loop.
    LmReport as LmReport {
        /// Cost at the start: half the sum of the losses of all residuals.
        initial_cost: f64,
        /// Cost at the end.
        final_cost: f64,
        /// Number of steps tried.
        iterations: usize,
        /// Number of steps kept.
        accepted: usize,
        /// Reason for the end of the loop.
        termination: Termination,
        /// Start and every step tried, in order.
        history: Vec<Iteration>,
    }

    /// Step of a Levenberg-Marquardt loop.
    Iteration as LmIteration {
        /// Counted from 1; 0 is the start.
        index: usize,
        /// Best cost so far.
        cost: f64,
        /// Damping of the step.
        damping: f64,
        /// Whether the step lowered the cost and was kept.
        accepted: bool,
    }
}

impl Output for Termination {
    fn typescript(_: &mut Types) -> String {
        "\"smallGradient\" | \"smallStep\" | \"smallCostChange\" | \"maxIterations\" | \"stuck\""
            .to_owned()
    }

    fn into_value(self) -> Value {
        let name = match self {
            Self::SmallGradient => "smallGradient",
            Self::SmallStep => "smallStep",
            Self::SmallCostChange => "smallCostChange",
            Self::MaxIterations => "maxIterations",
            Self::Stuck => "stuck",
        };
        Value::Text(name.to_owned())
    }
}
