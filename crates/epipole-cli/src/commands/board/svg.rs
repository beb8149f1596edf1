//! A page as SVG, in millimeters.

use super::page::Page;
use std::fmt::Write;

/// Writes the page.
pub(super) fn svg(page: &Page) -> String {
    let [width, height] = page.paper_mm;
    let mut path = String::new();
    for [x, y, width, height] in &page.rectangles {
        // Writing to a string does not fail.
        let _ = write!(path, "M{x:.4} {y:.4}h{width:.4}v{height:.4}h-{width:.4}z");
    }
    for [x, y, radius] in &page.disks {
        let (left, across) = (x - radius, 2.0 * radius);
        let _ = write!(
            path,
            "M{left:.4} {y:.4}a{radius:.4} {radius:.4} 0 1 0 {across:.4} 0a{radius:.4} {radius:.4} 0 1 0 -{across:.4} 0z"
        );
    }
    let mut texts = String::new();
    for text in &page.texts {
        let _ = writeln!(
            texts,
            "<text x=\"{:.3}\" y=\"{:.3}\" font-size=\"{:.3}\" font-family=\"sans-serif\">{}</text>",
            text.x, text.y, text.size, text.text
        );
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<path d=\"{path}\"/>\n{texts}</svg>\n"
    )
}
