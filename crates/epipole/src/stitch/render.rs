//! Rendering of panoramas.

use super::blend::{blend_bands, feather};
use super::canvas::Canvas;
use super::gains::gains;
use super::panorama::Panorama;
use super::surface::Surface;
use crate::progress::Monitor;
use crate::{Error, Result};
use derive_setters::Setters;
use image::RgbImage;

/// Maximum number of bands of multi-band blending.
const MAX_BANDS: usize = 6;
/// Width of the widest transition, relative to the image's side: that of OpenCV's stitcher.
const TRANSITION: f64 = 0.05;

/// Blending of photos where they overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Blend {
    /// Up to six bands of a Laplacian pyramid: no seams, and no ghosting.
    #[default]
    Bands,
    /// Weighted means by the distance to the border of a photo: ghosting where photos do not fit.
    Feather,
    /// Hard seams.
    Seams,
}

/// Options of [`render_panorama`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct RenderOptions {
    /// Projection surface. A cylinder.
    pub surface: Surface,
    /// Blending. Bands.
    pub blend: Blend,
    /// Whether to compensate exposure. True.
    pub gains: bool,
    /// Maximum number of pixels; larger results are downscaled. 100 million.
    pub max_pixels: u64,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            surface: Surface::default(),
            blend: Blend::default(),
            gains: true,
            max_pixels: 100_000_000,
        }
    }
}

/// Renders all photos of a panorama on a surface; black where there is none.
///
/// * `photos`: photos in the order of the panorama
/// * `monitor`: the only stage is [`Stage::Blending`](crate::progress::Stage::Blending)
///
/// # Errors
/// [`Error::SizeMismatch`] for another number of photos, [`Error::Degenerate`] if photos extend
/// beyond the surface, [`Error::Canceled`].
///
/// Source: Brown & Lowe 2007, §6 and 7.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::Intrinsics;
/// use epipole::image::{Rgb, RgbImage};
/// use epipole::nalgebra::{Matrix3, Rotation3, Vector3};
/// use epipole::stitch::{Panorama, RenderOptions, render_panorama};
/// // A photo of 64° to the left of another one by 0.6.
/// let k = Intrinsics::centered(80.0, 101, 61)?;
/// let matrices = [0.0, 0.6].map(|yaw| Rotation3::from_scaled_axis(Vector3::y() * -yaw).into_inner());
/// let panorama = Panorama {
///     pixel_from_direction: matrices.iter().map(|rotation| Some(k.matrix() * rotation)).collect(),
///     rotations: matrices.iter().copied().map(Some).collect(),
///     scale_px: 80.0,
///     focal_factor: None,
/// };
/// let photo = RgbImage::from_pixel(101, 61, Rgb([100, 150, 200]));
/// let picture = render_panorama(&panorama, &[&photo, &photo], &RenderOptions::default(), &mut ())?;
/// assert_eq!(picture.dimensions(), (138, 61)); // 80 (2 atan(50/80) + 0.6), and 1
/// assert_eq!(picture.get_pixel(69, 30), &Rgb([100, 150, 200]));
/// # Ok(()) }
/// ```
pub fn render_panorama(
    panorama: &Panorama,
    photos: &[&RgbImage],
    options: &RenderOptions,
    monitor: &mut dyn Monitor,
) -> Result<RgbImage> {
    let (first, second) = (panorama.pixel_from_direction.len(), photos.len());
    if first != second {
        return Err(Error::SizeMismatch {
            what: "the photos of a panorama and the list of their images",
            first,
            second,
        });
    }
    let sizes: Vec<(u32, u32)> = photos.iter().map(|photo| photo.dimensions()).collect();
    let (canvas, views) = Canvas::new(panorama, &sizes, options.surface, options.max_pixels)?;
    let gains = match options.gains {
        true => gains(&canvas, &views, photos),
        false => vec![1.0; views.len()],
    };
    match options.blend {
        Blend::Bands => {
            let num_bands = num_bands(canvas.width() * canvas.height());
            blend_bands(&canvas, &views, photos, &gains, num_bands, monitor)
        }
        Blend::Seams => blend_bands(&canvas, &views, photos, &gains, 1, monitor),
        Blend::Feather => feather(&canvas, &views, photos, &gains, monitor),
    }
}

