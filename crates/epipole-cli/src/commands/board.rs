//! `epipole board`: a calibration board to print.

mod page;
mod paper;
mod pdf;
mod png;
mod sheet;
mod svg;

use self::page::Page;
use self::paper::{Paper, paper};
use self::sheet::{Sheet, SheetArguments};
use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::matrices::positive;
use crate::pattern::{PatternArguments, columns_and_rows};
use crate::report::Report;
use clap::Args;
use epipole::calibration::{Board, Pattern};
use serde_json::json;
use std::path::PathBuf;

/// Last line of a caption.
const AT_SCALE: &str = "Print at 100%, and measure the ruler.";

/// Draw a calibration board or markers to print, true to scale.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole board --kind charuco --size 7x5 --square-mm 30 --marker-mm 22 -o board.pdf\n\n\
    Print at 100%, without \"fit to page\": the ruler below the board must be 100 mm long. Glue the sheet to\n\
    something flat. The caption names the options with which `epipole calibrate` reads the board.\n\n\
    ChArUco boards are those of OpenCV from 4.6 on: the upper left square is black (no legacyPattern), and\n\
    markers are numbered row by row. AprilGrids are those of Kalibr: tag 0 is at the lower left, and borders are\n\
    two bits wide; --square-mm is the side of a tag.\n\n\
    Single markers: epipole board --markers 36h11 --size 3x4 --square-mm 45 --first-id 10 -o markers.pdf\n\n\
    JSON: files, kind, size (columns and rows), square_mm, paper_mm and board_mm (width and height of the black\n\
    area), calibrate (options of `epipole calibrate` for this board). With --markers, kind is \"markers\", and\n\
    detect (options of `epipole detect`), ids (first and last) and gap_mm replace calibrate."
)]
pub(crate) struct Arguments {
    /// Columns and rows of the board (inner corners of a chessboard, squares of a ChArUco board,
    /// tags of an AprilGrid, disks) or of single markers.
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = columns_and_rows)]
    size: (usize, usize),
    /// Side of a square, tag or marker, mm. For circles, the distance between rows.
    #[arg(long, value_name = "S", default_value_t = 25.0, value_parser = positive)]
    square_mm: f64,
    /// Side of a ChArUco marker, mm [default: three quarters of a square].
    #[arg(long, value_name = "M", value_parser = positive)]
    marker_mm: Option<f64>,
    /// Paper size (a4, a3, letter, or WIDTHxHEIGHT in millimeters; named sizes are rotated to fit
    /// the board).
    #[arg(long, value_name = "PAPER", default_value = "a4", value_parser = paper)]
    paper: Paper,
    /// Pixels per inch of a PNG.
    #[arg(long, value_name = "N", default_value_t = 300.0, value_parser = positive)]
    dpi: f64,
    /// Output file, .pdf, .svg or .png.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    pattern: PatternArguments,
    #[command(flatten)]
    sheet: SheetArguments,
}

pub(crate) fn run(arguments: &Arguments, _: &Context) -> Result<Report, Failure> {
    match (arguments.sheet).sheet(arguments.size, arguments.square_mm)? {
        Some(sheet) => draw_sheet(arguments, &sheet),
        None => draw_board(arguments),
    }
}

fn draw_board(arguments: &Arguments) -> Result<Report, Failure> {
    let pattern = arguments
        .pattern
        .pattern(arguments.marker_mm, arguments.square_mm);
    if arguments.marker_mm.is_some() && !matches!(pattern, Pattern::Charuco { .. }) {
        return Err(Failure::usage(
            "--marker-mm is of --kind charuco: other boards have no such markers",
        ));
    }
    let (columns, rows) = arguments.size;
    let board = Board::new(pattern, columns, rows, arguments.square_mm / 1000.0)
        .map_err(|error| Failure::usage(error.to_string()))?;
    let options = calibrate_options(arguments, pattern);
    let caption = [
        sizes(arguments, pattern),
        format!("epipole calibrate PHOTOS {options}"),
        AT_SCALE.to_owned(),
    ];
    let mm = 1000.0 * board.square_m();
    let page = Page::new(&board.drawing(), &[], mm, arguments.paper, &caption)?;
    write(arguments, &page)?;
    Ok(report(arguments, &page, arguments.pattern.name())
        .field("calibrate", &options)
        .row("calibrate with", options))
}

