//! Profile of the cost over focal lengths, to find whether another focal length explains the
//! matches better.

use super::coordinates::Coordinates;
use super::essential::rotations_and_direction;
use super::estimate_pose_and_focal::{FocalEstimator, PoseWithFocal};
use super::five_point;
use super::in_front::{self, Lenses};
use super::refine::refine_in_frame;
use super::refine_focal::refine_pose_and_focal_in_frame;
use super::refine_pose::{ErrorsInFrame, Pose, RaysInFrame, Steps, refine_pose};
use super::{RelativePose, project_to_essential, sampson};
use crate::camera::Intrinsics;
use crate::math::order::at_rank;
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
use nalgebra::{Matrix3, Vector3};
use std::borrow::Cow;

/// Ratio of neighboring focal lengths, if the maximum number permits: valleys of the cost are
/// wider.
const STEP: f64 = 1.2;

/// Maximum number of focal lengths to try.
const MAX_TRIED: usize = 40;

/// Maximum number of matches for fitting motions: more only improve the noise estimate.
const MAX_MATCHES: usize = 2000;

/// Number of five-match samples for each focal length.
const NUM_SAMPLES: usize = 12;

/// Truncation of errors in medians: three standard deviations of Gaussian errors.
const WIDTH_MEDIANS: f64 = 4.5;

/// Focal lengths within this many standard deviations of the minimum cost are possible.
const POSSIBLE: f64 = 3.0;

/// Relative difference below which focal lengths are in one valley.
const SAME: f64 = 0.02;

/// A motion, a focal length, and the sum of squared errors, each truncated at the squared width,
/// px².
#[derive(Debug, Clone)]
struct Fit {
    pose: Pose,
    focal_px: f64,
    cost: f64,
}

/// Costs of the best motions over the plausible focal lengths.
pub(super) struct FocalProfile<'a> {
    /// The problem, with at most [`MAX_MATCHES`].
    of: Cow<'a, FocalEstimator>,
    /// Number of matches that each of these represents.
    num_each: f64,
    max_error_px: f64,
    /// Truncation of errors, pixels.
    width_px: f64,
    /// Variance of the errors about the best F of any kind, px².
    variance: f64,
    fits: Vec<Fit>,
}

