//! Three descriptors of a position in a photograph, and changes of the photograph around it.

use epipole::Error;
use epipole::feature::{
    Descriptors, Keypoint, SiftOptions, describe_patches, describe_sift, sift_directions,
};
use epipole::imaging::{Border, GrayImage32, gaussian_blur, sample_bilinear};
use serde::{Deserialize, Serialize};

/// Scale σ of the keypoint in the original photograph, pixels.
pub(super) const SIGMA_PX: f64 = 3.2;
/// Side of a raw patch, samples.
const SAMPLES: usize = 16;
/// Spacing of its samples, pixels, so that it covers the descriptor's window.
const SPACING_PX: f64 = 12.0 * SIGMA_PX / SAMPLES as f64;
/// Side of the changed piece of the photograph, pixels; and its middle.
const PIECE_PX: u32 = 161;
pub(super) const MIDDLE: f64 = (PIECE_PX / 2) as f64;
/// Norm of a byte descriptor.
const UNIT: f64 = 512.0;

/// Returns the SIFT options of all photographs here.
fn options() -> SiftOptions {
    SiftOptions::default()
        .with_upsample(false)
        .with_max_orientations(1)
}

/// A change of the photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Change {
    pub(super) turn_rad: f64,
    pub(super) zoom: f64,
    /// Offset of gray values in [0, 1].
    pub(super) brighter: f64,
    /// Factor on differences from middle gray.
    pub(super) contrast: f64,
}

impl Change {
    pub(super) const NONE: Self = Self {
        turn_rad: 0.0,
        zoom: 1.0,
        brighter: 0.0,
        contrast: 1.0,
    };

    /// Returns a piece of the changed photograph around a position in the original.
    ///
    /// # Errors
    /// As [`gaussian_blur`].
    pub(super) fn piece(
        &self,
        gray: &GrayImage32,
        place: (f64, f64),
    ) -> Result<GrayImage32, Error> {
        let (sin, cos) = (libm::sin(self.turn_rad), libm::cos(self.turn_rad));
        // Downscaling needs a blur first, against aliasing.
        let blur_px = 0.5 * (1.0 / (self.zoom * self.zoom) - 1.0).max(0.0).sqrt();
        let smooth;
        let source = match blur_px > 0.1 {
            true => {
                smooth = gaussian_blur(gray, blur_px, Border::Replicate, &mut ())?;
                &smooth
            }
            false => gray,
        };
        Ok(GrayImage32::from_fn(PIECE_PX, PIECE_PX, |i, j| {
            let (x, y) = (f64::from(i) - MIDDLE, f64::from(j) - MIDDLE);
            let u = place.0 + (x * cos + y * sin) / self.zoom;
            let v = place.1 + (y * cos - x * sin) / self.zoom;
            let value = f64::from(sample_bilinear(source, u, v, Border::Replicate));
            let lit = (value - 0.5) * self.contrast + 0.5 + self.brighter;
            image::Luma([lit.clamp(0.0, 1.0) as f32])
        }))
    }
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

    /// Converts a descriptor's distance to its own unit: gray levels per sample, or for vectors of
    /// norm 1.
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
