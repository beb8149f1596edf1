//! The model that two views deserve.

use super::motion::{median_angle, planar_motions, pose_of_fundamental};
use super::pairs::Pairs;
use super::search::Searches;
use super::through_lenses::estimate_through_lenses;
use super::turn::{ExplainingTurn, homography_of_turn};
use super::{RotationEstimator, TwoViewOptions};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Camera, RigidTransform};
#[cfg(doc)]
use crate::epipolar::estimate_fundamental;
use crate::epipolar::{FundamentalEstimator, RelativePose, estimate_relative_pose, sampson_px};
#[cfg(doc)]
use crate::homography::estimate_homography;
use crate::homography::{HomographyEstimator, homography_sampson_px};
use crate::progress::Monitor;
#[cfg(doc)]
use crate::robust::RansacOptions;
use crate::robust::{MatchSet, RansacReport, StopReason};
use nalgebra::{Matrix3, Point2};

/// What two views show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// A moving camera and a scene with depth: F or E says all.
    General,
    /// A moving camera and a plane: H says all; F is open, and the motion may be twofold.
    Planar,
    /// A camera that only turned, or hardly moved: H says all; depth cannot be told. Without
    /// intrinsics this cannot be told from a plane and is reported as [`Planar`](Configuration::Planar).
    Panoramic,
    /// No more matches agree on anything than wrong matches might by chance.
    Degenerate,
}

/// The matrix that describes the pair, unit Frobenius norm, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TwoViewModel {
    /// `x2ᵀ F x1 = 0`.
    Fundamental(Matrix3<f64>),
    /// E; the pixels' F is [`TwoViewReport::fundamental`].
    Essential(Matrix3<f64>),
    /// `x2 ∝ H x1`.
    Homography(Matrix3<f64>),
}

/// What was found out about two views.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViewReport {
    /// What they show.
    pub configuration: Configuration,
    /// The matrix chosen.
    pub model: TwoViewModel,
    /// F, where the pair has one: that of the motion for calibrated views of a plane, `None` for
    /// uncalibrated ones and for turns.
    pub fundamental: Option<Matrix3<f64>>,
    /// H, if one was found.
    pub homography: Option<Matrix3<f64>>,
    /// The motion, for calibrated views; |t| = 1, or 0 for [`Configuration::Panoramic`]. `None` for
    /// [`Configuration::Degenerate`].
    pub cam2_from_cam1: Option<RigidTransform>,
    /// Of a plane: another motion that explains the matches as well, if there is one. Which of the two
    /// is right, a plane alone does not tell.
    pub other_cam2_from_cam1: Option<RigidTransform>,
    /// For each match given, whether it fits `model`: within `max_error_px` of F or E, by the Sampson error,
    /// and within 1.25 times as much of H, which has to fit in two dimensions.
    pub inliers: Vec<bool>,
    /// How many do.
    pub num_inliers: usize,
    /// Matches that were left out: an infinite coordinate, or one beyond 10⁹ pixels.
    pub num_left_out: usize,
    /// The threshold of F and E, pixels.
    pub max_error_px: f64,
    /// Samples drawn, over all models tried.
    pub iterations: usize,
    /// Number of samples that `model` asks for.
    pub required_iterations: u64,
    /// Why the search for `model` ended.
    pub stop: StopReason,
    /// The median angle at which the inliers' rays meet, radians, for a calibrated pair with motion.
    pub median_triangulation_angle_rad: Option<f64>,
}

/// Chooses between F and H for two views of unknown intrinsics.
///
/// Both are estimated; if H explains nearly all matches that F does, the scene is a plane or the
/// camera only turned.
///
/// # Errors
/// As [`TwoViewOptions::check`], and as [`estimate_fundamental`] and [`estimate_homography`] if neither finds a
/// model.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view};
/// use nalgebra::Point2;
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// // A step to the right past a wall that stands straight ahead: everything moves by 12 pixels.
/// let wall: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 12.0, p.y)).collect();
/// let report = estimate_two_view(&p1, &wall, &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::Planar);
/// // With depth, near things move more than far ones.
/// let depth: Vec<_> = (0..60).map(|i| Point2::new(p1[i].x - (5 + i * 13 % 31) as f64, p1[i].y)).collect();
/// let report = estimate_two_view(&p1, &depth, &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::General);
/// # Ok(()) }
/// ```
pub fn estimate_two_view(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    options.check()?;
    let set = MatchSet::new(pixels1, pixels2)?;
    let pairs = Pairs::new(pixels1, pixels2, &set);
    let mut searches = Searches::new(monitor);
    let options = &searches.with_threshold(options, &set);
    let fundamental = searches.ransac(FundamentalEstimator::new(set.clone()), &options.ransac);
    let homography = searches.ransac(
        HomographyEstimator::new(set.clone()),
        &options.in_two_dimensions(),
    );
    let homography_wins = match (&fundamental, &homography) {
        // H needs fewer matches than F: what it lacks, F lacks as well.
        (Err(_), Err(error)) => return Err(error.clone()),
        (Err(_), Ok(_)) => true,
        (Ok(_), Err(_)) => false,
        (Ok(f), Ok(h)) => {
            f.could_be_chance() && !h.could_be_chance()
                || pairs.explained_share(&h.model, &f.inliers, options)
                    >= options.max_homography_share
        }
    };
    searches.check()?;
    let mut found = TwoViewReport::nothing(&searches, options);
    found.homography = homography.as_ref().ok().map(|report| report.model);
    if homography_wins {
        let report = homography?;
        found.model = TwoViewModel::Homography(report.model);
        found.configuration = Configuration::Planar;
        found.take_homography(&pairs, &report, options);
    } else {
        let report = fundamental?;
        found.model = TwoViewModel::Fundamental(report.model);
        found.configuration = Configuration::General;
        found.fundamental = Some(report.model);
        found.take(report.inliers.clone(), &report, options);
    }
    Ok(found)
}

