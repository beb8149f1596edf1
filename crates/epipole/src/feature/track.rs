//! Tracking of points from one image to the next.

use crate::imaging::{
    Border, Gradient, GrayImage32, centered_difference, gaussian_pyramid, require_finite,
    sample_bilinear,
};
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::Point2;

/// Options of [`track_lucas_kanade`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TrackOptions {
    /// Half the side of the window, pixels, 1 to 50.
    pub half_window: usize,
    /// Number of levels of the pyramid, 1 to 12; each doubles the maximum motion.
    pub num_levels: usize,
    /// Maximum number of steps per level, ≥ 1.
    pub max_iterations: usize,
    /// Step length at which the iteration ends, pixels, > 0.
    pub tolerance_px: f64,
    /// Minimum of the smaller eigenvalue per pixel, for squared gradients of gray values in [0, 1]
    /// per pixel; points with flatter windows are lost.
    pub min_eigenvalue: f64,
    /// Maximum distance between a point and its position when tracked back, pixels; `None` disables
    /// the check.
    pub max_forward_backward_px: Option<f64>,
}

impl Default for TrackOptions {
    /// Returns a 21×21 window, 4 levels, 30 steps to 0.01 pixels, and back within 1 pixel.
    fn default() -> Self {
        Self {
            half_window: 10,
            num_levels: 4,
            max_iterations: 30,
            tolerance_px: 0.01,
            min_eigenvalue: 1e-6,
            max_forward_backward_px: Some(1.0),
        }
    }
}

/// A tracked point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Track {
    /// Position in the second image, pixels.
    pub point: Point2<f64>,
    /// Mean absolute difference of gray values between the two windows.
    pub residual: f32,
    /// Distance between its start and the point tracked back, pixels; `None` if not requested.
    pub forward_backward_px: Option<f64>,
}

