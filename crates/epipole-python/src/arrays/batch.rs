//! Functions of single points, applied to arrays of points.
//!
//! Points are passed in blocks that fit in the cache. A fast function reads them in place and holds
//! the GIL, so that other threads cannot change them. For a slow one, a block is copied and the GIL
//! released, at a small relative cost.

use super::{Numbers, wrong_shape};
use crate::errors::OrRaise;
use crate::progress;
use epipole::nalgebra::SVector;
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::ops::Range;
use std::time::{Duration, Instant};

/// Number of rows of a block that is read in place, and of one that is copied.
const READ_ROWS: usize = 1 << 10;
const COPIED_ROWS: usize = 1 << 13;
/// Duration of a block of [`READ_ROWS`] above which blocks are copied: 25 times that of the copy.
const SLOW: Duration = Duration::from_micros(100);

/// One point, or N points, with D coordinates, as input for functions of single points.
pub(crate) struct Batch<'a, 'py, const D: usize> {
    numbers: Numbers<'a, 'py>,
}

impl<'a, 'py, const D: usize> Batch<'a, 'py, D> {
    /// Reads an array of shape `(D,)` or `(N, D)`.
    pub(crate) fn read(name: &'a str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let expected = || format!("({D},) or (N, {D})");
        let numbers = Numbers::read(name, value, expected)?;
        match *numbers.shape() {
            [columns] | [_, columns] if columns == D => Ok(Self { numbers }),
            _ => Err(wrong_shape(name, &expected(), value, numbers.shape())),
        }
    }

    fn len(&self) -> usize {
        self.numbers.len() / D
    }

    /// Returns whether the caller passed one point, not an array of points.
    fn is_one(&self) -> bool {
        self.numbers.shape().len() == 1
    }

    fn rows(&self, rows: Range<usize>) -> PyResult<&[[f64; D]]> {
        let numbers = self.numbers.checked(rows.start * D..rows.end * D)?;
        Ok(numbers.as_chunks().0)
    }

    /// Returns minimum and maximum of each coordinate; none without points.
    pub(crate) fn bounds(&self) -> PyResult<Option<[(f64, f64); D]>> {
        let rows = self.rows(0..self.len())?;
        let Some((first, others)) = rows.split_first() else {
            return Ok(None);
        };
        let mut bounds = first.map(|x| (x, x));
        for row in others {
            for (bound, &x) in bounds.iter_mut().zip(row) {
                *bound = (bound.0.min(x), bound.1.max(x));
            }
        }
        Ok(Some(bounds))
    }

    /// Calls `work` for each block.
    fn each(&self, py: Python<'py>, mut work: impl FnMut(&[[f64; D]]) + Send) -> PyResult<()> {
        let mut blocks = Blocks::new(self.len());
        while let Some(rows) = blocks.next() {
            let rows = self.rows(rows)?;
            if blocks.are_copied {
                let rows = rows.to_vec();
                progress::release(py, || work(&rows));
                py.check_signals()?;
            } else {
                work(rows);
            }
        }
        Ok(())
    }

    /// Computes one number per point: a float, or an array of shape `(N,)`.
    pub(crate) fn numbers(
        &self,
        py: Python<'py>,
        number: impl Fn(&SVector<f64, D>) -> f64 + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut values = Vec::with_capacity(self.len());
        self.each(py, |rows| {
            values.extend(rows.iter().map(|&row| number(&SVector::from(row))));
        })?;
        give_numbers(py, self.is_one(), values)
    }

    /// Computes one vector per point: shape `(E,)` or `(N, E)`. For a single point an error is
    /// raised; among several it becomes a row of NaN.
    pub(crate) fn vectors<const E: usize>(
        &self,
        py: Python<'py>,
        vector: impl Fn(&SVector<f64, D>) -> epipole::Result<SVector<f64, E>> + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        if self.is_one() {
            return give_one(py, vector(&SVector::from(self.rows(0..1)?[0])));
        }
        let mut values = Vec::with_capacity(self.len() * E);
        self.each(py, |rows| {
            for &row in rows {
                push(&mut values, vector(&SVector::from(row)));
            }
        })?;
        give_rows::<E>(py, self.len(), values)
    }
}

/// Two batches of the same length.
pub(crate) struct Pairs<'a, 'py, const D: usize, const E: usize> {
    first: Batch<'a, 'py, D>,
    second: Batch<'a, 'py, E>,
}

impl<'a, 'py, const D: usize, const E: usize> Pairs<'a, 'py, D, E> {
    /// Reads two arrays of equal length.
    pub(crate) fn read(
        (name1, value1): (&'a str, &Bound<'py, PyAny>),
        (name2, value2): (&'a str, &Bound<'py, PyAny>),
    ) -> PyResult<Self> {
        let first = Batch::read(name1, value1)?;
        let second = Batch::read(name2, value2)?;
        let (n1, n2) = (first.len(), second.len());
        if n1 != n2 || first.is_one() != second.is_one() {
            return Err(PyValueError::new_err(format!(
                "{name1} and {name2} must have the same number of points, but have {n1} and {n2}"
            )));
        }
        Ok(Self { first, second })
    }

