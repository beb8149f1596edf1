//! The report as a PDF of one page.

use epipole_io::photo::encode_jpeg;
use image::RgbImage;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};

/// Width and height of A4, and the margin, points.
const PAGE: [f32; 2] = [595.28, 841.89];
const MARGIN: f32 = 42.5;
/// Size of the text and distance of its lines, points.
const TEXT: f32 = 9.0;
const LINE: f32 = 12.0;
/// Upper bound of the mean letter width, relative to the text size.
const LETTER: f32 = 0.56;
/// Width of the column of facts, and of names in tables, points.
const FACTS_WIDTH: f32 = 240.0;
const NAME_WIDTH: f32 = 130.0;
/// Height of the row of photographs, points.
const PHOTOS_HEIGHT: f32 = 120.0;

/// A photograph with marks.
pub(super) struct Photo {
    pub(super) name: String,
    pub(super) image: RgbImage,
    /// Places, as ratios of width and height, with labels.
    pub(super) marks: Vec<([f64; 2], String)>,
}

/// Contents of the page.
pub(super) struct Paper {
    pub(super) title: String,
    pub(super) facts: Vec<String>,
    /// Heading and rows of each table; empty ones are left out.
    pub(super) tables: Vec<(String, Vec<(String, String)>)>,
    pub(super) picture: Option<RgbImage>,
    pub(super) photos: Vec<Photo>,
}

/// Writes the page.
///
/// # Errors
/// A message, if a picture cannot be compressed.
pub(super) fn pdf(paper: &Paper) -> Result<Vec<u8>, String> {
    let [catalog, pages, sheet, regular, bold, contents] = [1, 2, 3, 4, 5, 6].map(Ref::new);
    let photos = paper.photos.iter().map(|photo| &photo.image);
    let images: Vec<&RgbImage> = paper.picture.iter().chain(photos).collect();
    let names: Vec<String> = (0..images.len()).map(|n| format!("I{n}")).collect();
    let image_ref = |n: usize| Ref::new(7 + n as i32);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([sheet]).count(1);
    let mut leaf = pdf.page(sheet);
    leaf.parent(pages).contents(contents);
    leaf.media_box(Rect::new(0.0, 0.0, PAGE[0], PAGE[1]));
    let mut resources = leaf.resources();
    let mut fonts = resources.fonts();
    fonts.pair(Name(b"F"), regular).pair(Name(b"B"), bold);
    fonts.finish();
    let mut objects = resources.x_objects();
    for (n, name) in names.iter().enumerate() {
        objects.pair(Name(name.as_bytes()), image_ref(n));
    }
    objects.finish();
    resources.finish();
    leaf.finish();
    for (font, name) in [(regular, "Helvetica"), (bold, "Helvetica-Bold")] {
        let mut font = pdf.type1_font(font);
        font.base_font(Name(name.as_bytes()));
        font.encoding_predefined(Name(b"WinAnsiEncoding"));
    }
    for (n, image) in images.iter().enumerate() {
        let bytes = encode_jpeg(image).map_err(|error| error.to_string())?;
        let mut object = pdf.image_xobject(image_ref(n), &bytes);
        object.filter(Filter::DctDecode);
        object
            .width(image.width() as i32)
            .height(image.height() as i32);
        object.color_space().device_rgb();
        object.bits_per_component(8);
    }
    pdf.stream(contents, &drawn(paper, &names));
    Ok(pdf.finish())
}

/// Encodes a text for the fonts' encoding; other letters become question marks.
fn encoded(text: &str) -> Vec<u8> {
    let byte = |c: char| match c as u32 {
        code @ (0x20..=0x7e | 0xa0..=0xff) => code as u8,
        0x2212 | 0x2013 => b'-',
        _ => b'?',
    };
    text.chars().map(byte).collect()
}