/// Returns the number of bands for an image of this many pixels, from 2 upwards.
fn num_bands(num_pixels: usize) -> usize {
    let transition_px = TRANSITION * (num_pixels as f64).sqrt();
    let count = libm::log2(transition_px.max(1.0)).ceil() as usize;
    count.saturating_sub(1).clamp(2, MAX_BANDS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Intrinsics;
    use image::Rgb;
    use nalgebra::{Matrix3, Rotation3, Vector3};

    /// Color of a direction: smooth, and different everywhere.
    fn truth(d: &Vector3<f64>) -> [f64; 3] {
        let d = d.normalize();
        [d.x, d.y, d.z].map(|x| 128.0 + 90.0 * libm::sin(9.0 * x + 2.0 * d.y))
    }

    fn photo(matrix: &Matrix3<f64>, gain: f64) -> RgbImage {
        let inverse = matrix.try_inverse().unwrap();
        RgbImage::from_fn(200, 150, |u, v| {
            let color = truth(&(inverse * Vector3::new(f64::from(u), f64::from(v), 1.0)));
            Rgb(color.map(|value| (gain * value).round() as u8))
        })
    }

    fn panorama() -> Panorama {
        let k = Intrinsics::centered(180.0, 200, 150).unwrap();
        let rotation = |yaw: f64, pitch: f64| {
            let matrices = [Vector3::x() * pitch, Vector3::y() * -yaw];
            let [x, y] = matrices.map(Rotation3::from_scaled_axis);
            (x * y).into_inner()
        };
        let matrices = [
            rotation(-0.45, 0.0),
            rotation(0.0, 0.1),
            rotation(0.4, -0.05),
        ];
        Panorama {
            pixel_from_direction: matrices
                .iter()
                .map(|rotation| Some(k.matrix() * rotation))
                .collect(),
            rotations: matrices.iter().copied().map(Some).collect(),
            scale_px: 180.0,
            focal_factor: None,
        }
    }

    /// Maximum error of an image where there is a photo, of 255.
    fn off(panorama: &Panorama, picture: &RgbImage, surface: Surface) -> f64 {
        let sizes = [(200, 150); 3];
        let (canvas, _) = Canvas::new(panorama, &sizes, surface, 1 << 30).unwrap();
        assert_eq!(picture.width() as usize, canvas.width());
        let mut worst: f64 = 0.0;
        let mut num_covered = 0;
        for (u, v, pixel) in picture.enumerate_pixels() {
            if pixel.0 == [0; 3] {
                continue;
            }
            num_covered += 1;
            let truth = truth(&canvas.direction(u as usize, v as usize));
            for (value, truth) in pixel.0.iter().zip(truth) {
                worst = worst.max((f64::from(*value) - truth).abs());
            }
        }
        assert!(num_covered * 5 > picture.width() * picture.height() * 3);
        worst
    }

    #[test]
    fn blended_photos_are_as_the_world_on_every_surface() {
        let panorama = panorama();
        let photos: Vec<_> = (panorama.pixel_from_direction.iter())
            .map(|matrix| photo(&matrix.unwrap(), 1.0))
            .collect();
        let photos: Vec<_> = photos.iter().collect();
        for surface in [Surface::Plane, Surface::Cylinder, Surface::Sphere] {
            for blend in [Blend::Bands, Blend::Feather, Blend::Seams] {
                let options = RenderOptions::default()
                    .with_surface(surface)
                    .with_blend(blend);
                let picture = render_panorama(&panorama, &photos, &options, &mut ()).unwrap();
                let off = off(&panorama, &picture, surface);
                assert!(off < 4.0, "{surface:?} {blend:?}: {off}");
            }
        }
    }

    #[test]
    fn exposures_are_made_alike() {
        let panorama = panorama();
        let gains = [0.9, 1.0, 1.1];
        let photos: Vec<_> = (panorama.pixel_from_direction.iter().zip(gains))
            .map(|(matrix, gain)| photo(&matrix.unwrap(), gain))
            .collect();
        let photos: Vec<_> = photos.iter().collect();
        let off_with = |gains: bool| {
            let options = RenderOptions::default()
                .with_gains(gains)
                .with_blend(Blend::Seams);
            let picture = render_panorama(&panorama, &photos, &options, &mut ()).unwrap();
            off(&panorama, &picture, Surface::Cylinder)
        };
        let (alike, as_they_are) = (off_with(true), off_with(false));
        assert!(as_they_are > 18.0 && alike < 8.0, "{as_they_are} {alike}");
    }

    #[test]
    fn a_full_circle_closes_and_a_plane_has_an_end() {
        let k = Intrinsics::centered(100.0, 201, 101).unwrap();
        let matrices: Vec<Matrix3<f64>> = (0..6)
            .map(|n| Rotation3::from_scaled_axis(Vector3::y() * f64::from(n) * 1.05).into_inner())
            .collect();
        let panorama = Panorama {
            pixel_from_direction: matrices
                .iter()
                .map(|rotation| Some(k.matrix() * rotation))
                .collect(),
            rotations: matrices.iter().copied().map(Some).collect(),
            scale_px: 100.0,
            focal_factor: None,
        };
        let photo = RgbImage::from_pixel(201, 101, Rgb([90, 90, 90]));
        let photos = vec![&photo; 6];
        let options = RenderOptions::default();
        let picture = render_panorama(&panorama, &photos, &options, &mut ()).unwrap();
        assert_eq!(picture.width(), 629); // 2π 100
        assert!((0..629).all(|u| picture.get_pixel(u, 50).0 == [90; 3]));
        let plane = options.with_surface(Surface::Plane);
        assert!(render_panorama(&panorama, &photos, &plane, &mut ()).is_err());
    }
}
