//! Panoramas of planes.

use super::overlap::Overlap;
use super::panorama::Panorama;
use super::tree::largest_tree;
use crate::Result;
use nalgebra::{Matrix3, Vector3};

/// Aligns photos of one plane, or from one position, by chained homographies. The frame is that of
/// the central photo: a direction (x, y, 1) is its pixel s (x, y) for a scale s of
/// [`Panorama::scale_px`], and the surface must be [`Surface::Plane`](super::Surface).
///
/// * `num_images`: number of photos
/// * `overlaps`: pairs of photos; photos not connected to the largest set are left out
///
/// # Errors
/// [`Error::Degenerate`](crate::Error::Degenerate) if no photos overlap,
/// [`Error::OutOfRange`](crate::Error::OutOfRange) if an overlap refers to a missing photo.
///
/// Source: Szeliski 2022, §8.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stitch::{OverlapOptions, chain_homographies, find_overlap};
/// use nalgebra::{Point2, Vector3};
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(200 + i * 37 % 440), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| Point2::new(p.x - 200.0, p.y)).collect();
/// let overlap = find_overlap([0, 1], &p1, &p2, &OverlapOptions::default(), &mut ())?.unwrap();
/// let found = chain_homographies(2, &[overlap])?;
/// let s = found.scale_px;
/// let pixel = found.pixel_from_direction[1].unwrap() * Vector3::new(300.0 / s, 100.0 / s, 1.0);
/// assert!((pixel / pixel.z - Vector3::new(100.0, 100.0, 1.0)).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn chain_homographies(num_images: usize, overlaps: &[Overlap]) -> Result<Panorama> {
    let tree = largest_tree(num_images, overlaps)?;
    // About the size of a photo, so that directions have angles to z like those of a camera.
    let pixels = overlaps
        .iter()
        .flat_map(|overlap| overlap.pixels.iter().flatten());
    let scale_px = pixels.fold(1.0, |most: f64, pixel| most.max(pixel.coords.amax()));
    let mut matrices = vec![None; num_images];
    matrices[tree.root] = Some(Matrix3::from_diagonal(&Vector3::new(
        scale_px, scale_px, 1.0,
    )));
    for &[child, parent, index] in &tree.edges {
        let overlap = &overlaps[index];
        let child_from_parent = match overlap.images[0] == parent {
            true => Some(overlap.homography),
            false => overlap.homography.try_inverse(),
        };
        let first = overlap.pixels[usize::from(overlap.images[0] != parent)].first();
        matrices[child] = child_from_parent.zip(first).and_then(|(h, pixel)| {
            // The matches are in front of both cameras.
            let h = h * (h * pixel.to_homogeneous()).z.signum();
            let of_parent: Matrix3<f64> = matrices[parent]?;
            Some(h * of_parent)
        });
    }
    Ok(Panorama {
        pixel_from_direction: matrices,
        rotations: vec![None; num_images],
        scale_px,
        focal_factor: None,
    })
}