/// Tracks points from one image to the next by matching the windows around them; `None` for a lost
/// point.
///
/// At each level of the pyramid the displacement d minimizes `Σ (I₁(p) − I₂(p + d))²` over the
/// window by Gauss–Newton steps with the gradient of the first image. A point is lost if its window
/// is too flat or has a single edge, if it leaves the image, or if tracking it back ends elsewhere.
/// The only stage is [`Stage::Tracking`].
///
/// * `points`: pixels in the first image
///
/// # Errors
/// [`Error::SizeMismatch`] for images of different size, [`Error::NotFinite`] for an invalid pixel,
/// [`Error::OutOfRange`] for an option outside its range, [`Error::Canceled`].
///
/// Source: Lucas & Kanade 1981; Bouguet 2000, "Pyramidal implementation of the Lucas Kanade feature
/// tracker"; Kalal, Mikolajczyk & Matas 2010 for tracking back.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{TrackOptions, track_lucas_kanade};
/// use epipole::imaging::GrayImage32;
/// use nalgebra::Point2;
/// let blob = |x: f32, y: f32| {
///     GrayImage32::from_fn(64, 64, move |u, v| {
///         let (dx, dy) = (u as f32 - x, v as f32 - y);
///         image::Luma([1.0 / (1.0 + (dx * dx + dy * dy) / 30.0)])
///     })
/// };
/// let (first, second) = (blob(30.0, 30.0), blob(33.5, 29.0));
/// let start = [Point2::new(30.0, 30.0)];
/// let tracks = track_lucas_kanade(&first, &second, &start, &TrackOptions::default(), &mut ())?;
/// let track = tracks[0].expect("the blob is followed");
/// assert!((track.point - Point2::new(33.5, 29.0)).norm() < 0.02);
/// # Ok(()) }
/// ```
pub fn track_lucas_kanade(
    first: &GrayImage32,
    second: &GrayImage32,
    points: &[Point2<f64>],
    options: &TrackOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Option<Track>>> {
    check(options)?;
    for (what, a, b) in [
        ("the rows of the two images", first.width(), second.width()),
        (
            "the columns of the two images",
            first.height(),
            second.height(),
        ),
    ] {
        if a != b {
            return Err(Error::SizeMismatch {
                what,
                first: a as usize,
                second: b as usize,
            });
        }
    }
    require_finite(first)?;
    require_finite(second)?;
    let mut part = Part::new(monitor, 0.0, PYRAMID_WORK_RATIO);
    let levels = [
        levels(first, options, &mut Part::new(&mut part, 0.0, 0.5))?,
        levels(second, options, &mut Part::new(&mut part, 0.5, 1.0))?,
    ];
    let part = &mut Part::new(monitor, PYRAMID_WORK_RATIO, 1.0);
    monitored::map(points, Stage::Tracking, part, |point| {
        let (there, residual) = follow(&levels[0], &levels[1], point, options)?;
        let forward_backward_px = match options.max_forward_backward_px {
            None => None,
            Some(limit) => {
                let (back, _) = follow(&levels[1], &levels[0], &there, options)?;
                let distance = (back - point).norm();
                if distance > limit {
                    return None;
                }
                Some(distance)
            }
        };
        Some(Track {
            point: there,
            residual,
            forward_backward_px,
        })
    })
}

/// Progress after the pyramids, if there are many points.
const PYRAMID_WORK_RATIO: f32 = 0.1;

struct Level {
    image: GrayImage32,
    gradient: Gradient,
}

/// Returns the levels of the pyramid that are at least as large as the window, largest first.
///
/// # Errors
/// [`Error::Canceled`].
fn levels(
    image: &GrayImage32,
    options: &TrackOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Level>> {
    let smallest = 2 * options.half_window as u32 + 1;
    report(monitor, Stage::Tracking, 0.0)?;
    let images = gaussian_pyramid(image, options.num_levels);
    let large = (images.into_iter().enumerate())
        .filter(|(k, level)| *k == 0 || level.width().min(level.height()) >= smallest);
    let mut levels = Vec::new();
    for (_, image) in large {
        report(monitor, Stage::Tracking, 0.5)?;
        levels.push(Level {
            gradient: centered_difference(&image, Border::Replicate),
            image,
        });
    }
    Ok(levels)
}

/// Tracks a point to the second image; returns it with the mean residual.
fn follow(
    first: &[Level],
    second: &[Level],
    point: &Point2<f64>,
    options: &TrackOptions,
) -> Option<(Point2<f64>, f32)> {
    let mut shift = [0.0, 0.0];
    let mut residual = 0.0;
    for (k, (from, to)) in first.iter().zip(second).enumerate().rev() {
        // Sample i of a level is sample 2i of the next finer one.
        let scale = (1u64 << k) as f64;
        let place = [point.x / scale, point.y / scale];
        shift = shift.map(|s| 2.0 * s);
        (shift, residual) = step_down(from, to, place, shift, k == 0, options)?;
    }
    let there = Point2::new(point.x + shift[0], point.y + shift[1]);
    Some((there, residual))
}

/// Computes the displacement at one level, from an initial guess.
fn step_down(
    from: &Level,
    to: &Level,
    place: [f64; 2],
    mut shift: [f64; 2],
    finest: bool,
    options: &TrackOptions,
) -> Option<([f64; 2], f32)> {
    let half = options.half_window as isize;
    let (right, bottom) = (
        f64::from(from.image.width()) - 0.5,
        f64::from(from.image.height()) - 0.5,
    );
    let inside = |[u, v]: [f64; 2]| u >= -0.5 && v >= -0.5 && u < right && v < bottom;
    if !inside(place) {
        return None;
    }
    let read = |image: &GrayImage32, [u, v]: [f64; 2], x: isize, y: isize| {
        sample_bilinear(image, u + x as f64, v + y as f64, Border::Replicate)
    };
    let window = || (-half..=half).flat_map(|y| (-half..=half).map(move |x| (x, y)));
    let count = ((2 * half + 1) * (2 * half + 1)) as usize;
    let mut patch = Vec::with_capacity(count);
    let [mut a, mut b, mut c] = [0.0f64; 3];
    for (x, y) in window() {
        let value = read(&from.image, place, x, y);
        let du = f64::from(read(&from.gradient.du, place, x, y));
        let dv = f64::from(read(&from.gradient.dv, place, x, y));
        a += du * du;
        b += du * dv;
        c += dv * dv;
        patch.push((value, du, dv));
    }
    let mean = 0.5 * (a + c);
    let spread = (0.25 * (a - c) * (a - c) + b * b).sqrt();
    let determinant = a * c - b * b;
    if (mean - spread) / (count as f64) < options.min_eigenvalue || determinant <= 0.0 {
        // A coarse level may be flat where a fine one is not.
        return if finest { None } else { Some((shift, 0.0)) };
    }
    let mut residual = 0.0;
    for _ in 0..options.max_iterations {
        let there = [place[0] + shift[0], place[1] + shift[1]];
        if !inside(there) {
            return None;
        }
        let (mut p, mut q, mut sum) = (0.0, 0.0, 0.0);
        for ((x, y), &(value, du, dv)) in window().zip(&patch) {
            let difference = f64::from(value - read(&to.image, there, x, y));
            p += difference * du;
            q += difference * dv;
            sum += difference.abs();
        }
        residual = (sum / count as f64) as f32;
        let step = [(c * p - b * q) / determinant, (a * q - b * p) / determinant];
        shift = [shift[0] + step[0], shift[1] + step[1]];
        if step[0] * step[0] + step[1] * step[1] < options.tolerance_px * options.tolerance_px {
            break;
        }
    }
    inside([place[0] + shift[0], place[1] + shift[1]]).then_some((shift, residual))
}

fn check(options: &TrackOptions) -> Result<()> {
    let back = options.max_forward_backward_px.unwrap_or(1.0);
    let ranges = [
        (
            "half the window of the tracker in pixels",
            "between 1 and 50",
            options.half_window as f64,
            (1..=50).contains(&options.half_window),
        ),
        (
            "the number of levels",
            "between 1 and 12",
            options.num_levels as f64,
            (1..=12).contains(&options.num_levels),
        ),
        (
            "the number of steps",
            "at least 1",
            options.max_iterations as f64,
            options.max_iterations >= 1,
        ),
        (
            "the tolerance of the tracker in pixels",
            "greater than 0",
            options.tolerance_px,
            options.tolerance_px > 0.0,
        ),
        (
            "the smallest eigenvalue of the tracker",
            "0 or more",
            options.min_eigenvalue,
            options.min_eigenvalue >= 0.0,
        ),
        (
            "the largest distance after following back in pixels",
            "greater than 0",
            back,
            back > 0.0,
        ),
    ];
    Error::check_rules(&ranges)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn tracks_agree_with_the_truth_and_with_opencv() {
        let (first, second) = (fixture::gray8("track_1.npy"), fixture::gray8("track_2.npy"));
        let [first, second] = [first, second].map(|image| crate::imaging::gray_to_f32(&image));
        let list = fixture::floats("track_points.npy");
        // Each row: initial position, true position by the warp, and OpenCV's result.
        let points: Vec<Point2<f64>> = list
            .values
            .chunks_exact(6)
            .map(|p| Point2::new(f64::from(p[0]), f64::from(p[1])))
            .collect();
        let tracks =
            track_lucas_kanade(&first, &second, &points, &TrackOptions::default(), &mut ())
                .unwrap();
        let (mut num_tracked, mut ours, mut theirs) = (0, 0.0, 0.0);
        for (track, row) in tracks.iter().zip(list.values.chunks_exact(6)) {
            let Some(track) = track else { continue };
            let truth = Point2::new(f64::from(row[2]), f64::from(row[3]));
            let opencv = Point2::new(f64::from(row[4]), f64::from(row[5]));
            num_tracked += 1;
            ours += (track.point - truth).norm();
            theirs += (opencv - truth).norm();
            assert!((track.point - truth).norm() < 0.25, "{track:?} {truth}");
        }
        assert!(
            num_tracked * 10 >= points.len() * 9,
            "{num_tracked} of {}",
            points.len()
        );
        assert!(ours <= 1.05 * theirs, "{ours} {theirs}");
    }

    #[test]
    fn lost_points_are_none() {
        let image = fixture::gray8("track_1.npy");
        let image = crate::imaging::gray_to_f32(&image);
        let flat = GrayImage32::from_pixel(image.width(), image.height(), image::Luma([0.5]));
        let options = TrackOptions::default();
        let lost = |a: &GrayImage32, b: &GrayImage32, u: f64, v: f64| {
            let tracks = track_lucas_kanade(a, b, &[Point2::new(u, v)], &options, &mut ());
            tracks.unwrap() == [None]
        };
        assert!(lost(&flat, &flat, 30.0, 30.0));
        assert!(lost(&image, &image, -5.0, 30.0));
        assert!(lost(&image, &image, f64::NAN, 30.0));
        assert!(lost(&image, &image, 1e300, f64::INFINITY));
        assert!(!lost(&image, &image, 50.0, 40.0));
        let tiny = GrayImage32::new(2, 1);
        assert!(lost(&tiny, &tiny, 0.0, 0.0));
        let empty = GrayImage32::new(0, 0);
        assert!(lost(&empty, &empty, 0.0, 0.0));
    }

    #[test]
    fn bad_input_is_refused() {
        let image = GrayImage32::new(40, 40);
        let run = |a: &GrayImage32, b: &GrayImage32, o: &TrackOptions| {
            track_lucas_kanade(a, b, &[], o, &mut ()).is_err()
        };
        let options = TrackOptions::default();
        assert!(run(&image, &GrayImage32::new(40, 41), &options));
        assert!(run(&image, &GrayImage32::new(41, 40), &options));
        let nan = GrayImage32::from_pixel(40, 40, image::Luma([f32::NAN]));
        assert!(run(&image, &nan, &options));
        let bad = |change: fn(&mut TrackOptions)| {
            let mut options = options;
            change(&mut options);
            assert!(run(&image, &image, &options));
        };
        bad(|o| o.half_window = 0);
        bad(|o| o.num_levels = 0);
        bad(|o| o.max_iterations = 0);
        bad(|o| o.tolerance_px = f64::NAN);
        bad(|o| o.min_eigenvalue = -1.0);
        bad(|o| o.max_forward_backward_px = Some(0.0));
    }
}
