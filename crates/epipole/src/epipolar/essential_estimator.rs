//! RANSAC estimator of the relative pose of calibrated cameras.

use super::RelativePose;
use super::estimate_fundamental::refuse_collinear;
use super::five_point::{pose_in_front, solve};
use super::lens_matches::LensMatches;
use super::observed_matches::ObservedMatches;
use super::other_motion::other_motion_of_plane;
use super::pinhole_matches::PinholeMatches;
use super::refine_pose::Steps;
use super::sight::Sight;
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Camera, Observation};
use crate::math::random::Random;
use crate::robust::{Data, Estimator, Evidence, MatchSet, Problem, Support};
use nalgebra::{Matrix3, Point2, Vector3};

/// Estimator of relative poses of calibrated cameras from matches, for
/// [`Ransac`](crate::robust::Ransac).
///
/// A sample is five matches, and only solutions with the five points in front of both cameras are
/// scored. The error is the Sampson error in pixels, for lenses other than pinholes the [tangent
/// Sampson error](super::tangent_sampson_px); refinement minimizes it, truncated, over rotation and
/// direction. A match behind a camera supports no pose, however close it is to its epipolar line,
/// unless it could be infinitely far away within the threshold. If a plane holds most of the
/// inliers of pinhole cameras, the second motion that it allows is tried as well. Equal matches
/// count once.
///
/// Source: Nistér 2004, "An efficient solution to the five-point relative pose problem";
/// Longuet-Higgins 1986, "The reconstruction of a plane surface from two perspective projections".
#[derive(Debug)]
pub struct EssentialEstimator {
    matches: MatchSet,
    rays: Vec<[Vector3<f64>; 2]>,
    sight: Box<dyn Sight>,
    steps: Steps,
}

const NAME: &str = "an essential matrix from matches";

impl EssentialEstimator {
    /// Prepares the estimation; a match with a pixel that has no ray is left out.
    ///
    /// * `pixels1`, `pixels2`: matching pixels of the two images, in the same order
    ///
    /// # Errors
    /// As [`MatchSet::new`]; [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 5 matches,
    /// [`Error::Degenerate`] if all pixels of an image of a pinhole camera are equal or on one
    /// line.
    pub fn new(
        pixels1: &[Point2<f64>],
        pixels2: &[Point2<f64>],
        cameras: [&Camera; 2],
    ) -> Result<Self> {
        if Camera::are_pinholes(cameras) {
            let matches = MatchSet::new(pixels1, pixels2)?;
            matches.at_least(5, NAME)?;
            refuse_collinear(&matches, NAME)?;
            let [k1, k2] = cameras.map(|camera| camera.intrinsics);
            let ray = |i| {
                let (p1, p2) = matches.pair(i);
                [k1.ray(&p1).normalize(), k2.ray(&p2).normalize()]
            };
            let rays = (0..matches.len()).map(ray).collect();
            let sight = PinholeMatches::new(&matches, k1, k2);
            Ok(Self::of(matches, rays, Box::new(sight)))
        } else {
            let observed = ObservedMatches::new(pixels1, pixels2, cameras)?;
            observed.matches.at_least(5, NAME)?;
            let sight = LensMatches::new(&observed);
            let [observations1, observations2] = &observed.observations;
            let both = observations1.iter().zip(observations2);
            let rays = both.map(|(one, two)| [one, two].map(Observation::ray));
            let rays = rays.collect();
            Ok(Self::of(observed.matches, rays, Box::new(sight)))
        }
    }

    fn of(matches: MatchSet, rays: Vec<[Vector3<f64>; 2]>, sight: Box<dyn Sight>) -> Self {
        Self {
            matches,
            rays,
            sight,
            steps: Steps::Free,
        }
    }

    /// Restricts refinement to motions that keep the known direction of gravity.
    ///
    /// * `gravity2`: a unit vector in the frame of camera 2
    pub(super) fn upright(self, gravity2: Vector3<f64>) -> Self {
        Self {
            steps: Steps::AboutGravity(gravity2),
            ..self
        }
    }

    /// Returns the rays of a sample of matches; `None` if two of them share a pixel.
    pub(super) fn rays_of<const N: usize>(
        &self,
        sample: &[usize],
    ) -> Option<[[Vector3<f64>; N]; 2]> {
        let rays = |image: usize| core::array::from_fn(|i| self.rays[sample[i]][image]);
        (!self.matches.have_shared_pixel(sample)).then(|| [0, 1].map(rays))
    }

    /// Returns a pose with the matrix that measures its errors.
    pub(super) fn candidate(&self, pose: RelativePose) -> (RelativePose, Matrix3<f64>) {
        self.sight.candidate(pose)
    }

    /// Returns the rays of a subset of the given matches.
    ///
    /// * `mask`: for each given match, whether it is in the subset
    pub(super) fn rays_among<'a>(
        &'a self,
        mask: &'a [bool],
    ) -> impl Iterator<Item = [Vector3<f64>; 2]> + Clone + 'a {
        let places = self.matches.unique().places().iter();
        let inliers = places.zip(mask).filter(|(_, is)| **is);
        inliers.filter_map(|(place, _)| place.map(|place| self.rays[place]))
    }
}

impl Estimator for EssentialEstimator {
    /// A pose, and the matrix for its errors: F of the pixels of pinhole cameras, E of the rays of
    /// other lenses.
    type Model = (RelativePose, Matrix3<f64>);

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: NAME,
            sample_size: 5,
            max_models: 10,
            codimension: 1,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        let Some([rays1, rays2]) = self.rays_of(sample) else {
            return;
        };
        let mut solutions = [Matrix3::zeros(); 10];
        let count = solve(&rays1, &rays2, &mut solutions);
        for essential in &solutions[..count] {
            if let Some(pose) = pose_in_front(essential, &rays1, &rays2) {
                models.push(self.candidate(pose.into()));
            }
        }
    }

    fn error_sq(&self, model: &Self::Model, index: usize) -> f64 {
        self.sight.error_sq(model, index)
    }

    fn refine(
        &mut self,
        model: &Self::Model,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<Self::Model> {
        self.sight.refine(model, inliers, max_error_px, &self.steps)
    }

    fn polish(
        &mut self,
        model: &Self::Model,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Self::Model> {
        self.sight.polish(model, near, weights, &self.steps)
    }

    fn alternative(
        &mut self,
        model: &Self::Model,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<Self::Model> {
        let Evidence::Inliers(inliers) = evidence else {
            return None;
        };
        let plane = self
            .sight
            .dominant_plane(model, inliers, max_error_px, random)?;
        let there = other_motion_of_plane(&model.0.rotation, &model.0.direction, &plane)?;
        let there = self.candidate(there.into());
        let back = (there.0.back(), there.1);
        let cost = |model| self.support(model, max_error_px, f64::INFINITY).cost;
        let known = cost(model);
        let mut found = match cost(&back) < cost(&there) {
            true => back,
            false => there,
        };
        let mut near = Vec::new();
        for reach_px in [2.0 * max_error_px, max_error_px, max_error_px] {
            self.inliers(&found, reach_px, &mut near);
            found = self.refine(&found, &near, reach_px)?;
        }
        let cost = self.support(&found, max_error_px, f64::INFINITY).cost;
        (cost < known).then_some(found)
    }

    fn support(&self, model: &Self::Model, max_error_px: f64, cost_limit: f64) -> Support {
        self.sight.support(model, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &Self::Model, max_error_px: f64, inliers: &mut Vec<usize>) {
        self.sight.inliers(model, max_error_px, inliers);
    }
}
