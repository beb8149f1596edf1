//! Tests with files of all formats, generated here or by other programs.

use super::decode::{MAX_METADATA_BYTES, limits};
use super::*;
use crate::{Error, shared};
use image::codecs::png::PngEncoder;
use image::metadata::Orientation;
use image::{
    DynamicImage, GrayImage, ImageDecoder, ImageEncoder, ImageFormat, ImageReader, Limits, Luma,
};
use std::io::Cursor;

fn png(image: &DynamicImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    image
        .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
        .unwrap();
    bytes
}

fn sample() -> GrayImage {
    GrayImage::from_fn(40, 30, |u, v| Luma([((u * 7 + v * 13) % 256) as u8]))
}

/// Returns a TIFF structure with an orientation and a 35 mm equivalent focal length.
fn exif(orientation: u16, focal_35mm: u16) -> Vec<u8> {
    let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
    data.extend(2u16.to_le_bytes());
    for (tag, kind, value) in [(0x0112u16, 3u16, u32::from(orientation)), (0x8769, 4, 38)] {
        data.extend(tag.to_le_bytes());
        data.extend(kind.to_le_bytes());
        data.extend(1u32.to_le_bytes());
        data.extend(value.to_le_bytes());
    }
    data.extend(0u32.to_le_bytes());
    assert_eq!(data.len(), 38);
    data.extend(1u16.to_le_bytes());
    data.extend(0xA405u16.to_le_bytes());
    data.extend(3u16.to_le_bytes());
    data.extend(1u32.to_le_bytes());
    data.extend(u32::from(focal_35mm).to_le_bytes());
    data.extend(0u32.to_le_bytes());
    data
}

#[test]
fn metadata_beyond_the_limit_are_an_error() {
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    let stored = vec![0; MAX_METADATA_BYTES as usize + 1];
    encoder.set_exif_metadata(stored).unwrap();
    let kind = image::ExtendedColorType::L8;
    encoder.write_image(&sample(), 40, 30, kind).unwrap();
    let Err(Error::BadImage { why }) = decode_gray(&bytes, &DecodeOptions::default()) else {
        panic!("the data fit");
    };
    assert!(why.contains("beside them"), "{why}");
}

#[test]
fn a_color_profile_beyond_the_limit_is_ignored() {
    let image = sample();
    let profile = vec![0; 2 * MAX_METADATA_BYTES as usize];
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    encoder.set_icc_profile(profile).unwrap();
    let kind = image::ExtendedColorType::L8;
    encoder.write_image(&image, 40, 30, kind).unwrap();
    assert!(bytes.len() < MAX_METADATA_BYTES as usize / 100);
    let has_profile = |limits| {
        let reader = ImageReader::new(Cursor::new(&bytes)).with_guessed_format();
        let mut reader = reader.unwrap();
        reader.limits(limits);
        let mut decoder = reader.into_decoder().unwrap();
        decoder.icc_profile().unwrap().is_some()
    };
    assert!(has_profile(Limits::no_limits()));
    assert!(!has_profile(limits()));
    let decoded = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
    assert_eq!(decoded.image.dimensions(), (40, 30));
}

#[test]
fn a_gray_png_comes_back_exactly() {
    let image = sample();
    let decoded = decode_gray(
        &png(&DynamicImage::ImageLuma8(image.clone())),
        &DecodeOptions::default(),
    )
    .unwrap();
    assert_eq!(epipole::imaging::gray_to_u8(&decoded.image), image);
    assert_eq!(decoded.focal_px, None);
}

#[test]
fn sixteen_bits_are_preserved() {
    let deep = image::ImageBuffer::from_fn(5, 4, |u, v| Luma([(u * 1000 + v * 77) as u16]));
    let bytes = png(&DynamicImage::ImageLuma16(deep));
    let options = DecodeOptions::default().with_range(PixelRange::Full);
    let decoded = decode_gray(&bytes, &options).unwrap();
    let value = decoded.image.get_pixel(3, 2).0[0];
    assert!((value - 3154.0 / 65535.0).abs() < 1e-7);
    assert_eq!(decoded.range, None);
}

