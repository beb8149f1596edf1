//! Boards, their drawings, and their marks in photos.

use crate::arrays::{as_array, from_points, from_rows, from_vector};
use crate::errors::OrRaise;
use crate::images::{elements, wrong_shape};
use crate::options;
use crate::record::{Reduced, record};
use crate::sfm::wrapper::wrapper;
use epipole::calibration::{self, Pattern};
use epipole::nalgebra::Point2;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;

/// Flat board with marks at known positions: x along its columns, y along its rows, z = 0.
///
/// Parameters
/// ----------
/// pattern : str or dict
///     ``"chessboard"``, ``"circles"``, ``"asymmetric_circles"``,
///     ``{"charuco": {"dictionary": "Aruco4x4_50", "marker_ratio": 0.75}}`` or
///     ``{"april_grid": {"spacing": 0.3}}``.
/// columns, rows : int
///     Inner corners of a chessboard; squares of a ChArUco board; tags of an AprilGrid; disks per
///     row and rows of disks in a circle grid.
/// square_m : float
///     Side of a square or tag, or distance between two rows of circles, meters.
///
/// Raises
/// ------
/// ValueError
///     If there are fewer than 3 or more than 1000 columns or rows (minimum: 2 columns for shifted
///     circles, one tag for an AprilGrid), ``square_m`` is not above 0, a marker size is out of
///     range, or the dictionary has too few markers.
///
/// Examples
/// --------
/// >>> Board("chessboard", 9, 6, 0.03).num_marks
/// 54
#[pyclass(frozen, module = "epipole.calibration")]
pub(super) struct Board {
    pub(super) board: calibration::Board,
    /// Columns and rows given to the constructor.
    size: (usize, usize),
}

#[pymethods]
impl Board {
    #[new]
    fn new(
        pattern: &Bound<'_, PyAny>,
        columns: usize,
        rows: usize,
        square_m: f64,
    ) -> PyResult<Self> {
        let pattern: Pattern = options::value("pattern", pattern)?;
        Ok(Self {
            board: calibration::Board::new(pattern, columns, rows, square_m).or_raise()?,
            size: (columns, rows),
        })
    }

    /// Pattern, as in the constructor.
    ///
    /// Returns
    /// -------
    /// str or dict
    #[getter]
    fn pattern<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize::pythonize(py, &self.board.pattern())?)
    }

    /// Columns, as in the constructor.
    #[getter]
    fn columns(&self) -> usize {
        self.size.0
    }

    /// Rows, as in the constructor.
    #[getter]
    fn rows(&self) -> usize {
        self.size.1
    }

    /// Number of marks per row: inner corners of squares, corners of tags, or disks.
    #[getter]
    fn mark_columns(&self) -> usize {
        self.board.columns()
    }

    /// Number of rows of marks.
    #[getter]
    fn mark_rows(&self) -> usize {
        self.board.rows()
    }

    /// Side of a square or tag, or distance between two rows of circles, meters.
    #[getter]
    fn square_m(&self) -> f64 {
        self.board.square_m()
    }

    /// Number of marks.
    #[getter]
    fn num_marks(&self) -> usize {
        self.board.num_marks()
    }

    /// Returns the position of a mark on the board, meters, shape (2,). Marks are counted by row.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     Index of the mark, from 0.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If the board has no such mark.
    fn mark<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let count = self.board.num_marks();
        if index >= count {
            let message = format!("index is {index}, but there are {count} marks");
            return Err(PyIndexError::new_err(message));
        }
        Ok(from_vector(py, &self.board.mark(index).coords))
    }

    /// Returns the positions of all marks on the board, meters, shape (N, 2).
    fn marks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let indices = 0..self.board.num_marks();
        from_rows(py, indices.map(|index| self.board.mark(index).coords))
    }

    /// Returns the black shapes of the board.
    ///
    /// Returns
    /// -------
    /// BoardDrawing
    fn drawing(&self, py: Python<'_>) -> PyResult<BoardDrawing> {
        let drawing = self.board.drawing();
        let corners = drawing.rectangles.iter().flatten();
        let numbers: Vec<f64> = corners.flat_map(|corner| [corner.x, corner.y]).collect();
        let rectangles = PyArray1::from_vec(py, numbers);
        Ok(BoardDrawing {
            rectangles: rectangles
                .reshape([drawing.rectangles.len(), 2, 2])?
                .unbind(),
            disks: from_points(py, &drawing.disks)?.unbind(),
            disk_radius: drawing.disk_radius,
        })
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        crate::record::repr(slf, &["pattern", "columns", "rows", "square_m"])
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other
            .cast::<Self>()
            .is_ok_and(|other| other.get().board == self.board)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (board, (columns, rows)) = (slf.get(), slf.get().size);
        let pattern = board.pattern(slf.py())?;
        let arguments = (pattern, columns, rows, board.square_m()).into_pyobject(slf.py())?;
        Ok((slf.get_type().into_any(), arguments))
    }
}

record! {
    /// Black shapes of a board, in squares; the first mark is at the origin, y points down.
    "epipole.calibration" BoardDrawing {
        /// Upper left and lower right corner of each rectangle, shape (N, 2, 2).
        rectangles: Py<PyArray3<f64>>,
        /// Centers of disks, shape (M, 2).
        disks: Py<PyArray2<f64>>,
        /// Radius of the disks.
        disk_radius: f64,
    }
}

/// Marks of a board in one photo.
///
/// Parameters
/// ----------
/// pixels : array_like, shape (N, 2)
///     Pixel of each mark of the board, row by row; NaN where not visible.
#[pyclass(frozen, from_py_object, module = "epipole.calibration")]
#[derive(Clone)]
pub(crate) struct BoardView(pub(super) calibration::BoardView);

wrapper!(BoardView: pixels);

#[pymethods]
impl BoardView {
    #[new]
    fn new(pixels: &Bound<'_, PyAny>) -> PyResult<Self> {
        let array = as_array("pixels", pixels, "(N, 2)")?;
        // OpenCV's corners have shape (N, 1, 2).
        if !matches!(*array.shape(), [_, 2] | [_, 1, 2]) {
            return Err(wrong_shape("pixels", "(N, 2)", &array)?);
        }
        let numbers: Vec<f64> = elements(&array, "float64")?;
        if numbers.iter().any(|number| number.is_infinite()) {
            return Err(PyValueError::new_err("pixels contains infinity"));
        }
        let pixel = |p: &[f64]| (!p[0].is_nan() && !p[1].is_nan()).then(|| Point2::new(p[0], p[1]));
        Ok(Self(calibration::BoardView {
            pixels: numbers.chunks_exact(2).map(pixel).collect(),
        }))
    }

    /// Pixel of each mark of the board, shape (N, 2); NaN where not visible.
    #[getter]
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let hidden = Point2::new(f64::NAN, f64::NAN);
        let pixels = self.0.pixels.iter();
        from_rows(py, pixels.map(|pixel| pixel.unwrap_or(hidden).coords))
    }

    /// Returns the visible marks with their pixels.
    ///
    /// Returns
    /// -------
    /// marks : ndarray of int64, shape (M,)
    /// pixels : ndarray, shape (M, 2)
    #[allow(clippy::type_complexity)]
    fn visible<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, Bound<'py, PyArray2<f64>>)> {
        let marks = PyArray1::from_iter(py, self.0.visible().map(|(mark, _)| mark as i64));
        let pixels = self.0.visible().map(|(_, pixel)| pixel.coords);
        Ok((marks, from_rows(py, pixels)?))
    }

    /// Returns the number of visible marks.
    fn num_visible(&self) -> usize {
        self.0.num_visible()
    }
}
