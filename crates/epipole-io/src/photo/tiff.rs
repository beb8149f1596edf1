//! TIFF files: the first image.

use super::format::{bad, check_size, unsupported};
use super::raster::{Raster, Samples};
use crate::{Error, Result};
use image::metadata::Orientation;
use std::io::Cursor;
use tiff::ColorType;
use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

/// Version of the DNG format, in raw files.
const DNG_VERSION: Tag = Tag::Unknown(50_706);
/// Maximum list of a file's parts, bytes.
const MAX_LIST_BYTES: usize = 16 << 20;
/// Maximum part that may exceed the image, as a tile of a small image does, bytes.
const MAX_TILE_BYTES: usize = 64 << 20;

/// Returns width and height of the first image.
///
/// # Errors
/// [`Error::BadImage`] for a damaged file.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32)> {
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(decoder_error)?;
    decoder.dimensions().map_err(decoder_error)
}

/// Reads pixels and orientation.
///
/// # Errors
/// [`Error::BadImage`] for a damaged file, or with the kind of TIFF that is not supported;
/// [`Error::TooManyPixels`] beyond the limit.
pub(super) fn read(bytes: &[u8], max_pixels: u64) -> Result<(Raster, Orientation)> {
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(decoder_error)?;
    if is_raw(&mut decoder) {
        return Err(unsupported("camera raw (TIFF)"));
    }
    let (width, height) = decoder.dimensions().map_err(decoder_error)?;
    check_size(width, height, max_pixels)?;
    let color = decoder.colortype().map_err(decoder_error)?;
    let (channels, depth) = match color {
        ColorType::Gray(depth) => (1, depth),
        ColorType::GrayA(depth)
        | ColorType::Multiband {
            bit_depth: depth,
            num_samples: 2,
        } => (2, depth),
        ColorType::RGB(depth) => (3, depth),
        ColorType::RGBA(depth) => (4, depth),
        ColorType::Multiband { num_samples, .. } => {
            return Err(bad(format!(
                "it is a TIFF file with {num_samples} bands, which is not supported; write one of them as gray, or \
                 three as RGB"
            )));
        }
        other => return Err(unsupported_kind(&format!("{other:?}"))),
    };
    let packs = channels == 1 && matches!(depth, 1 | 2 | 4);
    if !packs && !matches!(depth, 8 | 16 | 32 | 64) {
        return Err(unsupported_kind(&format!("{depth} bits a sample")));
    }
    let layout = decoder.image_buffer_layout().map_err(decoder_error)?;
    let mut limits = Limits::default();
    // The size of the image was checked above.
    limits.decoding_buffer_size = layout.complete_len;
    limits.intermediate_buffer_size = layout.complete_len.saturating_add(MAX_TILE_BYTES);
    limits.ifd_value_size = MAX_LIST_BYTES;
    let mut decoder = decoder.with_limits(limits);
    let orientation = decoder.find_tag_unsigned::<u8>(Tag::Orientation);
    let orientation = (orientation.ok().flatten()).and_then(Orientation::from_exif);
    let mut read = DecodingResult::U8(Vec::new());
    let layout = decoder
        .read_image_to_buffer(&mut read)
        .map_err(decoder_error)?;
    if packs {
        let DecodingResult::U8(rows) = &read else {
            return Err(unsupported_kind(&format!("{depth} bits a sample")));
        };
        read = DecodingResult::U8(unpack_bits(rows, width as usize, depth));
    }
    let (mut samples, full) = samples(read);
    if layout.planes > 1 {
        samples = match samples {
            Samples::Bytes(planes) => Samples::Bytes(interleave(&planes, channels)),
            Samples::Words(planes) => Samples::Words(interleave(&planes, channels)),
            Samples::Floats(planes) => Samples::Floats(interleave(&planes, channels)),
        };
    }
    let raster = Raster {
        width,
        height,
        channels,
        samples,
        full,
    };
    if !raster.is_whole() {
        return Err(bad("its TIFF data are not those of an image of its size"));
    }
    Ok((raster, orientation.unwrap_or(Orientation::NoTransforms)))
}

