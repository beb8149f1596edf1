//! Photographs with EXIF data on orientation and position.

use epipole::math::Geodetic;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use std::path::Path;

const SHORT: u16 = 3;
const LONG: u16 = 4;
const RATIONAL: u16 = 5;

/// The beginning of a block of little-endian numbers with its first directory, of one entry that is
/// a number.
fn block(tag: u16, kind: u16, value: u32) -> Vec<u8> {
    let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
    directory(&mut data, &[(tag, kind, 1, value)]);
    data
}

/// A directory: tag, kind, count and value of each entry.
fn directory(data: &mut Vec<u8>, entries: &[(u16, u16, u32, u32)]) {
    data.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        data.extend(tag.to_le_bytes());
        data.extend(kind.to_le_bytes());
        data.extend(count.to_le_bytes());
        data.extend(value.to_le_bytes());
    }
    data.extend([0; 4]);
}

/// EXIF block with an orientation, 1 to 8.
pub(crate) fn orientation(orientation: u16) -> Vec<u8> {
    block(0x0112, SHORT, u32::from(orientation))
}

/// A place, its minutes in ten-millionths.
pub(crate) fn place(place: &Geodetic) -> Vec<u8> {
    let start = 8 + 2 + 12 + 4;
    let mut data = block(0x8825, LONG, start);
    let first = start + 2 + 6 * 12 + 4;
    let letter =
        |plus: u8, minus: u8, value: f64| u32::from(if value < 0.0 { minus } else { plus });
    directory(
        &mut data,
        &[
            (1, 2, 2, letter(b'N', b'S', place.latitude_deg)),
            (2, RATIONAL, 3, first),
            (3, 2, 2, letter(b'E', b'W', place.longitude_deg)),
            (4, RATIONAL, 3, first + 24),
            (5, 1, 1, 0),
            (6, RATIONAL, 1, first + 48),
        ],
    );
    let mut ratio = |value: f64, unit: u32| {
        data.extend(((value * f64::from(unit)).round() as u32).to_le_bytes());
        data.extend(unit.to_le_bytes());
    };
    for degrees in [place.latitude_deg.abs(), place.longitude_deg.abs()] {
        ratio(degrees.floor(), 1);
        ratio(degrees.fract() * 60.0, 10_000_000);
        ratio(0.0, 1);
    }
    ratio(place.height_m, 1000);
    data
}

/// EXIF block with a focal length in millimeters, and no more.
pub(crate) fn millimeters(mm: u32) -> Vec<u8> {
    let start = 8 + 2 + 12 + 4;
    let mut data = block(0x8769, LONG, start);
    directory(&mut data, &[(0x920A, RATIONAL, 1, start + 2 + 12 + 4)]);
    for number in [mm, 1] {
        data.extend(number.to_le_bytes());
    }
    data
}

/// Writes a PNG file with EXIF data.
pub(crate) fn write_png(file: &Path, image: &RgbImage, exif: Vec<u8>) {
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    encoder.set_exif_metadata(exif).unwrap();
    let (width, height) = image.dimensions();
    encoder
        .write_image(image.as_raw(), width, height, ExtendedColorType::Rgb8)
        .unwrap();
    std::fs::write(file, bytes).unwrap();
}
