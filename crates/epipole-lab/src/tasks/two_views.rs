//! Two-view geometry of a pair of photographs.

use super::are_finite;
use super::matches::MatchesOf;
use super::photograph::Calibrated;
use super::task::{Destination, Query, Task};
#[cfg(feature = "vision")]
use super::task::{Monitor, Progress, Run, report};
use crate::project::{Key, PairOptions, PhotoId, Project, Step, pairs};
use serde::{Deserialize, Serialize};

/// Kind of scene and motion of two photographs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shows {
    /// A scene with depth, from two positions.
    Depth,
    /// A plane, from two positions.
    Plane,
    /// A rotation only, or no motion at all.
    Turn,
    /// No more agreeing matches than by chance.
    Nothing,
}

/// Selected matrix of two photographs, row by row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ViewModel {
    /// Essential matrix.
    Essential([f64; 9]),
    /// Fundamental matrix.
    Fundamental([f64; 9]),
    /// Homography.
    Homography([f64; 9]),
}

/// Two-view geometry.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TwoViews {
    /// Kind of scene and motion.
    pub shows: Shows,
    /// Selected matrix.
    pub model: ViewModel,
    /// Fundamental matrix in pixels, if defined.
    pub fundamental: Option<[f64; 9]>,
    /// Whether each match is an inlier.
    pub inliers: Vec<bool>,
    /// Number of inliers.
    pub num_inliers: u32,
    /// Number of samples drawn.
    pub iterations: u32,
    /// Rotation angle of the camera, degrees, if known.
    pub turn_deg: Option<f64>,
    /// Factor of the focal lengths for which the motion is a pure rotation, if it is none for the
    /// given ones.
    pub focal_factor: Option<f64>,
    /// Median triangulation angle, degrees, if known.
    pub angle_deg: Option<f64>,
}

/// Estimates the two-view geometry of two photographs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VerifyPair {
    /// Positions of the matches: `u1, v1, u2, v2`.
    pub places: Vec<[f64; 4]>,
    /// Ratio of descriptor distances of each match: the higher, the more ambiguous.
    pub ratios: Vec<f32>,
    /// Intrinsics of both photographs.
    pub cameras: [Calibrated; 2],
    /// Two-view settings.
    pub options: PairOptions,
}

impl Task for VerifyPair {
    type Output = TwoViews;
}

/// Query for the two-view geometry of a pair, in the order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TwoViewsOf(pub PhotoId, pub PhotoId);

impl TwoViewsOf {
    fn cameras(self, project: &Project) -> Option<[Calibrated; 2]> {
        let camera = |id| project.camera(project.document.photo(id)?);
        Some([camera(self.0)?, camera(self.1)?])
    }
}

impl Query for TwoViewsOf {
    type Task = VerifyPair;
    const STEP: Step = Step::TwoViews;

    fn all(project: &Project) -> Vec<Self> {
        let photos = project.taking_part();
        pairs(&photos)
            .map(|(first, second)| Self(first.id, second.id))
            .collect()
    }

    fn key(self, project: &Project) -> Option<Key> {
        let [first, second] = self.cameras(project)?;
        let matches = MatchesOf(self.0, self.1).key(project)?;
        let options = project.document.settings.pairs;
        Some(Key::of(&(
            "two views",
            matches.0,
            (first.k, second.k),
            options,
        )))
    }

    fn is_ready(self, project: &Project, _is_imported: bool) -> bool {
        project.get(MatchesOf(self.0, self.1)).is_some()
    }

    /// The selected pair comes before the reconstruction, all others after it.
    fn priority(self, project: &Project) -> u8 {
        match project.view.pair == (self.0, self.1) {
            true => 50,
            false => 80,
        }
    }

    fn task(self, project: &Project) -> Option<VerifyPair> {
        let matches = MatchesOf(self.0, self.1);
        Some(VerifyPair {
            places: matches.places(project)?,
            ratios: project.get(matches)?.iter().map(|m| m.ratio).collect(),
            cameras: self.cameras(project)?,
            options: project.document.settings.pairs,
        })
    }

    fn label(self, project: &Project) -> String {
        let all = Self::all(project);
        let done = all.iter().filter(|pair| pair.is_settled(project)).count();
        format!("Verifying pairs: {done} of {}", all.len())
    }

    fn stored(output: &TwoViews, _destination: Destination) -> Option<TwoViews> {
        Some(output.clone())
    }

    fn fits(self, project: &Project, found: &TwoViews) -> bool {
        let Some(matches) = project.get(MatchesOf(self.0, self.1)) else {
            return false;
        };
        let (ViewModel::Essential(m) | ViewModel::Fundamental(m) | ViewModel::Homography(m)) =
            &found.model;
        let others = [found.turn_deg, found.focal_factor, found.angle_deg];
        found.inliers.len() == matches.len()
            && found.inliers.iter().filter(|fits| **fits).count() == found.num_inliers as usize
            && are_finite(m)
            && found.fundamental.is_none_or(|f| are_finite(&f))
            && others.into_iter().flatten().all(f64::is_finite)
    }
}

