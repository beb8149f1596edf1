//! The board in a photograph of full size: read and searched in one go, so that only a small
//! picture travels.

use super::board_sample;
use super::convert::{core_board, unreadable};
use super::{BoardFound, BoardOptions, Photograph, Progress, Sample, Source, Thumbnail, Told};
use epipole::calibration::{BoardSearch, find_board};
use epipole::feature::photo_to_gray;
use epipole::imaging::reduce_rgb;
use epipole_io::photo::{DecodeOptions, decode_rgb};
use image::RgbImage;

/// Pixels of the picture for the screen.
const SHOWN_PIXELS: u64 = 1_200_000;

/// Looks for a board just as `epipole calibrate` does.
///
/// # Errors
/// A sentence: for a file that cannot be read, for a board that is none, and if `progress` wants no
/// more.
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
    let whole = of_sensor(source)?;
    let sensor_size = whole.dimensions();
    tell(0.3, "searching")?;
    let search = find_board(&photo_to_gray(&whole), &board).map_err(|error| error.to_string())?;
    let problem = search.problem(&board);
    let other_grid = match search {
        BoardSearch::Partial { columns, rows, .. } => Some((columns as u32, rows as u32)),
        BoardSearch::Found(_) | BoardSearch::Markers { .. } | BoardSearch::Nothing => None,
    };
    let marks = search.view().map_or_else(Vec::new, |view| view.pixels);
    let picture = reduce_rgb(whole, SHOWN_PIXELS);
    let (width, height) = picture.dimensions();
    let small = Thumbnail::new((width, height), &picture);
    Ok(BoardFound {
        picture: Photograph {
            width,
            height,
            rgb: picture.into_raw().into(),
            small,
            focal_px: None,
            k: None,
            full_size: sensor_size,
            sensor_size,
            as_given: (width, height) == sensor_size,
        },
        marks: (marks.iter()).map(|mark| mark.map(Into::into)).collect(),
        problem,
        other_grid,
    })
}

/// The photograph as the sensor gave it, which is not always upright: a lens knows no other frame.
///
/// # Errors
/// A sentence, if a file is none that can be read, or there is no such photograph of a board.
fn of_sensor(source: &Source) -> Result<RgbImage, String> {
    let bytes = match source {
        Source::File(bytes) => bytes,
        Source::Rendered(Sample::Board, index) => {
            let image = board_sample::photograph(*index).map_err(|error| error.to_string())?;
            return image.ok_or_else(|| "the sample has no such photograph".to_owned());
        }
        Source::Rendered(..) => return Err("there is no board in this sample".to_owned()),
    };
    let as_stored = DecodeOptions::default().with_apply_orientation(false);
    let decoded = decode_rgb(bytes, &as_stored).map_err(unreadable)?;
    Ok(decoded.image)
}
