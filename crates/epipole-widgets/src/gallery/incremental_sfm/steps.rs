//! Steps of a growing reconstruction, in the ground-truth frame.

use crate::contract::{Problem, Progress};
use crate::kit::question::tell;
use epipole::Error;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::sfm::{
    IncrementalReconstruction, PairMatches, Reconstruction, SfmInput, SfmOptions, SfmStep,
};
use nalgebra::{Point3, Similarity3};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;

/// Maximum number of points per step.
const MAX_POINTS: usize = 1000;

/// A feature: its photograph, and its index there.
type Feature = (usize, usize);

/// State after a step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Step {
    /// Photograph registered last.
    pub(super) newest: usize,
    /// Poses of the registered cameras.
    pub(super) cam_from_world: Vec<Option<RigidTransform>>,
    /// Points with their colors, at most [`MAX_POINTS`].
    pub(super) points: Vec<([f32; 3], [u8; 3])>,
    pub(super) num_points: usize,
    /// Mean reprojection error, pixels.
    pub(super) error_px: f64,
    /// Number of points visible in each photograph; for an unregistered one according to its
    /// matches.
    pub(super) num_seen: Vec<usize>,
    /// Features of the newest photograph that had a point before its registration, and whether they
    /// are inliers of its pose.
    pub(super) sights: Vec<([f64; 2], bool)>,
    /// Root mean square distance of the cameras after the first from their true positions, meters.
    pub(super) off_m: f64,
}

impl Step {
    /// Returns whether it is consistent for this number of photographs, without NaN.
    pub(super) fn is_sound(&self, num_photographs: usize) -> bool {
        let poses = self.cam_from_world.iter().flatten();
        let places = self.points.iter().flat_map(|(place, _)| place);
        self.newest < num_photographs
            && self.cam_from_world.len() == num_photographs
            && self.num_seen.len() == num_photographs
            && self.off_m.is_finite()
            && self.error_px.is_finite()
            && places.into_iter().all(|x| x.is_finite())
            && poses
                .flat_map(|pose| pose.translation.vector.iter())
                .all(|x| x.is_finite())
    }

    pub(super) fn num_registered(&self) -> usize {
        self.cam_from_world.iter().flatten().count()
    }
}

/// Reconstructs, and returns the state after the start and after each registration; refinements
/// without a new photograph belong to the step before them.
///
/// * `truth`: true cameras of the photographs
///
/// # Errors
/// As [`IncrementalReconstruction::new`], and if no pair is suitable as a start.
pub(super) fn follow(
    input: &SfmInput,
    truth: &[PosedCamera],
    min_num_inliers: usize,
    progress: Progress<'_>,
) -> Result<Vec<Step>, Problem> {
    let options = SfmOptions::default().with_min_num_inliers(min_num_inliers);
    let mut run = IncrementalReconstruction::new(input, &options, &mut ())?;
    let (mut steps, mut start): (Vec<Step>, _) = (Vec::new(), None);
    // Features with a point before the newest photograph was registered.
    let mut known: HashSet<Feature> = HashSet::new();
    while let Some(step) = run.step(&mut ())? {
        tell(progress, steps.len() as f64 / truth.len() as f64)?;
        let newest = match step {
            // Photographs that do not connect to the others would start a second reconstruction.
            SfmStep::Started { .. } if start.is_some() => break,
            SfmStep::Started { images, .. } => {
                start = Some(images);
                Some(images[1])
            }
            SfmStep::Registered { image, .. } => Some(image),
            _ => None,
        };
        let (Some(start), Some(found)) = (start, run.current()) else {
            continue;
        };
        let before = newest.map_or_else(
            || steps.pop().map(|last| (last.newest, last.sights)),
            |newest| Some((newest, sights(&known, newest, &found, input))),
        );
        let Some((newest, sights)) = before else {
            continue;
        };
        known = features_with_points(&found, &input.pairs);
        steps.push(state(
            &found,
            (start, truth),
            input,
            &known,
            (newest, sights),
        ));
    }
    if steps.is_empty() {
        let why = "no two of them have enough matches in common";
        let what = "the start from two photographs";
        return Err(Error::Degenerate { what, why }.into());
    }
    Ok(steps)
}

