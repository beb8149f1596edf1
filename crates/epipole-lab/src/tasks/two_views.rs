//! Two-view geometry of a pair of photographs.

use super::convert::{intrinsics, sentence};
use super::{Calibrated, PairOptions, Progress, Shows, Told, TwoViews, ViewModel, ask};
use epipole::camera::Camera;
use epipole::progress::Status;
use epipole::robust::RansacOptions;
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, estimate_two_view_calibrated, find_turn_and_focal,
};
use nalgebra::{Matrix3, Point2};

/// Chooses among E, F and H, as `epipole two-view` does with known intrinsics: the least ambiguous
/// matches first.
///
/// Matches that do not allow any estimate also give an answer: [`Shows::Nothing`].
///
/// # Errors
/// A message for invalid numbers, and for cancellation by `progress`.
pub(super) fn two_views(
    places: &[[f64; 4]],
    ratios: &[f32],
    cameras: &[Calibrated; 2],
    options: &PairOptions,
    progress: Progress<'_>,
) -> Result<TwoViews, String> {
    if ratios.len() != places.len() {
        return Err("the matches did not arrive whole".to_owned());
    }
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| ratios[a].total_cmp(&ratios[b]));
    let ordered = || order.iter().map(|&n| places[n]);
    let first: Vec<Point2<f64>> = ordered().map(|p| Point2::new(p[0], p[1])).collect();
    let second: Vec<Point2<f64>> = ordered().map(|p| Point2::new(p[2], p[3])).collect();
    let [k1, k2] = [intrinsics(&cameras[0])?, intrinsics(&cameras[1])?];
    let how = TwoViewOptions::default().with_ransac(
        RansacOptions::default()
            .with_max_error_px(options.max_error_px)
            .with_seed(options.seed),
    );
    how.check().map_err(sentence)?;
    let mut monitor = |status: Status| progress(Told::Share(status.share, ""));
    // Estimators do not use the size of the images.
    let [one, two] = [k1, k2].map(|k| Camera::pinhole(k, 0, 0));
    let found = estimate_two_view_calibrated(&first, &second, [&one, &two], &how, &mut monitor);
    if found == Err(epipole::Error::Canceled) {
        return Err("stopped".to_owned());
    }
    let Ok(found) = found else {
        return Ok(nothing(places.len()));
    };
    ask(progress, 0.0)?;
    // With a wrong focal length a rotation passes for a plane.
    let otherwise = match found.configuration {
        Configuration::Planar => {
            find_turn_and_focal(&first, &second, [&one, &two], &found.inliers, &how)
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

fn rows(matrix: &Matrix3<f64>) -> [f64; 9] {
    let mut rows = [0.0; 9];
    rows.copy_from_slice(matrix.transpose().as_slice());
    rows
}
