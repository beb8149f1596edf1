//! What do two photographs tell? Every stage, from their pixels to points in space, as one question.

mod surface;
mod verdict;

use self::surface::{Surface, surface};
use self::verdict::{Judged, judge};
pub(crate) use self::verdict::{MIN_NUM_MATCHES, Verdict};
use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use crate::kit::scenes::{self, PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH};
use epipole::Error;
use epipole::camera::{Camera, Intrinsics, RigidTransform, look_at, relative_motion};
use epipole::feature::{
    FeatureOptions, Features, MatchOptions, detect_sift_with_progress, match_descriptors,
    photo_to_gray,
};
use epipole::sfm::{TwoViewReconstructionOptions, two_view_reconstruction};
use epipole::synthetic::still_life_camera;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// More features than this cost time and show nothing new.
const MAX_FEATURES: usize = 3000;

/// Where the cameras of the rendered pairs are, and where they look.
const FIRST: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.02, -0.16, 0.05]];
const STEP: [[f64; 3]; 2] = [[0.22, -0.47, -1.20], [0.02, -0.16, 0.05]];
const TURN: [[f64; 3]; 2] = [[-0.12, -0.45, -1.24], [0.30, -0.20, 0.0]];

/// How far the pipeline has come; later stages know what earlier ones do.
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

/// Where the two photographs come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Source {
    /// The rendered still life, from two places.
    Step,
    /// The rendered still life, from one place in two directions.
    Turn,
    /// The reader's own.
    Own([Picture; 2]),
}

/// Everything that the answer depends on.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Question {
    pub(crate) source: Source,
    /// Focal length, in units of a photograph's longer side.
    pub(crate) focal: f64,
    /// Of Lowe's test.
    pub(crate) max_ratio: f32,
    /// Largest distance of an inlier from its epipolar line, pixels.
    pub(crate) max_error_px: f64,
    /// How far camera 2 is turned away from its pose before points are triangulated, degrees.
    pub(crate) knock_deg: f64,
}

/// A point of the cloud.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct CloudPoint {
    /// Where it is in the frame of camera 1; the baseline has length 1.
    pub(crate) place: Point3<f64>,
    /// Where it was before the adjustment.
    pub(crate) triangulated: Point3<f64>,
    pub(crate) color: [u8; 3],
}

impl CloudPoint {
    /// Where it was before the adjustment, and its color.
    pub(crate) fn before(&self) -> (Point3<f64>, [u8; 3]) {
        (self.triangulated, self.color)
    }
}

/// A motion and what follows from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Motion {
    /// Camera 2 in the frame of camera 1, as RANSAC found it.
    pub(crate) found: RigidTransform,
    /// The same, adjusted.
    pub(crate) cam2_from_cam1: RigidTransform,
    /// How many inliers each of the four poses of E puts in front of both cameras, most first.
    pub(crate) num_in_front: [usize; 4],
    /// Root mean square of the distances of projections from their features, pixels, before and
    /// after the adjustment of all.
    pub(crate) error_px: [f64; 2],
    pub(crate) points: Vec<CloudPoint>,
    /// Every pixel that has a partner in its row; or why there is none.
    pub(crate) surface: Result<Surface, String>,
}

/// What the computation finds.
#[derive(Serialize, Deserialize)]
pub(crate) struct Answer {
    pub(crate) pictures: [Picture; 2],
    /// Places of all features, pixels.
    pub(crate) keypoints: [Vec<Point2<f64>>; 2],
    /// The features of each match.
    pub(crate) matches: Vec<(u32, u32)>,
    /// For each match, whether it agrees with what was found.
    pub(crate) inliers: Vec<bool>,
    pub(crate) verdict: Verdict,
    /// There for the verdicts that have a cloud.
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
        // NaN is not less than anything.
        is_motion(&self.found)
            && is_motion(&self.cam2_from_cam1)
            && numbers.into_iter().all(|x| x.abs() < 1e12)
            && surface.into_iter().all(|x| x.abs() < 1e12)
    }
}

impl Answer {
    /// Where the two features of a match are, pixels.
    pub(crate) fn pixels(&self, (i, j): (u32, u32)) -> [Point2<f64>; 2] {
        [self.keypoints[0][i as usize], self.keypoints[1][j as usize]]
    }

    /// The matches that agree with what was found, or those that do not.
    pub(crate) fn matches_that(&self, agree: bool) -> impl Iterator<Item = (u32, u32)> {
        let matches = self.matches.iter().zip(&self.inliers);
        matches.filter_map(move |(pair, is_inlier)| (*is_inlier == agree).then_some(*pair))
    }

    pub(crate) fn num_inliers(&self) -> usize {
        self.inliers.iter().filter(|is_inlier| **is_inlier).count()
    }
}

