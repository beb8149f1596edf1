//! The job of `incremental-sfm`: photographs on an arc, their matches, and the steps of a
//! reconstruction.

use super::steps::{self, Step};
use crate::contract::{Problem, Progress};
use crate::kit::features::features_of;
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use crate::kit::scenes::photograph;
use crate::kit::sfm_image::sfm_image;
use epipole::Error;
use epipole::camera::{PosedCamera, look_at};
use epipole::feature::{Features, MatchOptions, match_descriptors};
use epipole::sfm::{PairMatches, SfmInput};
use epipole_scenes::still_life_camera;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};

/// Size of a photograph, pixels.
pub(super) const SIZE: (u32, u32) = (320, 240);
/// Point that all cameras look at, meters.
pub(super) const TARGET: [f64; 3] = [0.02, -0.14, 0.05];
/// Distance of the cameras from the target along the floor, and their height above it, meters.
const DISTANCE_M: f64 = 1.3;
const HEIGHT_M: f64 = 0.42;

/// Photographs, and the thresholds of registration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) num_photographs: usize,
    /// Angle between neighbors as seen from the target, degrees.
    pub(super) apart_deg: f64,
    /// Minimum number of inliers of a pair and of a pose.
    pub(super) min_num_inliers: usize,
}

/// The photographs, and the state after each step.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    /// Photographs from left to right.
    pub(super) pictures: Vec<Picture>,
    pub(super) steps: Vec<Step>,
}

impl Question {
    /// Returns the camera of a photograph; the first one is at the left end of the arc.
    ///
    /// # Errors
    /// As [`look_at`].
    pub(super) fn camera(&self, index: usize) -> Result<PosedCamera, Error> {
        let from_middle = index as f64 - (self.num_photographs as f64 - 1.0) / 2.0;
        let (sin, cos) = libm::sincos((from_middle * self.apart_deg).to_radians());
        let target = Point3::from(TARGET);
        let center = target + Vector3::new(DISTANCE_M * sin, -HEIGHT_M, -DISTANCE_M * cos);
        Ok(PosedCamera {
            cam_from_world: look_at(&center, &target, &Vector3::new(0.0, -1.0, 0.0))?,
            ..still_life_camera(SIZE.0, SIZE.1)
        })
    }

    /// Returns all cameras.
    ///
    /// # Errors
    /// As [`look_at`].
    pub(super) fn cameras(&self) -> Result<Vec<PosedCamera>, Error> {
        (0..self.num_photographs)
            .map(|index| self.camera(index))
            .collect()
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Registering photographs";
    const FAILED: &'static str = "There is no reconstruction";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let truth = self.cameras()?;
        let count = truth.len() as f64;
        let (mut pictures, mut features, mut images) = (Vec::new(), Vec::new(), Vec::new());
        for (index, camera) in truth.iter().enumerate() {
            tell(progress, 0.7 * index as f64 / count)?;
            let mut quietly = |_| std::ops::ControlFlow::Continue(());
            let picture = photograph(camera, SIZE, &mut quietly)?;
            let found = features_of(&picture, &mut quietly)?;
            let places: Vec<_> = (found.keypoints.iter())
                .map(|keypoint| keypoint.point())
                .collect();
            images.push(sfm_image(&picture, &places));
            features.push(found);
            pictures.push(picture.into());
        }
        let input = SfmInput {
            images,
            cameras: vec![truth[0].camera],
            pairs: pairs(&features, &mut |share| progress(0.7 + 0.2 * share))?,
        };
        let steps = steps::follow(&input, &truth, self.min_num_inliers, &mut |share| {
            progress(0.9 + 0.1 * share)
        })?;
        Ok(Answer { pictures, steps })
    }

    fn fits(&self, answer: &Answer) -> bool {
        answer.pictures.len() == self.num_photographs
            && (answer.pictures.iter()).all(|picture| picture.size() == SIZE)
            && (answer.steps.iter()).all(|step| step.is_sound(self.num_photographs))
    }
}

/// Matches every photograph with every other.
fn pairs(features: &[Features], progress: Progress<'_>) -> Result<Vec<PairMatches>, Error> {
    let options = MatchOptions::default();
    let mut pairs = Vec::new();
    for image2 in 1..features.len() {
        tell(progress, image2 as f64 / features.len() as f64)?;
        for image1 in 0..image2 {
            let [first, second] = [image1, image2].map(|image| &features[image].descriptors);
            pairs.push(PairMatches {
                image1,
                image2,
                matches: match_descriptors(first, second, &options, &mut ())?,
            });
        }
    }
    Ok(pairs)
}
