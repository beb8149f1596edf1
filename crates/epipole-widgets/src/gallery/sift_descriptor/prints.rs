//! A place of a photograph described in three ways, and the photograph changed around it.

use epipole::Error;
use epipole::feature::{
    Descriptors, Keypoint, SiftOptions, describe_patches, describe_sift, sift_directions,
};
use epipole::imaging::{Border, GrayImage32, gaussian_blur, sample_bilinear};
use serde::{Deserialize, Serialize};

/// Blur of the keypoint in the photograph as it was taken, pixels.
pub(super) const SIGMA_PX: f64 = 3.2;
/// Side of a raw patch, samples.
const SAMPLES: usize = 16;
/// Distance of its samples, pixels, so that it is as large as the descriptor's window.
const SPACING_PX: f64 = 12.0 * SIGMA_PX / SAMPLES as f64;
/// Side of the piece of the photograph that is changed, pixels; and its middle.
const PIECE_PX: u32 = 161;
pub(super) const MIDDLE: f64 = (PIECE_PX / 2) as f64;
/// What a descriptor of length 1 is multiplied by.
const UNIT: f64 = 512.0;

/// The same way for every photograph here.
fn options() -> SiftOptions {
    SiftOptions::default()
        .with_upsample(false)
        .with_max_orientations(1)
}

/// What is done to the photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Change {
    pub(super) turn_rad: f64,
    pub(super) zoom: f64,
    /// Added to each gray value, of 1.
    pub(super) brighter: f64,
    /// Multiplies differences from middle gray.
    pub(super) contrast: f64,
}

impl Change {
    pub(super) const NONE: Self = Self {
        turn_rad: 0.0,
        zoom: 1.0,
        brighter: 0.0,
        contrast: 1.0,
    };

    /// A piece of the changed photograph, around a place of the photograph as it was.
    ///
    /// # Errors
    /// As [`gaussian_blur`].
    pub(super) fn piece(
        &self,
        gray: &GrayImage32,
        place: (f64, f64),
    ) -> Result<GrayImage32, Error> {
        let (sin, cos) = (libm::sin(self.turn_rad), libm::cos(self.turn_rad));
        // Whoever makes a picture smaller has to blur it first.
        let blur_px = 0.5 * (1.0 / (self.zoom * self.zoom) - 1.0).max(0.0).sqrt();
        let smooth;
        let source = match blur_px > 0.1 {
            true => {
                smooth = gaussian_blur(gray, blur_px, Border::Replicate)?;
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

/// The ways to describe a place.
pub(super) const WAYS: [&str; 3] = ["raw patch", "normalized patch", "SIFT"];

/// A place, described in each way.
#[derive(Clone)]
pub(super) struct Prints {
    /// The direction that SIFT gave it.
    pub(super) angle_rad: f64,
    /// The blur that it was taken to have.
    pub(super) scale_px: f64,
    pub(super) lists: [Descriptors; 3],
}

impl Prints {
    /// Describes a place of a photograph.
    ///
    /// * `scale_px`: the blur that SIFT takes it to have; raw patches know nothing of it
    /// * `finds_direction`: whether SIFT turns its window to the strongest gradients
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
            let directions = sift_directions(gray, &keypoints, &options())?;
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
                describe_patches(gray, &keypoints, SAMPLES, SPACING_PX)?,
                describe_sift(gray, &keypoints, &options())?,
            ],
        })
    }

    /// The distances of a way, in its own unit: gray levels a sample, or for vectors of length 1.
    pub(super) fn in_units(way: usize, distance: f64) -> f64 {
        match way {
            0 => distance * 255.0 / SAMPLES as f64,
            1 => distance,
            _ => distance / UNIT,
        }
    }

    /// The SIFT histogram of the first place: rows of cells, columns, directions.
    pub(super) fn histogram(&self) -> Vec<f32> {
        self.lists[2].get(0).unwrap_or_default()
    }
}

/// The gray values around each place, as they are.
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
