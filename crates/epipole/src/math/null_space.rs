//! Null vectors of small linear systems.

/// Returns an orthonormal basis of the vectors orthogonal to all `rows`, for fewer rows than
/// columns.
///
/// * `K` rows of `N` numbers; returns `D = N − K` basis vectors
///
/// If the rows are dependent, returns only some of the null vectors.
///
/// Source: Householder triangularization, Golub & Van Loan 2013, §5.2.
pub(crate) fn null_space<const K: usize, const N: usize, const D: usize>(
    rows: [[f64; N]; K],
) -> [[f64; N]; D] {
    Reflections::new(rows).null_space()
}

/// Householder reflections that triangularize rows: `rows = L Q` with L lower triangular.
pub(crate) struct Reflections<const K: usize, const N: usize> {
    vectors: [[f64; N]; K],
    scales: [f64; K],
    /// Norm of each row's component orthogonal to the previous rows: the diagonal of L.
    pub(crate) left: [f64; K],
}

impl<const K: usize, const N: usize> Reflections<K, N> {
    pub(crate) fn new(mut rows: [[f64; N]; K]) -> Self {
        let (mut scales, mut left) = ([0.0; K], [0.0; K]);
        for j in 0..K {
            let (done, rest) = rows.split_at_mut(j + 1);
            let v = &mut done[j];
            let mut norm_sq = 0.0;
            for x in &v[j..] {
                norm_sq += x * x;
            }
            let norm = norm_sq.sqrt();
            left[j] = norm;
            let first = v[j];
            scales[j] = if norm_sq > 0.0 {
                1.0 / (norm_sq + first.abs() * norm)
            } else {
                0.0
            };
            v[j] = if first < 0.0 {
                first - norm
            } else {
                first + norm
            };
            for row in rest {
                reflect(v, scales[j], j, row);
            }
        }
        Self {
            vectors: rows,
            scales,
            left,
        }
    }

    /// Returns an orthonormal basis of the vectors orthogonal to all rows.
    pub(crate) fn null_space<const D: usize>(&self) -> [[f64; N]; D] {
        const {
            assert!(
                K > 0 && K + D == N,
                "rows and basis vectors must fill the space"
            )
        };
        let mut basis = [[0.0; N]; D];
        for (d, vector) in basis.iter_mut().enumerate() {
            vector[K + d] = 1.0;
            // The last reflection comes first, with a single nonzero number.
            let (last, scale) = (&self.vectors[K - 1], self.scales[K - 1]);
            subtract(last, scale * last[K + d], K - 1, vector);
            for j in (0..K - 1).rev() {
                reflect(&self.vectors[j], self.scales[j], j, vector);
            }
        }
        basis
    }
}

#[inline(always)]
fn reflect<const N: usize>(v: &[f64; N], scale: f64, from: usize, x: &mut [f64; N]) {
    let mut dot = 0.0;
    for i in from..N {
        dot += v[i] * x[i];
    }
    subtract(v, scale * dot, from, x);
}

#[inline(always)]
fn subtract<const N: usize>(v: &[f64; N], factor: f64, from: usize, x: &mut [f64; N]) {
    for i in from..N {
        x[i] -= factor * v[i];
    }
}

/// Returns the singular values (largest first) of a tall matrix and its right singular vectors, one
/// per row.
///
/// * `num_rows`: any number; with fewer than `N` the last singular values are 0
/// * `row`: returns the i-th row
///
/// The rows are first reduced to a triangle by Householder reflections, block by block, so nothing
/// is squared or allocated.
///
/// Source: Golub & Van Loan 2013, §5.2 (QR), §8.6.3 (one-sided Jacobi).
///
/// ```
/// use epipole::math::right_singular_vectors;
/// let rows = [[0.0, 3.0], [2.0, 0.0], [0.0, 4.0]];
/// let (values, vectors) = right_singular_vectors(rows.len(), |i| rows[i]);
/// assert!((values[0] - 5.0).abs() < 1e-12 && (values[1] - 2.0).abs() < 1e-12);
/// assert!((vectors[0][1].abs() - 1.0).abs() < 1e-12);
/// ```
pub fn right_singular_vectors<const N: usize>(
    num_rows: usize,
    row: impl Fn(usize) -> [f64; N],
) -> ([f64; N], [[f64; N]; N]) {
    const BLOCK: usize = 16;
    let mut triangle = [[0.0; N]; N];
    let mut next = 0;
    while next < num_rows {
        let count = BLOCK.min(num_rows - next);
        let mut block = [[0.0; N]; BLOCK];
        for (i, target) in block[..count].iter_mut().enumerate() {
            *target = row(next + i);
        }
        next += count;
        // Column by column: the vector to be reflected onto the diagonal has one entry in the
        // triangle and `count` entries in the block.
        for j in 0..N {
            let mut below_sq = 0.0;
            for r in &block[..count] {
                below_sq += r[j] * r[j];
            }
            if below_sq == 0.0 {
                continue;
            }
            let top = triangle[j][j];
            let norm = (top * top + below_sq).sqrt();
            let v_top = if top < 0.0 { top - norm } else { top + norm };
            let scale = 1.0 / (norm * (norm + top.abs()));
            for k in j..N {
                let mut dot = v_top * triangle[j][k];
                for r in &block[..count] {
                    dot += r[j] * r[k];
                }
                let factor = scale * dot;
                triangle[j][k] -= factor * v_top;
                if k > j {
                    for r in &mut block[..count] {
                        r[k] -= factor * r[j];
                    }
                }
            }
        }
    }
    one_sided_jacobi(triangle)
}

