//! Pictures of results: marks on photos.

use epipole::feature::Keypoint;
use image::{Rgb, RgbImage};

/// Colors that differ for every kind of color vision (Okabe & Ito 2008).
pub(crate) const HUES: [[u8; 3]; 6] = [
    [86, 180, 233],
    [230, 159, 0],
    [0, 158, 115],
    [240, 228, 66],
    [204, 121, 167],
    [213, 94, 0],
];

/// Encodes a picture as PNG.
///
/// # Errors
/// If the picture has no pixels.
pub(crate) fn png(picture: &RgbImage) -> Result<Vec<u8>, crate::failure::Failure> {
    let mut bytes = Vec::new();
    picture
        .write_to(
            &mut std::io::Cursor::new(&mut bytes),
            image::ImageFormat::Png,
        )
        .map_err(|error| crate::failure::Failure::new("write", error.to_string()))?;
    Ok(bytes)
}

/// Marks each keypoint with a circle of its size and a stroke in its direction.
pub(crate) fn keypoints(picture: &mut RgbImage, keypoints: &[Keypoint], offset_u: f64) {
    for (index, keypoint) in keypoints.iter().enumerate() {
        let radius = (3.0 * f64::from(keypoint.scale_px)).max(3.0);
        let (u, v) = (keypoint.u + offset_u, keypoint.v);
        let color = HUES[index % HUES.len()];
        let steps = (radius * 8.0).min(2000.0) as usize;
        for step in 0..steps {
            let angle = step as f64 * std::f64::consts::TAU / steps as f64;
            dot(
                picture,
                u + radius * libm::cos(angle),
                v + radius * libm::sin(angle),
                color,
            );
        }
        let angle = f64::from(keypoint.angle_rad);
        let end = (u + radius * libm::cos(angle), v + radius * libm::sin(angle));
        line(picture, (u, v), end, color);
    }
}

/// Joins two photos side by side.
pub(crate) fn side_by_side(left: &RgbImage, right: &RgbImage) -> RgbImage {
    let height = left.height().max(right.height());
    let mut both = RgbImage::new(left.width() + right.width(), height);
    image::imageops::replace(&mut both, left, 0, 0);
    image::imageops::replace(&mut both, right, i64::from(left.width()), 0);
    both
}

/// Draws a line one pixel wide.
pub(crate) fn line(picture: &mut RgbImage, from: (f64, f64), to: (f64, f64), color: [u8; 3]) {
    let length = (to.0 - from.0)
        .abs()
        .max((to.1 - from.1).abs())
        .ceil()
        .clamp(1.0, 1e5);
    for step in 0..=length as u32 {
        let fraction = f64::from(step) / length;
        let at = |a: f64, b: f64| a + fraction * (b - a);
        dot(picture, at(from.0, to.0), at(from.1, to.1), color);
    }
}

fn dot(picture: &mut RgbImage, u: f64, v: f64, color: [u8; 3]) {
    let (u, v) = (u.round(), v.round());
    if u >= 0.0 && v >= 0.0 && u < f64::from(picture.width()) && v < f64::from(picture.height()) {
        picture.put_pixel(u as u32, v as u32, Rgb(color));
    }
}

/// Returns the PNG chunk of the resolution.
///
/// Source: PNG specification (third edition), §11.3.4.3 pHYs.
pub(crate) fn png_resolution(dpi: f64) -> Vec<u8> {
    let per_meter = ((dpi / 0.0254).round() as u32).to_be_bytes();
    let mut chunk = b"pHYs".to_vec();
    chunk.extend(per_meter);
    chunk.extend(per_meter);
    chunk.push(1);
    let length = (chunk.len() as u32 - 4).to_be_bytes();
    let check = crc32(&chunk).to_be_bytes();
    [&length[..], &chunk, &check].concat()
}

/// Source: PNG specification (third edition), annex D.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| match crc & 1 {
            1 => 0xedb8_8320 ^ (crc >> 1),
            _ => crc >> 1,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_the_specification() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b"IEND"), 0xae42_6082);
    }
}
