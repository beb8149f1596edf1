//! Three descriptors of a position in a photograph.

use epipole::Error;
use epipole::feature::{
    Descriptors, Keypoint, SiftOptions, describe_patches, describe_sift, sift_directions,
};
use epipole::imaging::{Border, GrayImage32, sample_bilinear};

/// Scale σ of the keypoint in the original photograph, pixels.
pub(super) const SIGMA_PX: f64 = 3.2;
/// Side of a raw patch, samples.
const SAMPLES: usize = 16;
/// Spacing of its samples, pixels, so that they cover the descriptor's window.
const SPACING_PX: f64 = 12.0 * SIGMA_PX / SAMPLES as f64;
/// Norm of a byte descriptor.
const UNIT: f64 = 512.0;

/// Returns the SIFT options of all photographs in this figure.
fn options() -> SiftOptions {
    SiftOptions::default()
        .with_upsample(false)
        .with_max_orientations(1)
}

/// Names of the descriptors.
pub(super) const WAYS: [&str; 3] = ["raw patch", "normalized patch", "SIFT"];

/// All descriptors of positions.
#[derive(Clone)]
pub(super) struct Prints {
    /// Orientation assigned by SIFT.
    pub(super) angle_rad: f64,
    /// Scale σ that SIFT assumes, pixels.
    pub(super) scale_px: f64,
    pub(super) lists: [Descriptors; 3],
}

impl Prints {
    /// Describes positions of a photograph.
    ///
    /// * `scale_px`: scale σ that SIFT assumes; raw patches ignore it
    /// * `finds_direction`: whether SIFT rotates its window to the dominant gradient direction
    ///
    /// # Errors
    /// As [`describe_sift`].
    pub(super) fn of(
        gray: &GrayImage32,
        places: &[(f64, f64)],
        scale_px: f64,
        finds_direction: bool,
    ) -> Result<Self, Error> {
        let mut keypoints: Vec<Keypoint> = (places.iter())
            .map(|&(u, v)| Keypoint {
                scale_px: scale_px as f32,
                ..Keypoint::at(u, v, 1.0)
            })
            .collect();
        if finds_direction {
            let directions = sift_directions(gray, &keypoints, &options(), &mut ())?;
            for (keypoint, found) in keypoints.iter_mut().zip(directions) {
                keypoint.angle_rad = found.first().copied().unwrap_or(0.0);
            }
        }
        Ok(Self {
            angle_rad: keypoints
                .first()
                .map_or(0.0, |first| f64::from(first.angle_rad)),
            scale_px,
            lists: [
                raw_patches(gray, places)?,
                describe_patches(gray, &keypoints, SAMPLES, SPACING_PX, &mut ())?,
                describe_sift(gray, &keypoints, &options(), &mut ())?,
            ],
        })
    }

    /// Converts a descriptor's distance to its own unit: gray levels per sample, or distance of
    /// unit vectors.
    pub(super) fn in_units(way: usize, distance: f64) -> f64 {
        match way {
            0 => distance * 255.0 / SAMPLES as f64,
            1 => distance,
            _ => distance / UNIT,
        }
    }

    /// Returns the SIFT histogram of the first position: rows of cells, columns, directions.
    pub(super) fn histogram(&self) -> Vec<f32> {
        self.lists[2].get(0).unwrap_or_default()
    }
}

/// Returns the unprocessed gray values around each position.
fn raw_patches(gray: &GrayImage32, places: &[(f64, f64)]) -> Result<Descriptors, Error> {
    let middle = (SAMPLES as f64 - 1.0) / 2.0;
    let mut values = Vec::with_capacity(places.len() * SAMPLES * SAMPLES);
    for (u, v) in places {
        for j in 0..SAMPLES {
            for i in 0..SAMPLES {
                let x = u + (i as f64 - middle) * SPACING_PX;
                let y = v + (j as f64 - middle) * SPACING_PX;
                values.push(sample_bilinear(gray, x, y, Border::Replicate));
            }
        }
    }
    Descriptors::from_floats(SAMPLES * SAMPLES, values)
}
