//! The Levenberg–Marquardt solver of all refinements.

use crate::progress::{self, Monitor, Stage};
use crate::{Error, Result};
use derive_setters::Setters;

/// Interface of a problem to the solver: linearize, solve, step, measure.
///
/// Implementations keep their matrices between calls, so that nothing is allocated after the first
/// iteration.
pub(crate) trait System {
    /// The estimated quantities, on any manifold.
    type Parameters: Clone;

    /// Builds the normal equations at `parameters` and keeps them.
    fn linearize(&mut self, parameters: &Self::Parameters) -> Linearization;

    /// Solves `(JᵀJ + λ D) δ = −Jᵀr` for the last linearization and keeps δ, where λ is `damping`
    /// and D the diagonal of `JᵀJ`, bounded away from 0. `None` if the matrix is not positive
    /// definite.
    fn solve(&mut self, damping: f64) -> Option<DampedStep>;

    /// Writes `from ⊞ δ` into `into`.
    fn step(&self, from: &Self::Parameters, into: &mut Self::Parameters);

    /// Returns the robust cost `½ Σ ρ(‖r‖²)` at `parameters`; not finite where residuals are
    /// undefined, which the solver then avoids.
    fn cost(&mut self, parameters: &Self::Parameters) -> f64;
}

/// Cost and gradient of a problem at the point of linearization.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Linearization {
    /// `½ Σ ρ(‖r‖²)`.
    pub cost: f64,
    /// The largest absolute component of `Jᵀr`.
    pub gradient_max: f64,
    /// Length of the parameters, for a relative step test; 1 if there is none.
    pub parameter_norm: f64,
}

/// A solution of the damped normal equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DampedStep {
    /// Decrease of the cost predicted by the quadratic model: `½ δᵀ(λ D δ − Jᵀr)`.
    pub predicted_decrease: f64,
    /// The length of δ.
    pub norm: f64,
}

/// Options of the Levenberg–Marquardt solver.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct LmOptions {
    /// Maximum number of steps, including rejected ones.
    pub max_iterations: usize,
    /// Maximum gradient component at convergence.
    pub gradient_tolerance: f64,
    /// Maximum step length at convergence, relative to the parameters' length.
    pub step_tolerance: f64,
    /// Maximum relative decrease of the cost by an accepted step at convergence.
    pub cost_tolerance: f64,
    /// Initial λ, relative to the diagonal of `JᵀJ`.
    pub initial_damping: f64,
    /// Maximum number of steps in a row that raise the cost before the solver returns to the best
    /// parameters and tries smaller steps. 0, a cost that never rises, suits most problems; on pose
    /// graphs the full step first bends the trajectory and only the next one straightens it.
    pub patience: usize,
}

impl LmOptions {
    /// Returns options for a few steps within robust estimation: the next round continues from
    /// their result, so it need not be exact.
    pub(crate) fn few_steps(max_iterations: usize) -> Self {
        Self {
            max_iterations,
            cost_tolerance: 1e-5,
            step_tolerance: 1e-9,
            ..Self::default()
        }
    }
}

impl Default for LmOptions {
    fn default() -> Self {
        Self {
            max_iterations: 50,
            gradient_tolerance: 1e-10,
            step_tolerance: 1e-10,
            cost_tolerance: 1e-9,
            initial_damping: 1e-4,
            patience: 0,
        }
    }
}

/// One tried step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Number of the iteration, from 1; 0 for the initial state.
    pub index: usize,
    /// The best cost so far.
    pub cost: f64,
    /// Damping λ of this step.
    pub damping: f64,
    /// Whether the step lowered the cost and was kept.
    pub accepted: bool,
}

/// Reason why the solver ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Termination {
    /// Converged: the gradient vanished.
    SmallGradient,
    /// Converged: the step was negligible.
    SmallStep,
    /// Converged: the cost hardly decreased.
    SmallCostChange,
    /// The maximum number of iterations is reached. The gradient after the last one is not checked.
    MaxIterations,
    /// No damping gave a usable step: the problem is singular, or not finite nearby.
    Stuck,
}

impl Termination {
    /// Returns whether this is one of the three kinds of convergence.
    pub fn is_converged(self) -> bool {
        matches!(
            self,
            Termination::SmallGradient | Termination::SmallStep | Termination::SmallCostChange
        )
    }
}

/// Report of a minimization.
#[derive(Debug, Clone, PartialEq)]
pub struct LmReport {
    /// Cost of the initial parameters.
    pub initial_cost: f64,
    /// Cost of the returned parameters; never larger than the initial cost.
    pub final_cost: f64,
    /// Number of steps tried.
    pub iterations: usize,
    /// Number of steps accepted.
    pub accepted: usize,
    /// Reason why the solver ended.
    pub termination: Termination,
    /// The initial state and every step tried, in order; empty from
    /// `minimize_fixed`, which does not allocate.
    pub history: Vec<Iteration>,
}

/// Maximum damping: with more, steps have no effect.
const MAX_DAMPING: f64 = 1e24;
const MIN_DAMPING: f64 = 1e-20;

