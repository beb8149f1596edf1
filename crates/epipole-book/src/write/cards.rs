//! Cards: preview pictures of pages for other sites, with title and first figure.

use super::assets::add_hashed;
use crate::parallel;
use crate::render::page::{FigureEntry, Page};
use anyhow::{Context, Result, anyhow};
use epipole_canvas::Rect;
use epipole_canvas::canvas::{Canvas, Picture, Stroke, TextStyle, paragraph_height};
use epipole_canvas::theme::{Role, Theme};
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use serde::Serialize;
use std::collections::BTreeMap;

/// Width, pixels, as recommended by large sites.
const WIDTH: u32 = 1200;
const HEIGHT: u32 = 630;
const QUALITY: u8 = 85;

const MARGIN: f64 = 56.0;
const TITLE_SIZE: f64 = 50.0;
/// Font size above the title, pixels.
const BOOK_SIZE: f64 = 28.0;
/// Gap between title and picture, pixels.
const GAP: f64 = 20.0;

/// A card and its text.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Card {
    /// Path from the root of the site, or its address.
    pub(crate) path: String,
    pub(crate) alt: String,
}

/// Draws a card for each page, using the posters in the files of the site, and adds them to these
/// files. Returns them by the paths of their pages.
///
/// # Errors
/// An unreadable poster.
pub(crate) fn add(
    files: &mut BTreeMap<String, Vec<u8>>,
    book_title: &str,
    pages: &[Page],
) -> Result<BTreeMap<String, Card>> {
    let drawn = parallel::map(pages.iter().collect(), |page: &Page| {
        let figure = page.figures.first();
        let poster = figure.and_then(|figure| files.get(&figure.poster));
        let title = title(book_title, page);
        draw(book_title, title, poster.map(Vec::as_slice))
            .with_context(|| format!("the card of {} cannot be drawn", page.path))
    });
    let mut cards = BTreeMap::new();
    for (page, bytes) in pages.iter().zip(drawn) {
        let name = page.path.replace(".html", "").replace('/', "-");
        let card = Card {
            path: add_hashed(files, &format!("cards/{name}"), "jpg", bytes?),
            alt: alt(title(book_title, page), page.figures.first()),
        };
        cards.insert(page.path.clone(), card);
    }
    Ok(cards)
}

/// Returns the title of the card: that of the book on its first page.
fn title<'a>(book_title: &'a str, page: &'a Page) -> &'a str {
    match page.path.as_str() {
        "index.html" => book_title,
        _ => &page.title,
    }
}

fn alt(title: &str, figure: Option<&FigureEntry>) -> String {
    match figure {
        Some(figure) => format!("{title}. {}", figure.description),
        None => title.to_owned(),
    }
}

/// Draws a JPEG of the title, and of the poster below it if there is one.
fn draw(book_title: &str, title: &str, poster: Option<&[u8]>) -> Result<Vec<u8>> {
    let (width, height) = (f64::from(WIDTH), f64::from(HEIGHT));
    let mut canvas = Canvas::new(width, height, 1.0, Theme::Light, Picture::default())?;
    let room = width - 2.0 * MARGIN;
    let title_height = paragraph_height(title, TITLE_SIZE, room);
    let poster = poster.map(decoded).transpose()?;
    let title_top = match &poster {
        Some(_) => MARGIN + BOOK_SIZE,
        None => (height - title_height) / 2.0,
    };
    if title != book_title {
        let place = (MARGIN, title_top - 0.5 * BOOK_SIZE);
        canvas.text(place, book_title, TextStyle::new(Role::Muted, BOOK_SIZE));
    }
    let style = TextStyle::new(Role::Ink, TITLE_SIZE);
    canvas.paragraph(
        Rect::new(MARGIN, title_top, room, title_height),
        title,
        style,
    );
    if let Some(poster) = &poster {
        let top = title_top + title_height + GAP;
        let rect = fitted(
            poster.dimensions(),
            Rect::new(MARGIN, top, room, height - MARGIN - top),
        );
        canvas.photograph(rect, poster);
        canvas.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
    }
    jpeg(&canvas.finish())
}

/// Fits a picture into a rectangle, as large as possible and aligned to its left edge.
fn fitted((width, height): (u32, u32), room: Rect) -> Rect {
    let (width, height) = (f64::from(width), f64::from(height));
    let scale = (room.width / width).min(room.height / height);
    Rect::new(room.x, room.y, width * scale, height * scale)
}

fn decoded(webp: &[u8]) -> Result<RgbImage> {
    let image = webp::Decoder::new(webp).decode();
    let image = image.ok_or_else(|| anyhow!("the poster is no WebP"))?;
    let pixels = match image.is_alpha() {
        true => image
            .chunks_exact(4)
            .flat_map(|p| [p[0], p[1], p[2]])
            .collect(),
        false => image.to_vec(),
    };
    RgbImage::from_raw(image.width(), image.height(), pixels).context("the poster is too short")
}

fn jpeg(picture: &Picture) -> Result<Vec<u8>> {
    let pixels = picture.rgba().chunks_exact(4);
    let rgb: Vec<u8> = pixels.flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY).write_image(
        &rgb,
        picture.width(),
        picture.height(),
        ExtendedColorType::Rgb8,
    )?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_shape_in_its_room() {
        let room = Rect::new(50.0, 100.0, 600.0, 400.0);
        assert_eq!(
            fitted((1200, 600), room),
            Rect::new(50.0, 100.0, 600.0, 300.0)
        );
        assert_eq!(
            fitted((500, 1000), room),
            Rect::new(50.0, 100.0, 200.0, 400.0)
        );
    }

    #[test]
    fn a_card_is_a_jpeg_of_its_size() {
        let rgba = [200, 40, 40, 255].repeat(40 * 20);
        let poster = webp::Encoder::from_rgba(&rgba, 40, 20).encode(80.0);
        let with = draw("Tiny", "A long title of many words", Some(&poster)).unwrap();
        let without = draw("Tiny", "A long title of many words", None).unwrap();
        assert_ne!(with, without);
        let image = image::load_from_memory(&with).unwrap().to_rgb8();
        assert_eq!(image.dimensions(), (WIDTH, HEIGHT));
        let [red, green, _] = image.get_pixel(400, 400).0;
        assert!(red > 150 && green < 90, "{red} {green}");
    }
}
