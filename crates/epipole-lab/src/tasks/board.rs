//! The board in a photograph of full size: read and searched in one go, so that only a small picture travels.

use super::convert::{core_board, to_image};
use super::photograph::{read, reduced};
use super::{BoardFound, BoardOptions, Progress, Source, Told};
use epipole::calibration::{BoardSearch, find_board};
use epipole::feature::photo_to_gray;

/// Pixels of the picture for the screen.
const SHOWN_PIXELS: u32 = 1_200_000;

/// Looks for a board just as `epipole calibrate` does.
///
/// # Errors
/// A sentence: for a file that cannot be read, for a board that is none, and if `progress` wants no more.
pub(super) fn board(
    source: &Source,
    options: &BoardOptions,
    progress: Progress<'_>,
) -> Result<BoardFound, String> {
    let mut tell = |share, words: &str| match progress(Told::Share(share, words)).is_break() {
        true => Err("stopped".to_owned()),
        false => Ok(()),
    };
    // The unit of length does not matter here.
    let board = core_board(options, 1.0)?;
    tell(0.0, "reading")?;
    let whole = read(source)?;
    tell(0.3, "searching")?;
    let search = find_board(&photo_to_gray(&to_image(&whole)?), &board)
        .map_err(|error| error.to_string())?;
    let problem = search.problem(&board);
    let other_grid = match search {
        BoardSearch::Partial { columns, rows, .. } => Some((columns as u32, rows as u32)),
        BoardSearch::Found(_) | BoardSearch::Nothing => None,
    };
    let marks = search.view().map_or_else(Vec::new, |view| view.pixels);
    Ok(BoardFound {
        picture: reduced(whole, SHOWN_PIXELS)?,
        marks: (marks.iter()).map(|mark| mark.map(Into::into)).collect(),
        problem,
        other_grid,
    })
}
