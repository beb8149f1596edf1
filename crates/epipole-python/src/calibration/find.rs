//! Boards and markers in photos, and rendered photos of boards.

use super::board::{Board, BoardView};
use crate::arrays::from_points;
use crate::camera::{Camera, RigidTransform};
use crate::images::{from_gray, require_size, unit_gray};
use crate::record::record;
use crate::{options, progress};
use epipole::calibration;
use numpy::PyArray2;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Result of a search for a board.
    "epipole.calibration" BoardSearch {
        /// "found"; "partial", a grid of another size; "markers", too few marks of the board; or
        /// "nothing".
        kind: String,
        /// Visible marks, if the board was found.
        view: Option<BoardView>,
        /// Number of marks along the longer side of a partial board.
        columns: Option<usize>,
        /// Number of marks along the shorter side of a partial board.
        rows: Option<usize>,
        /// Number of visible marks of a partial board.
        num_visible: Option<usize>,
        /// Number of markers that belong to the board.
        num_of_board: Option<usize>,
        /// Number of other markers of the dictionary.
        num_others: Option<usize>,
    }
}

#[pymethods]
impl BoardSearch {
    /// Returns the reason the board was not found, as a sentence; None if it was.
    ///
    /// Parameters
    /// ----------
    /// board : Board
    ///     Board of the search.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If ``kind`` is unknown.
    fn problem(&self, board: &Board) -> PyResult<Option<String>> {
        use calibration::BoardSearch as Search;
        let search = match (&*self.kind, &self.view) {
            ("found", Some(view)) => Search::Found(view.0.clone()),
            ("partial", _) => Search::Partial {
                columns: self.columns.unwrap_or(0),
                rows: self.rows.unwrap_or(0),
                num_visible: self.num_visible.unwrap_or(0),
            },
            ("markers", _) => Search::Markers {
                num_of_board: self.num_of_board.unwrap_or(0),
                num_others: self.num_others.unwrap_or(0),
            },
            ("nothing", _) => Search::Nothing,
            (kind, _) => {
                return Err(PyValueError::new_err(format!("kind \"{kind}\" is unknown")));
            }
        };
        Ok(search.problem(&board.board))
    }
}

impl From<calibration::BoardSearch> for BoardSearch {
    fn from(search: calibration::BoardSearch) -> Self {
        use calibration::BoardSearch as Search;
        let mut found = Self {
            kind: "nothing".to_owned(),
            view: None,
            columns: None,
            rows: None,
            num_visible: None,
            num_of_board: None,
            num_others: None,
        };
        match search {
            Search::Found(view) => {
                found.kind = "found".to_owned();
                found.view = Some(BoardView(view));
            }
            Search::Partial {
                columns,
                rows,
                num_visible,
            } => {
                found.kind = "partial".to_owned();
                found.columns = Some(columns);
                found.rows = Some(rows);
                found.num_visible = Some(num_visible);
            }
            Search::Markers {
                num_of_board,
                num_others,
            } => {
                found.kind = "markers".to_owned();
                found.num_of_board = Some(num_of_board);
                found.num_others = Some(num_others);
            }
            Search::Nothing => {}
        }
        found
    }
}

/// Finds the marks of a board in a photo.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// board : Board
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// BoardSearch
///     Marks are in `view`, which is None if the board was not found.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5].
#[pyfunction]
#[pyo3(signature = (image, board, *, progress=None))]
pub(super) fn find_board(
    image: &Bound<'_, PyAny>,
    board: &Board,
    progress: Option<Py<PyAny>>,
) -> PyResult<BoardSearch> {
    let py = image.py();
    let image = unit_gray("image", image)?;
    let board = &board.board;
    let search = progress::run(py, progress, |monitor| {
        calibration::find_board(&image, board, monitor)
    })?;
    Ok(search.into())
}

/// Set of square markers, with OpenCV's names and numbers.
///
/// Parameters
/// ----------
/// name : str
///     For example ``"Aruco4x4_50"``, ``"4x4_50"``, ``"AprilTag36h11"`` or ``"36h11"``.
#[pyclass(frozen, eq, module = "epipole.calibration")]
#[derive(PartialEq)]
pub(super) struct MarkerDictionary(calibration::MarkerDictionary);

