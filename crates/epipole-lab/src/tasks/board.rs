//! Board detection in a photograph of full size, read in the same task so that only a small image
//! is transferred.

use super::photograph::Photograph;
#[cfg(feature = "files")]
use super::task::{Monitor, Progress, Run, report};
use super::task::{Query, Task};
use crate::project::{BoardOptions, InputPhoto, Key, PhotoId, Project, Source, Step};
use serde::{Deserialize, Serialize};

/// Maximum number of pixels of the image for the screen.
#[cfg(feature = "files")]
const SHOWN_PIXELS: u64 = 1_200_000;

/// Result of board detection in a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoardFound {
    /// The photograph, downscaled for the screen.
    pub picture: Photograph,
    /// Pixel of each mark in the photograph of full size, row by row; `None` for hidden marks.
    /// Empty if the board was not found.
    pub marks: Vec<Option<[f64; 2]>>,
    /// Reason if the board was not found.
    pub problem: Option<String>,
    /// Marks along the longer and the shorter side of another grid that was found instead.
    pub other_grid: Option<(u32, u32)>,
}

impl BoardFound {
    /// Converts a position to the downscaled photograph.
    pub fn in_picture(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let full = self.picture.full_size;
        // Pixel centers are integers, so a photograph begins half a pixel before the first.
        let moved = |at: f64, small: u32, full: u32| {
            (at + 0.5) * f64::from(small) / f64::from(full.max(1)) - 0.5
        };
        [
            moved(u, self.picture.width, full.0),
            moved(v, self.picture.height, full.1),
        ]
    }

    /// Counts the visible marks.
    pub fn num_visible(&self) -> usize {
        self.marks.iter().flatten().count()
    }
}

/// Searches a photograph of full size for a board.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FindBoard {
    /// File or sample.
    pub source: Source,
    /// The board.
    pub options: BoardOptions,
}

impl Task for FindBoard {
    type Output = BoardFound;
}

/// Query for the board in the photograph with this number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BoardOf(pub PhotoId);

impl Query for BoardOf {
    type Task = FindBoard;
    const STEP: Step = Step::Calibrate;

    fn all(project: &Project) -> Vec<Self> {
        let boards = project.document.boards.iter();
        boards.map(|photo| Self(photo.id)).collect()
    }

    fn key(self, project: &Project) -> Option<Key> {
        let photo = project.document.board(self.0)?;
        let options = project.document.settings.calibration.board;
        Some(Key::of(&("board", photo.content.0, options)))
    }

    fn is_ready(self, project: &Project, _is_imported: bool) -> bool {
        let photo = project.document.board(self.0);
        photo.is_some_and(|photo| !photo.excluded)
    }

    /// Boards come first in their step, and last in all others.
    fn priority(self, project: &Project) -> u8 {
        match project.view.step {
            Step::Calibrate => 0,
            _ => 90,
        }
    }

    fn task(self, project: &Project) -> Option<FindBoard> {
        Some(FindBoard {
            source: project.document.board(self.0)?.source.clone(),
            options: project.document.settings.calibration.board,
        })
    }

    fn label(self, project: &Project) -> String {
        let name = project.document.name_of(self.0);
        format!("Looking for the board in {name}")
    }
}

impl Project {
    /// Returns the photographs of a board that take part.
    pub fn boards_taking_part(&self) -> Vec<&InputPhoto> {
        let readable = |photo: &&InputPhoto| self.failure(BoardOf(photo.id)).is_none();
        let boards = self.document.boards.iter();
        boards
            .filter(|photo| !photo.excluded)
            .filter(readable)
            .collect()
    }

    /// Returns the most frequent width and height among photographs in which the board was found;
    /// of ties, the first in the list.
    pub fn size_of_boards(&self) -> Option<(u32, u32)> {
        let found = |photo: &&InputPhoto| {
            Some(self.get(BoardOf(photo.id))?).filter(|found| !found.marks.is_empty())
        };
        let sizes: Vec<(u32, u32)> = (self.boards_taking_part().iter())
            .filter_map(found)
            .map(|found| found.picture.full_size)
            .collect();
        let count = |size: &(u32, u32)| sizes.iter().filter(|other| *other == size).count();
        // `max_by_key` returns the last of equals, hence the reversed order.
        sizes.iter().rev().max_by_key(|size| count(size)).copied()
    }
}

#[cfg(feature = "files")]
impl Run for FindBoard {
    /// Searches just as `epipole calibrate` does.
    fn run(self, monitor: Monitor<'_>) -> Result<BoardFound, String> {
        use super::convert::{core_board, sentence};
        use super::thumbnail::Thumbnail;
        use epipole::calibration::{BoardSearch, find_board};
        use epipole::feature::photo_to_gray;
        use epipole::imaging::reduce_rgb;
        use epipole::progress::Status;
        // The unit of length is irrelevant here.
        let board = core_board(&self.options, 1.0)?;
        report(monitor, 0.0, "reading")?;
        let whole = of_sensor(&self.source)?;
        let sensor_size = whole.dimensions();
        let mut watch =
            |status: Status| monitor(Progress::Share(0.3 + 0.7 * status.fraction, "searching"));
        let search = find_board(&photo_to_gray(&whole), &board, &mut watch).map_err(sentence)?;
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
                quarters: Some(0),
                as_given: (width, height) == sensor_size,
            },
            marks: (marks.iter()).map(|mark| mark.map(Into::into)).collect(),
            problem,
            other_grid,
        })
    }
}

/// Reads a photograph in the sensor's orientation, as lens distortion is defined in its frame.
///
/// # Errors
/// A message, if the file is unreadable, or there is no photograph of a board with this
/// index.
#[cfg(feature = "files")]
fn of_sensor(source: &Source) -> Result<image::RgbImage, String> {
    use super::board_sample;
    use super::convert::unreadable;
    use crate::project::Sample;
    use epipole_io::photo::{DecodeOptions, decode_rgb};

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