#[test]
fn orientation_and_focal_length_are_read() {
    let image = sample();
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    // Orientation 6: the camera was rotated; a clockwise quarter turn makes it upright.
    encoder.set_exif_metadata(exif(6, 28)).unwrap();
    encoder
        .write_image(image.as_raw(), 40, 30, image::ExtendedColorType::L8)
        .unwrap();
    let decoded = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
    assert_eq!(decoded.image.dimensions(), (30, 40));
    // The stored top-left pixel is at the top right.
    let stored = f32::from(image.get_pixel(0, 0).0[0]) / 255.0;
    assert_eq!(decoded.image.get_pixel(29, 0).0[0], stored);
    // The diagonal is 50 pixels, equivalent to 43.2666 mm of film.
    let focal_px = decoded.focal_px.unwrap();
    assert!(
        (focal_px - 28.0 * 50.0 / 1872f64.sqrt()).abs() < 1e-9,
        "{focal_px}"
    );
    let options = DecodeOptions {
        apply_orientation: false,
        ..DecodeOptions::default()
    };
    let stored = decode_rgb(&bytes, &options).unwrap();
    assert_eq!(stored.image.dimensions(), (40, 30));
    assert_eq!(stored.orientation, Orientation::Rotate90);
}

#[test]
fn truncated_and_corrupt_files_are_errors() {
    let mut formats = vec![png(&DynamicImage::ImageLuma8(sample()))];
    for (format, image) in [
        (ImageFormat::Jpeg, DynamicImage::ImageLuma8(sample())),
        (
            ImageFormat::WebP,
            DynamicImage::ImageLuma8(sample()).to_rgb8().into(),
        ),
    ] {
        let mut bytes = Vec::new();
        image
            .write_to(&mut Cursor::new(&mut bytes), format)
            .unwrap();
        formats.push(bytes);
    }
    for bytes in formats {
        let options = DecodeOptions::default();
        assert!(decode_gray(&bytes, &options).is_ok());
        for keep in [
            0,
            1,
            7,
            20,
            bytes.len() / 3,
            bytes.len() / 2,
            bytes.len() * 9 / 10,
        ] {
            let result = decode_gray(&bytes[..keep], &options);
            assert!(
                matches!(result, Err(Error::BadImage { .. })),
                "{keep}: {result:?}"
            );
        }
        // A flipped byte may decode to another image, but never panics.
        for k in 0..bytes.len() {
            let mut corrupt = bytes.clone();
            corrupt[k] ^= 0x55;
            let _ = decode_gray(&corrupt, &options);
        }
    }
}

#[test]
fn the_limit_is_checked_before_decoding_and_can_be_raised() {
    let bytes = png(&DynamicImage::ImageLuma8(sample()));
    let mut options = DecodeOptions {
        max_pixels: 1199,
        ..DecodeOptions::default()
    };
    assert_eq!(
        decode_gray(&bytes, &options),
        Err(Error::TooManyPixels {
            got: 1200,
            limit: 1199
        })
    );
    options.max_pixels = 1200;
    assert!(decode_gray(&bytes, &options).is_ok());
}

#[test]
fn a_photo_from_the_data_folder() {
    let Some(path) = shared::data("multiview/fountain_p11/0000.jpg") else {
        return;
    };
    let bytes = std::fs::read(path).unwrap();
    let gray = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
    assert_eq!(gray.image.dimensions(), (768, 512));
    assert!(gray.image.as_raw().iter().all(|value| value.is_finite()));
}

