//! Multi-band blending: coarse bands change gradually from photo to photo, fine ones abruptly.

use super::canvas::{Canvas, View};
use super::layer::{color, weight};
use super::level::Level;
use crate::Result;
use crate::imaging::{
    Border, GrayImage32, from_laplacian_pyramid, from_vec, laplacian_pyramid, pyramid_down,
};
use crate::progress::{Monitor, Stage, report};
use image::{Rgb, RgbImage};

/// Index for canvas positions without a photo.
const NONE: usize = usize::MAX;

/// Blends photos into one image; black where there is none.
///
/// * `gains`: gain of each view
/// * `num_bands`: number of frequency bands, 1 for hard seams
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Burt & Adelson 1983, "A multiresolution spline with application to image mosaics".
pub(super) fn blend_bands(
    canvas: &Canvas,
    views: &[View],
    photos: &[&RgbImage],
    gains: &[f32],
    num_bands: usize,
    monitor: &mut dyn Monitor,
) -> Result<RgbImage> {
    let (width, height) = (canvas.width(), canvas.height());
    let owner = owners(canvas, views, photos);
    let size = |level: usize| (width.div_ceil(1 << level), height.div_ceil(1 << level));
    let mut levels: Vec<Level> = (0..num_bands)
        .map(|level| Level::new(size(level).0, size(level).1))
        .collect();
    for (n, view) in views.iter().enumerate() {
        report(monitor, Stage::Blending, n as f32 / views.len() as f32)?;
        let area = Area::around(view, canvas, num_bands);
        let mut planes = [const { Vec::new() }; 3];
        let mut mask = Vec::with_capacity(area.width * area.height);
        for v in area.top..area.top + area.height {
            for u in area.left..area.left + area.width {
                // Coarse bands extend beyond the border of a photo, into the photo that is visible
                // there, if any.
                let size = photos[view.image].dimensions();
                let owner = owner[v * width + u];
                let shown = match owner == NONE || weight(canvas, view, size, u, v) > 0.0 {
                    true => n,
                    false => owner,
                };
                let from = &views[shown];
                let color = color(canvas, from, photos[from.image], u, v);
                for (plane, value) in planes.iter_mut().zip(color) {
                    plane.push(gains[shown] * value);
                }
                mask.push(f32::from(u8::from(owner == n)));
            }
        }
        let image = |values| from_vec(area.width as u32, area.height as u32, values);
        let bands = planes.map(|plane| laplacian_pyramid(&image(plane), num_bands));
        let mut mask = image(mask);
        for (k, level) in levels.iter_mut().enumerate() {
            // A small photo has fewer bands.
            if bands[0].len() <= k {
                break;
            }
            let colors = bands.each_ref().map(|bands| &bands[k]);
            level.add([area.left >> k, area.top >> k], colors, &mask);
            mask = pyramid_down(&mask, Border::Replicate);
        }
    }
    let mut pyramids: [Vec<GrayImage32>; 3] = [const { Vec::new() }; 3];
    for (k, level) in levels.into_iter().enumerate() {
        let (width, height) = size(k);
        for (pyramid, values) in pyramids.iter_mut().zip(level.means()) {
            pyramid.push(from_vec(width as u32, height as u32, values));
        }
    }
    let [red, green, blue] = pyramids.map(|pyramid| from_laplacian_pyramid(&pyramid));
    let value =
        |image: &GrayImage32, u, v| image.get_pixel(u, v).0[0].round().clamp(0.0, 255.0) as u8;
    Ok(RgbImage::from_fn(
        width as u32,
        height as u32,
        |u, v| match owner[v as usize * width + u as usize] {
            NONE => Rgb([0; 3]),
            _ => Rgb([value(&red, u, v), value(&green, u, v), value(&blue, u, v)]),
        },
    ))
}

/// Returns the view with the largest weight at each position.
fn owners(canvas: &Canvas, views: &[View], photos: &[&RgbImage]) -> Vec<usize> {
    let width = canvas.width();
    let mut owner = vec![NONE; width * canvas.height()];
    let mut most = vec![0.0; owner.len()];
    for (n, view) in views.iter().enumerate() {
        let size = photos[view.image].dimensions();
        for v in view.rows.clone() {
            for u in view.columns.clone() {
                let (place, weight) = (v * width + u, weight(canvas, view, size, u, v));
                if weight > most[place] {
                    (most[place], owner[place]) = (weight, n);
                }
            }
        }
    }
    owner
}

/// Returns the weighted mean of all photos at each position.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn feather(
    canvas: &Canvas,
    views: &[View],
    photos: &[&RgbImage],
    gains: &[f32],
    monitor: &mut dyn Monitor,
) -> Result<RgbImage> {
    let mut picture = RgbImage::new(canvas.width() as u32, canvas.height() as u32);
    for v in 0..canvas.height() {
        report(monitor, Stage::Blending, v as f32 / canvas.height() as f32)?;
        for u in 0..canvas.width() {
            let (mut sums, mut total) = ([0.0_f32; 3], 0.0);
            for (view, gain) in views.iter().zip(gains) {
                if !(view.columns.contains(&u) && view.rows.contains(&v)) {
                    continue;
                }
                let photo = photos[view.image];
                let weight = weight(canvas, view, photo.dimensions(), u, v);
                if weight > 0.0 {
                    let color = color(canvas, view, photo, u, v);
                    (0..3).for_each(|c| sums[c] += weight * gain * color[c]);
                    total += weight;
                }
            }
            if total > 0.0 {
                let value = sums.map(|sum| (sum / total).round().clamp(0.0, 255.0) as u8);
                picture.put_pixel(u as u32, v as u32, Rgb(value));
            }
        }
    }
    Ok(picture)
}

/// Region of the canvas, aligned so that all bands have a pixel at its corner.
struct Area {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl Area {
    fn around(view: &View, canvas: &Canvas, num_bands: usize) -> Self {
        // Two pixels of the coarsest band, the radius of its kernel.
        let unit = 1 << (num_bands - 1);
        let start = |first: usize| (first / unit).saturating_sub(2) * unit;
        let end = |last: usize, size: usize| (last.div_ceil(unit) * unit + 2 * unit).min(size);
        let (left, top) = (start(view.columns.start), start(view.rows.start));
        Self {
            left,
            top,
            width: end(view.columns.end, canvas.width()) - left,
            height: end(view.rows.end, canvas.height()) - top,
        }
    }
}
