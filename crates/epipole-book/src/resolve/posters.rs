//! Posters: pictures of the figures, drawn at build time and cached.

use super::cache::Cache;
use super::figures::{Figure, Poster, Room};
use crate::parallel;
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

/// Device pixels per CSS pixel of a poster. On paper, 720 CSS pixels on 160 mm give 229 dpi.
const SCALE: u32 = 2;

/// Quality of lossy posters, 0 to 100. At two device pixels per CSS pixel, text stays crisp.
const QUALITY: f32 = 76.0;
/// Quality of JPEGs on paper, 0 to 100, for a book below 25 MB.
const PAPER_QUALITY: u8 = 72;

/// Maximum number of colors for which a lossless poster is tried, as it takes long and is never
/// smaller for more. Of 514 posters, the ten that are smaller without loss have at most 2731
/// colors.
const MOST_COLORS: usize = 4096;

/// Medium that posters are drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Medium {
    /// WebP for the widths of a page, light and dark.
    Screen,
    /// JPEG for one width, light, which PDF files contain unchanged.
    Paper,
}

/// Posters of a figure for some widths of a page, narrow ones first.
#[derive(Debug, Default)]
pub(crate) struct Posters(pub(crate) Vec<Shades>);

/// The posters for one width of a page.
#[derive(Debug)]
pub(crate) struct Shades {
    /// Width, CSS pixels.
    pub(crate) width: u32,
    /// Height, CSS pixels.
    pub(crate) height: f64,
    pub(crate) light: Encoded,
    /// Dark poster; `None` on paper.
    pub(crate) dark: Option<Encoded>,
}

impl Posters {
    /// Returns width and height of each, CSS pixels.
    pub(crate) fn sizes(&self) -> Vec<(u32, f64)> {
        let all = self.0.iter();
        all.map(|shades| (shades.width, shades.height)).collect()
    }
}

/// Draws the posters for these widths, or takes them from the cache.
pub(super) fn draw(
    figure: &dyn Figure,
    name: &str,
    settings: &[(String, String)],
    (medium, rooms): (Medium, &[Room]),
    cache: &Cache,
) -> Result<Posters, String> {
    let shades = |room: Room| {
        let width = room.width();
        let make = || {
            let [light, dark] = figure.posters(room, SCALE)?;
            let made = match medium {
                Medium::Screen => vec![encode(&light)?, encode(&dark)?],
                Medium::Paper => vec![encode_for_paper(&light)?],
            };
            let bytes = pack(&made);
            Ok((made, bytes))
        };
        let what = match medium {
            Medium::Screen => width.to_string(),
            Medium::Paper => format!("paper {width}"),
        };
        let made = cache.get_or((name, settings, &what), unpack, make)?;
        let mut made = made.into_iter();
        let light = made.next().ok_or("no poster was drawn")?;
        Ok(Shades {
            width,
            height: f64::from(light.size.1) / f64::from(SCALE),
            light,
            dark: made.next(),
        })
    };
    let drawn = parallel::map(rooms.to_vec(), shades).into_iter();
    let drawn: Result<_, String> = drawn.collect();
    drawn.map(Posters)
}

/// A compressed poster and its size in device pixels, whose ratio is exactly that of the live
/// picture.
#[derive(Debug)]
pub(crate) struct Encoded {
    pub(crate) bytes: Vec<u8>,
    pub(crate) size: (u32, u32),
}

impl Encoded {
    /// Returns the extension of its file.
    pub(crate) fn ending(&self) -> &'static str {
        match &self.bytes[..] {
            [0xff, 0xd8, ..] => "jpg",
            _ => "webp",
        }
    }
}

/// Encodes a poster losslessly or lossily, whichever is smaller: drawings are usually lossless,
/// photographs lossy.
fn encode(poster: &Poster) -> Result<Encoded, String> {
    let encoder = webp::Encoder::from_rgba(&poster.rgba, poster.width, poster.height);
    let encode = |lossless: bool| {
        let failed = |error: String| format!("the poster could not be encoded: {error}");
        let mut config =
            webp::WebPConfig::new().map_err(|()| failed("no configuration".to_owned()))?;
        config.lossless = i32::from(lossless);
        config.quality = if lossless { 75.0 } else { QUALITY };
        // Keeps the color of thin lines and letters at full resolution.
        config.use_sharp_yuv = 1;
        encoder
            .encode_advanced(&config)
            .map_err(|error| failed(format!("{error:?}")))
    };
    let mut webp = encode(false)?.to_vec();
    if !has_many_colors(&poster.rgba) {
        let lossless = encode(true)?.to_vec();
        webp = std::cmp::min_by_key(lossless, webp, Vec::len);
    }
    Ok(Encoded {
        bytes: webp,
        size: (poster.width, poster.height),
    })
}

