//! Stills: small pictures of all figures with their descriptions, for pages without widgets. They
//! are part of the Python package, so each is a PNG of few colors in which runs of similar pixels
//! have one color: drawings do not change, photographs become coarse.

use crate::resolve::facts::Facts;
use crate::resolve::figures::{Gallery, Poster, Room};
use anyhow::{Context, Result, anyhow};
use epipole::imaging::{GrayImage32, gray_from_values, resize};
use png::{BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// Width of a still, pixels. A figure is laid out for a column and downscaled.
const WIDTH: u32 = 400;

/// Target size of a still, bytes: 31 of them and the modules take less than 1.2 MB.
const BYTES: usize = 6_800;

/// Number of colors, and tolerance for reusing a neighbor's color, 0 to 255. The first pair whose
/// result is small enough is used.
const LADDER: [(usize, i32); 9] = [
    (32, 0),
    (32, 6),
    (32, 12),
    (24, 16),
    (20, 20),
    (16, 24),
    (16, 30),
    (14, 38),
    (12, 46),
];

/// Fraction of the pixels above which a color is kept exactly, in thousandths.
const FREQUENT: usize = 5;

type Color = [u8; 3];

/// Writes `NAME.png` for each figure, and all descriptions as `words.json`, to a folder.
///
/// # Errors
/// A figure that cannot be drawn, or a folder that is not writable.
pub fn write(gallery: &dyn Gallery, folder: &Path) -> Result<usize> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let names = gallery.names();
    let stills: Vec<(String, Vec<u8>)> = names
        .par_iter()
        .map(|name| still(gallery, name).map_err(|problem| anyhow!("figure {name}: {problem}")))
        .collect::<Result<_>>()?;
    let mut words = BTreeMap::new();
    for (name, (description, png)) in names.iter().zip(stills) {
        let file = folder.join(format!("{name}.png"));
        std::fs::write(&file, png).with_context(|| format!("cannot write {}", file.display()))?;
        words.insert(name, description);
    }
    let file = folder.join("words.json");
    std::fs::write(&file, serde_json::to_vec(&words)?)
        .with_context(|| format!("cannot write {}", file.display()))?;
    Ok(names.len())
}

/// Returns description and PNG of a figure's initial state.
fn still(gallery: &dyn Gallery, name: &str) -> Result<(String, Vec<u8>), String> {
    let figure = gallery.open(name, &[])?;
    let facts = Facts::parse(&figure.snapshot()?)?;
    let [light, _] = figure.posters(Room::Column, 1)?;
    let picture = Picture::reduced(&light, WIDTH).map_err(|error| error.to_string())?;
    let png = small(&picture)?;
    Ok((facts.description().to_owned(), png))
}

struct Picture {
    width: usize,
    pixels: Vec<Color>,
}

impl Picture {
    /// Downscales a poster on white.
    fn reduced(poster: &Poster, width: u32) -> epipole::Result<Picture> {
        let width = width.min(poster.width);
        let height = (poster.height * width / poster.width).max(1);
        let channel = |channel: usize| {
            let on_white = |rgba: &[u8; 4]| {
                let alpha = f32::from(rgba[3]) / 255.0;
                f32::from(rgba[channel]) * alpha + 255.0 * (1.0 - alpha)
            };
            let levels = poster.rgba.as_chunks().0.iter().map(on_white).collect();
            let whole = gray_from_values(poster.width, poster.height, levels)?;
            resize(&whole, width, height)
        };
        let [red, green, blue] = [channel(0)?, channel(1)?, channel(2)?];
        let level = |plane: &GrayImage32, at: usize| plane.as_raw()[at].round() as u8;
        let pixels = (0..(width * height) as usize)
            .map(|at| [level(&red, at), level(&green, at), level(&blue, at)])
            .collect();
        Ok(Picture {
            width: width as usize,
            pixels,
        })
    }
}

/// Returns the first PNG of the ladder that is small enough, or the last.
fn small(picture: &Picture) -> Result<Vec<u8>, String> {
    let mut made = Vec::new();
    for (colors, tolerance) in LADDER {
        let palette = Palette::of(picture, colors);
        let indices = indices(picture, &palette, tolerance);
        made =
            encode(picture.width, &palette.colors, &indices).map_err(|error| error.to_string())?;
        if made.len() <= BYTES {
            break;
        }
    }
    Ok(made)
}

