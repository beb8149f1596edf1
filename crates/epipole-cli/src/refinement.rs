//! Options of least squares shared by commands: loss and convergence.

use crate::matrices::{not_negative, positive};
use clap::{Args, ValueEnum};
use epipole::optim::{LmOptions, RobustLoss};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Loss {
    /// Squared errors.
    None,
    /// Quadratic near zero, then linear.
    Huber,
    /// Grows logarithmically.
    Cauchy,
    /// Quadratic near zero, then constant: outliers have no influence.
    Truncated,
}

/// Loss and convergence. Each command has its own maximum number of iterations.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Least squares")]
pub(crate) struct RefinementArguments {
    /// Loss function.
    #[arg(long, value_enum, default_value = "none")]
    loss: Loss,
    /// Error above which the loss is no longer quadratic: pixels, or standard deviations of a
    /// measurement.
    #[arg(long, default_value_t = 1.0, value_name = "W", value_parser = positive)]
    loss_width: f64,
    /// Stop when no component of the gradient is larger than this.
    #[arg(long, default_value = "1e-10", value_name = "G", value_parser = not_negative)]
    gradient_tolerance: f64,
    /// Stop when a step is shorter than this, relative to the norm of all parameters.
    #[arg(long, default_value = "1e-10", value_name = "RATIO", value_parser = not_negative)]
    step_tolerance: f64,
    /// Stop when a step lowers the cost by less than this, relatively.
    #[arg(long, default_value = "1e-9", value_name = "RATIO", value_parser = not_negative)]
    cost_tolerance: f64,
    /// Initial damping, relative to the diagonal (for a pose graph at most 1e-12).
    #[arg(long, default_value = "1e-4", value_name = "L", value_parser = positive)]
    initial_damping: f64,
    /// Maximum number of consecutive steps that raise the cost (for a pose graph at least 3).
    #[arg(long, default_value_t = LmOptions::default().patience, value_name = "N")]
    patience: usize,
}

impl RefinementArguments {
    /// Returns the options of the core.
    pub(crate) fn options(&self, max_iterations: usize) -> LmOptions {
        LmOptions::default()
            .with_max_iterations(max_iterations)
            .with_gradient_tolerance(self.gradient_tolerance)
            .with_step_tolerance(self.step_tolerance)
            .with_cost_tolerance(self.cost_tolerance)
            .with_initial_damping(self.initial_damping)
            .with_patience(self.patience)
    }

    /// Loss function.
    pub(crate) fn loss(&self) -> RobustLoss {
        let width = self.loss_width;
        match self.loss {
            Loss::None => RobustLoss::Trivial,
            Loss::Huber => RobustLoss::Huber { width },
            Loss::Cauchy => RobustLoss::Cauchy { width },
            Loss::Truncated => RobustLoss::Truncated { width },
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct All {
        #[command(flatten)]
        refinement: RefinementArguments,
    }

    #[test]
    fn omitted_options_have_the_defaults_of_the_core() {
        let all = All::try_parse_from(["epipole"]).unwrap().refinement;
        let core = LmOptions::default();
        assert_eq!(all.options(core.max_iterations), core);
        assert_eq!(all.loss(), RobustLoss::default());
    }
}