/// Files of 5 × 3 pixels as OpenCV writes them by `libtiff`: 7 u + 13 v + 29 c of color c (blue,
/// green, red), times 100 in 16 bits, halved in floats.
mod written_by_opencv {
    pub(super) const GRAY_8: &str = "49492a001800000000070e151c0d141b22291a21282f36000b0000010300010000000500000001010300010000\
        000300000002010300010000000800000003010300010000000100000006010300010000000100000011010400010000000800000015010300\
        010000000100000016010300010000000300000017010400010000000f0000001c010300010000000100000053010300010000000100000000\
        000000";
    /// LZW with the horizontal predictor.
    pub(super) const GRAY_16: &str = "49492a001e0000008000000bc014120c020a0160f071402a1705014040000c00000103000100000005000000\
        010103000100000003000000020103000100000010000000030103000100000005000000060103000100000001000000110104000100000008\
        0000001501030001000000010000001601030001000000030000001701040001000000150000001c01030001000000010000003d0103000100\
        00000200000053010300010000000100000000000000";
    /// Deflate with the predictor for floats.
    pub(super) const GRAY_F32: &str = "49492a0034000000789c6370606064d89fd0e061b18001061c1881447f8085814c0c5ccc1144f09bc8c8c868\
        c0c500f20b0601000c000001030001000000050000000101030001000000030000000201030001000000200000000301030001000000080000\
        000601030001000000010000001101040001000000080000001501030001000000010000001601030001000000030000001701040001000000\
        2b0000001c01030001000000010000003d010300010000000300000053010300010000000300000000000000";
    /// PackBits.
    pub(super) const RGB_8: &str = "49492a00380000000e3a1d00412407482b0e4f321556391c0e472a0d4e311455381b5c3f226346290e54371a5b\
        3e21624528694c2f7053360b000001030001000000050000000101030001000000030000000201030003000000c20000000301030001000000\
        058000000601030001000000020000001101040001000000080000001501030001000000030000001601030001000000030000001701040001\
        000000300000001c01030001000000010000005301030003000000c800000000000000080008000800010001000100";
    /// Deflate.
    pub(super) const RGB_16: &str = "49492a002a000000789c5b2116c2cdc0b087090794ce101061c5257b41a14654830b972c0064451ef1000c0000\
        01030001000000050000000101030001000000030000000201030003000000c000000003010300010000000800000006010300010000000200\
        00001101040001000000080000001501030001000000030000001601030001000000030000001701040001000000210000001c010300010000\
        00010000003d01030001000000020000005301030003000000c600000000000000100010001000010001000100";
    pub(super) const BMP: &str = "424d6600000000000000360000002800000005000000030000000100180000000000000000000000000000000000\
        00000000000000001a3754213e5b2845622f4c69365370000d2a4714314e1b3855223f5c29466300001d3a0724410e2b4815324f1c395600";
    pub(super) const PGM_16: &str =
        "50350a3520330a36353533350a000002bc057808340af0051407d00a8c0d4810040a280ce40fa0125c1518";
    pub(super) const ALL: [&str; 7] = [GRAY_8, GRAY_16, GRAY_F32, RGB_8, RGB_16, BMP, PGM_16];
}

fn from_hex(hex: &str) -> Vec<u8> {
    let digit = |k: usize| u8::from_str_radix(&hex[k..k + 2], 16).unwrap();
    (0..hex.len()).step_by(2).map(digit).collect()
}

/// Returns red, green and blue of the same pixels.
fn expected(u: u32, v: u32) -> [u8; 3] {
    [58, 29, 0].map(|more| (7 * u + 13 * v) as u8 + more)
}

#[test]
fn tiff_bmp_and_pnm_files_are_read() {
    use written_by_opencv as files;
    let between = |low, high| DecodeOptions::default().with_range(PixelRange::Between(low, high));
    // In a range that corresponds to 0 to 255, 16-bit and float values equal those of 8 bits.
    for (hex, options) in [
        (files::GRAY_8, DecodeOptions::default()),
        (files::GRAY_16, between(0.0, 25_500.0)),
        (files::GRAY_F32, between(0.0, 127.5)),
        (files::PGM_16, between(0.0, 25_500.0)),
    ] {
        let rgb = decode_rgb(&from_hex(hex), &options).unwrap().image;
        assert_eq!(rgb.dimensions(), (5, 3));
        let gray = decode_gray(&from_hex(hex), &options).unwrap().image;
        for (u, v, pixel) in rgb.enumerate_pixels() {
            assert_eq!(pixel.0, [expected(u, v)[2]; 3], "{hex}");
            let value = f32::from(pixel.0[0]) / 255.0;
            assert!((gray.get_pixel(u, v).0[0] - value).abs() < 1e-6);
        }
    }
    for (hex, options) in [
        (files::RGB_8, DecodeOptions::default()),
        (files::RGB_16, between(0.0, 25_500.0)),
        (files::BMP, DecodeOptions::default()),
    ] {
        let rgb = decode_rgb(&from_hex(hex), &options).unwrap().image;
        for (u, v, pixel) in rgb.enumerate_pixels() {
            assert_eq!(pixel.0, expected(u, v), "{hex}");
        }
    }
}