/// Colors of a picture; the first `exact` of them are its most frequent ones.
struct Palette {
    colors: Vec<Color>,
    exact: usize,
}

impl Palette {
    fn of(picture: &Picture, limit: usize) -> Palette {
        let mut counts: BTreeMap<Color, usize> = BTreeMap::new();
        for pixel in &picture.pixels {
            *counts.entry(*pixel).or_default() += 1;
        }
        let mut ranked: Vec<(Color, usize)> = counts.into_iter().collect();
        ranked.sort_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
        let enough = picture.pixels.len() * FREQUENT / 1000;
        let exact = ranked
            .iter()
            .take(limit / 2)
            .take_while(|(_, count)| *count > enough)
            .count();
        let rest = ranked.split_off(exact);
        let mut colors: Vec<Color> = ranked.into_iter().map(|(color, _)| color).collect();
        colors.extend(cut(rest, limit - exact));
        Palette { colors, exact }
    }

    fn nearest(&self, pixel: Color) -> usize {
        let far = |&index: &usize| distance_sq(self.colors[index], pixel);
        (0..self.colors.len()).min_by_key(far).unwrap_or_default()
    }
}

/// Returns the squared perceptual distance of two colors: green counts most.
fn distance_sq(one: Color, other: Color) -> i32 {
    let difference = |channel: usize| i32::from(one[channel]) - i32::from(other[channel]);
    let [r, g, b] = [difference(0), difference(1), difference(2)];
    (2 * r * r + 4 * g * g + b * b) / 7
}

/// Quantizes colors by median cut: halves the box of colors with the largest spread until there are
/// `limit`, and returns their means.
///
/// Source: Heckbert 1982, Color image quantization for frame buffer display.
fn cut(colors: Vec<(Color, usize)>, limit: usize) -> Vec<Color> {
    if colors.is_empty() {
        return Vec::new();
    }
    let mut boxes = vec![colors];
    while boxes.len() < limit {
        let widest = boxes
            .iter()
            .enumerate()
            .map(|(index, inside)| (spread(inside), index))
            .max_by_key(|((weighted, _), _)| *weighted);
        let Some(((weighted, channel), index)) = widest else {
            break;
        };
        if weighted == 0 {
            break;
        }
        let mut inside = boxes.swap_remove(index);
        inside.sort_by_key(|(color, _)| (color[channel], *color));
        let all: usize = inside.iter().map(|(_, count)| count).sum();
        let mut before = 0;
        let middle = inside.iter().position(|(_, count)| {
            before += count;
            before * 2 >= all
        });
        let middle = middle.map_or(1, |at| at + 1).clamp(1, inside.len() - 1);
        boxes.push(inside.split_off(middle));
        boxes.push(inside);
    }
    boxes.iter().map(|inside| mean(inside)).collect()
}

/// Returns the squared range of a box's widest channel, weighted by the root of the number of
/// colors, and that channel.
fn spread(inside: &[(Color, usize)]) -> (u64, usize) {
    let count: usize = inside.iter().map(|(_, count)| count).sum();
    let range = |channel: usize| {
        let levels = inside.iter().map(|(color, _)| u64::from(color[channel]));
        levels.clone().max().unwrap_or(0) - levels.min().unwrap_or(0)
    };
    let widest = (0..3).map(|channel| (range(channel), channel)).max();
    let (range, channel) = widest.unwrap_or_default();
    (range * range * count.isqrt() as u64, channel)
}

fn mean(inside: &[(Color, usize)]) -> Color {
    let all: usize = inside.iter().map(|(_, count)| count).sum();
    let sum = |channel: usize| -> usize {
        let weighed = inside.iter();
        weighed
            .map(|(color, count)| usize::from(color[channel]) * count)
            .sum()
    };
    [0, 1, 2].map(|channel| (sum(channel) / all.max(1)) as u8)
}