/// Encodes a JPEG on white.
fn encode_for_paper(poster: &Poster) -> Result<Encoded, String> {
    let failed = |error: ImageError| format!("the poster could not be encoded: {error}");
    let on_white = |[r, g, b, a]: &[u8; 4]| {
        [*r, *g, *b].map(|level| {
            let alpha = u32::from(*a);
            ((u32::from(level) * alpha + 255 * (255 - alpha) + 127) / 255) as u8
        })
    };
    let (pixels, _) = poster.rgba.as_chunks();
    let rgb: Vec<u8> = pixels.iter().flat_map(on_white).collect();
    let mut bytes = Vec::new();
    let (width, height, kind) = (poster.width, poster.height, ExtendedColorType::Rgb8);
    JpegEncoder::new_with_quality(&mut bytes, PAPER_QUALITY)
        .write_image(&rgb, width, height, kind)
        .map_err(failed)?;
    Ok(Encoded {
        bytes,
        size: (width, height),
    })
}

fn has_many_colors(rgba: &[u8]) -> bool {
    let mut is_used = vec![false; 1 << 24];
    let mut count = 0;
    rgba.chunks_exact(4).any(|pixel| {
        let color = u32::from_le_bytes([pixel[0], pixel[1], pixel[2], 0]);
        count += usize::from(!std::mem::replace(&mut is_used[color as usize], true));
        count > MOST_COLORS
    })
}

fn pack(posters: &[Encoded]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for poster in posters {
        let length = u32::try_from(poster.bytes.len()).unwrap_or(u32::MAX);
        for number in [poster.size.0, poster.size.1, length] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(&poster.bytes);
    }
    bytes
}

fn unpack(bytes: &[u8]) -> Option<Vec<Encoded>> {
    let mut rest = bytes;
    let mut posters = Vec::new();
    while !rest.is_empty() {
        let mut number = || {
            let (first, after) = rest.split_first_chunk::<4>()?;
            rest = after;
            Some(u32::from_le_bytes(*first))
        };
        let (width, height, length) = (number()?, number()?, number()?);
        let (bytes, after) = rest.split_at_checked(length as usize)?;
        rest = after;
        posters.push(Encoded {
            bytes: bytes.to_vec(),
            size: (width, height),
        });
    }
    Some(posters)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poster(level: u8) -> Encoded {
        encode(&Poster {
            width: 4,
            height: 2,
            rgba: [level, 0, 0, 255].repeat(8),
        })
        .unwrap()
    }

    #[test]
    fn drawings_are_lossless_and_photos_are_not() {
        let poster = |level: fn(u32) -> u32| Poster {
            width: 256,
            height: 256,
            rgba: (0..256 * 256)
                .flat_map(|n| (level(n) | 0xff00_0000).to_le_bytes())
                .collect(),
        };
        let kind = |poster: &Poster| encode(poster).unwrap().bytes[12..16].to_vec();
        let drawing = poster(|n| {
            if n % 256 < 100 {
                0x30_60_c0
            } else {
                0xff_ff_ff
            }
        });
        assert_eq!(kind(&drawing), b"VP8L");
        assert!(!has_many_colors(&drawing.rgba));
        let photo = poster(|n| n.wrapping_mul(2_654_435_761) >> 8);
        assert_ne!(kind(&photo), b"VP8L");
        let start = |poster: &Poster| encode_for_paper(poster).unwrap().bytes[..4].to_vec();
        assert_eq!(start(&drawing)[..3], [0xff, 0xd8, 0xff]);
        assert!(has_many_colors(&photo.rgba));
    }

    #[test]
    fn posters_are_webp_and_unpack_as_packed() {
        let posters = [poster(9), poster(200)];
        assert_eq!(&posters[0].bytes[8..12], b"WEBP");
        assert_eq!(posters[0].size, (4, 2));
        let packed = pack(&posters);
        let again = unpack(&packed).unwrap();
        assert_eq!(again[1].bytes, posters[1].bytes);
        assert_eq!(again[1].size, posters[1].size);
        assert!(unpack(&packed[1..]).is_none());
        assert!(unpack(b"broken").is_none());
    }
}
