//! Two-view reconstruction as one question: every stage from pixels to points in 3D.

mod stages;
mod surface;
mod verdict;

use self::surface::Surface;
pub(crate) use self::verdict::{MIN_NUM_MATCHES, Verdict};
use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question;
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at, relative_motion};
use epipole_scenes::still_life_camera;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// Center and target of the cameras of the rendered pairs, meters.
const FIRST: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.02, -0.16, 0.05]];
const STEP: [[f64; 3]; 2] = [[0.22, -0.47, -1.20], [0.02, -0.16, 0.05]];
const TURN: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.30, -0.20, 0.0]];

/// Stage of the pipeline; later stages include earlier results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stage {
    Detect,
    Match,
    Ransac,
    Pose,
    Cloud,
    Adjust,
    Surface,
}

/// Source of the two photographs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Source {
    /// The rendered still life, from two positions.
    Step,
    /// The rendered still life, from one position in two directions.
    Turn,
    /// Photographs of the reader.
    Own([Picture; 2]),
}

/// Input of the computation.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Question {
    pub(crate) source: Source,
    /// Focal length, in units of a photograph's longer side.
    pub(crate) focal: f64,
    /// Maximum ratio of Lowe's test.
    pub(crate) max_ratio: f32,
    /// Maximum distance of an inlier from its epipolar line, pixels.
    pub(crate) max_error_px: f64,
    /// Rotation that perturbs camera 2 before triangulation, degrees.
    pub(crate) knock_deg: f64,
}

/// A point of the cloud.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct CloudPoint {
    /// Position in the frame of camera 1; the baseline has length 1.
    pub(crate) place: Point3<f64>,
    /// Position before bundle adjustment.
    pub(crate) triangulated: Point3<f64>,
    pub(crate) color: [u8; 3],
}

impl CloudPoint {
    /// Returns its position before bundle adjustment, and its color.
    pub(crate) fn before(&self) -> (Point3<f64>, [u8; 3]) {
        (self.triangulated, self.color)
    }
}

/// A relative pose and the reconstruction from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Motion {
    /// Pose of camera 2 relative to camera 1, from RANSAC.
    pub(crate) found: RigidTransform,
    /// The same after bundle adjustment.
    pub(crate) cam2_from_cam1: RigidTransform,
    /// Number of inliers in front of both cameras for each of the four poses of E, in descending
    /// order.
    pub(crate) num_in_front: [usize; 4],
    /// Root mean square reprojection error before and after bundle adjustment, pixels.
    pub(crate) error_px: [f64; 2],
    pub(crate) points: Vec<CloudPoint>,
    /// Dense points from stereo matching, or the reason why there are none.
    pub(crate) surface: Result<Surface, String>,
}

/// Result of the computation.
#[derive(Serialize, Deserialize)]
pub(crate) struct Answer {
    pub(crate) pictures: [Picture; 2],
    /// Positions of all features, pixels.
    pub(crate) keypoints: [Vec<Point2<f64>>; 2],
    /// Feature indices of each match.
    pub(crate) matches: Vec<(u32, u32)>,
    /// Inlier mask over the matches.
    pub(crate) inliers: Vec<bool>,
    pub(crate) verdict: Verdict,
    /// Present if the verdict allows a cloud.
    pub(crate) motion: Option<Motion>,
}

impl Motion {
    fn is_sound(&self) -> bool {
        let is_motion = |motion: &RigidTransform| {
            (motion.rotation.coords.norm() - 1.0).abs() < 1e-6
                && (motion.translation.vector.norm() - 1.0).abs() < 1e-6
        };
        let places = self
            .points
            .iter()
            .flat_map(|point| [&point.place, &point.triangulated]);
        let numbers = places.flat_map(|place| place.iter()).chain(&self.error_px);
        let surface = self.surface.iter().flat_map(|surface| &surface.points);
        let surface = surface.flat_map(|(place, _)| place);
        // Written so that NaN is rejected.
        is_motion(&self.found)
            && is_motion(&self.cam2_from_cam1)
            && numbers.into_iter().all(|x| x.abs() < 1e12)
            && surface.into_iter().all(|x| x.abs() < 1e12)
    }
}

