//! The stages of the reconstruction.

use super::surface::surface;
use super::verdict::{Judged, Verdict, judge};
use super::{Answer, CloudPoint, Motion, Question, Source};
use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question::tell;
use crate::kit::scenes::{self, PHOTO_SIZE};
use crate::kit::sfm_image::color_at;
use epipole::Error;
use epipole::camera::Camera;
use epipole::feature::{
    FeatureOptions, Features, MatchOptions, detect_sift, match_descriptors, photo_to_gray,
};
use epipole::progress::Status;
use epipole::sfm::{TwoViewReconstructionOptions, two_view_reconstruction};
use nalgebra::Point2;

/// Maximum number of features per photograph; more cost time without visible benefit.
const MAX_FEATURES: usize = 3000;

impl Question {
    /// Runs every stage in order.
    ///
    /// # Errors
    /// As the stages, and [`Error::Canceled`] if `progress` cancels.
    pub(super) fn follow(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        tell(progress, 0.0)?;
        let pictures = self.photographs(progress)?;
        let cameras = [
            self.camera(pictures[0].size())?,
            self.camera(pictures[1].size())?,
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
            .map(|m| color_at(pictures[0].image(), &keypoints[0][m.0 as usize]))
            .collect();
        let judged = judge([&pixels1, &pixels2], &cameras, self.max_error_px)?;
        tell(progress, 0.75)?;
        let mut motion = self.reconstruct(&judged, [&pixels1, &pixels2], &cameras, &colors)?;
        if let Some(motion) = &mut motion {
            Self::look_everywhere(motion, &pictures, &cameras, &mut |share| {
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

    /// Matches the features of the first photograph with those of the second.
    fn matches(&self, first: &Features, second: &Features) -> Result<Vec<(u32, u32)>, Error> {
        let options = MatchOptions::default().with_max_ratio(Some(self.max_ratio));
        let found = match_descriptors(&first.descriptors, &second.descriptors, &options, &mut ())?;
        let pairs = found.iter().map(|m| (m.index1 as u32, m.index2 as u32));
        Ok(pairs.collect())
    }

    /// Reconstructs a pair with depth from its inliers; `None` if there are hardly any points.
    fn reconstruct(
        &self,
        judged: &Judged,
        [pixels1, pixels2]: [&[Point2<f64>]; 2],
        cameras: &[Camera; 2],
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
            cameras.each_ref(),
            &self.knocked(&motion),
            &TwoViewReconstructionOptions::default(),
            &mut (),
        );
        let found = match found {
            // All but a few points have too small a triangulation angle.
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

    /// Adds a point for every pixel, if the pair can be rectified.
    fn look_everywhere(
        motion: &mut Motion,
        pictures: &[Picture; 2],
        cameras: &[Camera; 2],
        progress: Progress<'_>,
    ) -> Result<(), Error> {
        let places: Vec<_> = motion.points.iter().map(|point| point.place).collect();
        let images = pictures.each_ref().map(Picture::image);
        let found = surface(images, cameras, &motion.cam2_from_cam1, &places, progress);
        motion.surface = match found {
            Err(Error::Canceled) => return Err(Error::Canceled),
            found => found.map_err(|error| error.to_string()),
        };
        Ok(())
    }
}

/// Detects the core's default features; any other kind would enlarge the worker's download.
fn features(picture: &Picture, progress: Progress<'_>) -> Result<Features, Error> {
    let options = FeatureOptions::default().with_max_features(MAX_FEATURES);
    let (width, height) = picture.size();
    detect_sift(
        &photo_to_gray(picture.image()),
        &options.sift(width, height),
        &mut |status: Status| progress(f64::from(status.fraction)),
    )
}
