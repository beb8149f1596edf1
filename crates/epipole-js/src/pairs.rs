//! Application of functions of one match to many.

use crate::argument::Vectors;
use crate::fault::{Fault, Result};
use crate::output::Numbers;
use epipole::nalgebra::{Const, OPoint};

/// Points with D coordinates.
pub type Points<const D: usize> = Vec<OPoint<f64, Const<D>>>;

/// Pairs the elements of two lists of equal length.
///
/// # Errors
/// `RangeError` if lengths differ.
pub fn zip<const D: usize, const E: usize>(
    (name1, first): (&str, Vectors<D>),
    (name2, second): (&str, Vectors<E>),
) -> Result<(Points<D>, Points<E>)> {
    let (first, second) = (first.points(), second.points());
    if first.len() != second.len() {
        return Err(Fault::of_range(format!(
            "{name1} and {name2} must have the same number of points, but have {} and {}",
            first.len(),
            second.len()
        )));
    }
    Ok((first, second))
}

/// Computes one number for each match.
///
/// # Errors
/// `RangeError` if lengths differ.
pub fn numbers(
    pixels1: Vectors<2>,
    pixels2: Vectors<2>,
    number: impl Fn(&OPoint<f64, Const<2>>, &OPoint<f64, Const<2>>) -> f64,
) -> Result<Numbers> {
    let (first, second) = zip(("pixels1", pixels1), ("pixels2", pixels2))?;
    let pairs = first.iter().zip(&second);
    Ok(Numbers(pairs.map(|(a, b)| number(a, b)).collect()))
}