impl Answer {
    /// Returns the positions of a match's two features, pixels.
    pub(crate) fn pixels(&self, (i, j): (u32, u32)) -> [Point2<f64>; 2] {
        [self.keypoints[0][i as usize], self.keypoints[1][j as usize]]
    }

    /// Returns the inlier matches, or the outliers.
    pub(crate) fn matches_that(&self, agree: bool) -> impl Iterator<Item = (u32, u32)> {
        let matches = self.matches.iter().zip(&self.inliers);
        matches.filter_map(move |(pair, is_inlier)| (*is_inlier == agree).then_some(*pair))
    }

    pub(crate) fn num_inliers(&self) -> usize {
        self.inliers.iter().filter(|is_inlier| **is_inlier).count()
    }
}

impl Question {
    fn camera(&self, (width, height): (u32, u32)) -> Result<Camera, Error> {
        let focal_px = self.focal * f64::from(width.max(height));
        let intrinsics = Intrinsics::centered(focal_px, width, height)?;
        Ok(Camera::pinhole(intrinsics, width, height))
    }

    /// Returns the pose of camera 2 relative to camera 1 at a stage.
    pub(crate) fn motion(&self, answer: &Answer, stage: Stage) -> Option<RigidTransform> {
        let motion = answer.motion.as_ref()?;
        match stage {
            Stage::Detect | Stage::Match | Stage::Ransac => None,
            Stage::Pose => Some(motion.found),
            Stage::Cloud => Some(self.knocked(&motion.found)),
            Stage::Adjust | Stage::Surface => Some(motion.cam2_from_cam1),
        }
    }

    /// Returns camera 1, and camera 2 once a stage knows its pose.
    pub(crate) fn cameras(
        &self,
        answer: &Answer,
        stage: Stage,
    ) -> Option<(PosedCamera, Option<PosedCamera>)> {
        let camera = |index: usize, cam_from_world| {
            Some(PosedCamera {
                camera: self.camera(answer.pictures[index].size()).ok()?,
                cam_from_world,
            })
        };
        let second = self
            .motion(answer, stage)
            .and_then(|motion| camera(1, motion));
        Some((camera(0, RigidTransform::identity())?, second))
    }

    /// Rotates camera 2 about its center, up and sideways.
    fn knocked(&self, cam2_from_cam1: &RigidTransform) -> RigidTransform {
        let axis = Vector3::new(0.8, 0.6, 0.0) * self.knock_deg.to_radians();
        UnitQuaternion::from_scaled_axis(axis) * cam2_from_cam1
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Following the pipeline";
    const FAILED: &'static str = "There is no motion";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        self.follow(progress)
    }

    fn fits(&self, answer: &Answer) -> bool {
        let nums = answer.keypoints.each_ref().map(Vec::len);
        let is_there = |(i, j): &(u32, u32)| (*i as usize) < nums[0] && (*j as usize) < nums[1];
        // Written so that NaN is rejected.
        let is_place = |pixel: &Point2<f64>| pixel.iter().all(|x| x.abs() < 1e6);
        answer.keypoints.iter().flatten().all(is_place)
            && answer.matches.iter().all(is_there)
            && answer.inliers.len() == answer.matches.len()
            && answer.motion.iter().all(Motion::is_sound)
    }
}

impl Source {
    /// Returns the true cameras of a rendered pair.
    fn cameras(&self) -> Result<[PosedCamera; 2], Error> {
        let second = match self {
            Self::Turn => TURN,
            Self::Step | Self::Own(_) => STEP,
        };
        let camera = |[center, target]: [[f64; 3]; 2]| {
            let up = Vector3::new(0.0, -1.0, 0.0);
            Ok(PosedCamera {
                cam_from_world: look_at(&Point3::from(center), &Point3::from(target), &up)?,
                ..still_life_camera(PHOTO_WIDTH, PHOTO_HEIGHT)
            })
        };
        Ok([camera(FIRST)?, camera(second)?])
    }

    /// Returns the true rotation of camera 2 of a rendered pair, degrees.
    pub(crate) fn true_turn_deg(&self) -> Option<f64> {
        if matches!(self, Self::Own(_)) {
            return None;
        }
        let [first, second] = self.cameras().ok()?;
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        Some(motion.rotation.angle().to_degrees())
    }
}