/// Returns the features in tracks of points, and those that match one of them.
fn features_with_points(found: &Reconstruction, pairs: &[PairMatches]) -> HashSet<Feature> {
    let tracks = found.points.iter().flat_map(|point| &point.track);
    let direct: HashSet<Feature> = tracks
        .map(|element| (element.image as usize, element.keypoint as usize))
        .collect();
    let mut known = direct.clone();
    for pair in pairs {
        for m in &pair.matches {
            let (one, two) = ((pair.image1, m.index1), (pair.image2, m.index2));
            if direct.contains(&one) || direct.contains(&two) {
                known.extend([one, two]);
            }
        }
    }
    known
}

/// Returns the features of the newest photograph that had a point, and whether they now belong to
/// one; at the start all of its features that have a point.
fn sights(
    known: &HashSet<Feature>,
    newest: usize,
    found: &Reconstruction,
    input: &SfmInput,
) -> Vec<([f64; 2], bool)> {
    let tracks = found.points.iter().flat_map(|point| &point.track);
    let agreeing: HashSet<usize> = tracks
        .filter(|element| element.image as usize == newest)
        .map(|element| element.keypoint as usize)
        .collect();
    let places = input.images[newest].keypoints.iter().enumerate();
    places
        .filter(|(index, _)| match known.is_empty() {
            true => agreeing.contains(index),
            false => known.contains(&(newest, *index)),
        })
        .map(|(index, place)| ([place.x, place.y], agreeing.contains(&index)))
        .collect()
}

/// Returns the state of a reconstruction, transformed to the ground-truth frame.
fn state(
    found: &Reconstruction,
    (start, truth): ([usize; 2], &[PosedCamera]),
    input: &SfmInput,
    known: &HashSet<Feature>,
    (newest, sights): (usize, Vec<([f64; 2], bool)>),
) -> Step {
    let error_px = found.mean_reprojection_px(&input.images);
    let found = match true_from_found(found, start, truth) {
        Some(moves) => found.moved(&moves),
        None => found.clone(),
    };
    let mut num_seen = vec![0; truth.len()];
    for (image, _) in known {
        num_seen[*image] += 1;
    }
    let registered = || found.cameras.iter().zip(truth).enumerate();
    let off_sq: Vec<f64> = registered()
        .filter(|(image, _)| *image != start[0])
        .filter_map(|(_, (camera, truth))| {
            let center = camera.as_ref()?.center_in_world();
            Some((center - truth.center_in_world()).norm_squared())
        })
        .collect();
    let every = found.points.len().div_ceil(MAX_POINTS).max(1);
    let points = found.points.iter().step_by(every);
    Step {
        newest,
        cam_from_world: (found.cameras.iter())
            .map(|camera| Some(camera.as_ref()?.cam_from_world))
            .collect(),
        points: points
            .map(|point| (point.position.coords.cast::<f32>().into(), point.color))
            .collect(),
        num_points: found.points.len(),
        error_px,
        num_seen,
        sights,
        off_m: (off_sq.iter().sum::<f64>() / off_sq.len().max(1) as f64).sqrt(),
    }
}

/// Returns the similarity that moves the first camera to its true pose, scaled by the true distance
/// to the second camera; `None` unless both are registered.
fn true_from_found(
    found: &Reconstruction,
    start: [usize; 2],
    truth: &[PosedCamera],
) -> Option<Similarity3<f64>> {
    let [first, second] = [found.cameras[start[0]]?, found.cameras[start[1]]?];
    let apart = |a: Point3<f64>, b: Point3<f64>| (a - b).norm();
    let wanted = apart(
        truth[start[0]].center_in_world(),
        truth[start[1]].center_in_world(),
    );
    let scale = wanted / apart(first.center_in_world(), second.center_in_world());
    let world_from_cam = truth[start[0]].cam_from_world.inverse();
    (scale.is_finite() && scale > 0.0).then(|| {
        Similarity3::from_isometry(world_from_cam, scale)
            * Similarity3::from_isometry(first.cam_from_world, 1.0)
    })
}