fn draw_sheet(arguments: &Arguments, sheet: &Sheet) -> Result<Report, Failure> {
    let [first, last] = sheet.ids;
    let name = sheet.dictionary.name();
    let options = format!("--markers {name}");
    let caption = [
        format!(
            "Markers {name}, {first} to {last}, of {} mm, {:.2} mm apart",
            arguments.square_mm, sheet.gap_mm
        ),
        format!("epipole detect PHOTO {options}"),
        AT_SCALE.to_owned(),
    ];
    let page = Page::new(
        &sheet.drawing,
        &sheet.labels,
        arguments.square_mm,
        arguments.paper,
        &caption,
    )?;
    write(arguments, &page)?;
    Ok(report(arguments, &page, "markers".to_owned())
        .field("detect", &options)
        .field("ids", sheet.ids)
        .field("gap_mm", sheet.gap_mm)
        .row("markers", format!("{name}, {first} to {last}"))
        .row("detect with", options))
}

/// Writes the page in the format of the file extension.
fn write(arguments: &Arguments, page: &Page) -> Result<(), Failure> {
    let extension = arguments.output.extension().and_then(|e| e.to_str());
    let bytes = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("pdf") => pdf::pdf(page),
        Some("svg") => svg::svg(page).into_bytes(),
        Some("png") => png::png(page, arguments.dpi)?,
        _ => {
            return Err(Failure::usage(format!(
                "{} must end in .pdf, .svg or .png",
                arguments.output.display()
            )));
        }
    };
    files::write(&arguments.output, &bytes)
}

fn report(arguments: &Arguments, page: &Page, kind: String) -> Report {
    let ((columns, rows), [width, height]) = (arguments.size, page.board_mm);
    Report::default()
        .field("files", [&arguments.output])
        .field("kind", kind)
        .field("size", json!([columns, rows]))
        .field("square_mm", arguments.square_mm)
        .field("paper_mm", page.paper_mm)
        .field("board_mm", page.board_mm)
        .row("board", format!("{width:.1} × {height:.1} mm"))
        .row(
            "paper",
            format!("{} × {} mm", page.paper_mm[0], page.paper_mm[1]),
        )
        .row("written", arguments.output.display())
}

/// Returns the options of `epipole calibrate` that describe the board.
fn calibrate_options(arguments: &Arguments, pattern: Pattern) -> String {
    let (columns, rows) = arguments.size;
    let meters = |mm: f64| format!("{:.6}", mm / 1000.0);
    let trimmed = |mm: f64| meters(mm).trim_end_matches('0').to_owned();
    let mut options = format!(
        "--kind {} --board {columns}x{rows} --square-m {}",
        arguments.pattern.name(),
        trimmed(arguments.square_mm)
    );
    match pattern {
        Pattern::Charuco {
            dictionary,
            marker_ratio,
        } => {
            let marker = trimmed(marker_ratio * arguments.square_mm);
            options += &format!(" --marker-m {marker} --dictionary {}", dictionary.name());
        }
        Pattern::AprilGrid { spacing } => options += &format!(" --tag-spacing {spacing}"),
        Pattern::Chessboard | Pattern::Circles | Pattern::AsymmetricCircles => {}
    }
    options
}

/// Describes the sizes of the board, for its caption.
fn sizes(arguments: &Arguments, pattern: Pattern) -> String {
    let ((columns, rows), side) = (arguments.size, arguments.square_mm);
    match pattern {
        Pattern::Chessboard => format!("{columns} x {rows} inner corners, squares of {side} mm"),
        Pattern::Charuco {
            dictionary,
            marker_ratio,
        } => format!(
            "ChArUco, {columns} x {rows} squares of {side} mm, markers {} of {:.2} mm",
            dictionary.name(),
            marker_ratio * side
        ),
        Pattern::AprilGrid { spacing } => format!(
            "AprilGrid, {columns} x {rows} tags 36h11 of {side} mm, {:.2} mm apart",
            spacing * side
        ),
        Pattern::Circles => format!("{columns} x {rows} circles, {side} mm apart"),
        Pattern::AsymmetricCircles => {
            format!("{columns} x {rows} circles in shifted rows, {side} mm between rows")
        }
    }
}