impl Question {
    fn lens(&self, (width, height): (u32, u32)) -> Result<Intrinsics, Error> {
        Intrinsics::centered(self.focal * f64::from(width.max(height)), width, height)
    }

    /// Camera 2 in the frame of camera 1, as a stage has it.
    pub(crate) fn motion(&self, answer: &Answer, stage: Stage) -> Option<RigidTransform> {
        let motion = answer.motion.as_ref()?;
        match stage {
            Stage::Detect | Stage::Match | Stage::Ransac => None,
            Stage::Pose => Some(motion.found),
            Stage::Cloud => Some(self.knocked(&motion.found)),
            Stage::Adjust | Stage::Surface => Some(motion.cam2_from_cam1),
        }
    }

    /// Camera 1 of the answer, and camera 2 once a stage knows its motion.
    pub(crate) fn cameras(
        &self,
        answer: &Answer,
        stage: Stage,
    ) -> Option<(Camera, Option<Camera>)> {
        let camera = |index: usize, cam_from_world| {
            let intrinsics = self.lens(answer.pictures[index].size()).ok()?;
            Some(Camera {
                intrinsics,
                cam_from_world,
            })
        };
        let second = self
            .motion(answer, stage)
            .and_then(|motion| camera(1, motion));
        Some((camera(0, RigidTransform::identity())?, second))
    }

    /// Camera 2 turned on the spot, up and aside.
    fn knocked(&self, cam2_from_cam1: &RigidTransform) -> RigidTransform {
        let axis = Vector3::new(0.8, 0.6, 0.0) * self.knock_deg.to_radians();
        UnitQuaternion::from_scaled_axis(axis) * cam2_from_cam1
    }

    fn photographs(&self, progress: Progress<'_>) -> Result<[Picture; 2], Error> {
        if let Source::Own(pictures) = &self.source {
            return Ok(pictures.clone());
        }
        let [first, second] = self.source.cameras()?;
        let first = scenes::photograph(&first, PHOTO_SIZE, &mut |share| progress(0.2 * share))?;
        let part = &mut |share| progress(0.2 + 0.2 * share);
        let second = scenes::photograph(&second, PHOTO_SIZE, part)?;
        Ok([first.into(), second.into()])
    }

    /// What the inliers of a pair with depth give; `None` if hardly any point can be had.
    fn reconstruct(
        &self,
        judged: &Judged,
        [pixels1, pixels2]: [&[Point2<f64>]; 2],
        [lens1, lens2]: &[Intrinsics; 2],
        colors: &[[u8; 3]],
    ) -> Result<Option<Motion>, Error> {
        let Some(motion) = judged.cam2_from_cam1 else {
            return Ok(None);
        };
        let chosen = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let pixels = pixels.iter().zip(&judged.inliers);
            pixels
                .filter(|(_, is_inlier)| **is_inlier)
                .map(|(p, _)| *p)
                .collect()
        };
        let inliers: Vec<usize> = (0..colors.len()).filter(|&n| judged.inliers[n]).collect();
        let found = two_view_reconstruction(
            &chosen(pixels1),
            &chosen(pixels2),
            lens1,
            lens2,
            &self.knocked(&motion),
            &TwoViewReconstructionOptions::default(),
            &mut |_| ControlFlow::Continue(()),
        );
        let found = match found {
            // The rays of all but a few meet at a narrow angle.
            Err(Error::TooFew { .. }) => return Ok(None),
            found => found?,
        };
        let places = found.points.iter().zip(&found.triangulated);
        let points = places.zip(&found.match_of_point);
        Ok(Some(Motion {
            found: motion,
            cam2_from_cam1: found.cam2_from_cam1,
            num_in_front: found.num_in_front,
            error_px: [found.rms_before_px, found.rms_px],
            points: points
                .map(|((place, triangulated), inlier)| CloudPoint {
                    place: *place,
                    triangulated: *triangulated,
                    color: colors[inliers[*inlier]],
                })
                .collect(),
            surface: Err(String::new()),
        }))
    }

    /// Every pixel as a point, where the pair can be rectified.
    fn look_everywhere(
        motion: &mut Motion,
        pictures: &[Picture; 2],
        lenses: &[Intrinsics; 2],
        progress: Progress<'_>,
    ) -> Result<(), Error> {
        let places: Vec<_> = motion.points.iter().map(|point| point.place).collect();
        let images = pictures.each_ref().map(Picture::image);
        let found = surface(images, lenses, &motion.cam2_from_cam1, &places, progress);
        motion.surface = match found {
            Err(Error::Canceled) => return Err(Error::Canceled),
            found => found.map_err(|error| error.to_string()),
        };
        Ok(())
    }
}