/// Minimizes `½ Σ ρ(‖r‖²)` from `parameters`, in place, and returns a report.
///
/// Each iteration solves `(JᵀJ + λ D) δ = −Jᵀr` and keeps `parameters ⊞ δ` if the true cost
/// decreases. The damping λ falls when the quadratic model predicts well and rises otherwise.
///
/// * `monitor`: notified before the first step and after each, in the only stage,
///   [`Stage::Refinement`]
///
/// # Errors
/// [`Error::NotFinite`] if the initial cost or gradient is not finite, [`Error::Canceled`] if the
/// monitor cancels; `parameters` are then the best found so far.
///
/// Source: Levenberg 1944, Marquardt 1963; the update of λ from Nielsen 1999, "Damping parameter in
/// Marquardt's method", §3; steps that may raise the cost are the watchdog technique of
/// Chamberlain, Powell, Lemaréchal & Pedersen 1982.
pub(crate) fn minimize<S: System>(
    system: &mut S,
    parameters: &mut S::Parameters,
    options: &LmOptions,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    let most = options.max_iterations.max(1) as f32;
    let mut history = Vec::new();
    let mut visit = |iteration: &Iteration| {
        history.push(*iteration);
        let fraction = (iteration.index as f32 / most).min(1.0);
        progress::report(monitor, Stage::Refinement, fraction)
    };
    let report = minimize_visiting(system, parameters, options, &mut visit)?;
    Ok(LmReport { history, ..report })
}

/// Runs the loop of [`minimize`]; an error of `visit` ends it.
pub(super) fn minimize_visiting<S: System>(
    system: &mut S,
    parameters: &mut S::Parameters,
    options: &LmOptions,
    visit: &mut dyn FnMut(&Iteration) -> Result<()>,
) -> Result<LmReport> {
    let mut here = system.linearize(parameters);
    if !here.cost.is_finite() || !here.gradient_max.is_finite() {
        return Err(Error::NotFinite {
            what: "the cost at the start of a minimization",
        });
    }
    let mut report = LmReport {
        initial_cost: here.cost,
        final_cost: here.cost,
        iterations: 0,
        accepted: 0,
        termination: Termination::MaxIterations,
        history: Vec::new(),
    };
    let mut outcome = Ok(());
    let mut damping = options.initial_damping.clamp(MIN_DAMPING, MAX_DAMPING);
    let mut raise = 2.0;
    let mut candidate = parameters.clone();
    // While the cost is above the best: the best parameters, and the number of steps since.
    let mut best: Option<S::Parameters> = None;
    let mut steps_away = 0;
    let start = Iteration {
        index: 0,
        cost: here.cost,
        damping,
        accepted: true,
    };
    visit(&start)?;
    if here.gradient_max <= options.gradient_tolerance {
        report.termination = Termination::SmallGradient;
        return Ok(report);
    }
    while report.iterations < options.max_iterations {
        report.iterations += 1;
        let used_damping = damping;
        let mut accepted = false;
        let mut converged = None;
        if let Some(step) = system.solve(damping)
            && step.norm.is_finite()
        {
            if step.norm <= options.step_tolerance * (here.parameter_norm + options.step_tolerance)
            {
                report.termination = Termination::SmallStep;
                break;
            }
            system.step(parameters, &mut candidate);
            let cost = system.cost(&candidate);
            let improves = cost < report.final_cost;
            if improves && report.final_cost - cost <= options.cost_tolerance * report.final_cost {
                converged = Some(Termination::SmallCostChange);
            }
            if improves && (converged.is_some() || report.iterations == options.max_iterations) {
                // The last step needs no derivatives.
                std::mem::swap(parameters, &mut candidate);
                report.final_cost = cost;
                accepted = true;
            } else if improves || (cost.is_finite() && steps_away < options.patience) {
                let there = system.linearize(&candidate);
                if there.cost.is_finite() && there.gradient_max.is_finite() {
                    std::mem::swap(parameters, &mut candidate);
                    let decrease = here.cost - there.cost;
                    here = there;
                    if improves {
                        report.final_cost = here.cost;
                        accepted = true;
                        let gain = decrease / step.predicted_decrease.max(f64::MIN_POSITIVE);
                        let slope = 2.0 * gain - 1.0;
                        damping *= (1.0 - slope * slope * slope).clamp(1.0 / 3.0, 2.0);
                        raise = 2.0;
                        if here.gradient_max <= options.gradient_tolerance {
                            converged = Some(Termination::SmallGradient);
                        }
                    } else {
                        // The previous parameters are now in `candidate`.
                        best.get_or_insert_with(|| candidate.clone());
                        steps_away += 1;
                    }
                } else {
                    // Undo: the search cannot continue without finite derivatives.
                    system.linearize(parameters);
                }
            }
            if accepted {
                report.accepted += 1;
                best = None;
                steps_away = 0;
            } else if steps_away == 0 || steps_away == options.patience {
                if let Some(place) = best.take() {
                    *parameters = place;
                    here = system.linearize(parameters);
                    steps_away = 0;
                }
                damping *= raise;
                raise *= 2.0;
            }
        } else {
            damping *= raise;
            raise *= 2.0;
        }
        damping = damping.max(MIN_DAMPING);
        let iteration = Iteration {
            index: report.iterations,
            cost: report.final_cost,
            damping: used_damping,
            accepted,
        };
        outcome = visit(&iteration);
        if outcome.is_err() {
            break;
        }
        if let Some(termination) = converged {
            report.termination = termination;
            break;
        }
        if damping > MAX_DAMPING {
            report.termination = Termination::Stuck;
            break;
        }
    }
    if let Some(place) = best {
        *parameters = place;
    }
    outcome.map(|()| report)
}
