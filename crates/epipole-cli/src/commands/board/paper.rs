//! Sizes of paper.

/// A sheet of paper, millimeters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paper {
    pub(super) width_mm: f64,
    pub(super) height_mm: f64,
    /// Whether it may be rotated by 90°.
    pub(super) may_rotate: bool,
}

/// Largest side, millimeters: a PDF page has at most 200 inches.
const LARGEST_MM: f64 = 5080.0;

/// Reads "a4", "a3", "letter" or "420x297".
pub(super) fn paper(text: &str) -> Result<Paper, String> {
    let named = match text.to_ascii_lowercase().as_str() {
        "a4" => Some((210.0, 297.0)),
        "a3" => Some((297.0, 420.0)),
        "letter" => Some((215.9, 279.4)),
        _ => None,
    };
    let may_rotate = named.is_some();
    let text_sides = || {
        let text = text.strip_suffix("mm").unwrap_or(text);
        let (width, height) = text.split_once(['x', 'X', '×'])?;
        Some((
            width.trim().parse::<f64>().ok()?,
            height.trim().parse::<f64>().ok()?,
        ))
    };
    let sides = 10.0..=LARGEST_MM;
    match named.or_else(text_sides) {
        Some((width_mm, height_mm)) if sides.contains(&width_mm) && sides.contains(&height_mm) => {
            Ok(Paper {
                width_mm,
                height_mm,
                may_rotate,
            })
        }
        _ => Err(format!(
            "\"{text}\" is none of a4, a3, letter, or a size in millimeters such as 420x297 (10 to 5080)"
        )),
    }
}
