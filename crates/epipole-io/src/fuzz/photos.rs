//! PNG, JPEG and WebP with the EXIF data in them, TIFF, BMP and PNM.

use crate::Error;
use crate::damage::{config, damage_bytes, some_damage};
use crate::photo::{DecodeOptions, decode_gray, decode_rgb, sensor_size};
use image::codecs::{jpeg::JpegEncoder, png::PngEncoder, webp::WebPEncoder};
use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, RgbImage};
use proptest::prelude::*;
use std::io::Cursor;
use std::sync::LazyLock;
use tiff::encoder::{Compression, Predictor, TiffEncoder, colortype};

const WIDTH: u32 = 13;
const HEIGHT: u32 = 9;

/// Returns EXIF data with a rotation by 90°, a 35 mm equivalent focal length and one in
/// millimeters.
fn exif() -> Vec<u8> {
    let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
    let entry = |data: &mut Vec<u8>, tag: u16, kind: u16, value: u32| {
        data.extend(tag.to_le_bytes());
        data.extend(kind.to_le_bytes());
        data.extend(1_u32.to_le_bytes());
        data.extend(value.to_le_bytes());
    };
    data.extend(2_u16.to_le_bytes());
    entry(&mut data, 0x0112, 3, 6);
    entry(&mut data, 0x8769, 4, 38);
    data.extend(0_u32.to_le_bytes());
    data.extend(4_u16.to_le_bytes());
    entry(&mut data, 0x920A, 5, 92);
    entry(&mut data, 0xA20E, 5, 100);
    entry(&mut data, 0xA210, 3, 3);
    entry(&mut data, 0xA405, 3, 28);
    data.extend(0_u32.to_le_bytes());
    for (numerator, denominator) in [(50_u32, 10_u32), (1000, 1)] {
        data.extend(numerator.to_le_bytes());
        data.extend(denominator.to_le_bytes());
    }
    data
}

fn pixels() -> Vec<u8> {
    let values = (0..WIDTH * HEIGHT * 3).map(|i| (i * 37 % 251) as u8);
    values.collect()
}

/// Encodes an image in one of the formats, with EXIF data.
fn encode(format: usize, exif: Vec<u8>) -> Vec<u8> {
    let pixels = pixels();
    let mut bytes = Vec::new();
    let size = (WIDTH, HEIGHT, ExtendedColorType::Rgb8);
    match format {
        0 => write(PngEncoder::new(&mut bytes), &pixels, size, exif),
        1 => write(JpegEncoder::new(&mut bytes), &pixels, size, exif),
        _ => write(WebPEncoder::new_lossless(&mut bytes), &pixels, size, exif),
    }
    bytes
}

fn write(
    mut encoder: impl ImageEncoder,
    pixels: &[u8],
    (width, height, color): (u32, u32, ExtendedColorType),
    exif: Vec<u8>,
) {
    encoder.set_exif_metadata(exif).unwrap();
    encoder.write_image(pixels, width, height, color).unwrap();
}

static RIGHT: LazyLock<[Vec<u8>; 3]> =
    LazyLock::new(|| std::array::from_fn(|format| encode(format, exif())));

/// A BMP file, and a PNM file of 16 bits.
static UNCOMPRESSED: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let image = RgbImage::from_raw(WIDTH, HEIGHT, pixels()).unwrap();
    let image = DynamicImage::from(image);
    let deep = DynamicImage::from(image.to_rgb16());
    [(image, ImageFormat::Bmp), (deep, ImageFormat::Pnm)].map(|(image, format)| {
        let mut file = Cursor::new(Vec::new());
        image.write_to(&mut file, format).unwrap();
        file.into_inner()
    })
});

