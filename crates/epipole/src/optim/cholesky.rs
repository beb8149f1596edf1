//! Cholesky factorization of large dense matrices, in blocks.

use crate::math::parallel::for_each_chunk;

/// Number of columns that are eliminated together; a panel of them stays in the caches.
const BLOCK: usize = 48;
/// Number of columns that one pass of the update writes.
const LANES: usize = 8;

/// Replaces the lower triangle of the row-major `n × n` matrix `a` by L with `L Lᵀ = A`.
///
/// The upper triangle is never read and may be overwritten. Returns false, with `a` destroyed,
/// unless A is positive definite.
pub(crate) fn factorize(a: &mut [f64], n: usize) -> bool {
    let mut panel = Vec::new();
    let mut start = 0;
    while start < n {
        let end = (start + BLOCK).min(n);
        let width = end - start;
        if !factorize_diagonal_block(a, n, start, end) {
            return false;
        }
        let rest = n - end;
        if rest == 0 {
            break;
        }
        let (above, below) = a.split_at_mut(end * n);
        let diagonal = &above[start * n..];
        // L21 = A21 L11⁻ᵀ, each row independently.
        for_each_chunk(below, n * 8, |_, rows| {
            for row in rows.chunks_mut(n) {
                for j in 0..width {
                    let (done, todo) = row[start..end].split_at_mut(j);
                    let factor = &diagonal[j * n + start..j * n + start + j + 1];
                    let mut value = todo[0];
                    for k in 0..j {
                        value -= done[k] * factor[k];
                    }
                    todo[0] = value / factor[j];
                }
            }
        });
        // The panel transposed, padded to whole lanes: column k of L21 is a row of `panel`.
        let padded = rest.div_ceil(LANES) * LANES;
        panel.clear();
        panel.resize(width * padded, 0.0);
        for (i, row) in below.chunks(n).enumerate() {
            for k in 0..width {
                panel[k * padded + i] = row[start + k];
            }
        }
        // A22 −= L21 L21ᵀ, lower triangle only, two rows at a time.
        let panel = &panel[..];
        for_each_chunk(below, 2 * n, |first, rows| {
            let i = first / n;
            update_rows(rows, n, start, end, i, panel, padded);
        });
        start = end;
    }
    true
}

fn factorize_diagonal_block(a: &mut [f64], n: usize, start: usize, end: usize) -> bool {
    for j in start..end {
        for i in j..end {
            let mut value = a[i * n + j];
            for k in start..j {
                value -= a[i * n + k] * a[j * n + k];
            }
            if i == j {
                if !(value > 0.0 && value.is_finite()) {
                    return false;
                }
                a[j * n + j] = value.sqrt();
            } else {
                a[i * n + j] = value / a[j * n + j];
            }
        }
    }
    true
}

/// Updates the rows `end + i` and, if it exists, `end + i + 1` up to their diagonals.
fn update_rows(
    rows: &mut [f64],
    n: usize,
    start: usize,
    end: usize,
    i: usize,
    panel: &[f64],
    padded: usize,
) {
    let width = end - start;
    let mut left = [[0.0; BLOCK]; 2];
    for (row, left) in rows.chunks(n).zip(&mut left) {
        left[..width].copy_from_slice(&row[start..end]);
    }
    let columns = i + rows.len() / n;
    let mut column = 0;
    while column < columns {
        let mut sums = [[0.0; LANES]; 2];
        for (k, right) in panel.chunks_exact(padded).enumerate() {
            let right: &[f64; LANES] = right[column..column + LANES]
                .try_into()
                .expect("a slice of LANES numbers");
            for lane in 0..LANES {
                sums[0][lane] += left[0][k] * right[lane];
                sums[1][lane] += left[1][k] * right[lane];
            }
        }
        let count = LANES.min(n - end - column);
        for (row, sums) in rows.chunks_mut(n).zip(&sums) {
            for (target, sum) in row[end + column..end + column + count].iter_mut().zip(sums) {
                *target -= sum;
            }
        }
        column += LANES;
    }
}

/// Solves `L Lᵀ x = b` in place for a factor from [`factorize`].
pub(crate) fn solve(lower: &[f64], n: usize, b: &mut [f64]) {
    for i in 0..n {
        let row = &lower[i * n..i * n + i + 1];
        let mut value = b[i];
        for k in 0..i {
            value -= row[k] * b[k];
        }
        b[i] = value / row[i];
    }
    for i in (0..n).rev() {
        let row = &lower[i * n..i * n + i + 1];
        let value = b[i] / row[i];
        b[i] = value;
        for k in 0..i {
            b[k] -= row[k] * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn solves_systems_of_every_size() {
        let mut random = Random::new(11);
        for n in [1, 2, 7, 8, 9, 47, 48, 49, 97, 130] {
            let g: Vec<f64> = (0..n * n).map(|_| random.normal()).collect();
            let mut a = vec![f64::NAN; n * n];
            let mut full = vec![0.0; n * n];
            for i in 0..n {
                for j in 0..n {
                    let dot: f64 = (0..n).map(|k| g[i * n + k] * g[j * n + k]).sum();
                    full[i * n + j] = dot + if i == j { 0.5 } else { 0.0 };
                    if j <= i {
                        a[i * n + j] = full[i * n + j];
                    }
                }
            }
            let x: Vec<f64> = (0..n).map(|_| random.normal()).collect();
            let mut b: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| full[i * n + j] * x[j]).sum())
                .collect();
            assert!(factorize(&mut a, n));
            solve(&a, n, &mut b);
            let worst = b
                .iter()
                .zip(&x)
                .map(|(b, x)| (b - x).abs())
                .fold(0.0, f64::max);
            assert!(worst < 1e-9, "n = {n}: {worst}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        assert!(!factorize(&mut [1.0, 0.0, 2.0, 1.0], 2));
        assert!(!factorize(&mut [f64::NAN], 1));
        let n = 60;
        let mut a = vec![0.0; n * n];
        for i in 0..n {
            a[i * n + i] = if i == 55 { -1.0 } else { 1.0 };
        }
        assert!(!factorize(&mut a, n));
    }
}
