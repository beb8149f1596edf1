//! Overlapping pairs of photos and their errors.

use super::arguments::Arguments;
use super::input::Input;
use crate::context::Context;
use crate::failure::Failure;
use crate::progress::Progress;
use epipole::Error;
use epipole::feature::Match;
use epipole::progress::Part;
use epipole::sfm::{PhotoOptions, match_photos};
use epipole::stitch::{Overlap, OverlapOptions, Panorama, find_overlap};
use nalgebra::{Matrix3, Point2};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Fraction of the work after which all photos are matched.
const MATCHED: f32 = 0.8;

/// Maximum error of a fitting match after all photos are placed, pixels.
const FITS_PX: f64 = 6.0;

/// Fraction of fitting matches of an overlap below which there is parallax.
const MOST: f64 = 0.7;

/// Fraction below which the matches are wrong, if other overlaps place both photos.
const FEW: f64 = 0.1;

/// All overlaps.
pub(super) struct Overlaps {
    pub(super) found: Vec<Overlap>,
}

/// Errors of all overlaps.
pub(super) struct Judged {
    pub(super) mean_error_px: f64,
    pub(super) rows: Vec<Value>,
    /// Whether the camera moved between two photos.
    pub(super) has_parallax: bool,
}

impl Overlaps {
    /// Matches all photos with each other.
    ///
    /// # Errors
    /// A failure that names photos, if no two overlap.
    pub(super) fn find(
        arguments: &Arguments,
        input: &Input,
        context: &Context,
    ) -> Result<Self, Failure> {
        let photo_options = PhotoOptions::default()
            .with_features(arguments.features.options())
            .with_matching(arguments.matching.options());
        let options = OverlapOptions::default();
        let options = options.with_ransac(options.ransac.with_seed(context.seed));
        let progress = Progress::new(context, "overlaps");
        let watch = &mut |status| progress.show(status);
        let mut part = Part::new(watch, 0.0, MATCHED);
        let (images, pairs) = match_photos(&input.photos, &photo_options, &mut part)?;
        let mut found = Vec::new();
        let fraction = |n: usize| MATCHED + (1.0 - MATCHED) * n as f32 / pairs.len() as f32;
        for (n, pair) in pairs.iter().enumerate() {
            let list = |image: usize, side: fn(&Match) -> usize| -> Vec<Point2<f64>> {
                let keypoints = &images[image].keypoints;
                pair.matches
                    .iter()
                    .map(|found| keypoints[side(found)])
                    .collect()
            };
            let (a, b) = (
                list(pair.image1, |m| m.index1),
                list(pair.image2, |m| m.index2),
            );
            let mut part = Part::new(watch, fraction(n), fraction(n + 1));
            let numbers = [pair.image1, pair.image2];
            match find_overlap(numbers, &a, &b, &options, &mut part) {
                Err(Error::Canceled) => return Err(Error::Canceled.into()),
                overlap => found.extend(overlap?),
            }
        }
        if found.is_empty() {
            let most = pairs.iter().max_by_key(|pair| pair.matches.len());
            let most = most.map_or_else(String::new, |pair| {
                format!(
                    ": most matches have {} and {}, {}, and they do not agree",
                    input.photos[pair.image1].name,
                    input.photos[pair.image2].name,
                    pair.matches.len()
                )
            });
            return Err(Failure::new(
                "no-consensus",
                format!("no two photos overlap{most}"),
            ));
        }
        Ok(Self { found })
    }

