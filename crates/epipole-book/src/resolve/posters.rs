//! Posters: pictures of the figures, drawn while the book is built, kept between builds.

use crate::html::path_to_root;
use crate::render::markdown::Renderer;
use crate::resolve::figures::{Figure, Poster, Room};
use crate::write::assets::fnv;
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

/// Device pixels of a poster to a CSS pixel.
const SCALE: u32 = 2;

/// Of 100, for posters with photographs. At two device pixels to a CSS pixel text stays crisp.
const QUALITY: f32 = 76.0;

/// Pages of this width have no more room than a phone, or than a column: `web/theme/tokens.css` keeps the
/// figures of the others wider.
const PHONE: &str = "(max-width: 551.98px)";
const COLUMN: &str = "(max-width: 927.98px)";
const DARK: &str = "(prefers-color-scheme: dark)";

/// The posters of a figure for all widths of a page, light and dark, as HTML.
#[derive(Default)]
pub(crate) struct Posters {
    /// A `<source>` for each. They carry the sizes, since those differ.
    pub(crate) sources: String,
    /// The widest, light.
    pub(crate) src: String,
    /// Width and height of each, CSS pixels.
    pub(crate) sizes: Vec<(u32, f64)>,
}

/// Draws the posters for these rooms, narrow ones first, or takes them from `folder`, and adds them to the
/// site.
pub(crate) fn draw(
    figure: &dyn Figure,
    rooms: &[Room],
    name: &str,
    settings: &[(String, String)],
    renderer: &Renderer,
    folder: &Path,
) -> Result<Posters, String> {
    let drawn: Vec<[Encoded; 2]> = rooms
        .par_iter()
        .map(|room| {
            let file = kept_as(folder, name, settings, &room.width().to_string());
            cached(&file, || {
                let [light, dark] = figure.posters(*room, SCALE)?;
                Ok([encode(&light)?, encode(&dark)?])
            })
        })
        .collect::<Result<_, String>>()?;
    let root = path_to_root(&renderer.page.path);
    let add = |encoded: &Encoded, suffix: &str| {
        let bytes = encoded.webp.clone();
        let path = renderer
            .shared
            .add_asset(&format!("figures/{name}-{suffix}"), "webp", bytes);
        format!("{root}{path}")
    };
    let mut posters = Posters::default();
    for (index, [light, dark]) in drawn.iter().enumerate() {
        let width = rooms[index].width();
        let height = f64::from(light.size.1) / f64::from(SCALE);
        posters.sizes.push((width, height));
        posters.src = add(light, &format!("{width}-light"));
        let dark_src = add(dark, &format!("{width}-dark"));
        // The widest is for all pages that the ones before leave.
        let pages = [PHONE, COLUMN]
            .get(index)
            .filter(|_| index + 1 < rooms.len());
        let when_dark = pages.map_or(DARK.to_owned(), |pages| format!("{pages} and {DARK}"));
        for (src, media, (width, height)) in [
            (&dark_src, when_dark.as_str(), dark.size),
            (&posters.src, pages.unwrap_or(&"all"), light.size),
        ] {
            posters.sources.push_str(&format!(
                "<source srcset=\"{src}\" media=\"{media}\" width=\"{width}\" height=\"{height}\">"
            ));
        }
    }
    Ok(posters)
}

/// The file in `folder` that keeps something of a figure in some state between builds.
pub(crate) fn kept_as(
    folder: &Path,
    name: &str,
    settings: &[(String, String)],
    what: &str,
) -> PathBuf {
    let key = fnv(format!("{}{name}{settings:?}{what}", program()).as_bytes());
    folder.join(format!("{name}-{key:016x}"))
}

/// A compressed poster and its size in device pixels: their ratio is exactly that of the living picture.
struct Encoded {
    webp: Vec<u8>,
    size: (u32, u32),
}

/// The smaller of a lossless and a good lossy picture: drawings come out lossless, photographs
/// lossy.
fn encode(poster: &Poster) -> Result<Encoded, String> {
    let encoder = webp::Encoder::from_rgba(&poster.rgba, poster.width, poster.height);
    let encode = |lossless: bool| {
        let failed = |error: String| format!("the poster could not be encoded: {error}");
        let mut config =
            webp::WebPConfig::new().map_err(|()| failed("no configuration".to_owned()))?;
        config.lossless = i32::from(lossless);
        config.quality = if lossless { 75.0 } else { QUALITY };
        // Colors of thin lines and letters at full resolution.
        config.use_sharp_yuv = 1;
        encoder
            .encode_advanced(&config)
            .map_err(|error| failed(format!("{error:?}")))
    };
    let (lossless, lossy) = (encode(true)?, encode(false)?);
    let smaller = if lossless.len() <= lossy.len() {
        lossless
    } else {
        lossy
    };
    Ok(Encoded {
        webp: smaller.to_vec(),
        size: (poster.width, poster.height),
    })
}

/// What `make` gave when the file was written: two posters behind a line with their sizes.
fn cached(
    file: &Path,
    make: impl FnOnce() -> Result<[Encoded; 2], String>,
) -> Result<[Encoded; 2], String> {
    if let Some(kept) = fs::read(file).ok().and_then(|bytes| unpack(&bytes)) {
        return Ok(kept);
    }
    let made = make()?;
    // A cache that cannot be written costs time, nothing else.
    let part = file.with_extension("part");
    let _ = fs::write(&part, pack(&made)).and_then(|()| fs::rename(&part, file));
    Ok(made)
}

fn pack(posters: &[Encoded; 2]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for poster in posters {
        let length = u32::try_from(poster.webp.len()).unwrap_or(u32::MAX);
        for number in [poster.size.0, poster.size.1, length] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(&poster.webp);
    }
    bytes
}

fn unpack(bytes: &[u8]) -> Option<[Encoded; 2]> {
    let mut rest = bytes;
    let mut next = || {
        let mut number = || {
            let (first, after) = rest.split_first_chunk::<4>()?;
            rest = after;
            Some(u32::from_le_bytes(*first))
        };
        let (width, height, length) = (number()?, number()?, number()?);
        let (webp, after) = rest.split_at_checked(length as usize)?;
        rest = after;
        Some(Encoded {
            webp: webp.to_vec(),
            size: (width, height),
        })
    };
    let posters = [next()?, next()?];
    rest.is_empty().then_some(posters)
}

/// This program's build: figures drawn by another build are drawn again.
fn program() -> String {
    let metadata = std::env::current_exe().and_then(fs::metadata);
    let modified = metadata
        .as_ref()
        .ok()
        .and_then(|metadata| metadata.modified().ok());
    format!(
        "{modified:?} {:?}",
        metadata.map(|metadata| metadata.len()).ok()
    )
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
    fn posters_are_webp_and_kept() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a-1");
        let first = cached(&file, || Ok([poster(9), poster(200)])).unwrap();
        assert_eq!(&first[0].webp[8..12], b"WEBP");
        assert_eq!(first[0].size, (4, 2));
        let second = cached(&file, || Err("it was kept".to_owned())).unwrap();
        assert_eq!(second[1].webp, first[1].webp);
        assert_eq!(second[1].size, first[1].size);
        fs::write(&file, b"broken").unwrap();
        assert!(cached(&file, || Err("made again".to_owned())).is_err());
    }
}