/// Chooses among E, F and H for two views of known intrinsics, and finds the motion.
///
/// * `cameras`: the two cameras, of any lens. If the intrinsics of pinhole cameras are wrong, F explains more matches
///   than E and is chosen
///
/// A camera that only turned is recognized by a rotation that explains nearly all matches that the best
/// other model does. Where F is chosen, the motion is still that of E, if enough matches support it: it
/// is the best that agrees with the intrinsics. For a plane the motion is taken from E or from the
/// decomposition of H, whichever fits more matches with the points in front of both cameras; often two
/// motions do equally well.
///
/// Other lenses than pinholes have no F: [`TwoViewReport::model`] and [`TwoViewReport::homography`] are of rays then,
/// `x2ᵀ E x1 = 0` and `x2 ∝ H x1`, and errors in the pixels of the distorted images.
///
/// # Errors
/// As [`TwoViewOptions::check`], and as [`estimate_relative_pose`] and [`estimate_homography`] if no model
/// is found.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_calibrated};
/// use nalgebra::{Point2, Rotation3, Vector3};
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// let turn = Rotation3::from_scaled_axis(Vector3::new(0.0, 0.1, 0.0));
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| {
///     let x = k.matrix() * (turn * k.ray(p));
///     Point2::new(x.x / x.z, x.y / x.z)
/// }).collect();
/// let camera = Camera::pinhole(k, 640, 480);
/// let report = estimate_two_view_calibrated(&p1, &p2, [&camera; 2], &TwoViewOptions::default(), &mut ())?;
/// assert_eq!(report.configuration, Configuration::Panoramic);
/// assert!((report.cam2_from_cam1.unwrap().rotation.angle() - 0.1).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_two_view_calibrated(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    options.check()?;
    if !cameras.iter().all(|camera| camera.is_pinhole()) {
        return estimate_through_lenses(pixels1, pixels2, cameras, options, monitor);
    }
    let [k1, k2] = cameras.map(|camera| &camera.intrinsics);
    let set = MatchSet::new(pixels1, pixels2)?;
    let pairs = Pairs::new(pixels1, pixels2, &set);
    let mut searches = Searches::new(monitor);
    let options = &searches.with_threshold(options, &set);
    let in_two_dimensions = options.in_two_dimensions();
    let essential = searches
        .run(|monitor| estimate_relative_pose(pixels1, pixels2, cameras, &options.ransac, monitor));
    let fundamental = searches.ransac(FundamentalEstimator::new(set.clone()), &options.ransac);
    let homography = searches.ransac(HomographyEstimator::new(set.clone()), &in_two_dimensions);
    let rotation = searches.ransac(
        RotationEstimator::new(set.clone(), *k1, *k2),
        &in_two_dimensions,
    );
    searches.check()?;
    let mut found = TwoViewReport::nothing(&searches, options);
    found.homography = homography.as_ref().ok().map(|report| report.model);
    let (num_e, num_f) = (support(&essential), support(&fundamental));
    let epipolar = if num_e > num_f {
        essential.as_ref().ok().map(|report| &report.inliers)
    } else {
        fundamental.as_ref().ok().map(|report| &report.inliers)
    };
    let explains = |matrix: &Matrix3<f64>| {
        epipolar.is_none_or(|inliers| {
            pairs.explained_share(matrix, inliers, options) >= options.max_homography_share
        })
    };
    // A homography may explain what a rotation does not, even where nothing epipolar was found.
    let num_needed = options.max_homography_share * support(&homography) as f64;
    if let Ok(report) = &rotation
        && report.num_unique_inliers as f64 >= num_needed
        && let Some(turn) = ExplainingTurn::new(
            report,
            [k1, k2],
            epipolar.iter().flat_map(|mask| pairs.different_among(mask)),
            options,
        )
    {
        let matrix = homography_of_turn(&report.model, [k1, k2]);
        found.model = TwoViewModel::Homography(matrix / matrix.norm());
        found.configuration = Configuration::Panoramic;
        found.cam2_from_cam1 = Some(turn.cam2_from_cam1);
        found.take_homography(&pairs, report, options);
        return Ok(found);
    }
    if let Ok(report) = &homography
        && explains(&report.model)
    {
        found.model = TwoViewModel::Homography(report.model);
        found.configuration = Configuration::Planar;
        let [best, other] = planar_motions(
            &pairs,
            k1,
            k2,
            report,
            essential.as_ref().ok(),
            options.ransac.max_error_px,
        );
        found.cam2_from_cam1 = best.as_ref().map(RelativePose::cam2_from_cam1);
        found.other_cam2_from_cam1 = other.as_ref().map(RelativePose::cam2_from_cam1);
        found.fundamental = best.and_then(|pose| pose.fundamental(k1, k2).ok());
        found.take_homography(&pairs, report, options);
    } else if num_e as f64 >= options.min_essential_share * num_f as f64
        && let Ok(report) = &essential
    {
        found.model = TwoViewModel::Essential(report.model.essential());
        found.configuration = Configuration::General;
        found.cam2_from_cam1 = Some(report.model.cam2_from_cam1());
        found.fundamental = report.model.fundamental(k1, k2).ok();
        found.take(report.inliers.clone(), report, options);
    } else {
        // H needs fewer matches than F: what it lacks, F lacks as well.
        let report = fundamental.map_err(|error| homography.err().unwrap_or(error))?;
        found.model = TwoViewModel::Fundamental(report.model);
        found.configuration = Configuration::General;
        found.fundamental = Some(report.model);
        // E's motion was fitted with the intrinsics. F's, made to respect them afterwards, is far
        // less exact, all the more where F has bent to wrong matches that E refused.
        found.cam2_from_cam1 = match &essential {
            Ok(essential) if num_e >= options.min_num_inliers && !essential.could_be_chance() => {
                Some(essential.model.cam2_from_cam1())
            }
            _ => pose_of_fundamental(&pairs, k1, k2, &report),
        };
        found.take(report.inliers.clone(), &report, options);
    }
    if let Some(motion) = &found.cam2_from_cam1 {
        found.median_triangulation_angle_rad = median_angle(&pairs, k1, k2, motion, &found.inliers);
    }
    Ok(found)
}

