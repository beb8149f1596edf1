//! Reading the bits of a marker.

use crate::imaging::{Border, GrayImage32, sample_bilinear};
use nalgebra::{Matrix3, Vector3};

/// Sample positions in a cell, relative to its middle and side.
const SAMPLES: [f64; 3] = [-0.18, 0.0, 0.18];
/// Fraction of the differences to neighboring cells that is added, to reduce blur.
///
/// Source: Krogius, Haggenmiller & Olson 2019, "Flexible layouts for fiducial tags".
const SHARPENING: f64 = 0.25;
/// Minimum difference between white and black, of a range of 1.
const LEAST_CONTRAST: f64 = 0.05;
/// Maximum fraction of white cells in the border.
const MOST_WHITE: f64 = 0.1;

/// Size of a marker, in cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cells {
    /// Number of bits along a side.
    pub(super) bits: usize,
    /// Width of the black border.
    pub(super) border: usize,
}

impl Cells {
    pub(super) fn side(self) -> usize {
        self.bits + 2 * self.border
    }
}

/// A cell: its position in the marker, from −1 to 1, and its gray value.
#[derive(Clone, Copy)]
struct Cell {
    x: f64,
    y: f64,
    gray: f64,
}

/// Reads the bits of a marker row by row, the first the most significant, with 1 for white; `None`
/// if its border is not black.
///
/// * `pixel_from_marker`: homography from the square with corners (0, 0) and (1, 1), the border's
///   outline
pub(super) fn read_bits(
    image: &GrayImage32,
    pixel_from_marker: &Matrix3<f64>,
    cells: Cells,
) -> Option<u64> {
    let side = cells.side();
    let grays = cell_grays(image, pixel_from_marker, side);
    let center = |i: usize| (2.0 * i as f64 + 1.0) / side as f64 - 1.0;
    let cell = |k: usize| Cell {
        x: center(k % side),
        y: center(k / side),
        gray: sharpen_cell(&grays, k, side),
    };
    let all: Vec<Cell> = (0..side * side).map(cell).collect();
    let inside = cells.border..side - cells.border;
    let is_border = |k: usize| !inside.contains(&(k % side)) || !inside.contains(&(k / side));
    let is_white = classify(&all)?;
    let num_border = side * side - cells.bits * cells.bits;
    let num_wrong = (0..side * side)
        .filter(|&k| is_border(k) && is_white[k])
        .count();
    if num_wrong as f64 > MOST_WHITE * num_border as f64 {
        return None;
    }
    let bits = (0..side * side).filter(|&k| !is_border(k));
    Some(bits.fold(0, |code, k| code << 1 | u64::from(is_white[k])))
}

fn cell_grays(image: &GrayImage32, pixel_from_marker: &Matrix3<f64>, side: usize) -> Vec<f64> {
    let mean = |k: usize| {
        let mut sum = 0.0;
        for dy in SAMPLES {
            for dx in SAMPLES {
                let x = ((k % side) as f64 + 0.5 + dx) / side as f64;
                let y = ((k / side) as f64 + 0.5 + dy) / side as f64;
                let p = pixel_from_marker * Vector3::new(x, y, 1.0);
                let (u, v) = (p.x / p.z, p.y / p.z);
                sum += f64::from(sample_bilinear(image, u, v, Border::Replicate));
            }
        }
        sum / 9.0
    };
    (0..side * side).map(mean).collect()
}

fn sharpen_cell(grays: &[f64], k: usize, side: usize) -> f64 {
    let (column, row) = (k % side, k / side);
    let beside = [
        (column > 0).then(|| k - 1),
        (column + 1 < side).then(|| k + 1),
        (row > 0).then(|| k - side),
        (row + 1 < side).then(|| k + side),
    ];
    let differences = beside.into_iter().flatten().map(|n| grays[k] - grays[n]);
    grays[k] + SHARPENING * differences.sum::<f64>()
}

/// Returns whether each cell is white: first by a threshold between two means, then by one that
/// adapts to the illumination over the marker.
fn classify(cells: &[Cell]) -> Option<Vec<bool>> {
    let (least, most) = cells
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), cell| {
            (a.min(cell.gray), b.max(cell.gray))
        });
    let mut threshold = 0.5 * (least + most);
    let mut contrast = most - least;
    for _ in 0..8 {
        let mean = |white: bool| {
            let of_class = cells.iter().filter(|c| (c.gray > threshold) == white);
            let (sum, count) = of_class.fold((0.0, 0.0), |(s, n), c| (s + c.gray, n + 1.0));
            sum / count
        };
        let (black, white) = (mean(false), mean(true));
        contrast = white - black;
        threshold = 0.5 * (black + white);
    }
    // Also false for NaN, when all cells are equal.
    let is_clear = contrast >= LEAST_CONTRAST;
    if !is_clear {
        return None;
    }
    let class = |white: bool| -> Vec<Cell> {
        let of_class = cells.iter().filter(|c| (c.gray > threshold) == white);
        of_class.copied().collect()
    };
    let (black, white) = (plane(&class(false)), plane(&class(true)));
    let middle = |c: &Cell| (black + white).dot(&Vector3::new(c.x, c.y, 1.0)) / 2.0;
    Some(cells.iter().map(|c| c.gray > middle(c)).collect())
}

/// Fits `gray = a x + b y + c` by least squares; constant for few cells or those on one line.
fn plane(cells: &[Cell]) -> Vector3<f64> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for cell in cells {
        let row = Vector3::new(cell.x, cell.y, 1.0);
        normal += row * row.transpose();
        right += row * cell.gray;
    }
    let count = cells.len() as f64;
    match normal.try_inverse() {
        Some(inverse) if cells.len() > 5 && normal.determinant() > 1e-3 * count => inverse * right,
        _ => Vector3::new(0.0, 0.0, right.z / count),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    /// A marker of 4 × 4 bits, 8 pixels per cell, with illumination that falls to a third.
    fn draw_marker(bits: u64) -> GrayImage32 {
        GrayImage32::from_fn(48, 48, |u, v| {
            let (column, row) = (u / 8, v / 8);
            let is_inside = (1..5).contains(&column) && (1..5).contains(&row);
            let is_white = is_inside && bits >> (15 - ((row - 1) * 4 + column - 1)) & 1 == 1;
            let light = 1.0 - 0.67 * u as f32 / 47.0;
            Luma([light * if is_white { 0.9 } else { 0.1 }])
        })
    }

    fn upright() -> Matrix3<f64> {
        Matrix3::new(48.0, 0.0, -0.5, 0.0, 48.0, -0.5, 0.0, 0.0, 1.0)
    }

    const CELLS: Cells = Cells { bits: 4, border: 1 };

    #[test]
    fn bits_are_read_under_uneven_light() {
        for bits in [0b1011_0101_0011_0010, 0b0100_1111_0010_1110] {
            assert_eq!(read_bits(&draw_marker(bits), &upright(), CELLS), Some(bits));
        }
    }

    #[test]
    fn a_white_border_is_no_marker() {
        let mut image = draw_marker(0b1011_0101_0011_0010);
        for (u, _, value) in image.enumerate_pixels_mut() {
            if u < 8 {
                *value = Luma([0.9]);
            }
        }
        assert_eq!(read_bits(&image, &upright(), CELLS), None);
        let flat = GrayImage32::from_pixel(48, 48, Luma([0.5]));
        assert_eq!(read_bits(&flat, &upright(), CELLS), None);
    }
}