/// Reads a dictionary by its class or name.
fn dictionary(name: &str, value: &Bound<'_, PyAny>) -> PyResult<calibration::MarkerDictionary> {
    if let Ok(dictionary) = value.cast::<MarkerDictionary>() {
        return Ok(dictionary.get().0);
    }
    let text: String = value.extract().unwrap_or_default();
    let mut all = calibration::MarkerDictionary::ALL.into_iter();
    match all.find(|dictionary| dictionary.name() == text) {
        Some(dictionary) => Ok(dictionary),
        None => options::value(name, value),
    }
}

#[pymethods]
impl MarkerDictionary {
    #[new]
    fn new(name: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(dictionary("name", name)?))
    }

    /// Returns the dictionaries of all kinds.
    #[staticmethod]
    fn all() -> Vec<Self> {
        let all = calibration::MarkerDictionary::ALL.into_iter();
        all.map(Self).collect()
    }

    /// Name as in OpenCV, without the prefix, such as "4x4_50".
    #[getter]
    fn name(&self) -> &'static str {
        self.0.name()
    }

    /// Number of markers.
    #[getter]
    fn num_markers(&self) -> usize {
        self.0.num_markers()
    }

    /// Number of bits along a side, without the border.
    #[getter]
    fn num_bits(&self) -> usize {
        self.0.num_bits()
    }

    /// Maximum number of wrong bits at which markers are accepted by default.
    #[getter]
    fn max_hamming(&self) -> u32 {
        self.0.max_hamming()
    }

    /// Returns whether a bit of an upright marker is white.
    ///
    /// Parameters
    /// ----------
    /// id : int
    ///     Number of the marker.
    /// row, column : int
    ///     From the upper left bit, without the border.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If the dictionary has no such marker or bit.
    fn is_white(&self, id: usize, row: usize, column: usize) -> PyResult<bool> {
        self.0.is_white(id, row, column).ok_or_else(|| {
            PyIndexError::new_err(format!("marker {id} has no bit ({row}, {column})"))
        })
    }

    fn __repr__(&self) -> String {
        format!("MarkerDictionary(name='{}')", self.0.name())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (&'static str,))> {
        Ok((slf.get_type().into_any(), (slf.get().name(),)))
    }
}

record! {
    /// Square marker in a photo.
    "epipole.calibration" Marker {
        /// Number in the dictionary.
        id: usize,
        /// Corners of the black border, pixels, shape (4, 2): clockwise from the upper left one of
        /// the upright marker.
        corners: Py<PyArray2<f64>>,
        /// Number of bits that differ from the dictionary.
        hamming: u32,
    }
}

/// Finds ArUco markers and AprilTags.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// dictionary : str or MarkerDictionary
///     For example ``"4x4_50"`` or ``"36h11"``.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MarkerOptions
///     ``max_hamming``, ``border_bits``, ``min_side_px``.
///
/// Returns
/// -------
/// list of Marker
///     Sorted by number.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5].
#[pyfunction]
#[pyo3(signature = (image, dictionary, *, progress=None, **options))]
pub(super) fn detect_markers(
    image: &Bound<'_, PyAny>,
    dictionary: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<Marker>> {
    let py = image.py();
    let image = unit_gray("image", image)?;
    let dictionary = self::dictionary("dictionary", dictionary)?;
    let markers = progress::run_with(py, progress, options, |options, monitor| {
        calibration::detect_markers(&image, dictionary, options, monitor)
    })?;
    let give = |marker: &calibration::Marker| {
        Ok(Marker {
            id: marker.id,
            corners: from_points(py, &marker.corners)?.unbind(),
            hamming: marker.hamming,
        })
    };
    markers.iter().map(give).collect()
}

/// Renders a photo of a board with known ground truth.
///
/// Parameters
/// ----------
/// board : Board
/// camera : Camera
/// cam_from_board : RigidTransform
///     Pose of the board, meters.
/// noise : float, optional
///     Standard deviation of the gray values.
/// seed : int, optional
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     Gray, in [0, 1].
///
/// Raises
/// ------
/// ValueError
///     If the result has more than 2**32 pixels.
#[pyfunction]
#[pyo3(signature = (board, camera, cam_from_board, noise=0.0, seed=0, *, progress=None))]
pub(super) fn render_board<'py>(
    py: Python<'py>,
    board: &Board,
    camera: &Camera,
    cam_from_board: &RigidTransform,
    noise: f64,
    seed: u64,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (board, camera, pose) = (&board.board, &camera.0, &cam_from_board.0);
    require_size(camera.width, camera.height)?;
    let image = progress::run(py, progress, |monitor| {
        calibration::render_board(board, camera, pose, noise, seed, monitor)
    });
    from_gray(py, image?)
}