#[cfg(feature = "vision")]
impl Run for VerifyPair {
    /// Chooses among E, F and H, as `epipole two-view` does with known intrinsics, sampling the
    /// least ambiguous matches first. Returns [`Shows::Nothing`] if matches do not allow any
    /// estimate.
    fn run(self, monitor: Monitor<'_>) -> Result<TwoViews, String> {
        use super::convert::sentence;
        use epipole::camera::Camera;
        use epipole::progress::Status;
        use epipole::robust::RansacOptions;
        use epipole::two_view::{
            Configuration, TwoViewModel, TwoViewOptions, estimate_two_view_calibrated,
            find_rotation_and_focal,
        };
        use nalgebra::Point2;
        let Self {
            places,
            ratios,
            cameras,
            options,
        } = self;
        if ratios.len() != places.len() {
            return Err("the matches did not arrive whole".to_owned());
        }
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.sort_by(|&a, &b| ratios[a].total_cmp(&ratios[b]));
        let ordered = || order.iter().map(|&n| places[n]);
        let first: Vec<Point2<f64>> = ordered().map(|p| Point2::new(p[0], p[1])).collect();
        let second: Vec<Point2<f64>> = ordered().map(|p| Point2::new(p[2], p[3])).collect();
        let [k1, k2] = [cameras[0].intrinsics()?, cameras[1].intrinsics()?];
        let how = TwoViewOptions::default().with_ransac(
            RansacOptions::default()
                .with_max_error_px(options.max_error_px)
                .with_seed(options.seed),
        );
        how.check().map_err(sentence)?;
        let mut watch = |status: Status| monitor(Progress::Share(status.fraction, ""));
        // Estimators ignore the size of the images.
        let [one, two] = [k1, k2].map(|k| Camera::pinhole(k, 0, 0));
        let found = estimate_two_view_calibrated(&first, &second, [&one, &two], &how, &mut watch);
        if found == Err(epipole::Error::Canceled) {
            return Err("stopped".to_owned());
        }
        let Ok(found) = found else {
            return Ok(nothing(places.len()));
        };
        report(monitor, 0.0, "")?;
        // With a wrong focal length, a rotation can look like a plane.
        let otherwise = match found.configuration {
            Configuration::Planar => {
                find_rotation_and_focal(&first, &second, [&one, &two], &found.inliers, &how)
                    .map_err(sentence)?
            }
            _ => None,
        };
        let shows = match found.configuration {
            Configuration::General => Shows::Depth,
            Configuration::Planar if otherwise.is_some() => Shows::Turn,
            Configuration::Planar => Shows::Plane,
            Configuration::Panoramic => Shows::Turn,
            Configuration::Degenerate => Shows::Nothing,
        };
        let motion = match &otherwise {
            Some(turn) => Some(turn.cam2_from_cam1),
            None => found.cam2_from_cam1,
        };
        let angle_rad = (found.median_triangulation_angle_rad).filter(|_| otherwise.is_none());
        let mut inliers = vec![false; places.len()];
        for (&place, is_inlier) in order.iter().zip(&found.inliers) {
            inliers[place] = *is_inlier;
        }
        Ok(TwoViews {
            shows,
            model: match found.model {
                TwoViewModel::Essential(e) => ViewModel::Essential(rows(&e)),
                TwoViewModel::Fundamental(f) => ViewModel::Fundamental(rows(&f)),
                TwoViewModel::Homography(h) => ViewModel::Homography(rows(&h)),
            },
            fundamental: found.fundamental.as_ref().map(rows),
            num_inliers: found.num_inliers as u32,
            iterations: found.iterations as u32,
            turn_deg: motion.map(|motion| motion.rotation.angle().to_degrees()),
            focal_factor: otherwise.map(|turn| turn.focal_factor),
            angle_deg: angle_rad.map(f64::to_degrees),
            inliers,
        })
    }
}

#[cfg(feature = "vision")]
fn nothing(num_matches: usize) -> TwoViews {
    TwoViews {
        shows: Shows::Nothing,
        model: ViewModel::Fundamental([0.0; 9]),
        fundamental: None,
        inliers: vec![false; num_matches],
        num_inliers: 0,
        iterations: 0,
        turn_deg: None,
        focal_factor: None,
        angle_deg: None,
    }
}

#[cfg(feature = "vision")]
fn rows(matrix: &nalgebra::Matrix3<f64>) -> [f64; 9] {
    let mut rows = [0.0; 9];
    rows.copy_from_slice(matrix.transpose().as_slice());
    rows
}