#[test]
fn the_range_in_use_is_that_of_all_colors_and_is_reported() {
    use written_by_opencv as files;
    for (hex, most) in [
        (files::GRAY_16, 5400.0),
        (files::PGM_16, 5400.0),
        (files::GRAY_F32, 27.0),
        (files::RGB_16, 11_200.0),
    ] {
        let decoded = decode_gray(&from_hex(hex), &DecodeOptions::default()).unwrap();
        assert_eq!(decoded.range, Some([0.0, most]));
        let full = DecodeOptions::default().with_range(PixelRange::Full);
        assert_eq!(decode_gray(&from_hex(hex), &full).unwrap().range, None);
    }
    let bytes = decode_gray(&from_hex(files::GRAY_8), &DecodeOptions::default()).unwrap();
    assert_eq!(bytes.range, None);
    let stretched = DecodeOptions::default().with_range(PixelRange::Between(0.0, 54.0));
    let stretched = decode_rgb(&from_hex(files::GRAY_8), &stretched).unwrap();
    assert_eq!(stretched.image.get_pixel(4, 2).0, [255; 3]);
    assert_eq!(stretched.range, Some([0.0, 54.0]));
}

#[test]
fn bits_planes_and_signs_of_tiff_files_are_read() {
    use ::tiff::encoder::{Rational, TiffEncoder, colortype};
    use ::tiff::tags::Tag;
    // Signed values, as some thermal cameras write, with an orientation and a focal length.
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let mut exif = encoder.extra_directory().unwrap();
    exif.write_tag(Tag::Unknown(0xA405), 28_u16).unwrap();
    let exif = exif.finish_with_offsets().unwrap();
    let mut image = encoder.new_image::<colortype::GrayI16>(3, 2).unwrap();
    let tags = image.encoder();
    tags.write_tag(Tag::Orientation, 6_u16).unwrap();
    tags.write_tag(Tag::ExifDirectory, exif.offset).unwrap();
    image.write_data(&[-200, -100, 0, 100, 200, 200]).unwrap();
    let decoded = decode_gray(file.get_ref(), &DecodeOptions::default()).unwrap();
    assert_eq!(decoded.image.dimensions(), (2, 3));
    assert_eq!(decoded.image.as_raw(), &[0.75, 0.0, 1.0, 0.25, 1.0, 0.5]);
    assert_eq!(decoded.orientation, Orientation::Rotate90);
    let expected = 28.0 * (13.0_f64 / 1872.0).sqrt();
    assert!((decoded.focal_px.unwrap() - expected).abs() < 1e-12);
    // A thumbnail before raw data is not the photo.
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let mut image = encoder.new_image::<colortype::Gray8>(3, 2).unwrap();
    image
        .encoder()
        .write_tag(Tag::Unknown(50_706), &[1_u8, 4, 0, 0][..])
        .unwrap();
    image
        .encoder()
        .write_tag(Tag::XResolution, Rational { n: 1, d: 1 })
        .unwrap();
    image.write_data(&[0; 6]).unwrap();
    let error = decode_gray(file.get_ref(), &DecodeOptions::default()).unwrap_err();
    assert!(error.to_string().contains("develop it to TIFF"), "{error}");
    // One bit per pixel, black and white.
    let pbm = decode_rgb(b"P1 3 1 1 0 1", &DecodeOptions::default()).unwrap();
    assert_eq!(pbm.image.as_raw(), &[0, 0, 0, 255, 255, 255, 0, 0, 0]);
}

#[test]
fn damaged_files_of_all_formats_are_errors_or_other_images() {
    let options = DecodeOptions::default().with_max_pixels(1000);
    for hex in written_by_opencv::ALL {
        let whole = from_hex(hex);
        for keep in 0..whole.len() {
            let _ = decode_rgb(&whole[..keep], &options);
        }
        for at in 0..whole.len() {
            for mask in [0x01, 0x55, 0x80, 0xFF] {
                let mut changed = whole.clone();
                changed[at] ^= mask;
                let _ = decode_gray(&changed, &options);
            }
        }
        let limit = options.with_max_pixels(14);
        let refused = decode_gray(&whole, &limit);
        assert_eq!(refused, Err(Error::TooManyPixels { got: 15, limit: 14 }));
    }
}

#[test]
fn a_thermal_picture_is_that_of_its_twin_in_eight_bits() {
    let Some(path) = shared::field("11/thermal00.png") else {
        return;
    };
    let bytes = std::fs::read(path).unwrap();
    let decoded = decode_rgb(&bytes, &DecodeOptions::default()).unwrap();
    let range = decoded.range.unwrap();
    assert_eq!(range, [51_241.0, 52_181.0]);
    let deep = image::load_from_memory(&bytes).unwrap().into_luma16();
    for (deep, pixel) in deep.pixels().zip(decoded.image.pixels()) {
        let twin = (f64::from(deep.0[0]) - range[0]) / (range[1] - range[0]) * 255.0;
        assert!((twin - f64::from(pixel.0[0])).abs() <= 0.5);
    }
}
