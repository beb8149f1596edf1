//! Robust estimation from data with many outliers.
//!
//! [`Ransac`] is the only loop, and it knows nothing about cameras: an [`Estimator`] fits a model
//! to a minimal sample, measures the error of a data point, and refines a model from many data
//! points. Estimators are next to their solvers; those for the plane, [`LineEstimator`] and
//! [`SimilarityEstimator`], are here.
//!
//! [`least_median`] minimizes the median error instead and needs no threshold.
//!
//! Source: Fischler & Bolles 1981 (the loop); Torr & Zisserman 2000 (the MSAC score); Chum, Matas
//! & Kittler 2003 (local optimization).

mod budget;
mod by_noise;
mod data;
mod engine;
mod estimator;
mod false_alarms;
mod least_median;
mod line;
mod line_huber;
mod matches;
mod noise;
mod options;
mod run;
mod sampler;
mod similarity;
mod step;
mod to_end;
mod unique;

pub use budget::{num_trials_with_replacement, num_trials_without_replacement};
pub use data::{Data, Support};
pub use engine::Ransac;
pub use estimator::{Estimator, Evidence, Problem};
pub use false_alarms::log10_false_alarms;
pub(crate) use false_alarms::{probability_near_line, probability_near_point};
pub use least_median::{LeastMedian, LeastMedianOptions, least_median};
pub use line::{LineEstimator, fit_line_total_least_squares};
pub use line_huber::fit_line_huber;
pub use matches::{FARTHEST_PX, MatchSet};
pub use options::{
    Budget, RansacOptions, RansacReport, SamplerKind, ScoreKind, StopReason, ThresholdKind,
};
pub use run::ransac;
pub use similarity::{PlaneSimilarity, SimilarityEstimator, estimate_similarity, fit_similarity};
pub use step::{Step, Trial};
pub use unique::Unique;
