//! The searches of `epipole two-view` and their results.

use super::arguments::{Arguments, Model};
use super::errors::{self, ObservedPixels, Pixels};
use super::focal::intrinsics;
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::{known_cameras, warn_of_unseen};
use crate::photo::Photo;
use crate::progress::Progress;
use crate::rotation_only::{self, left_open, left_open_by_homography};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{
    FundamentalEstimator, RelativePose, essential_from_fundamental, estimate_relative_pose,
};
use epipole::homography::{HomographyEstimator, estimate_homography_calibrated};
use epipole::progress::Stage;
use epipole::robust::{MatchSet, RansacReport};
use epipole::two_view::{
    Configuration, ExplainingRotation, TwoViewModel, TwoViewOptions, TwoViewReport,
    estimate_two_view, estimate_two_view_calibrated, find_explaining_rotation,
};
use nalgebra::Matrix3;

/// Result of any model.
pub(super) struct Found {
    pub(super) kind: &'static str,
    pub(super) model: Matrix3<f64>,
    pub(super) inliers: Vec<bool>,
    pub(super) cam2_from_cam1: Option<RigidTransform>,
    pub(super) other_cam2_from_cam1: Option<RigidTransform>,
    pub(super) configuration: &'static str,
    pub(super) errors_px: Vec<f64>,
    pub(super) max_error_px: f64,
    /// Focal lengths of both cameras, if E was searched for.
    pub(super) focals_px: Option<[f64; 2]>,
}

impl Found {
    /// Returns the result of a search for one model.
    ///
    /// * `kind`, `otherwise`: name of the model, and its configuration unless degenerate
    pub(super) fn of_search<M>(
        [kind, otherwise]: [&'static str; 2],
        model: Matrix3<f64>,
        errors_px: Vec<f64>,
        report: RansacReport<M>,
        options: &TwoViewOptions,
    ) -> Self {
        Self {
            kind,
            model,
            errors_px,
            configuration: configuration(&report, otherwise, options),
            max_error_px: report.max_error_px,
            inliers: report.inliers,
            cam2_from_cam1: None,
            other_cam2_from_cam1: None,
            focals_px: None,
        }
    }

    fn of_report(report: TwoViewReport, errors_px: Vec<f64>) -> Self {
        let (kind, model) = match report.model {
            TwoViewModel::Fundamental(f) => ("fundamental", f),
            TwoViewModel::Essential(e) => ("essential", e),
            TwoViewModel::Homography(h) => ("homography", h),
        };
        Self {
            kind,
            model,
            errors_px,
            max_error_px: report.max_error_px,
            focals_px: None,
            inliers: report.inliers,
            cam2_from_cam1: report.cam2_from_cam1,
            other_cam2_from_cam1: report.other_cam2_from_cam1,
            configuration: word(report.configuration),
        }
    }

    /// Records a rotation that explains the inliers.
    pub(super) fn set_rotation_only(&mut self, rotation_only: &ExplainingRotation) {
        self.configuration = "panoramic";
        self.cam2_from_cam1 = Some(rotation_only.cam2_from_cam1);
    }
}

/// The cameras of two photos.
struct Cameras([Camera; 2]);

impl Cameras {
    fn new(photos: &[Photo; 2], [k1, k2]: [Intrinsics; 2]) -> Self {
        Self([photos[0].camera(k1), photos[1].camera(k2)])
    }

    fn both(&self) -> [&Camera; 2] {
        self.0.each_ref()
    }

