//! Alignment of photos in a panorama.

use super::overlap::Overlap;
use super::rotations::estimate_rotations;
use super::tree::largest_tree;
use crate::Result;
use crate::camera::Intrinsics;
use crate::math::svd3;
use crate::progress::Monitor;
use nalgebra::{Matrix3, Vector3};

/// Minimum spread of horizontal axes that determines the vertical, relative to the largest.
const CONSTRAINS_UP: f64 = 1e-4;

/// Photos in the frame of a panorama, which looks along z with y down.
#[derive(Debug, Clone, PartialEq)]
pub struct Panorama {
    /// For each photo the matrix `M` from directions of the panorama to pixels, `p ∝ M d`, with
    /// p.z > 0 where the photo sees the direction. `None` for photos without overlap.
    pub pixel_from_direction: Vec<Option<Matrix3<f64>>>,
    /// Rotations of the cameras, for rotating cameras: `d_in_cam = R d`.
    pub rotations: Vec<Option<Matrix3<f64>>>,
    /// Pixels per unit of a direction at z = 1: the focal length, for rotating cameras.
    pub scale_px: f64,
    /// Estimated common factor of the focal lengths, if requested and determined by the matches.
    pub focal_factor: Option<f64>,
}

/// Estimates the rotations of photos from one position, with a common factor of their focal
/// lengths.
///
/// Overlaps are joined to a tree; the best factor on a grid and the rotation that aligns the rays
/// of each overlap initialize a joint refinement by Levenberg–Marquardt, with a Cauchy loss. The
/// horizon is leveled for photos taken by rotating left or right.
///
/// * `intrinsics`: intrinsics of each photo; focal lengths are known or guessed
/// * `overlaps`: pairs of photos; photos not connected to the largest set are left out
/// * `find_focal`: whether to estimate a common factor of all focal lengths, from ¼ to 4
///
/// # Errors
/// [`Error::Degenerate`](crate::Error::Degenerate) if no photos overlap or all matches of an
/// overlap coincide, [`Error::OutOfRange`](crate::Error::OutOfRange) if an overlap refers to a
/// missing photo, [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Brown & Lowe 2007, §4 and 5.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::Intrinsics;
/// use epipole::stitch::{OverlapOptions, estimate_panorama, find_overlap};
/// use nalgebra::{Point2, Rotation3, Vector3};
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// // A rotation by 0.3 to the right.
/// let rotation = Rotation3::from_scaled_axis(Vector3::y() * -0.3);
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(200 + i * 37 % 440), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| k.project(&(rotation * k.ray(p)).into()).unwrap()).collect();
/// let overlap = find_overlap([0, 1], &p1, &p2, &OverlapOptions::default(), &mut ())?.unwrap();
/// let guess = [Intrinsics::centered(768.0, 640, 480)?; 2];
/// let found = estimate_panorama(&guess, &[overlap], true, &mut ())?;
/// assert!((found.scale_px - 600.0).abs() < 1e-3);
/// # Ok(()) }
/// ```
pub fn estimate_panorama(
    intrinsics: &[Intrinsics],
    overlaps: &[Overlap],
    find_focal: bool,
    monitor: &mut dyn Monitor,
) -> Result<Panorama> {
    let tree = largest_tree(intrinsics.len(), overlaps)?;
    let (rotations, focal_factor) =
        estimate_rotations(intrinsics, overlaps, &tree, find_focal, monitor)?;
    let level = level_rotation(&rotations);
    let rotations: Vec<_> = rotations
        .iter()
        .map(|r| r.map(|r| r * level.transpose()))
        .collect();
    let factor = focal_factor.unwrap_or(1.0);
    let matrix = |(k, r): (&Intrinsics, &Option<Matrix3<f64>>)| -> Result<_> {
        r.map(|r| Ok(k.zoomed(factor)?.matrix() * r)).transpose()
    };
    let matrices = intrinsics.iter().zip(&rotations).map(matrix);
    Ok(Panorama {
        pixel_from_direction: matrices.collect::<Result<_>>()?,
        rotations,
        scale_px: intrinsics[tree.root].fu_px() * factor,
        focal_factor,
    })
}

/// Returns the rotation to a frame whose y is perpendicular to the x axes of all cameras, and whose
/// z is their mean direction.
///
/// Source: Brown & Lowe 2007, §5 (automatic panorama straightening).
fn level_rotation(rotations: &[Option<Matrix3<f64>>]) -> Matrix3<f64> {
    let axis = |row: usize| {
        let axes = rotations
            .iter()
            .flatten()
            .map(move |r| r.row(row).transpose());
        axes.collect::<Vec<Vector3<f64>>>()
    };
    let spread: Matrix3<f64> = axis(0).iter().map(|x| x * x.transpose()).sum();
    let mean = |row| axis(row).iter().sum::<Vector3<f64>>();
    let svd = svd3(&spread);
    let constrains_up = svd.singular_values[1] > CONSTRAINS_UP * svd.singular_values[0];
    let down = match constrains_up {
        true => svd.v.column(2).into_owned(),
        false => mean(1),
    };
    let ahead = mean(2);
    let signed = down * down.dot(&mean(1)).signum();
    let right = signed.cross(&ahead);
    // For a full circle, the mean direction may vanish.
    let (Some(y), Some(x)) = (signed.try_normalize(1e-9), right.try_normalize(1e-9)) else {
        return Matrix3::identity();
    };
    Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()])
}
