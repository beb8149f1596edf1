//! Layout of a board on paper.

use super::paper::Paper;
use crate::failure::Failure;
use epipole::calibration::BoardDrawing;

/// Margin of the paper, which printers cannot reach.
const MARGIN_MM: f64 = 6.0;
/// Height of a line of the caption.
const LINE_MM: f64 = 3.5;
/// Height of the ruler with its numbers.
const RULER_MM: f64 = 6.5;
/// Gap between board and caption.
const GAP_MM: f64 = 4.0;
/// Size of the text.
const TEXT_MM: f64 = 2.6;
/// Largest size of the number of a marker.
const LABEL_MM: f64 = 2.0;
/// Upper bound of the mean letter width, relative to the text size.
const LETTER: f64 = 0.56;
/// Longest ruler.
const RULER_LENGTH_MM: f64 = 100.0;
/// Thickness of the ruler's lines.
const THIN_MM: f64 = 0.25;

/// A line of text; `x` and `y` are the left end of its baseline.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Text {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) size: f64,
    pub(super) text: String,
}

/// Black shapes and texts on white paper: millimeters from its upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Page {
    pub(super) paper_mm: [f64; 2],
    /// Width and height of the black area of the board.
    pub(super) board_mm: [f64; 2],
    /// Left, top, width and height.
    pub(super) rectangles: Vec<[f64; 4]>,
    /// Center and radius.
    pub(super) disks: Vec<[f64; 3]>,
    pub(super) texts: Vec<Text>,
}

impl Page {
    /// Centers the drawing, with the caption and a ruler below.
    ///
    /// * `labels`: texts on the drawing and the left end of their baselines, squares
    /// * `mm`: side of a square
    ///
    /// # Errors
    /// If the board does not fit.
    pub(super) fn new(
        drawing: &BoardDrawing,
        labels: &[([f64; 2], String)],
        mm: f64,
        paper: Paper,
        caption: &[String],
    ) -> Result<Self, Failure> {
        let radius = drawing.disk_radius;
        let corners = drawing.rectangles.iter().flatten();
        let mut points: Vec<[f64; 2]> = corners.map(|p| [p.x, p.y]).collect();
        for p in &drawing.disks {
            points.extend([[p.x - radius, p.y - radius], [p.x + radius, p.y + radius]]);
        }
        let most = |axis: usize, sign: f64| {
            let values = points.iter().map(|p| sign * p[axis]);
            sign * values.fold(f64::NEG_INFINITY, f64::max)
        };
        let [left, top] = [0, 1].map(|axis| most(axis, -1.0));
        let board_mm = [mm * (most(0, 1.0) - left), mm * (most(1, 1.0) - top)];
        let footer_mm = GAP_MM + RULER_MM + LINE_MM * caption.len() as f64;
        let (paper_mm, free_mm) = fitting(board_mm, paper, footer_mm, mm)?;
        let x0 = (paper_mm[0] - board_mm[0]) / 2.0;
        let y0 = MARGIN_MM + (free_mm[1] - board_mm[1]) / 2.0;
        let place = |x: f64, y: f64| (x0 + mm * (x - left), y0 + mm * (y - top));
        let mut page = Self {
            paper_mm,
            board_mm,
            rectangles: Vec::new(),
            disks: Vec::new(),
            texts: Vec::new(),
        };
        for [a, b] in &drawing.rectangles {
            let (x, y) = place(a.x, a.y);
            page.rectangles
                .push([x, y, mm * (b.x - a.x), mm * (b.y - a.y)]);
        }
        for p in &drawing.disks {
            let (x, y) = place(p.x, p.y);
            page.disks.push([x, y, mm * radius]);
        }
        for ([x, y], text) in labels {
            let (x, y) = place(*x, *y);
            page.texts.push(Text {
                x,
                y,
                size: LABEL_MM.min(0.06 * mm),
                text: text.clone(),
            });
        }
        page.add_footer(caption, paper_mm[1] - MARGIN_MM - footer_mm + GAP_MM);
        Ok(page)
    }

    fn add_footer(&mut self, caption: &[String], top: f64) {
        let width = self.paper_mm[0] - 2.0 * MARGIN_MM;
        let longest = caption.iter().map(|line| line.chars().count()).max();
        let size = TEXT_MM.min(width / (LETTER * longest.unwrap_or(1).max(1) as f64));
        for (index, text) in caption.iter().enumerate() {
            self.texts.push(Text {
                x: MARGIN_MM,
                y: top + LINE_MM * (index as f64 + 0.8),
                size,
                text: text.clone(),
            });
        }
        let steps = (width.min(RULER_LENGTH_MM) / 10.0).floor();
        let y = top + LINE_MM * caption.len() as f64 + 0.5;
        // The outer ticks are flush with the ends of the ruler.
        self.rectangles.push([MARGIN_MM, y, 10.0 * steps, THIN_MM]);
        for step in 0..=steps as u32 {
            let height = if step % 5 == 0 { 2.5 } else { 1.5 };
            let fraction = f64::from(step) / steps.max(1.0);
            let x = MARGIN_MM + 10.0 * f64::from(step) - THIN_MM * fraction;
            self.rectangles.push([x, y + THIN_MM, THIN_MM, height]);
        }
        for (step, unit) in [(0.0, ""), (steps, " mm")] {
            self.texts.push(Text {
                x: MARGIN_MM + 10.0 * step,
                y: y + 2.5 + TEXT_MM,
                size: TEXT_MM,
                text: format!("{:.0}{unit}", 10.0 * step),
            });
        }
    }
}

/// Returns the size of the paper, rotated if that helps, and the room for the board, millimeters.
///
/// * `square_mm`: side of a square, for the advice in the error
fn fitting(
    board_mm: [f64; 2],
    paper: Paper,
    footer_mm: f64,
    square_mm: f64,
) -> Result<([f64; 2], [f64; 2]), Failure> {
    let portrait = [paper.width_mm, paper.height_mm];
    let rotated = [paper.height_mm, paper.width_mm];
    let room = |paper: [f64; 2]| {
        [
            paper[0] - 2.0 * MARGIN_MM,
            paper[1] - 2.0 * MARGIN_MM - footer_mm,
        ]
    };
    // Largest possible scale of the board.
    let scale = |paper: [f64; 2]| {
        let [width, height] = room(paper);
        (width / board_mm[0]).min(height / board_mm[1])
    };
    let best = match paper.may_rotate && scale(rotated) > scale(portrait) {
        true => rotated,
        false => portrait,
    };
    let scale = scale(best);
    if scale < 1.0 {
        let [width, height] = room(best);
        let advice = match (10.0 * square_mm * scale).floor() / 10.0 {
            largest if largest > 0.0 => {
                format!("take --square-mm {largest} at most, or larger paper")
            }
            _ => "take larger paper".to_owned(),
        };
        return Err(Failure::usage(format!(
            "the board of {:.1} × {:.1} mm does not fit: the paper of {} × {} mm leaves {:.1} × {:.1} mm; {advice}",
            board_mm[0],
            board_mm[1],
            best[0],
            best[1],
            width.max(0.0),
            height.max(0.0)
        )));
    }
    Ok((best, room(best)))
}
