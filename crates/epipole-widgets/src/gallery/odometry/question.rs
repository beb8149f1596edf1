//! The job of `odometry`: renders the frames, tracks corners, and estimates the path of the camera.

use super::corners::Corners;
use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use crate::kit::sequence::{self, NUM_FRAMES, SIZE};
use crate::kit::sfm_image::sfm_image;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use epipole::math::random::Random;
use epipole::sfm::{
    AlignmentKind, Odometry, OdometryOptions, OdometryResult, SfmInput, absolute_trajectory_error,
};
use image::RgbImage;
use nalgebra::{Point3, Similarity3};
use serde::{Deserialize, Serialize};

/// Maximum stride over frames.
pub(super) const MAX_STRIDE: usize = 3;
/// Maximum number of points in the result.
const MAX_POINTS: usize = 600;

/// Frames used, and settings of the refinement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    /// Stride over the frames.
    pub(super) stride: usize,
    /// Maximum number of corners per frame.
    pub(super) num_corners: usize,
    /// Standard deviation of the noise, gray levels.
    pub(super) noise: f64,
    /// Number of keyframes refined together.
    pub(super) window: usize,
    /// Whether everything is refined at the end.
    pub(super) is_refined: bool,
}

/// A frame of the path.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Frame {
    pub(super) picture: Picture,
    /// Columns and rows of the corners.
    pub(super) corners: Vec<(f64, f64)>,
    /// Estimated `world_from_cam` in the ground-truth frame; `None` if the camera was lost.
    pub(super) world_from_cam: Option<RigidTransform>,
    pub(super) is_keyframe: bool,
}

/// The path, aligned to the true one.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) frames: Vec<Frame>,
    /// Points with their colors, in the ground-truth frame, and the first frame that saw each.
    pub(super) points: Vec<(Point3<f64>, [u8; 3], u32)>,
    /// Root mean square distance of the camera from its true path, meters.
    pub(super) error_m: f64,
    /// Meters per unit of the estimated path.
    pub(super) scale: f64,
}

impl Question {
    /// Returns the numbers of the frames used.
    pub(super) fn used(&self) -> impl Iterator<Item = usize> + use<> {
        (0..NUM_FRAMES).step_by(self.stride.clamp(1, MAX_STRIDE))
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Following the camera";
    const FAILED: &'static str = "There is no path";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let frames = sequence::frames(&mut |share| progress(0.5 * share))?;
        let used: Vec<usize> = self.used().collect();
        let gray: Vec<_> = (used.iter())
            .map(|frame| noisy(&frames[*frame], *frame, self.noise))
            .collect();
        let corners = Corners::follow(&gray, self.num_corners, &mut |share| {
            progress(0.5 + 0.2 * share)
        })?;
        tell(progress, 0.75)?;
        let images = (used.iter().zip(&corners.places))
            .map(|(frame, places)| sfm_image(&frames[*frame], places));
        let input = SfmInput {
            images: images.collect(),
            cameras: vec![sequence::camera(0).camera],
            pairs: corners.pairs(),
        };
        let options = OdometryOptions::default()
            .with_window(self.window)
            .with_final_adjustment(self.is_refined);
        let mut odometry = Odometry::monocular(&input, &options, &mut ())?;
        let mut done = 0.0;
        while odometry.step(&mut ())?.is_some() {
            done += 1.0;
            tell(progress, 0.8 + 0.2 * (done / used.len() as f64).min(1.0))?;
        }
        let result = odometry.finish();
        let truth: Vec<PosedCamera> = used.iter().map(|frame| sequence::camera(*frame)).collect();
        let (error_m, truth_from_found) = alignment(&result, &truth)?;
        let pictures = used.iter().map(|frame| frames[*frame].clone().into());
        let frames =
            (pictures.zip(&corners.places).enumerate()).map(|(index, (picture, places))| Frame {
                picture,
                corners: places.iter().map(|place| (place.x, place.y)).collect(),
                world_from_cam: result.world_from_cam[index]
                    .map(|pose| moved(&truth_from_found, &pose)),
                is_keyframe: result.keyframes.contains(&index),
            });
        let points = &result.reconstruction.points;
        let every = points.len().div_ceil(MAX_POINTS).max(1);
        let points = points.iter().step_by(every).map(|point| {
            let first = point.track.first().map_or(0, |element| element.image);
            (truth_from_found * point.position, point.color, first)
        });
        Ok(Answer {
            frames: frames.collect(),
            points: points.collect(),
            error_m,
            scale: truth_from_found.scaling(),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let is_finite = |point: &Point3<f64>| point.coords.iter().all(|x| x.is_finite());
        let mut centers = answer.frames.iter().filter_map(Frame::center);
        answer.frames.len() == self.used().count()
            && answer
                .frames
                .iter()
                .all(|frame| frame.picture.size() == SIZE)
            && centers.all(|center| is_finite(&center))
            && answer.points.iter().all(|(point, ..)| is_finite(point))
            && answer.error_m.is_finite()
            && answer.scale.is_finite()
    }
}

impl Answer {
    /// Returns the number of frames with a pose.
    pub(super) fn num_placed(&self) -> usize {
        let frames = self.frames.iter();
        frames
            .filter(|frame| frame.world_from_cam.is_some())
            .count()
    }
}

impl Frame {
    /// Returns the estimated camera center, in the ground-truth frame.
    pub(super) fn center(&self) -> Option<Point3<f64>> {
        Some(Point3::from(self.world_from_cam?.translation.vector))
    }
}

/// Returns the gray values of a frame, in [0, 1], with noise.
fn noisy(frame: &RgbImage, index: usize, noise: f64) -> GrayImage32 {
    let mut gray = rgb_to_gray_f32(frame, &BT601_WEIGHTS);
    let mut random = Random::new(index as u64);
    for value in gray.iter_mut() {
        *value += (noise / 255.0 * random.normal()) as f32;
    }
    gray
}

/// Returns the error of the path and the similarity that aligns it to the true one.
fn alignment(
    result: &OdometryResult,
    truth: &[PosedCamera],
) -> Result<(f64, Similarity3<f64>), Problem> {
    let (found, truth): (Vec<_>, Vec<_>) = (result.world_from_cam.iter().zip(truth))
        .filter_map(|(pose, camera)| {
            let center = Point3::from(pose.as_ref()?.translation.vector);
            Some((center, camera.center_in_world()))
        })
        .unzip();
    let (errors, truth_from_found) =
        absolute_trajectory_error(&found, &truth, AlignmentKind::Similarity)?;
    Ok((errors.rmse, truth_from_found))
}

fn moved(to_from_world: &Similarity3<f64>, world_from_cam: &RigidTransform) -> RigidTransform {
    let center = to_from_world * Point3::from(world_from_cam.translation.vector);
    let rotation = to_from_world.isometry.rotation * world_from_cam.rotation;
    RigidTransform::from_parts(center.coords.into(), rotation)
}
