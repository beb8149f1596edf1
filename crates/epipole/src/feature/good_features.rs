//! Strong corners at minimum distances, distributed over the image.

use super::nms::strongest_first;
use super::{Keypoint, StructureTensorOptions, harris_response, min_eigenvalue_response};
use crate::imaging::GrayImage32;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;

/// Measure of corners.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum CornerMeasure {
    /// The smaller eigenvalue of the structure tensor.
    #[default]
    ShiTomasi,
    /// Harris measure with its constant k.
    Harris(f32),
}

/// Grid that distributes the corners evenly over the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Grid {
    /// Number of columns of cells, ≥ 1.
    pub columns: usize,
    /// Number of rows of cells, ≥ 1.
    pub rows: usize,
}

/// Options of [`good_features_to_track`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct GoodFeaturesOptions {
    /// Maximum number of corners; 0 means no limit.
    pub max_corners: usize,
    /// Minimum response relative to the strongest corner, in (0, 1].
    pub quality: f32,
    /// Minimum distance between corners, pixels; 0 allows neighbors.
    pub min_distance_px: f64,
    /// Corner measure.
    pub measure: CornerMeasure,
    /// Options of the structure tensor.
    pub tensor: StructureTensorOptions,
    /// With a grid and a limit, each cell first contributes an equal number of its strongest
    /// corners; cells with too few leave the remainder to the strongest of the rest.
    pub grid: Option<Grid>,
}

impl Default for GoodFeaturesOptions {
    /// Returns at most 1000 Shi–Tomasi corners, 1 % quality, 8 pixels apart, without a grid.
    fn default() -> Self {
        Self {
            max_corners: 1000,
            quality: 0.01,
            min_distance_px: 8.0,
            measure: CornerMeasure::ShiTomasi,
            tensor: StructureTensorOptions::default(),
            grid: None,
        }
    }
}