/// Returns the singular values (largest first) of a square matrix and its right singular vectors,
/// one per row.
pub(crate) fn one_sided_jacobi<const N: usize>(matrix: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    // Columns of the matrix as contiguous arrays, so that rotations are contiguous in memory.
    let mut a = [[0.0; N]; N];
    let mut v = [[0.0; N]; N];
    for i in 0..N {
        v[i][i] = 1.0;
        for j in 0..N {
            a[j][i] = matrix[i][j];
        }
    }
    for _ in 0..40 {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                let (mut alpha, mut beta, mut gamma) = (0.0, 0.0, 0.0);
                for i in 0..N {
                    alpha += a[p][i] * a[p][i];
                    beta += a[q][i] * a[q][i];
                    gamma += a[p][i] * a[q][i];
                }
                if gamma == 0.0 || gamma * gamma <= 1e-32 * alpha * beta {
                    continue;
                }
                rotated = true;
                let zeta = (beta - alpha) / (2.0 * gamma);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = cosine * tangent;
                for matrix in [&mut a, &mut v] {
                    for i in 0..N {
                        let (x, y) = (matrix[p][i], matrix[q][i]);
                        matrix[p][i] = cosine * x - sine * y;
                        matrix[q][i] = sine * x + cosine * y;
                    }
                }
            }
        }
        if !rotated {
            break;
        }
    }
    let mut order = [0; N];
    let mut norms = [0.0; N];
    for i in 0..N {
        order[i] = i;
        norms[i] = a[i].iter().map(|x| x * x).sum::<f64>().sqrt();
    }
    order.sort_by(|&i, &j| norms[j].total_cmp(&norms[i]));
    (order.map(|i| norms[i]), order.map(|i| v[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
        a.iter().zip(b).map(|(x, y)| x * y).sum()
    }

    #[test]
    fn basis_is_orthonormal_and_orthogonal_to_the_rows() {
        let mut random = Random::new(1);
        for trial in 0..50 {
            let mut rows = [[0.0; 9]; 7];
            for row in &mut rows {
                for x in row.iter_mut() {
                    *x = random.uniform(-1.0, 1.0);
                }
            }
            if trial % 5 == 0 {
                rows[3] = rows[1];
            }
            if trial % 7 == 0 {
                rows[2] = [0.0; 9];
            }
            let basis: [[f64; 9]; 2] = null_space(rows);
            assert!((dot(&basis[0], &basis[0]) - 1.0).abs() < 1e-14);
            assert!(dot(&basis[0], &basis[1]).abs() < 1e-14);
            for row in &rows {
                assert!(dot(row, &basis[0]).abs() < 1e-14 && dot(row, &basis[1]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn singular_values_of_a_known_matrix() {
        // Columns (3, 4, 0, 0) and (0, 0, 2, 0): singular values 5 and 2.
        let rows = [[3.0, 0.0], [4.0, 0.0], [0.0, 2.0], [0.0, 0.0]];
        let (values, vectors) = right_singular_vectors(4, |i| rows[i]);
        assert!((values[0] - 5.0).abs() < 1e-14 && (values[1] - 2.0).abs() < 1e-14);
        assert!((vectors[0][0].abs() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn many_rows_keep_a_small_singular_value() {
        let mut random = Random::new(2);
        let normal = [0.5, -0.5, 0.5, 0.5];
        let rows: Vec<[f64; 4]> = (0..1000)
            .map(|_| {
                let mut row = [0.0; 4].map(|_: f64| random.uniform(-1.0, 1.0));
                let off = dot(&row, &normal);
                for i in 0..4 {
                    row[i] -= off * normal[i];
                }
                row
            })
            .collect();
        let (values, vectors) = right_singular_vectors(rows.len(), |i| rows[i]);
        assert!(values[3] < 1e-13 && values[2] > 10.0, "{values:?}");
        assert!((dot(&vectors[3], &normal).abs() - 1.0).abs() < 1e-14);
    }
}
