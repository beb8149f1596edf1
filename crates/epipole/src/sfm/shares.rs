//! What share of the work of structure from motion, or of an adjustment, is done.

use super::incremental::SfmStep;
use crate::optim::{Iteration, LmOptions};
use crate::progress::{Progress, Stage, Status};
use std::ops::ControlFlow;

/// The shares of the whole at which features are found, matched, and pairs tested, judged by some dozens of
/// photographs; the rest goes to adding photographs.
const DETECTED: f32 = 0.3;
const MATCHED: f32 = 0.6;
const VERIFIED: f32 = 0.7;

/// Where the work begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Begin {
    /// With photographs.
    Photos,
    /// With matches.
    Matches,
}

/// Makes shares of the steps, and tells them.
pub(super) struct Shares<'a> {
    progress: Progress<'a>,
    begin: f32,
    num_images: usize,
    last: Status,
}

impl<'a> Shares<'a> {
    pub(super) fn new(progress: Progress<'a>, begin: Begin, num_images: usize) -> Self {
        let (begin, stage) = match begin {
            Begin::Photos => (0.0, Stage::FeatureDetection),
            Begin::Matches => (MATCHED, Stage::PairVerification),
        };
        let last = Status { stage, share: 0.0 };
        Self {
            progress,
            begin,
            num_images,
            last,
        }
    }

    /// Answers a step in the place of an observer.
    pub(super) fn tell(&mut self, step: &SfmStep) -> ControlFlow<()> {
        let part = |from: f32, to: f32, done: usize, total: usize| {
            from + (to - from) * done as f32 / total.max(1) as f32
        };
        let (stage, share) = match *step {
            SfmStep::Detected { done, total } => {
                (Stage::FeatureDetection, part(0.0, DETECTED, done, total))
            }
            SfmStep::Matched { done, total } => {
                (Stage::FeatureMatching, part(DETECTED, MATCHED, done, total))
            }
            SfmStep::Verified { done, total } => (
                Stage::PairVerification,
                part(MATCHED, VERIFIED, done, total),
            ),
            SfmStep::Started { .. } => (
                Stage::Registration,
                part(VERIFIED, 1.0, 2, self.num_images.max(2)),
            ),
            SfmStep::Registered { num_registered, .. } => (
                Stage::Registration,
                part(
                    VERIFIED,
                    1.0,
                    num_registered,
                    self.num_images.max(num_registered),
                ),
            ),
            SfmStep::Refined { .. } | SfmStep::Adjusted { .. } => (Stage::BundleAdjustment, 0.0),
        };
        let share = (share - self.begin) / (1.0 - self.begin);
        // A further component begins anew with two photographs; what was done stays done.
        let share = share.clamp(self.last.share, 1.0);
        self.last = Status { stage, share };
        (self.progress)(self.last)
    }
}

/// An observer of iterations that tells the share of those that there may be at most.
pub(super) fn iterations<'a>(
    progress: Progress<'a>,
    stage: Stage,
    options: &LmOptions,
) -> impl FnMut(&Iteration) -> ControlFlow<()> + use<'a> {
    let most = options.max_iterations.max(1);
    move |iteration| {
        let share = (iteration.index as f32 / most as f32).min(1.0);
        progress(Status { stage, share })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(begin: Begin, steps: &[SfmStep]) -> Vec<Status> {
        let mut told = Vec::new();
        let mut progress = |status| {
            told.push(status);
            ControlFlow::Continue(())
        };
        let mut shares = Shares::new(&mut progress, begin, 4);
        for step in steps {
            assert!(shares.tell(step).is_continue());
        }
        told
    }

    fn registered(num_registered: usize) -> SfmStep {
        SfmStep::Registered {
            image: 0,
            num_registered,
            num_points: 0,
        }
    }

    #[test]
    fn shares_rise_to_one_and_name_their_stage() {
        let started = SfmStep::Started {
            images: [0, 1],
            num_points: 9,
        };
        let steps = [
            SfmStep::Detected { done: 4, total: 4 },
            SfmStep::Matched { done: 3, total: 6 },
            SfmStep::Verified { done: 6, total: 6 },
            started.clone(),
            SfmStep::Adjusted { cost: 1.0 },
            registered(3),
            registered(4),
            // Another component, whose first photographs do not take back what was done.
            started,
            SfmStep::Verified { done: 0, total: 0 },
        ];
        let told = shares(Begin::Photos, &steps);
        let expected = [0.3, 0.45, 0.7, 0.85, 0.85, 0.925, 1.0, 1.0, 1.0];
        for (status, share) in told.iter().zip(expected) {
            assert!((status.share - share).abs() < 1e-6, "{status:?} {share}");
        }
        assert_eq!(told[1].stage, Stage::FeatureMatching);
        assert_eq!(told[4].stage, Stage::BundleAdjustment);
        assert_eq!(told[5].stage, Stage::Registration);
        // From matches on, the same steps fill the whole.
        let told = shares(Begin::Matches, &steps[2..7]);
        let expected = [0.25, 0.625, 0.625, 0.8125, 1.0];
        for (status, share) in told.iter().zip(expected) {
            assert!((status.share - share).abs() < 1e-6, "{status:?} {share}");
        }
    }

    #[test]
    fn steps_are_a_share_of_the_most_there_may_be() {
        let options = LmOptions {
            max_iterations: 8,
            ..LmOptions::default()
        };
        let mut told = Vec::new();
        let mut progress = |status: Status| {
            told.push(status);
            match told.len() {
                3 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        };
        let mut report = iterations(&mut progress, Stage::PoseGraph, &options);
        let mut at = |index| {
            report(&Iteration {
                index,
                cost: 1.0,
                damping: 1.0,
                accepted: true,
            })
        };
        assert!(at(0).is_continue() && at(2).is_continue() && at(9).is_break());
        drop(report);
        let shares: Vec<f32> = told.iter().map(|status| status.share).collect();
        assert_eq!(shares, [0.0, 0.25, 1.0]);
        assert_eq!(told[0].stage, Stage::PoseGraph);
    }
}