    fn are_pinholes(&self) -> bool {
        self.0.iter().all(Camera::is_pinhole)
    }
}

/// Searches for the requested model.
///
/// # Errors
/// As the core's searches, and as [`PairArguments::explicit`](crate::camera::PairArguments::given).
pub(super) fn estimate(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels: Pixels<'_>,
) -> Result<Found, Failure> {
    if arguments.known.is_set() {
        return through_lenses(arguments, context, photos, pixels);
    }
    match arguments.model {
        Model::Auto => {
            let explicit = arguments.camera.explicit(photos)?;
            let cameras = explicit.map(|explicit| Cameras::new(photos, explicit));
            let report = auto(arguments, context, cameras.as_ref(), pixels)?;
            let errors_px = match (report.model, &report.fundamental) {
                (TwoViewModel::Homography(h), _) => errors::of_homography(pixels, &h),
                (_, Some(f)) => errors::of_fundamental(pixels, f),
                (_, None) => vec![0.0; pixels[0].len()],
            };
            let found = Found::of_report(report, errors_px);
            warn_of_rotation(arguments, context, photos, pixels, &found)?;
            Ok(found)
        }
        Model::Fundamental => fundamental(arguments, context, pixels),
        Model::Essential => {
            let [p1, p2] = pixels;
            let [k1, k2] = intrinsics(arguments, context, photos, p1, p2)?;
            let cameras = Cameras::new(photos, [k1, k2]);
            let errors_px = |pose: &RelativePose| {
                let f = pose.fundamental(&k1, &k2)?;
                Ok(errors::of_fundamental(pixels, &f))
            };
            let mut found = essential(arguments, context, &cameras, pixels, errors_px)?;
            found.focals_px = Some([k1.fu_px(), k2.fu_px()]);
            Ok(found)
        }
        Model::Homography => {
            let explicit = arguments.camera.explicit(photos)?;
            let estimator = HomographyEstimator::new(MatchSet::new(pixels[0], pixels[1])?)?;
            let report = arguments.robust.run(estimator, context)?;
            let errors_px = errors::of_homography(pixels, &report.model);
            // Pixels alone do not distinguish a rotation from a plane.
            let cameras = explicit.map(|explicit| Cameras::new(photos, explicit));
            let found = planar(arguments, context, cameras, pixels, (report, errors_px))?;
            warn_of_rotation(arguments, context, photos, pixels, &found)?;
            Ok(found)
        }
    }
}

/// Does the work of [`estimate`] for photos with a known lens, for which there is no F.
fn through_lenses(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    pixels: Pixels<'_>,
) -> Result<Found, Failure> {
    let cameras = known_cameras(&arguments.camera, context, photos)?;
    warn_of_unseen(cameras.each_ref(), pixels, context);
    let observed = ObservedPixels::new(cameras.each_ref(), pixels);
    let cameras = Cameras(cameras);
    match arguments.model {
        Model::Auto | Model::Fundamental => {
            let report = auto(arguments, context, Some(&cameras), pixels)?;
            let report = TwoViewReport {
                model: of_rays(report.model, &cameras)?,
                ..report
            };
            let errors_px = match report.model {
                TwoViewModel::Homography(h) => observed.of_homography(&h),
                TwoViewModel::Essential(e) | TwoViewModel::Fundamental(e) => {
                    observed.of_essential(&e)?
                }
            };
            Ok(Found::of_report(report, errors_px))
        }
        Model::Essential => {
            let errors_px = |pose: &RelativePose| Ok(observed.of_motion(&pose.cam2_from_cam1()));
            essential(arguments, context, &cameras, pixels, errors_px)
        }
        Model::Homography => {
            let [p1, p2] = pixels;
            let report = arguments.robust.watched(context, |options, monitor| {
                estimate_homography_calibrated(p1, p2, cameras.both(), options, monitor)
            })?;
            let errors_px = observed.of_homography(&report.model);
            planar(
                arguments,
                context,
                Some(cameras),
                pixels,
                (report, errors_px),
            )
        }
    }
}

/// Converts a model of pixels, found without distortion, to a model of rays.
fn of_rays(model: TwoViewModel, cameras: &Cameras) -> Result<TwoViewModel, Failure> {
    if !cameras.are_pinholes() {
        return Ok(model);
    }
    let [k1, k2] = cameras.both().map(|camera| camera.intrinsics);
    Ok(match model {
        TwoViewModel::Fundamental(f) => {
            TwoViewModel::Essential(essential_from_fundamental(&f, &k1, &k2)?)
        }
        TwoViewModel::Essential(e) => TwoViewModel::Essential(e),
        TwoViewModel::Homography(h) => {
            let h = k2.inverse_matrix() * h * k1.matrix();
            // Both cameras are on the same side of the plane.
            TwoViewModel::Homography(h / (h.norm() * h.determinant().signum()))
        }
    })
}

fn auto(
    arguments: &Arguments,
    context: &Context,
    cameras: Option<&Cameras>,
    [pixels1, pixels2]: Pixels<'_>,
) -> Result<TwoViewReport, Failure> {
    let options = arguments.options(context);
    let progress = Progress::new(context, Stage::RobustEstimation.words());
    let mut monitor = |status| progress.show(status);
    let report = match cameras.map(Cameras::both) {
        Some(cameras) => {
            estimate_two_view_calibrated(pixels1, pixels2, cameras, &options, &mut monitor)
        }
        None => estimate_two_view(pixels1, pixels2, &options, &mut monitor),
    }?;
    drop(progress);
    arguments.robust.warn_of_stop(
        report.stop,
        options.ransac.max_iterations,
        report.required_iterations,
        context,
    );
    Ok(report)
}

fn fundamental(
    arguments: &Arguments,
    context: &Context,
    pixels: Pixels<'_>,
) -> Result<Found, Failure> {
    let options = arguments.options(context);
    let [pixels1, pixels2] = pixels;
    let estimator = FundamentalEstimator::new(MatchSet::new(pixels1, pixels2)?)?;
    let report = arguments.robust.run(estimator, context)?;
    let (f, judging) = (report.model, options.ransac.within(report.max_error_px));
    let errors_px = errors::of_fundamental(pixels, &f);
    let found = Found::of_search(["fundamental", "general"], f, errors_px, report, &options);
    if found.configuration != "degenerate"
        && let Some(open) = left_open(pixels1, pixels2, &found.inliers, &judging)?
    {
        context.warn(&open);
    }
    Ok(found)
}

/// Searches for E, and for a rotation that explains its inliers.
fn essential(
    arguments: &Arguments,
    context: &Context,
    cameras: &Cameras,
    [pixels1, pixels2]: Pixels<'_>,
    errors_px: impl Fn(&RelativePose) -> Result<Vec<f64>, Failure>,
) -> Result<Found, Failure> {
    let options = arguments.options(context);
    let report = arguments.robust.watched(context, |options, monitor| {
        estimate_relative_pose(pixels1, pixels2, cameras.both(), options, monitor)
    })?;
    let pose = report.model;
    let judging = options.within(report.max_error_px);
    let (model, errors_px) = (pose.essential(), errors_px(&pose)?);
    let words = ["essential", "general"];
    let mut found = Found::of_search(words, model, errors_px, report, &options);
    if found.configuration == "degenerate" {
        return Ok(found);
    }
    found.cam2_from_cam1 = Some(pose.cam2_from_cam1());
    let (cameras, inliers) = (cameras.both(), &found.inliers);
    if let Some(rotation_only) =
        find_explaining_rotation(pixels1, pixels2, cameras, inliers, &judging)?
    {
        context.warn(&rotation_only::sentence(&rotation_only));
        found.set_rotation_only(&rotation_only);
    }
    Ok(found)
}

/// Builds the result for a homography; with known cameras, checks whether it is a rotation.
fn planar(
    arguments: &Arguments,
    context: &Context,
    cameras: Option<Cameras>,
    [pixels1, pixels2]: Pixels<'_>,
    (report, errors_px): (RansacReport<Matrix3<f64>>, Vec<f64>),
) -> Result<Found, Failure> {
    let options = arguments.options(context);
    let (h, judging) = (report.model, options.within(report.max_error_px));
    let mut found = Found::of_search(["homography", "planar"], h, errors_px, report, &options);
    if let (Some(cameras), "planar") = (cameras, found.configuration) {
        let (cameras, inliers) = (cameras.both(), &found.inliers);
        let rotation_only = find_explaining_rotation(pixels1, pixels2, cameras, inliers, &judging)?;
        rotation_only
            .iter()
            .for_each(|rotation_only| found.set_rotation_only(rotation_only));
    }
    Ok(found)
}

/// Warns of a plane that did not move, or that may be a rotation with another focal length than the
/// given, read or guessed one.
fn warn_of_rotation(
    arguments: &Arguments,
    context: &Context,
    photos: &[Photo; 2],
    [pixels1, pixels2]: Pixels<'_>,
    found: &Found,
) -> Result<(), Failure> {
    if found.configuration != "planar" {
        return Ok(());
    }
    let options = arguments.options(context).within(found.max_error_px);
    let inliers = &found.inliers;
    let unmoved = left_open_by_homography(pixels1, pixels2, inliers, &options.ransac)?;
    let can_guess = arguments.first.is_some() || arguments.camera.is_set();
    let sentence = match unmoved {
        None if can_guess => {
            let ([k1, k2], _) = arguments.camera.or_guess(photos)?;
            let cameras = [photos[0].camera(k1), photos[1].camera(k2)];
            rotation_only::sentence_of_other_focal(
                pixels1,
                pixels2,
                cameras.each_ref(),
                inliers,
                &options,
            )?
        }
        unmoved => unmoved,
    };
    if let Some(sentence) = sentence {
        context.warn(&sentence);
    }
    Ok(())
}

/// Returns the word for a configuration.
pub(super) fn word(configuration: Configuration) -> &'static str {
    match configuration {
        Configuration::General => "general",
        Configuration::Planar => "planar",
        Configuration::Panoramic => "panoramic",
        Configuration::Degenerate => "degenerate",
    }
}

/// Returns whether no more matches agree than wrong ones might.
fn is_degenerate<M>(report: &RansacReport<M>, options: &TwoViewOptions) -> bool {
    report.could_be_random() || report.num_unique_inliers < options.min_num_inliers
}

/// Returns the configuration of the views, if the model is significant.
fn configuration<M>(
    report: &RansacReport<M>,
    otherwise: &'static str,
    options: &TwoViewOptions,
) -> &'static str {
    if is_degenerate(report, options) {
        "degenerate"
    } else {
        otherwise
    }
}
