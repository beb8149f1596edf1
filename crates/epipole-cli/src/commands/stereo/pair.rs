//! Warnings about a pair that is the same image twice or not rectified, or has disparities outside
//! the range.

use crate::context::Context;
use crate::failure::Failure;
use crate::photo::Photo;
use epipole::feature::{
    FeatureKind, FeatureOptions, MatchOptions, detect_features, match_descriptors,
};
use epipole::imaging::resize;

/// Maximum number of pixels of the images searched for features; the check must be cheap compared
/// to matching.
const MAX_PIXELS: f64 = 1e5;

/// Maximum number of features of an image.
const MAX_FEATURES: usize = 500;

/// Maximum distance between the rows of a match in a rectified pair, pixels of these images.
const TOLERANCE_PX: f64 = 0.75;

/// Minimum number of representative matches.
const MIN_MATCHES: usize = 30;

/// Vector from the left to the right pixel of a match.
type Move = [f64; 2];

/// Warns if both images are equal, if the rows of matches disagree, or if most disparities are
/// outside the range.
///
/// * `range`: minimum and maximum disparity, pixels
///
/// # Errors
/// As the core's detector.
pub(super) fn check(
    photos: &[Photo; 2],
    range: (i32, i32),
    context: &Context,
) -> Result<(), Failure> {
    if photos[0].color == photos[1].color {
        context.warn("left and right are the same image, so every disparity is 0");
        return Ok(());
    }
    let (moves, scale) = moves(photos)?;
    if let Some(sentence) = sentence(&moves, TOLERANCE_PX / scale, range) {
        context.warn(&sentence);
    }
    Ok(())
}

/// Returns the moves of the matches, and the scale of the searched images.
fn moves(photos: &[Photo; 2]) -> Result<(Vec<Move>, f64), Failure> {
    let (width, height) = photos[0].color.dimensions();
    let scale = (MAX_PIXELS / (f64::from(width) * f64::from(height)))
        .sqrt()
        .min(1.0);
    let side = |side: u32| ((f64::from(side) * scale).round() as u32).max(1);
    // Much cheaper than SIFT, and accurate enough for rows.
    let options = FeatureOptions::default()
        .with_kind(FeatureKind::Orb)
        .with_max_features(MAX_FEATURES);
    let features = |photo: &Photo| -> Result<_, Failure> {
        let gray = match scale < 1.0 {
            true => resize(&photo.gray(), side(width), side(height))?,
            false => photo.gray(),
        };
        Ok(detect_features(&gray, &options, &mut ())?)
    };
    let [left, right] = [features(&photos[0])?, features(&photos[1])?];
    let matching = MatchOptions::default()
        .with_max_ratio(Some(0.8))
        .with_mutual(true);
    let matches = match_descriptors(&left.descriptors, &right.descriptors, &matching, &mut ())?;
    let moves = matches.iter().map(|found| {
        let (a, b) = (
            &left.keypoints[found.index1],
            &right.keypoints[found.index2],
        );
        [(b.u - a.u) / scale, (b.v - a.v) / scale]
    });
    Ok((moves.collect(), scale))
}

fn sentence(moves: &[Move], tolerance_px: f64, (low, high): (i32, i32)) -> Option<String> {
    let count = moves.len();
    if count < MIN_MATCHES {
        return None;
    }
    let stays = |axis: usize| moves.iter().filter(move |m| m[axis].abs() <= tolerance_px);
    let (num_columns, num_rows) = (stays(0).count(), stays(1).count());
    if 10 * num_rows < 3 * count {
        let found = format!("{num_rows} of {count} matches are in one row");
        return Some(match 2 * num_columns > count {
            true => format!(
                "columns agree, not rows: {found}, {num_columns} in one column; disparities are \
                 looked for along rows, so turn both images by 90°"
            ),
            false => format!(
                "rows do not agree: {found}; rectify the pair first (epipole rectify), or the \
                 disparities mean nothing"
            ),
        });
    }
    let mut disparities: Vec<f64> = stays(1).map(|m| -m[0]).collect();
    disparities.sort_by(f64::total_cmp);
    let (low, high) = (
        f64::from(low) - tolerance_px,
        f64::from(high) + tolerance_px,
    );
    let num_missed = disparities
        .iter()
        .filter(|d| !(low..=high).contains(*d))
        .count();
    if 10 * num_missed <= num_rows {
        return None;
    }
    let at = |fraction: f64| disparities[(fraction * (num_rows - 1) as f64).round() as usize];
    let (first, last) = (at(0.02).floor(), at(0.98).ceil());
    let found = format!(
        "{num_missed} of {num_rows} matches have disparities that are not looked for: they are {first} to {last} px"
    );
    Some(match last < low {
        true => format!("{found}; left and right may be swapped"),
        false => format!("{found}; set --min-disparity and --max-disparity"),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    /// Returns the moves `of(0)` to `of(99)`.
    fn of(of: impl Fn(f64) -> Move) -> Vec<Move> {
        (0..100).map(|n| of(f64::from(n))).collect()
    }

    #[test]
    fn a_good_pair_is_not_commented() {
        let good = of(|n| [-n / 2.0, if n > 70.0 { n } else { 0.3 }]);
        assert_eq!(sentence(&good, 1.5, (0, 64)), None);
        assert_eq!(sentence(&good[..20], 1.5, (0, 4)), None);
    }

    #[test]
    fn each_cause_has_its_sentence() {
        let warning_of = |moves: &[Move]| sentence(moves, 1.5, (0, 64)).unwrap();
        assert!(
            warning_of(&of(|n| [0.2, 5.0 + n])).starts_with("columns agree, not rows: 0 of 100")
        );
        assert!(warning_of(&of(|n| [n + 3.0, 5.0 + n])).starts_with("rows do not agree"));
        assert!(warning_of(&of(|n| [n + 3.0, 0.0])).ends_with("left and right may be swapped"));
        let far = warning_of(&of(|n| [-60.0 - n, 0.0]));
        assert!(far.contains("they are 62 to 157 px; set --min"), "{far}");
    }
}
