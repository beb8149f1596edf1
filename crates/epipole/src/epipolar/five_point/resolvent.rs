//! Reduction of the five-point problem's ten cubics to one polynomial.

use super::cubics::{Cubic, constraints};
use nalgebra::Vector3;

/// Pivot below which equations count as dependent. For random rays not one problem in 100 000 has a
/// pivot below 1e-6; after a roll of 90° and a step along the rows all have.
const SMALL_PIVOT: f64 = 1e-8;

/// Relative leading coefficient below which a root is at infinity. For random rays one problem in
/// 10 000 has one below 1e-10; after a step along the rows nearly all have.
const SMALL_LEAD: f64 = 1e-10;

/// Factor on the two limits below which rounding may have removed two roots.
const ROUGH: f64 = 1e3;

/// Runs Gauss–Jordan elimination on the first ten columns. Returns the last six rows, as only these
/// are needed, and the smallest pivot. `None` if the columns are nearly dependent.
fn eliminate(rows: &mut [Cubic; 10]) -> Option<([[f64; 10]; 6], f64)> {
    let mut smallest = f64::INFINITY;
    for column in 0..10 {
        let mut pivot = column;
        for r in column + 1..10 {
            if rows[r][column].abs() > rows[pivot][column].abs() {
                pivot = r;
            }
        }
        rows.swap(column, pivot);
        let value = rows[column][column];
        if value.abs() < SMALL_PIVOT || !value.is_finite() {
            return None;
        }
        smallest = smallest.min(value.abs());
        let inverse = 1.0 / value;
        for x in &mut rows[column] {
            *x *= inverse;
        }
        let top = rows[column];
        for row in &mut rows[column + 1..] {
            let factor = row[column];
            for k in 0..20 {
                row[k] -= factor * top[k];
            }
        }
    }
    for column in (5..10).rev() {
        let below = rows[column];
        for row in &mut rows[4..column] {
            let factor = row[column];
            for k in 10..20 {
                row[k] -= factor * below[k];
            }
        }
    }
    let mut reduced = [[0.0; 10]; 6];
    for (target, row) in reduced.iter_mut().zip(&rows[4..]) {
        target.copy_from_slice(&row[10..]);
    }
    Some((reduced, smallest))
}

/// A row of B(z): polynomials in z that multiply x, y and 1; ascending powers.
#[derive(Clone, Copy)]
struct Reduced {
    x: [f64; 4],
    y: [f64; 4],
    one: [f64; 5],
}

/// Returns `a − z b`, for rows `a = x²z + …` and `b = x² + …`: the leading terms cancel.
fn combine(a: &[f64; 10], b: &[f64; 10]) -> Reduced {
    Reduced {
        x: [a[2], a[1] - b[2], a[0] - b[1], -b[0]],
        y: [a[5], a[4] - b[5], a[3] - b[4], -b[3]],
        one: [a[9], a[8] - b[9], a[7] - b[8], a[6] - b[7], -b[6]],
    }
}

fn multiply_add<const A: usize, const B: usize, const C: usize>(
    a: &[f64; A],
    b: &[f64; B],
    sign: f64,
    product: &mut [f64; C],
) {
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += sign * x * y;
        }
    }
}

fn evaluate<const N: usize>(c: &[f64; N], z: f64) -> f64 {
    c.iter().rev().fold(0.0, |value, x| value * z + x)
}

/// The equations reduced to one unknown.
pub(super) struct Resolvent {
    /// B(z), whose null vector is (x, y, 1).
    b: [Reduced; 3],
    /// Its determinant.
    pub(super) polynomial: [f64; 11],
    /// Whether rounding may have removed roots.
    pub(super) is_rough: bool,
}

impl Resolvent {
    /// Returns `None` if the equations are nearly dependent.
    pub(super) fn new(basis: &[[f64; 9]; 4]) -> Option<Self> {
        let (r, smallest_pivot) = eliminate(&mut constraints(basis))?;
        let b = [
            combine(&r[0], &r[1]),
            combine(&r[2], &r[3]),
            combine(&r[4], &r[5]),
        ];
        // Expanded along the constant column.
        let mut polynomial = [0.0; 11];
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let mut minor = [0.0; 7];
            multiply_add(&b[j].x, &b[k].y, 1.0, &mut minor);
            multiply_add(&b[k].x, &b[j].y, -1.0, &mut minor);
            multiply_add(&b[i].one, &minor, 1.0, &mut polynomial);
        }
        Some(Self {
            is_rough: smallest_pivot < ROUGH * SMALL_PIVOT
                || lead(&polynomial) < ROUGH * SMALL_LEAD,
            b,
            polynomial,
        })
    }

    /// Returns whether no root is at infinity, where a solution lacks the last basis vector.
    pub(super) fn has_all_degrees(&self) -> bool {
        lead(&self.polynomial) >= SMALL_LEAD
    }

    /// Returns the coefficients x and y that belong to a root z.
    #[inline]
    pub(super) fn others(&self, z: f64) -> (f64, f64) {
        let rows = [0, 1, 2].map(|i: usize| {
            Vector3::new(
                evaluate(&self.b[i].x, z),
                evaluate(&self.b[i].y, z),
                evaluate(&self.b[i].one, z),
            )
        });
        // (x, y, 1) is perpendicular to all rows of B(z).
        let crosses = [
            rows[0].cross(&rows[1]),
            rows[1].cross(&rows[2]),
            rows[2].cross(&rows[0]),
        ];
        let mut null = crosses[0];
        for cross in &crosses[1..] {
            if cross.norm_squared() > null.norm_squared() {
                null = *cross;
            }
        }
        (null.x / null.z, null.y / null.z)
    }
}

/// Returns the size of the leading coefficient, relative to the largest.
fn lead(polynomial: &[f64; 11]) -> f64 {
    let largest = polynomial.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    polynomial[10].abs() / largest
}