/// Breaks a text into lines of a width, points.
fn broken(text: &str, width: f32) -> Vec<String> {
    let most = (width / (TEXT * LETTER)) as usize;
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > 0 && line + 1 + word.chars().count() > most {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

/// Pen that moves down the page.
struct Pen {
    content: Content,
    /// Height of the next line above the lower edge.
    y: f32,
}

impl Pen {
    fn text(&mut self, font: &[u8], size: f32, at: [f32; 2], text: &str) {
        self.content
            .begin_text()
            .set_font(Name(font), size)
            .next_line(at[0], at[1])
            .show(Str(&encoded(text)))
            .end_text();
    }

    fn image(&mut self, name: &str, [x, y, width, height]: [f32; 4]) {
        self.content
            .save_state()
            .transform([width, 0.0, 0.0, height, x, y])
            .x_object(Name(name.as_bytes()))
            .restore_state();
    }
}

/// Draws the page.
fn drawn(paper: &Paper, names: &[String]) -> Vec<u8> {
    let mut names = names.iter();
    let mut pen = Pen {
        content: Content::new(),
        y: PAGE[1] - MARGIN - 16.0,
    };
    pen.text(b"B", 18.0, [MARGIN, pen.y], &paper.title);
    pen.y -= 2.0 * LINE;
    let top = pen.y;
    for fact in &paper.facts {
        for line in broken(fact, FACTS_WIDTH) {
            pen.text(b"F", TEXT, [MARGIN, pen.y], &line);
            pen.y -= LINE;
        }
    }
    if let (Some(picture), Some(name)) = (
        &paper.picture,
        names.next().filter(|_| paper.picture.is_some()),
    ) {
        let x = MARGIN + FACTS_WIDTH + LINE;
        let width = PAGE[0] - MARGIN - x;
        let height = width * picture.height() as f32 / picture.width().max(1) as f32;
        let low = top + TEXT - height;
        pen.image(name, [x, low, width, height]);
        pen.y = pen.y.min(low - LINE);
    }
    let bottom = match paper.photos.is_empty() {
        true => MARGIN,
        false => MARGIN + PHOTOS_HEIGHT + 2.0 * LINE,
    };
    tables(&mut pen, &paper.tables, bottom);
    photos(&mut pen, &paper.photos, names);
    pen.content.finish().to_vec()
}

/// Draws the tables as far as they fit above a height, and the number of rows that do not.
fn tables(pen: &mut Pen, tables: &[(String, Vec<(String, String)>)], bottom: f32) {
    let mut num_left = 0;
    for (heading, rows) in tables.iter().filter(|(_, rows)| !rows.is_empty()) {
        if pen.y - 4.0 * LINE < bottom {
            num_left += rows.len();
            continue;
        }
        pen.y -= 0.5 * LINE;
        pen.text(b"B", 11.0, [MARGIN, pen.y], heading);
        pen.y -= 1.3 * LINE;
        for (name, value) in rows {
            let names = broken(name, NAME_WIDTH - LINE);
            let values = broken(value, PAGE[0] - 2.0 * MARGIN - NAME_WIDTH);
            let count = names.len().max(values.len());
            // A line stays free for the number of rows left out.
            if pen.y - (count as f32) * LINE < bottom {
                num_left += 1;
                continue;
            }
            for n in 0..count {
                for (x, lines) in [(MARGIN, &names), (MARGIN + NAME_WIDTH, &values)] {
                    if let Some(line) = lines.get(n) {
                        pen.text(b"F", TEXT, [x, pen.y], line);
                    }
                }
                pen.y -= LINE;
            }
        }
    }
    if num_left > 0 {
        let words = format!("{num_left} more in measures.csv");
        pen.text(b"F", TEXT, [MARGIN, pen.y], &words);
    }
}

/// Draws the photographs with their marks and names at the lower edge.
fn photos<'a>(pen: &mut Pen, photos: &[Photo], names: impl Iterator<Item = &'a String>) {
    let count = photos.len().max(1) as f32;
    let gap = 8.0;
    let most = ((PAGE[0] - 2.0 * MARGIN + gap) / count - gap).min(180.0);
    for (n, (photo, name)) in photos.iter().zip(names).enumerate() {
        let (width, height) = (photo.image.width() as f32, photo.image.height() as f32);
        let scale = (most / width).min(PHOTOS_HEIGHT / height);
        let (width, height) = (scale * width, scale * height);
        let (x, y) = (MARGIN + n as f32 * (most + gap), MARGIN + LINE);
        pen.image(name, [x, y, width, height]);
        pen.text(b"F", 7.0, [x, MARGIN], &photo.name);
        for ([u, v], label) in &photo.marks {
            let at = [x + *u as f32 * width, y + (1.0 - *v as f32) * height];
            mark(pen, at, label);
        }
    }
}

/// Draws a mark: a cross in white and in red, with its label on white.
fn mark(pen: &mut Pen, [x, y]: [f32; 2], label: &str) {
    for (width, color) in [(2.2, [1.0, 1.0, 1.0]), (0.9, [0.8, 0.24, 0.11])] {
        let [red, green, blue] = color;
        pen.content
            .set_stroke_rgb(red, green, blue)
            .set_line_width(width);
        for [dx, dy] in [[3.5, 0.0], [0.0, 3.5]] {
            pen.content
                .move_to(x - dx, y - dy)
                .line_to(x + dx, y + dy)
                .stroke();
        }
    }
    let width = 6.0 * LETTER * label.chars().count() as f32 + 1.0;
    pen.content.set_fill_rgb(1.0, 1.0, 1.0);
    pen.content
        .rect(x + 3.0, y + 2.0, width, 6.5)
        .fill_nonzero();
    pen.content.set_fill_rgb(0.0, 0.0, 0.0);
    pen.text(b"F", 6.0, [x + 3.5, y + 3.2], label);
}