impl Question {
    /// Features of the first photograph and what they match in the second.
    fn matches(&self, first: &Features, second: &Features) -> Result<Vec<(u32, u32)>, Error> {
        let options = MatchOptions {
            max_ratio: Some(self.max_ratio),
            ..MatchOptions::default()
        };
        let found = match_descriptors(&first.descriptors, &second.descriptors, &options)?;
        let pairs = found.iter().map(|m| (m.index1 as u32, m.index2 as u32));
        Ok(pairs.collect())
    }
}

/// What the core looks for in photographs by default, and no other kind: a worker would download those for nothing.
fn features(picture: &Picture, progress: Progress<'_>) -> Result<Features, Error> {
    let options = FeatureOptions {
        max_features: MAX_FEATURES,
        ..FeatureOptions::default()
    };
    let (width, height) = picture.size();
    detect_sift_with_progress(
        &photo_to_gray(picture.image()),
        &options.sift(width, height),
        &mut |status| progress(f64::from(status.share)),
    )
}

fn color_at(picture: &Picture, pixel: &Point2<f64>) -> [u8; 3] {
    let (width, height) = picture.size();
    let inside = |x: f64, size: u32| (x.round().max(0.0) as u32).min(size.max(1) - 1);
    let (u, v) = (inside(pixel.x, width), inside(pixel.y, height));
    picture.image().get_pixel(u, v).0
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Following the pipeline";
    const FAILED: &'static str = "There is no motion";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        tell(progress, 0.0)?;
        let pictures = self.photographs(progress)?;
        let lenses = [
            self.lens(pictures[0].size())?,
            self.lens(pictures[1].size())?,
        ];
        let first = features(&pictures[0], &mut |share| progress(0.4 + 0.1 * share))?;
        let second = features(&pictures[1], &mut |share| progress(0.5 + 0.1 * share))?;
        let matches = self.matches(&first, &second)?;
        tell(progress, 0.7)?;
        let keypoints = [&first, &second].map(|found| -> Vec<_> {
            let keypoints = found.keypoints.iter();
            keypoints.map(|keypoint| keypoint.point()).collect()
        });
        let pixels1: Vec<_> = matches.iter().map(|m| keypoints[0][m.0 as usize]).collect();
        let pixels2: Vec<_> = matches.iter().map(|m| keypoints[1][m.1 as usize]).collect();
        let colors: Vec<_> = (matches.iter())
            .map(|m| color_at(&pictures[0], &keypoints[0][m.0 as usize]))
            .collect();
        let judged = judge([&pixels1, &pixels2], &lenses, self.max_error_px)?;
        tell(progress, 0.75)?;
        let mut motion = self.reconstruct(&judged, [&pixels1, &pixels2], &lenses, &colors)?;
        if let Some(motion) = &mut motion {
            Self::look_everywhere(motion, &pictures, &lenses, &mut |share| {
                progress(0.8 + 0.2 * share)
            })?;
        }
        let has_depth = judged.cam2_from_cam1.is_some();
        Ok(Answer {
            pictures,
            keypoints,
            matches,
            verdict: match motion.is_none() && has_depth {
                true => Verdict::Narrow(judged.median_angle_deg),
                false => judged.verdict,
            },
            inliers: judged.inliers,
            motion,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let nums = answer.keypoints.each_ref().map(Vec::len);
        let is_there = |(i, j): &(u32, u32)| (*i as usize) < nums[0] && (*j as usize) < nums[1];
        // NaN is not within any bounds.
        let is_place = |pixel: &Point2<f64>| pixel.iter().all(|x| x.abs() < 1e6);
        answer.keypoints.iter().flatten().all(is_place)
            && answer.matches.iter().all(is_there)
            && answer.inliers.len() == answer.matches.len()
            && answer.motion.iter().all(Motion::is_sound)
    }
}

impl Source {
    /// The true cameras of a rendered pair.
    fn cameras(&self) -> Result<[Camera; 2], Error> {
        let second = match self {
            Self::Turn => TURN,
            Self::Step | Self::Own(_) => STEP,
        };
        let camera = |[center, target]: [[f64; 3]; 2]| {
            let up = Vector3::new(0.0, -1.0, 0.0);
            Ok(Camera {
                cam_from_world: look_at(&Point3::from(center), &Point3::from(target), &up)?,
                ..still_life_camera(PHOTO_WIDTH, PHOTO_HEIGHT)
            })
        };
        Ok([camera(FIRST)?, camera(second)?])
    }

    /// How far camera 2 of a rendered pair is really turned, degrees.
    pub(crate) fn true_turn_deg(&self) -> Option<f64> {
        if matches!(self, Self::Own(_)) {
            return None;
        }
        let [first, second] = self.cameras().ok()?;
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        Some(motion.rotation.angle().to_degrees())
    }
}