impl<'a> FocalProfile<'a> {
    /// Computes the profile; `None` if there are too few inliers for a fundamental matrix.
    ///
    /// * `model`: motion and focal length found so far
    pub(super) fn new(
        of: &'a FocalEstimator,
        model: &PoseWithFocal,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Self> {
        // The noise is measured about F, which is independent of the focal length.
        let loss = RobustLoss::Truncated {
            width: max_error_px * of.frame.scale,
        };
        let options = LmOptions::few_steps(10);
        let fundamental = (of.frame).fundamental_within(&model.fundamental, |f| {
            refine_in_frame(&of.in_frame, f, loss, &options)
        })?;
        let errors_sq: Vec<f64> = (0..of.matches.len())
            .map(|index| {
                let (x1, x2) = of.matches.pair(index);
                super::sampson_sq(&fundamental, &x1, &x2)
            })
            .collect();
        let near_sq = |most_px: f64| -> Vec<f64> {
            let is_near = |error_sq: &f64| *error_sq < most_px * most_px;
            errors_sq.iter().copied().filter(is_near).collect()
        };
        let mut near = near_sq(max_error_px);
        if near.len() < 8 {
            return None;
        }
        let middle = near.len() / 2;
        let median_px = at_rank(&mut near, middle).sqrt();
        let least_px = 1e-3 * max_error_px;
        let width_px = (WIDTH_MEDIANS * median_px).clamp(least_px, max_error_px);
        let near = near_sq(width_px);
        let freedom = near.len().checked_sub(7).filter(|n| *n > 0)? as f64;
        let inliers = (0..errors_sq.len())
            .filter(|index| errors_sq[*index] < max_error_px * max_error_px)
            .collect();
        let few = (of.matches.len() > MAX_MATCHES).then(|| choose_subset(inliers, random));
        let mut profile = Self {
            num_each: few.as_ref().map_or(1.0, |(_, num_each)| *num_each),
            of: match few {
                Some((few, _)) => Cow::Owned(of.subset(&few)?),
                None => Cow::Borrowed(of),
            },
            max_error_px,
            width_px,
            variance: near.iter().sum::<f64>() / freedom,
            fits: Vec::new(),
        };
        profile.fill(model, &fundamental, random);
        Some(profile)
    }

    fn fill(&mut self, model: &PoseWithFocal, fundamental: &Matrix3<f64>, random: &mut Random) {
        let mut inliers = Vec::new();
        sampson::inliers(
            &self.of.pixels,
            &model.fundamental,
            self.max_error_px,
            &mut inliers,
        );
        let range = &self.of.focals_px;
        let span = libm::log(range.end / range.start);
        if inliers.len() < 5 || !span.is_finite() {
            return;
        }
        let count = ((span / libm::log(STEP)) as usize + 2).min(MAX_TRIED);
        for index in 0..count {
            let fraction = index as f64 / (count - 1) as f64;
            let focal_px = range.start * libm::exp(fraction * span);
            let mut starts = self.five_point_starts(focal_px, &inliers, random);
            starts.extend(pose_of_fundamental(fundamental, self.intrinsics(focal_px)));
            starts.push((model.pose.rotation, model.pose.direction));
            starts.extend(self.fits.last().map(|fit| fit.pose));
            self.fits.extend(self.best_at(focal_px, &starts));
        }
        for index in (1..self.fits.len()).rev() {
            let (focal_px, start) = (self.fits[index - 1].focal_px, self.fits[index].pose);
            if let Some(fit) = self.best_at(focal_px, &[start])
                && fit.cost < self.fits[index - 1].cost
            {
                self.fits[index - 1] = fit;
            }
        }
    }

    /// Returns the model of another valley that explains the matches better than `model`, if any.
    pub(super) fn better_than(&self, model: &PoseWithFocal) -> Option<PoseWithFocal> {
        let start = (model.pose.rotation, model.pose.direction);
        let known = self.refined(start, model.focal_px)?;
        let is_valley = |index: usize| {
            let cost = self.fits[index].cost;
            let before = index.checked_sub(1).map(|i| self.fits[i].cost);
            let after = self.fits.get(index + 1).map(|fit| fit.cost);
            [before, after].iter().flatten().all(|other| cost <= *other)
        };
        let best = (0..self.fits.len())
            .filter(|index| is_valley(*index))
            .filter_map(|index| self.refined(self.fits[index].pose, self.fits[index].focal_px))
            .min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        let is_other = (best.focal_px / known.focal_px - 1.0).abs() > SAME;
        if !(is_other && best.cost < known.cost) {
            return None;
        }
        PoseWithFocal::new(best.pose, best.focal_px, &self.of.centers)
    }

    /// Returns the standard deviation of the logarithm of the focal length, from the profile.
    ///
    /// Each profiled focal length gives a ratio: its distance, in logarithms, over the number of
    /// standard deviations by which its cost exceeds the minimum. For a parabolic cost all ratios
    /// are equal; for a cost that is flat on one side, or has two valleys, the largest counts.
    ///
    /// Source: the likelihood ratio; Venzon & Moolgavkar 1988, "A method for computing
    /// profile-likelihood-based confidence intervals".
    pub(super) fn relative_deviation(&self, model: &PoseWithFocal) -> f64 {
        let start = (model.pose.rotation, model.pose.direction);
        let here = self.fit(start, model.focal_px).map(|fit| fit.cost);
        let costs = self.fits.iter().map(|fit| fit.cost);
        let least = costs.chain(here).fold(f64::INFINITY, f64::min);
        let mut deviation: f64 = 0.0;
        for fit in &self.fits {
            let deviations = ((fit.cost - least) * self.num_each / self.variance).sqrt();
            if deviations <= POSSIBLE {
                let distance = libm::log(fit.focal_px / model.focal_px).abs();
                deviation = deviation.max(distance / deviations.max(1.0));
            }
        }
        deviation
    }

    fn intrinsics(&self, focal_px: f64) -> Option<[Intrinsics; 2]> {
        let [c1, c2] = self.of.centers;
        let k1 = Intrinsics::new(focal_px, focal_px, c1.x, c1.y).ok()?;
        let k2 = Intrinsics::new(focal_px, focal_px, c2.x, c2.y).ok()?;
        Some([k1, k2])
    }

    /// Scores a motion by the matches in front of both cameras, using the best of the four motions
    /// of its essential matrix.
    fn fit(&self, (rotation, direction): Pose, focal_px: f64) -> Option<Fit> {
        let [k1, k2] = self.intrinsics(focal_px)?;
        let lenses = Lenses::new(&k1, &k2);
        let essential = crate::camera::cross_matrix(&direction) * rotation;
        let (rotations, direction) = rotations_and_direction(&essential)?;
        let width_sq = self.width_px * self.width_px;
        let motions = rotations
            .into_iter()
            .flat_map(|rotation| [(rotation, direction), (rotation, -direction)]);
        motions
            .map(|pose| {
                let judged = RelativePose::from(pose);
                let fundamental = judged.fundamental_or_zeros(&k1, &k2);
                let judge = lenses.judge(&(judged, fundamental), self.max_error_px);
                let support =
                    in_front::support(&self.of.pixels, &judge, self.width_px, f64::INFINITY);
                Fit {
                    pose,
                    focal_px,
                    cost: width_sq * support.cost,
                }
            })
            .min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// Returns the best motion for a focal length from some initial motions.
    fn best_at(&self, focal_px: f64, starts: &[Pose]) -> Option<Fit> {
        let [k1, k2] = self.intrinsics(focal_px)?;
        let rays = RaysInFrame::new(&self.of.frame, &k1, &k2);
        let refined = |coordinates: &Coordinates, pose: &Pose, width_px: f64, steps: usize| {
            let width = width_px * self.of.frame.scale;
            let errors = ErrorsInFrame {
                coordinates,
                rays: &rays,
                loss: RobustLoss::Truncated { width },
            };
            refine_pose(&errors, *pose, &Steps::Free, &LmOptions::few_steps(steps))
        };
        let all = &self.of.in_frame;
        let fits = starts.iter().filter_map(|start| {
            let wide = refined(all, start, self.max_error_px, 5)?;
            self.fit(refined(all, &wide, self.width_px, 15)?, focal_px)
        });
        fits.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// Refines motion and focal length from initial values.
    fn refined(&self, start: Pose, focal_px: f64) -> Option<Fit> {
        let start = RelativePose::from(start);
        let width = self.width_px * self.of.frame.scale;
        let (pose, focal_px) = refine_pose_and_focal_in_frame(
            &self.of.in_frame,
            &self.of.centers_in_frame,
            (&start, focal_px),
            RobustLoss::Truncated { width },
            &LmOptions::few_steps(30),
        )?;
        let is_plausible = self.of.focals_px.contains(&focal_px);
        is_plausible.then(|| self.fit(pose, focal_px))?
    }

    /// Returns the two best motions of samples of five inliers.
    fn five_point_starts(
        &self,
        focal_px: f64,
        inliers: &[usize],
        random: &mut Random,
    ) -> Vec<Pose> {
        let ray = |p: nalgebra::Vector2<f64>| Vector3::new(p.x, p.y, focal_px).normalize();
        let mut found = Vec::new();
        for _ in 0..NUM_SAMPLES {
            let sample: [usize; 5] = core::array::from_fn(|_| inliers[random.below(inliers.len())]);
            let pairs = sample.map(|i| self.of.matches.pair(i));
            let rays1 = pairs.map(|(p, _)| ray(p - self.of.centers[0]));
            let rays2 = pairs.map(|(_, p)| ray(p - self.of.centers[1]));
            let mut solutions = [Matrix3::zeros(); 10];
            let count = five_point::solve(&rays1, &rays2, &mut solutions);
            for essential in &solutions[..count] {
                let pose = rotations_and_direction(essential).map(|(r, t)| (r[0], t));
                found.extend(pose.and_then(|pose| self.fit(pose, focal_px)));
            }
        }
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found.iter().take(2).map(|fit| fit.pose).collect()
    }
}

/// Chooses at most [`MAX_MATCHES`] of the inliers at random; returns them, and the number that each
/// represents.
fn choose_subset(mut inliers: Vec<usize>, random: &mut Random) -> (Vec<usize>, f64) {
    let (all, few) = (inliers.len(), inliers.len().min(MAX_MATCHES));
    for place in 0..few {
        inliers.swap(place, place + random.below(all - place));
    }
    inliers.truncate(few);
    (inliers, all as f64 / few.max(1) as f64)
}

/// Returns a motion of the essential matrix nearest to F.
fn pose_of_fundamental(
    fundamental: &Matrix3<f64>,
    intrinsics: Option<[Intrinsics; 2]>,
) -> Option<Pose> {
    let [k1, k2] = intrinsics?;
    let essential = k2.matrix().transpose() * fundamental * k1.matrix();
    let essential = project_to_essential(&essential).ok()?;
    rotations_and_direction(&essential).map(|(rotations, direction)| (rotations[0], direction))
}