    /// Measures the overlaps in a panorama. Warns of photos that are left out and of cameras that
    /// moved.
    pub(super) fn judge(&self, panorama: &Panorama, input: &Input, context: &Context) -> Judged {
        let names = |overlap: &Overlap| overlap.images.map(|image| &*input.photos[image].name);
        let left_out: Vec<&str> = (input.photos.iter().zip(&panorama.pixel_from_direction))
            .filter(|(_, place)| place.is_none())
            .map(|(photo, _)| &*photo.name)
            .collect();
        if !left_out.is_empty() {
            context.warn(&format!(
                "left out, for they overlap none of the others: {}",
                left_out.join(", ")
            ));
        }
        let fits: Vec<Fit<'_>> = (self.found.iter())
            .filter_map(|overlap| Fit::new(overlap, panorama))
            .collect();
        let mut joined = BTreeSet::new();
        for fit in fits.iter().filter(|fit| fit.inlier_ratio() >= MOST) {
            joined.extend(fit.overlap.images);
        }
        let (mut moved, mut elsewhere) = (Vec::new(), Vec::new());
        let (mut rows, mut sum_px, mut count) = (Vec::new(), 0.0, 0_usize);
        for fit in &fits {
            let overlap = fit.overlap;
            let are_joined = overlap.images.iter().all(|image| joined.contains(image));
            let is_elsewhere = are_joined && fit.inlier_ratio() < FEW;
            let parallax = !is_elsewhere && (overlap.has_parallax || fit.inlier_ratio() < MOST);
            for (list, is_in) in [(&mut moved, parallax), (&mut elsewhere, is_elsewhere)] {
                if is_in {
                    list.push(names(overlap).join(" and "));
                }
            }
            (sum_px, count) = (sum_px + fit.sum_px, count + fit.num_fitting);
            rows.push(json!({
                "names": names(overlap), "num_matches": overlap.num_matches, "num_inliers": fit.num_fitting,
                "mean_error_px": fit.sum_px / fit.num_fitting.max(1) as f64, "parallax": parallax,
            }));
        }
        if !moved.is_empty() {
            context.warn(&format!(
                "the camera moved between {}: objects at different distances do not align (parallax). For a plane, such as \
                 a wall, use --model homography",
                moved.join(", ")
            ));
        }
        if !elsewhere.is_empty() {
            context.warn(&format!(
                "matches of {} contradict all others and are not used: the scene may repeat itself",
                elsewhere.join(", ")
            ));
        }
        Judged {
            mean_error_px: sum_px / count.max(1) as f64,
            rows,
            has_parallax: !moved.is_empty(),
        }
    }
}

/// Matches of an overlap after all photos are placed.
struct Fit<'a> {
    overlap: &'a Overlap,
    num_fitting: usize,
    /// Sum of the errors of fitting matches.
    sum_px: f64,
}

impl<'a> Fit<'a> {
    /// Fits an overlap; `None` if one of its photos is left out.
    fn new(overlap: &'a Overlap, panorama: &Panorama) -> Option<Self> {
        let [first, second] = overlap.images.map(|n| panorama.pixel_from_direction[n]);
        let errors = errors_px(&first?, &second?, overlap);
        let fitting = || errors.iter().filter(|error| **error <= FITS_PX);
        Some(Self {
            overlap,
            num_fitting: fitting().count(),
            sum_px: fitting().fold(0.0, |sum, error| sum + error),
        })
    }

    /// Returns the fraction of the matches that fit.
    fn inlier_ratio(&self) -> f64 {
        self.num_fitting as f64 / self.overlap.pixels[0].len().max(1) as f64
    }
}

/// Returns the errors in the second photo, pixels.
fn errors_px(first: &Matrix3<f64>, second: &Matrix3<f64>, overlap: &Overlap) -> Vec<f64> {
    let inverse = first.try_inverse().unwrap_or_default();
    let transfer = second * inverse;
    let [pixels1, pixels2] = &overlap.pixels;
    let error = |(a, b): (&Point2<f64>, &Point2<f64>)| {
        let mapped = transfer * a.to_homogeneous();
        match mapped.z > 0.0 {
            true => (mapped.xy() / mapped.z - b.coords).norm(),
            false => f64::INFINITY,
        }
    };
    pixels1.iter().zip(pixels2).map(error).collect()
}
