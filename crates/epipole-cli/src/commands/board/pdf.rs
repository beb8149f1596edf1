//! A page as PDF, in vectors.

use super::page::Page;
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str};

const POINTS_PER_MM: f64 = 72.0 / 25.4;
/// Distance of the control points of a quarter of the unit circle.
const QUARTER: f64 = 0.552_284_75;

/// Writes the page.
pub(super) fn pdf(page: &Page) -> Vec<u8> {
    let [catalog, pages, sheet, font, contents] = [1, 2, 3, 4, 5].map(Ref::new);
    let [width, height] = page.paper_mm.map(|side| (side * POINTS_PER_MM) as f32);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([sheet]).count(1);
    let mut leaf = pdf.page(sheet);
    leaf.parent(pages).contents(contents);
    leaf.media_box(Rect::new(0.0, 0.0, width, height));
    leaf.resources().fonts().pair(Name(b"F"), font);
    leaf.finish();
    pdf.type1_font(font).base_font(Name(b"Helvetica"));
    pdf.stream(contents, &content(page));
    pdf.finish()
}

fn content(page: &Page) -> Vec<u8> {
    let mut content = Content::new();
    let points = |mm: f64| (mm * POINTS_PER_MM) as f32;
    // The origin of PDF is the lower left corner.
    let up = |y: f64| points(page.paper_mm[1] - y);
    for [x, y, width, height] in &page.rectangles {
        content.rect(points(*x), up(y + height), points(*width), points(*height));
    }
    for [x, y, radius] in &page.disks {
        let at = |dx: f64, dy: f64| (points(x + radius * dx), up(y + radius * dy));
        let (u, v) = at(1.0, 0.0);
        content.move_to(u, v);
        let quarters = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        for (cosine, sine) in quarters {
            let a = at(cosine - QUARTER * sine, sine + QUARTER * cosine);
            let b = at(QUARTER * cosine - sine, QUARTER * sine + cosine);
            let c = at(-sine, cosine);
            content.cubic_to(a.0, a.1, b.0, b.1, c.0, c.1);
        }
        content.close_path();
    }
    // One path, to avoid seams between touching rectangles.
    content.fill_nonzero();
    for text in &page.texts {
        content
            .begin_text()
            .set_font(Name(b"F"), points(text.size))
            .next_line(points(text.x), up(text.y))
            .show(Str(text.text.as_bytes()))
            .end_text();
    }
    content.finish().to_vec()
}