fn support<M>(report: &Result<RansacReport<M>>) -> usize {
    report
        .as_ref()
        .map_or(0, |report| report.num_unique_inliers)
}

impl TwoViewReport {
    fn nothing(searches: &Searches<'_>, options: &TwoViewOptions) -> Self {
        Self {
            configuration: Configuration::Degenerate,
            model: TwoViewModel::Homography(Matrix3::identity() / 3.0_f64.sqrt()),
            fundamental: None,
            homography: None,
            cam2_from_cam1: None,
            other_cam2_from_cam1: None,
            inliers: Vec::new(),
            num_inliers: 0,
            num_left_out: 0,
            max_error_px: options.ransac.max_error_px,
            iterations: searches.iterations,
            required_iterations: u64::MAX,
            stop: StopReason::Exhausted,
            median_triangulation_angle_rad: None,
        }
    }

    /// Fills in the inliers of the model; without enough of them nothing is said of the motion.
    fn take<M>(&mut self, inliers: Vec<bool>, report: &RansacReport<M>, options: &TwoViewOptions) {
        self.num_inliers = inliers.iter().filter(|&&inlier| inlier).count();
        self.inliers = inliers;
        self.num_left_out = report.num_left_out;
        self.required_iterations = report.required_iterations;
        self.stop = report.stop;
        if report.num_unique_inliers < options.min_num_inliers || report.could_be_chance() {
            self.configuration = Configuration::Degenerate;
            self.cam2_from_cam1 = None;
            self.other_cam2_from_cam1 = None;
        }
    }

    /// Fills in the matches that fit the homography, which is the model.
    fn take_homography<M>(
        &mut self,
        pairs: &Pairs<'_>,
        report: &RansacReport<M>,
        options: &TwoViewOptions,
    ) {
        if let TwoViewModel::Homography(h) = self.model {
            self.take(pairs.fit(&h, options), report, options);
        }
    }

    /// The mean Sampson error of the inliers, pixels. `None` without inliers, or if the pair has no F
    /// to measure by.
    pub fn mean_error_px(&self, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Option<f64> {
        let (mut total, mut count) = (0.0, 0);
        for ((p1, p2), _) in pixels1
            .iter()
            .zip(pixels2)
            .zip(&self.inliers)
            .filter(|(_, is)| **is)
        {
            total += match &self.model {
                TwoViewModel::Homography(h) => homography_sampson_px(h, p1, p2),
                _ => sampson_px(self.fundamental.as_ref()?, p1, p2),
            };
            count += 1;
        }
        (count > 0).then(|| total / f64::from(count))
    }
}