/// Returns the palette index of each pixel: that of its neighbor above or to the left if close
/// enough, else the nearest. Pixels with a frequent color keep it.
fn indices(picture: &Picture, palette: &Palette, tolerance: i32) -> Vec<u8> {
    let mut found: Vec<u8> = Vec::with_capacity(picture.pixels.len());
    let mut from_above = false;
    for (place, &pixel) in picture.pixels.iter().enumerate() {
        let nearest = palette.nearest(pixel);
        let exactly = nearest < palette.exact && palette.colors[nearest] == pixel;
        let above = place.checked_sub(picture.width).map(|at| found[at]);
        let left = (place % picture.width > 0).then(|| found[place - 1]);
        // Continuing with the same choice compresses better.
        let known = match from_above {
            true => [above, left],
            false => [left, above],
        };
        let near = |index: &u8| {
            distance_sq(palette.colors[usize::from(*index)], pixel) <= tolerance * tolerance
        };
        let taken = match exactly || tolerance == 0 {
            true => None,
            false => known.into_iter().flatten().find(near),
        };
        from_above = taken.is_some() && taken == above;
        found.push(taken.unwrap_or(nearest as u8));
    }
    found
}

/// Encodes a PNG with a palette of at most 256 colors.
fn encode(width: usize, palette: &[Color], indices: &[u8]) -> Result<Vec<u8>, EncodingError> {
    // As few bits per pixel as the palette needs.
    let depth = match palette.len() {
        0..=2 => BitDepth::One,
        3..=4 => BitDepth::Two,
        5..=16 => BitDepth::Four,
        _ => BitDepth::Eight,
    };
    let bits = depth as usize;
    let packed: Vec<u8> = indices
        .chunks(width)
        .flat_map(|row| row.chunks(8 / bits))
        .map(|together| {
            let places = together.iter().enumerate();
            places.fold(0, |byte, (place, index)| {
                byte | index << (8 - bits * (place + 1))
            })
        })
        .collect();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width as u32, (indices.len() / width) as u32);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(depth);
    encoder.set_palette(palette.as_flattened());
    encoder.set_deflate_compression(DeflateCompression::Level(9));
    // Neighboring indices of a palette are not neighboring colors.
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&packed)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use png::{Decoder, Transformations};
    use std::io::Cursor;

    const WHITE: Color = [255; 3];
    const INK: Color = [11, 22, 33];

    /// A white page with a dark line, and a noisy photograph in its lower half.
    fn page() -> Picture {
        let (width, height) = (200, 160);
        let mut state = 1_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let pixels = (0..width * height).map(|place| match place / width {
            20..22 => INK,
            0..80 => WHITE,
            _ => [noise(), noise(), noise()],
        });
        Picture {
            width,
            pixels: pixels.collect(),
        }
    }

    /// Returns the size of the palette and the colors of all pixels.
    fn read(file: &[u8]) -> (usize, Vec<Color>) {
        let mut decoder = Decoder::new(Cursor::new(file));
        decoder.set_transformations(Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let palette = reader.info().palette.as_ref().unwrap();
        (palette.len() / 3, pixels.as_chunks().0.to_vec())
    }

    #[test]
    fn drawings_keep_their_colors_and_photos_become_coarse() {
        let picture = page();
        let png = small(&picture).unwrap();
        let (palette, pixels) = read(&png);
        assert!(palette <= 32);
        assert_eq!(pixels.len(), picture.pixels.len());
        let drawn = 80 * picture.width;
        assert_eq!(pixels[..drawn], picture.pixels[..drawn]);
        // Noise at three bytes per pixel would take 48 kB.
        assert!(png.len() < 12_000, "{} bytes", png.len());
    }

    #[test]
    fn few_colors_stay_exactly_as_they_are() {
        for colors in [1, 2, 3, 5, 17] {
            let shades: Vec<Color> = (0..colors).map(|level| [level * 9, 200, level]).collect();
            let width = 7;
            let pixels: Vec<Color> = (0..width * 34)
                .map(|place| shades[place % shades.len()])
                .collect();
            let picture = Picture { width, pixels };
            assert_eq!(
                read(&small(&picture).unwrap()).1,
                picture.pixels,
                "{colors}"
            );
        }
    }

    #[test]
    fn reducing_is_a_mean_of_what_is_covered() {
        let poster = Poster {
            width: 3,
            height: 2,
            rgba: [[0; 3], [90; 3], [240; 3]]
                .repeat(2)
                .iter()
                .flat_map(|[r, g, b]| [*r, *g, *b, 255])
                .collect(),
        };
        // Three columns become two, each of which covers one and a half.
        let picture = Picture::reduced(&poster, 2).unwrap();
        assert_eq!(picture.pixels, vec![[30; 3], [190; 3]]);
        assert_eq!(Picture::reduced(&poster, 9).unwrap().pixels.len(), 6);
    }
}
