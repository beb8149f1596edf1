//! Boards and markers in photos, and photos of boards.

use crate::argument::{Argument, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::images::{Gray, require_size};
use crate::options::{NoOptions, Options, Setting};
use crate::output::{Numbers, Text, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::calibration::{
    self, Board, BoardView, Marker, MarkerDictionary, MarkerOptions, Pattern,
};
use epipole::camera::{Camera, RigidTransform};
use epipole::imaging::GrayImage32;
use epipole::nalgebra::Point2;

structs! {
    /// Result of a search for a board.
    struct FoundBoard as FoundBoard {
        /// Pixel of each mark, row by row, interleaved; NaN for hidden marks. Null without a
        /// board.
        pixels: Option<Numbers>,
        /// Number of visible marks.
        num_visible: usize,
        /// Why the board was not found, as a sentence; null if it was.
        problem: Option<Text>,
    }

    /// Black shapes of a board, in squares; the first mark is at the origin, y points down.
    struct Drawing as BoardDrawing {
        /// Upper left and lower right corner of each rectangle, 4 numbers each.
        rectangles: Numbers,
        /// Centers of disks, interleaved.
        disks: Numbers,
        /// Radius of the disks.
        disk_radius: f64,
    }
}

records! {
    /// Square marker in a photo.
    Marker as Marker {
        /// Number in the dictionary.
        id: usize,
        /// Corners of the black border, pixels: clockwise from the one that is upper left in an
        /// upright marker.
        corners: [Point2<f64>; 4],
        /// Number of bits that differ from the dictionary's.
        hamming: u32,
    }
}

impl Argument for Board {
    fn typescript(types: &mut Types) -> String {
        let pattern = Setting::<Pattern>::typescript(types);
        types.interface(
            "Board",
            "Flat board with marks at known places: x along its columns, y along its rows, z = 0.",
            &[
                (
                    "pattern",
                    &pattern,
                    "Marks. Markers of a ChArUco board have `markerRatio` of the side of its \
                     squares; tags of an AprilGrid are `spacing` of their side apart.",
                ),
                (
                    "columns",
                    "number",
                    "Inner corners of a chessboard, squares of a ChArUco board, tags of an \
                     AprilGrid, disks in a row.",
                ),
                ("rows", "number", "The same along a column; rows of disks."),
                (
                    "squareM",
                    "number",
                    "Side of a square or a tag, or distance of two rows of disks, meters.",
                ),
            ],
        );
        "Board".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["pattern", "columns", "rows", "squareM"])?;
        let Setting(pattern) = entry::<Setting<Pattern>>(name, value, "pattern")?;
        let count = |key| -> Result<usize> { Ok(entry::<u32>(name, value, key)? as usize) };
        let (columns, rows) = (count("columns")?, count("rows")?);
        Self::new(pattern, columns, rows, entry(name, value, "squareM")?)
            .map_err(|error| Fault::of_range(format!("{name}: {error}")))
    }
}

/// Returns the pixels of all marks, NaN for hidden ones.
fn pixels(view: &BoardView) -> Numbers {
    let pixels = view.pixels.iter();
    let place = |pixel: &Option<Point2<f64>>| pixel.map_or([f64::NAN; 2], |p| [p.x, p.y]);
    Numbers(pixels.flat_map(place).collect())
}

functions! {
    /// Searches a photo for a board of any pattern. A chessboard may be partly hidden; of a board
    /// with markers, a part is enough.
    fn find_board(image: Gray, board: Board, options: NoOptions; monitor) -> FoundBoard {
        let NoOptions = options;
        let search = calibration::find_board(&image.0, &board, monitor)?;
        let problem = search.problem(&board).map(Text);
        let view = search.view();
        FoundBoard {
            num_visible: view.as_ref().map_or(0, BoardView::num_visible),
            pixels: view.as_ref().map(pixels),
            problem,
        }
    }

    /// Finds ArUco markers and AprilTags, in the order of their numbers.
    fn detect_markers(
        image: Gray, dictionary: Setting<MarkerDictionary>, options: Options<MarkerOptions>;
        monitor
    ) -> Vec<Marker> {
        calibration::detect_markers(&image.0, dictionary.0, &options.0, monitor)?
    }

    /// Places of all marks on a board, row by row, meters, interleaved.
    fn board_marks(board: Board) -> Numbers {
        let marks: Vec<_> = (0..board.num_marks()).map(|index| board.mark(index)).collect();
        Numbers::of_points(&marks)
    }

    /// Black shapes of a board, to print it.
    fn board_drawing(board: Board) -> Drawing {
        let drawing = board.drawing();
        let corners: Vec<_> = drawing.rectangles.iter().flatten().copied().collect();
        Drawing {
            rectangles: Numbers::of_points(&corners),
            disks: Numbers::of_points(&drawing.disks),
            disk_radius: drawing.disk_radius,
        }
    }

    /// Photo of a board with gray values in [0, 1], to test with exact truth. `noise` is the
    /// standard deviation of the gray values, 0 if not given.
    fn render_board(
        board: Board, camera: Camera, cam_from_board: RigidTransform, noise: Option<f64>,
        seed: Option<u32>; monitor
    ) -> GrayImage32 {
        require_size("camera", camera.width, camera.height)?;
        let (noise, seed) = (noise.unwrap_or(0.0), u64::from(seed.unwrap_or(0)));
        calibration::render_board(&board, &camera, &cam_from_board, noise, seed, monitor)?
    }
}