/// Returns whether the first image is only the preview of raw data.
fn is_raw(decoder: &mut Decoder<Cursor<&[u8]>>) -> bool {
    let has = |decoder: &mut Decoder<_>, tag| matches!(decoder.find_tag(tag), Ok(Some(_)));
    let kind = decoder.find_tag_unsigned::<u32>(Tag::NewSubfileType);
    let is_reduced = matches!(kind, Ok(Some(kind)) if kind & 1 == 1);
    has(decoder, DNG_VERSION) || is_reduced && has(decoder, Tag::SubIfd)
}

/// Describes the error of the decoder.
fn decoder_error(error: TiffError) -> Error {
    match error {
        TiffError::UnsupportedError(what) => unsupported_kind(&what.to_string()),
        TiffError::LimitsExceeded => bad("its TIFF data need too much memory"),
        other => bad(format!("its TIFF data are damaged: {other}")),
    }
}

fn unsupported_kind(what: &str) -> Error {
    bad(format!(
        "it is a TIFF file of a kind that is not supported ({what}); convert it to PNG, or to a TIFF file of 8 or 16 bits"
    ))
}

/// Unpacks samples of 1, 2 or 4 bits, in rows of whole bytes, to bytes from 0 to 255.
fn unpack_bits(rows: &[u8], width: usize, depth: u8) -> Vec<u8> {
    let depth = usize::from(depth);
    let most = (1_u8 << depth) - 1;
    let sample = |row: &[u8], u: usize| {
        let bit = u * depth;
        (row[bit / 8] >> (8 - depth - bit % 8) & most) * (255 / most)
    };
    let rows = rows.chunks_exact((width * depth).div_ceil(8));
    rows.flat_map(|row| (0..width).map(move |u| sample(row, u)))
        .collect()
}

/// Converts consecutive planes to samples pixel by pixel.
fn interleave<T: Copy>(planes: &[T], channels: usize) -> Vec<T> {
    let length = planes.len() / channels;
    let pixel = |at: usize| (0..channels).map(move |plane| planes[plane * length + at]);
    (0..length).flat_map(pixel).collect()
}

/// Returns the samples, with the values of black and white.
fn samples(read: DecodingResult) -> (Samples, [f64; 2]) {
    use Samples::{Bytes, Floats, Words};
    match read {
        DecodingResult::U8(v) => (Bytes(v), [0.0, 255.0]),
        DecodingResult::U16(v) => (Words(v), [0.0, 65_535.0]),
        DecodingResult::F32(v) => (Floats(v), [0.0, 1.0]),
        DecodingResult::F16(v) => {
            let floats = v.iter().map(|x| x.to_f32()).collect();
            (Floats(floats), [0.0, 1.0])
        }
        DecodingResult::F64(v) => {
            let floats = v.iter().map(|&x| x as f32).collect();
            (Floats(floats), [0.0, 1.0])
        }
        DecodingResult::U32(v) => {
            let floats = v.iter().map(|&x| x as f32).collect();
            (Floats(floats), [0.0, f64::from(u32::MAX)])
        }
        DecodingResult::U64(v) => {
            let floats = v.iter().map(|&x| x as f32).collect();
            (Floats(floats), [0.0, u64::MAX as f64])
        }
        DecodingResult::I8(v) => {
            let floats = v.iter().map(|&x| x.into()).collect();
            (Floats(floats), [-128.0, 127.0])
        }
        DecodingResult::I16(v) => {
            let floats = v.iter().map(|&x| x.into()).collect();
            (Floats(floats), [-32_768.0, 32_767.0])
        }
        DecodingResult::I32(v) => {
            let floats = v.iter().map(|&x| x as f32).collect();
            (Floats(floats), [f64::from(i32::MIN), f64::from(i32::MAX)])
        }
        DecodingResult::I64(v) => {
            let floats = v.iter().map(|&x| x as f32).collect();
            (Floats(floats), [i64::MIN as f64, i64::MAX as f64])
        }
    }
}
