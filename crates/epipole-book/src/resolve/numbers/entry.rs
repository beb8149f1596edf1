//! Entries of the registry of numbers, and their arguments.

use nalgebra::Point2;

/// A number computed by the core, with its number of printed decimals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Number {
    /// An integer.
    Count(u64),
    /// A real number and its decimals.
    Real(f64, usize),
}

/// An entry of the registry.
pub struct Entry {
    /// Name in chapters.
    pub name: &'static str,
    /// Parameters, all of which are required.
    pub parameters: &'static [&'static str],
    /// Description for authors.
    pub summary: &'static str,
    pub(super) compute: fn(&Arguments) -> Result<Number, String>,
}

/// The values of an entry's parameters.
pub struct Arguments<'a> {
    names: &'static [&'static str],
    values: &'a [f64],
}

impl<'a> Arguments<'a> {
    pub(super) fn new(names: &'static [&'static str], values: &'a [f64]) -> Arguments<'a> {
        Arguments { names, values }
    }

    pub(super) fn get(&self, name: &str) -> f64 {
        let index = self.names.iter().position(|known| *known == name);
        index
            .and_then(|index| self.values.get(index).copied())
            .unwrap_or(f64::NAN)
    }

    /// Returns a parameter that is a count.
    pub(super) fn count(&self, name: &str) -> Result<usize, String> {
        let value = self.get(name);
        if (0.0..1e9).contains(&value) && value == value.trunc() {
            Ok(value as usize)
        } else {
            Err(format!("{name}={value} is not a count"))
        }
    }

    /// Returns a parameter that is an index from 1 to `length`.
    pub(super) fn index(&self, name: &str, length: usize) -> Result<usize, String> {
        let index = self.count(name)?.checked_sub(1);
        index
            .filter(|&index| index < length)
            .ok_or_else(|| format!("{name} must be 1 to {length}"))
    }

    /// Returns (u, v), a pixel of image 1.
    pub(super) fn pixel1(&self) -> Point2<f64> {
        Point2::new(self.get("u"), self.get("v"))
    }

    /// Returns (u2, v2), a pixel of image 2.
    pub(super) fn pixel2(&self) -> Point2<f64> {
        Point2::new(self.get("u2"), self.get("v2"))
    }
}

pub(super) fn sentence(error: epipole::Error) -> String {
    error.to_string()
}