/// TIFF files of bytes, words and floats, in all compressions of the encoder.
static TIFF: LazyLock<[Vec<u8>; 3]> = LazyLock::new(|| {
    let compressions = [
        Compression::Packbits,
        Compression::Lzw,
        Compression::Deflate(Default::default()),
    ];
    let mut files = compressions.map(|compression| (Cursor::new(Vec::new()), compression));
    let (words, floats): (Vec<u16>, Vec<f32>) = pixels()
        .into_iter()
        .map(|v| (u16::from(v) * 9, f32::from(v) / 7.0))
        .unzip();
    for (depth, (file, compression)) in files.iter_mut().enumerate() {
        let encoder = TiffEncoder::new(file)
            .unwrap()
            .with_compression(*compression);
        let mut encoder = encoder.with_predictor(match depth {
            1 => Predictor::Horizontal,
            _ => Predictor::None,
        });
        match depth {
            0 => encoder.write_image::<colortype::RGB8>(WIDTH, HEIGHT, &pixels()),
            1 => encoder.write_image::<colortype::RGB16>(WIDTH, HEIGHT, &words),
            _ => encoder.write_image::<colortype::RGB32Float>(WIDTH, HEIGHT, &floats),
        }
        .unwrap();
    }
    files.map(|(file, _)| file.into_inner())
});

static OPTIONS: LazyLock<DecodeOptions> =
    LazyLock::new(|| DecodeOptions::default().with_max_pixels(20_000));

/// Checks that a result is consistent, or that the error is one of the two of decoding.
fn check(bytes: &[u8]) -> Result<(), TestCaseError> {
    match decode_gray(bytes, &OPTIONS) {
        Ok(decoded) => {
            let image = decoded.image;
            let count = u64::from(image.width()) * u64::from(image.height());
            prop_assert!(count <= OPTIONS.max_pixels && count as usize == image.as_raw().len());
            prop_assert!(image.as_raw().iter().all(|gray| (0.0..=1.0).contains(gray)));
            prop_assert!(decoded.focal_px.is_none_or(|f| f > 0.0 && f.is_finite()));
            let color = decode_rgb(bytes, &OPTIONS).unwrap();
            prop_assert_eq!(color.image.dimensions(), image.dimensions());
            prop_assert_eq!(color.focal_px, decoded.focal_px);
            let (width, height) = sensor_size(bytes).unwrap();
            let sides = [image.dimensions(), (image.height(), image.width())];
            prop_assert!(sides.contains(&(width, height)));
        }
        Err(error) => {
            let is_expected = matches!(error, Error::BadImage { .. } | Error::TooManyPixels { .. });
            prop_assert!(is_expected, "{}", error);
        }
    }
    Ok(())
}

#[test]
fn the_pictures_to_damage_are_right() {
    for bytes in RIGHT.iter() {
        let decoded = decode_gray(bytes, &OPTIONS).unwrap();
        // The images are rotated upright, and have a focal length.
        assert_eq!(decoded.image.dimensions(), (HEIGHT, WIDTH));
        assert!(decoded.focal_px.is_some());
    }
    for bytes in UNCOMPRESSED.iter().chain(TIFF.iter()) {
        let decoded = decode_gray(bytes, &OPTIONS).unwrap();
        assert_eq!(decoded.image.dimensions(), (WIDTH, HEIGHT));
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn png(changes in some_damage()) {
        check(&damage_bytes(&RIGHT[0], &changes))?;
    }

    #[test]
    fn jpeg(changes in some_damage()) {
        check(&damage_bytes(&RIGHT[1], &changes))?;
    }

    #[test]
    fn webp(changes in some_damage()) {
        check(&damage_bytes(&RIGHT[2], &changes))?;
    }

    #[test]
    fn bmp_and_pnm(format in 0..2_usize, changes in some_damage()) {
        check(&damage_bytes(&UNCOMPRESSED[format], &changes))?;
    }

    #[test]
    fn tiff(depth in 0..3_usize, changes in some_damage()) {
        check(&damage_bytes(&TIFF[depth], &changes))?;
    }

    /// The checksum of the file is valid, so that the damage reaches the EXIF reader.
    #[test]
    fn exif_data(format in 0..3_usize, changes in some_damage()) {
        let damaged = damage_bytes(&exif(), &changes);
        check(&encode(format, damaged))?;
    }
}