/// Finds the corners of an image: local maxima of the measure in 3×3 pixels, at least `quality`
/// times the strongest, no two closer than `min_distance_px` (the stronger one is kept), strongest
/// first.
///
/// Border pixels are excluded. An image without corners gives an empty list. Positions are
/// integers; [`refine_corners`](super::refine_corners()) refines them.
///
/// # Errors
/// [`Error::OutOfRange`] for a quality outside (0, 1], a negative or infinite distance or a grid
/// without cells; [`Error::Canceled`]; else as [`harris_response`].
///
/// Source: Shi & Tomasi 1994; the selection is that of OpenCV's `goodFeaturesToTrack`.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{GoodFeaturesOptions, good_features_to_track};
/// use epipole::imaging::GrayImage32;
/// // A white square with its corner pixels at 5 and 14.
/// let inside = |x: u32| (5..15).contains(&x);
/// let square = GrayImage32::from_fn(20, 20, |u, v| {
///     image::Luma([if inside(u) && inside(v) { 1.0 } else { 0.0 }])
/// });
/// let corners = good_features_to_track(&square, &GoodFeaturesOptions::default(), &mut ())?;
/// assert_eq!(corners.len(), 4);
/// assert_eq!((corners[0].u, corners[0].v), (5.0, 5.0));
/// # Ok(()) }
/// ```
pub fn good_features_to_track(
    image: &GrayImage32,
    options: &GoodFeaturesOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Keypoint>> {
    if !(options.quality > 0.0 && options.quality <= 1.0) {
        return Err(Error::OutOfRange {
            what: "the quality of a corner",
            requirement: "greater than 0 and at most 1",
            value: f64::from(options.quality),
        });
    }
    if !(options.min_distance_px >= 0.0 && options.min_distance_px.is_finite()) {
        return Err(Error::OutOfRange {
            what: "the smallest distance between corners in pixels",
            requirement: "0 or more",
            value: options.min_distance_px,
        });
    }
    if options.grid.is_some_and(|g| g.columns == 0 || g.rows == 0) {
        return Err(Error::OutOfRange {
            what: "the number of cells of the grid along an axis",
            requirement: "at least 1",
            value: 0.0,
        });
    }
    let part = &mut Part::new(monitor, 0.0, 0.8);
    let response = match options.measure {
        CornerMeasure::ShiTomasi => min_eigenvalue_response(image, &options.tensor, part)?,
        CornerMeasure::Harris(k) => harris_response(image, k, &options.tensor, part)?,
    };
    report(monitor, Stage::FeatureDetection, 0.8)?;
    let mut candidates = inner_maxima(&response, options.quality);
    report(monitor, Stage::FeatureDetection, 0.85)?;
    strongest_first(&mut candidates);
    report(monitor, Stage::FeatureDetection, 0.95)?;
    let limit = if options.max_corners == 0 {
        usize::MAX
    } else {
        options.max_corners
    };
    let (width, height) = (f64::from(image.width()), f64::from(image.height()));
    let mut chosen = Chosen::new(width, height, options.min_distance_px);
    let Some(grid) = options.grid else {
        for candidate in candidates {
            if chosen.list.len() == limit {
                break;
            }
            chosen.push_if_free(candidate);
        }
        return Ok(chosen.list);
    };
    let quota = limit.div_ceil(grid.columns.saturating_mul(grid.rows));
    let mut counts = vec![0usize; grid.columns.saturating_mul(grid.rows).min(1 << 20)];
    let cells = counts.len();
    let mut rest = Vec::new();
    for candidate in candidates {
        let column = (candidate.u / width * grid.columns as f64) as usize;
        let row = (candidate.v / height * grid.rows as f64) as usize;
        let cell = row.saturating_mul(grid.columns).saturating_add(column) % cells;
        if counts[cell] < quota && chosen.list.len() < limit {
            if chosen.push_if_free(candidate) {
                counts[cell] += 1;
            }
        } else {
            rest.push(candidate);
        }
    }
    for candidate in rest {
        if chosen.list.len() == limit {
            break;
        }
        chosen.push_if_free(candidate);
    }
    strongest_first(&mut chosen.list);
    Ok(chosen.list)
}

/// Returns the pixels inside the border that no neighbor exceeds and that reach the quality.
fn inner_maxima(response: &GrayImage32, quality: f32) -> Vec<Keypoint> {
    let (width, height) = (response.width() as usize, response.height() as usize);
    let values = response.as_raw();
    let strongest = values.iter().fold(0.0f32, |m, &v| m.max(v));
    let threshold = strongest * quality;
    let mut found = Vec::new();
    if strongest <= 0.0 || width < 3 {
        return found;
    }
    for v in 1..height.saturating_sub(1) {
        let rows: [&[f32]; 3] =
            std::array::from_fn(|k| &values[(v + k - 1) * width..(v + k) * width]);
        for u in 1..width - 1 {
            let value = rows[1][u];
            if value >= threshold
                && rows
                    .iter()
                    .all(|row| row[u - 1..=u + 1].iter().all(|&n| n <= value))
            {
                found.push(Keypoint::at(u as f64, v as f64, value));
            }
        }
    }
    found
}

/// Corners chosen so far, in buckets as wide as the minimum distance.
struct Chosen {
    list: Vec<Keypoint>,
    min_distance_px: f64,
    bucket_px: f64,
    columns: usize,
    buckets: Vec<Vec<usize>>,
}

impl Chosen {
    fn new(width: f64, height: f64, min_distance_px: f64) -> Self {
        let bucket_px = min_distance_px.max(4.0);
        let columns = (width / bucket_px) as usize + 1;
        let rows = (height / bucket_px) as usize + 1;
        let count = if min_distance_px > 0.0 {
            columns * rows
        } else {
            0
        };
        Self {
            list: Vec::new(),
            min_distance_px,
            bucket_px,
            columns,
            buckets: vec![Vec::new(); count],
        }
    }

    /// Adds the corner unless one is too close; returns whether it was added.
    fn push_if_free(&mut self, corner: Keypoint) -> bool {
        if self.min_distance_px > 0.0 {
            let column = (corner.u / self.bucket_px) as usize;
            let row = (corner.v / self.bucket_px) as usize;
            let rows = self.buckets.len() / self.columns;
            for y in row.saturating_sub(1)..=(row + 1).min(rows - 1) {
                for x in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                    for &k in &self.buckets[y * self.columns + x] {
                        let (du, dv) = (self.list[k].u - corner.u, self.list[k].v - corner.v);
                        if du * du + dv * dv < self.min_distance_px * self.min_distance_px {
                            return false;
                        }
                    }
                }
            }
            self.buckets[row * self.columns + column].push(self.list.len());
        }
        self.list.push(corner);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::{Scaling, Window};
    use crate::imaging::fixture;

    fn options() -> GoodFeaturesOptions {
        GoodFeaturesOptions {
            tensor: StructureTensorOptions {
                scaling: Scaling::OpenCv,
                ..StructureTensorOptions::default()
            },
            ..GoodFeaturesOptions::default()
        }
    }

    fn assert_same_corners(corners: &[Keypoint], name: &str) {
        let expected = fixture::floats(name);
        assert_eq!(corners.len(), expected.shape[0], "{name}");
        for (corner, want) in corners.iter().zip(expected.values.chunks_exact(2)) {
            assert_eq!(
                (corner.u, corner.v),
                (f64::from(want[0]), f64::from(want[1])),
                "{name}"
            );
        }
    }

    #[test]
    fn corners_and_their_order_equal_opencv() {
        let image = fixture::gray32("corners.npy");
        let mut options = options();
        (
            options.max_corners,
            options.quality,
            options.min_distance_px,
        ) = (60, 0.05, 7.0);
        let corners = good_features_to_track(&image, &options, &mut ()).unwrap();
        assert_same_corners(&corners, "good_features.npy");
        (
            options.max_corners,
            options.quality,
            options.min_distance_px,
        ) = (25, 0.01, 10.0);
        options.measure = CornerMeasure::Harris(0.04);
        options.tensor.window = Window::Box(5);
        let corners = good_features_to_track(&image, &options, &mut ()).unwrap();
        assert_same_corners(&corners, "good_features_harris.npy");
    }

    #[test]
    fn a_grid_spreads_the_corners() {
        // The left half is full of strong corners, the right half of weak ones.
        let image = GrayImage32::from_fn(200, 100, |u, v| {
            let strength = if u < 100 { 1.0 } else { 0.2 };
            image::Luma([if (u / 10 + v / 10) % 2 == 0 {
                strength
            } else {
                0.0
            }])
        });
        let mut options = GoodFeaturesOptions {
            max_corners: 40,
            ..options()
        };
        options.quality = 1e-4;
        let right = |corners: &[Keypoint]| corners.iter().filter(|c| c.u > 105.0).count();
        let plain = good_features_to_track(&image, &options, &mut ()).unwrap();
        options.grid = Some(Grid {
            columns: 4,
            rows: 2,
        });
        let spread = good_features_to_track(&image, &options, &mut ()).unwrap();
        assert_eq!((plain.len(), spread.len()), (40, 40));
        assert_eq!(right(&plain), 0);
        assert!(right(&spread) >= 15, "{}", right(&spread));
    }

    #[test]
    fn nothing_to_find_is_an_empty_list() {
        for (w, h) in [(0, 0), (1, 1), (2, 9), (1, 30), (30, 20)] {
            let image = GrayImage32::from_pixel(w, h, image::Luma([0.5]));
            assert!(
                good_features_to_track(&image, &options(), &mut ())
                    .unwrap()
                    .is_empty()
            );
        }
    }

    #[test]
    fn bad_options_are_refused() {
        let image = GrayImage32::new(9, 9);
        let bad = |change: fn(&mut GoodFeaturesOptions)| {
            let mut options = options();
            change(&mut options);
            assert!(good_features_to_track(&image, &options, &mut ()).is_err());
        };
        bad(|o| o.quality = 0.0);
        bad(|o| o.quality = f32::NAN);
        bad(|o| o.quality = 1.5);
        bad(|o| o.min_distance_px = -1.0);
        bad(|o| o.min_distance_px = f64::INFINITY);
        bad(|o| {
            o.grid = Some(Grid {
                columns: 0,
                rows: 2,
            })
        });
        bad(|o| o.measure = CornerMeasure::Harris(0.7));
    }
}