    /// As [`Batch::each`].
    fn each(
        &self,
        py: Python<'py>,
        mut work: impl FnMut(&[[f64; D]], &[[f64; E]]) + Send,
    ) -> PyResult<()> {
        let mut blocks = Blocks::new(self.first.len());
        while let Some(rows) = blocks.next() {
            let (first, second) = (self.first.rows(rows.clone())?, self.second.rows(rows)?);
            if blocks.are_copied {
                let (first, second) = (first.to_vec(), second.to_vec());
                progress::release(py, || work(&first, &second));
                py.check_signals()?;
            } else {
                work(first, second);
            }
        }
        Ok(())
    }

    /// As [`Batch::numbers`].
    pub(crate) fn numbers(
        &self,
        py: Python<'py>,
        number: impl Fn(&SVector<f64, D>, &SVector<f64, E>) -> f64 + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut values = Vec::with_capacity(self.first.len());
        self.each(py, |first, second| {
            let pairs = first.iter().zip(second);
            values.extend(pairs.map(|(&a, &b)| number(&SVector::from(a), &SVector::from(b))));
        })?;
        give_numbers(py, self.first.is_one(), values)
    }

    /// As [`Batch::vectors`].
    pub(crate) fn vectors<const F: usize>(
        &self,
        py: Python<'py>,
        vector: impl Fn(&SVector<f64, D>, &SVector<f64, E>) -> epipole::Result<SVector<f64, F>> + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        if self.first.is_one() {
            let (first, second) = (self.first.rows(0..1)?[0], self.second.rows(0..1)?[0]);
            return give_one(py, vector(&SVector::from(first), &SVector::from(second)));
        }
        let mut values = Vec::with_capacity(self.first.len() * F);
        self.each(py, |first, second| {
            for (&a, &b) in first.iter().zip(second) {
                push(&mut values, vector(&SVector::from(a), &SVector::from(b)));
            }
        })?;
        give_rows::<F>(py, self.first.len(), values)
    }
}

impl<'py> Pairs<'_, 'py, 2, 2> {
    /// Reads the arguments `pixel1` and `pixel2`.
    pub(crate) fn pixels(pixel1: &Bound<'py, PyAny>, pixel2: &Bound<'py, PyAny>) -> PyResult<Self> {
        Self::read(("pixel1", pixel1), ("pixel2", pixel2))
    }
}

/// Defines the Python function of an error of matches by a matrix of two views.
macro_rules! match_error {
    (
        $(#[doc = $doc:literal])*
        fn $name:ident($matrix:ident, pixel1, pixel2) -> $result:ty { $error:path }
    ) => {
        $(#[doc = $doc])*
        #[pyfunction]
        pub(crate) fn $name<'py>(
            $matrix: &Bound<'py, PyAny>,
            pixel1: &Bound<'py, PyAny>,
            pixel2: &Bound<'py, PyAny>,
        ) -> $result {
            let matrix = $crate::arrays::matrix(stringify!($matrix), $matrix)?;
            let pairs = $crate::arrays::Pairs::pixels(pixel1, pixel2)?;
            pairs.numbers(pixel1.py(), |p, q| $error(&matrix, &(*p).into(), &(*q).into()))
        }
    };
}

pub(crate) use match_error;

/// Ranges of rows; the duration of the first decides whether the others are copied.
struct Blocks {
    count: usize,
    end: usize,
    started: Option<Instant>,
    are_copied: bool,
}

impl Blocks {
    fn new(count: usize) -> Self {
        Self {
            count,
            end: 0,
            started: None,
            are_copied: false,
        }
    }

    fn next(&mut self) -> Option<Range<usize>> {
        let start = self.end;
        if start == self.count {
            return None;
        }
        if start == READ_ROWS {
            self.are_copied = self.started.is_some_and(|started| started.elapsed() > SLOW);
        } else if start == 0 {
            self.started = Some(Instant::now());
        }
        let rows = if self.are_copied {
            COPIED_ROWS
        } else {
            READ_ROWS
        };
        self.end = self.count.min(start + rows);
        Some(start..self.end)
    }
}

fn push<const E: usize>(values: &mut Vec<f64>, vector: epipole::Result<SVector<f64, E>>) {
    match vector {
        Ok(vector) => values.extend_from_slice(vector.as_slice()),
        Err(_) => values.extend([f64::NAN; E]),
    }
}

fn give_numbers(py: Python<'_>, is_one: bool, values: Vec<f64>) -> PyResult<Bound<'_, PyAny>> {
    match *values {
        [value] if is_one => Ok(value.into_pyobject(py)?.into_any()),
        _ => Ok(PyArray1::from_vec(py, values).into_any()),
    }
}

fn give_one<const E: usize>(
    py: Python<'_>,
    vector: epipole::Result<SVector<f64, E>>,
) -> PyResult<Bound<'_, PyAny>> {
    Ok(PyArray1::from_slice(py, vector.or_raise()?.as_slice()).into_any())
}

fn give_rows<const E: usize>(
    py: Python<'_>,
    count: usize,
    values: Vec<f64>,
) -> PyResult<Bound<'_, PyAny>> {
    Ok(PyArray1::from_vec(py, values)
        .reshape([count, E])?
        .into_any())
}
