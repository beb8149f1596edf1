//! A page as antialiased PNG.

use super::page::{Page, Text};
use crate::failure::Failure;
use crate::picture;
use epipole_widgets::canvas::{Canvas, Picture, TextStyle};
use epipole_widgets::theme::{Role, Theme};
use image::{GrayImage, Luma};
use std::io::Cursor;

/// Largest side, pixels: eight-bit gray of this size has 400 MB.
const LARGEST_PX: f64 = 20_000.0;
/// Samples of a pixel along each axis, at the rim of a disk.
const SAMPLES: u32 = 8;
/// Bytes of a PNG before the chunk that follows its header.
const HEADER: usize = 33;

/// Writes the page with its resolution.
///
/// # Errors
/// If it has too many pixels.
pub(super) fn png(page: &Page, dpi: f64) -> Result<Vec<u8>, Failure> {
    let scale = dpi / 25.4;
    let [width, height] = page.paper_mm.map(|side| (side * scale).round());
    if !(1.0..=LARGEST_PX).contains(&width.max(height)) {
        return Err(Failure::usage(format!(
            "a picture of {width} × {height} pixels is too large (at most {LARGEST_PX} along a side): take a lower --dpi, \
             or PDF"
        )));
    }
    let mut black = vec![0.0_f32; width as usize * height as usize];
    let mut add = |x: u32, y: u32, coverage: f64| {
        if f64::from(x) < width && f64::from(y) < height {
            black[y as usize * width as usize + x as usize] += coverage as f32;
        }
    };
    for [x, y, across, down] in &page.rectangles {
        let ends = |from: f64, length: f64| (from * scale, (from + length) * scale);
        let ((left, right), (top, bottom)) = (ends(*x, *across), ends(*y, *down));
        for v in top.floor() as u32..bottom.ceil() as u32 {
            for u in left.floor() as u32..right.ceil() as u32 {
                add(u, v, overlap(u, left, right) * overlap(v, top, bottom));
            }
        }
    }
    for disk in &page.disks {
        let [x, y, radius] = disk.map(|mm| mm * scale);
        for v in (y - radius).floor() as u32..(y + radius).ceil() as u32 {
            for u in (x - radius).floor() as u32..(x + radius).ceil() as u32 {
                add(u, v, ratio_in_disk(u, v, [x, y], radius));
            }
        }
    }
    let mut gray = GrayImage::from_fn(width as u32, height as u32, |u, v| {
        let coverage = black[v as usize * width as usize + u as usize].min(1.0);
        Luma([(255.0 * (1.0 - coverage)).round() as u8])
    });
    for text in &page.texts {
        draw_text(&mut gray, text, scale)?;
    }
    let mut bytes = Vec::new();
    gray.write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png)
        .map_err(|error| Failure::new("write", error.to_string()))?;
    let resolution = picture::png_resolution(dpi);
    bytes.splice(HEADER..HEADER, resolution);
    Ok(bytes)
}

/// Returns the length of a pixel's overlap with an interval.
fn overlap(pixel: u32, from: f64, to: f64) -> f64 {
    let first = f64::from(pixel);
    ((first + 1.0).min(to) - first.max(from)).max(0.0)
}

fn ratio_in_disk(u: u32, v: u32, [x, y]: [f64; 2], radius: f64) -> f64 {
    let at = |pixel: u32, k: u32| f64::from(pixel) + (f64::from(k) + 0.5) / f64::from(SAMPLES);
    let inside = (0..SAMPLES * SAMPLES)
        .filter(|k| {
            let (dx, dy) = (at(u, k % SAMPLES) - x, at(v, k / SAMPLES) - y);
            dx * dx + dy * dy <= radius * radius
        })
        .count();
    inside as f64 / f64::from(SAMPLES * SAMPLES)
}

/// Draws a line of text in a separate strip, and darkens the image by it.
fn draw_text(gray: &mut GrayImage, text: &Text, scale: f64) -> Result<(), Failure> {
    let size = text.size * scale;
    let width = (f64::from(gray.width()) - text.x * scale).max(1.0);
    let width = width.min(Canvas::MAX_SIDE);
    let height = (2.0 * size).ceil().clamp(1.0, Canvas::MAX_SIDE);
    let baseline = 1.4 * size;
    let mut canvas = Canvas::new(width, height, 1.0, Theme::Light, Picture::default())
        .map_err(|error| Failure::new("too-large", error.to_string()))?;
    canvas.text((0.0, baseline), &text.text, TextStyle::new(Role::Ink, size));
    let strip = canvas.finish();
    let (left, top) = (
        (text.x * scale) as u32,
        (text.y * scale - baseline).max(0.0) as u32,
    );
    let [ground, ink] =
        [Role::Background, Role::Ink].map(|role| f64::from(Theme::Light.color(role)[1]));
    for (index, pixel) in strip.rgba().chunks_exact(4).enumerate() {
        let (u, v) = (index as u32 % strip.width(), index as u32 / strip.width());
        if let Some(value) = gray.get_pixel_mut_checked(left + u, top + v) {
            let white = (f64::from(pixel[1]) - ink) / (ground - ink);
            value.0[0] = value.0[0].min((255.0 * white).round() as u8);
        }
    }
    Ok(())
}
