//! The ten equations as a matrix that is quadratic in f⁻².

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Coefficients of xx, xy, xz, yy, yz, zz.
type Quadratic = [f64; 6];

/// Coefficients of xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
type Cubic = [f64; 10];

const PRODUCTS: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// Cubic monomials of each quadratic one times x, y and z.
const TRIPLES: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 3, 4],
    [2, 4, 5],
    [3, 6, 7],
    [4, 7, 8],
    [5, 8, 9],
];

/// The degree of the polynomial in f⁻².
pub(super) const DEGREE: usize = 15;

fn add_product(sum: &mut Quadratic, a: &[f64; 3], b: &[f64; 3], factor: f64) {
    for i in 0..3 {
        for j in 0..3 {
            sum[PRODUCTS[i][j]] += factor * a[i] * b[j];
        }
    }
}

fn add_triple(sum: &mut Cubic, a: &Quadratic, b: &[f64; 3], factor: f64) {
    for i in 0..6 {
        for j in 0..3 {
            sum[TRIPLES[i][j]] += factor * a[i] * b[j];
        }
    }
}

/// Returns the cubic monomials.
fn cubes(v: &Vector3<f64>) -> SVector<f64, 10> {
    let (x, y, z) = (v.x, v.y, v.z);
    SVector::from([
        x * x * x,
        x * x * y,
        x * x * z,
        x * y * y,
        x * y * z,
        x * z * z,
        y * y * y,
        y * y * z,
        y * z * z,
        z * z * z,
    ])
}

/// Returns their derivatives by x, y and z.
fn cubes_derivatives(v: &Vector3<f64>) -> SMatrix<f64, 10, 3> {
    let (x, y, z) = (v.x, v.y, v.z);
    let columns = [
        [
            3.0 * x * x,
            2.0 * x * y,
            2.0 * x * z,
            y * y,
            y * z,
            z * z,
            0.0,
            0.0,
            0.0,
            0.0,
        ],
        [
            0.0,
            x * x,
            0.0,
            2.0 * x * y,
            x * z,
            0.0,
            3.0 * y * y,
            2.0 * y * z,
            z * z,
            0.0,
        ],
        [
            0.0,
            0.0,
            x * x,
            0.0,
            x * y,
            2.0 * x * z,
            0.0,
            y * y,
            2.0 * y * z,
            3.0 * z * z,
        ],
    ];
    SMatrix::from_fn(|i, j| columns[j][i])
}

type Square = SMatrix<f64, 10, 10>;

/// `(A0 + w A1 + w² A2) m = 0`, with w = f⁻² and m the cubic monomials.
pub(super) struct Pencil {
    parts: [Square; 3],
}

impl Pencil {
    /// Creates the pencil of the fundamental matrices `x F1 + y F2 + z F3`.
    pub(super) fn new(basis: &[Matrix3<f64>; 3]) -> Self {
        let f = |i: usize, j: usize| basis.map(|b| b[(i, j)]);
        // F P Fᵀ: without and with w.
        let mut gram = [[[[0.0; 6]; 2]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                for k in 0..3 {
                    add_product(&mut gram[i][j][k / 2], &f(i, k), &f(j, k), 1.0);
                }
            }
        }
        let mut trace = [[0.0; 6]; 3];
        for l in 0..3 {
            for power in 0..2 {
                for (sum, term) in trace[power + l / 2].iter_mut().zip(&gram[l][l][power]) {
                    *sum += term;
                }
            }
        }
        let mut parts = [Square::zeros(); 3];
        let mut set = |power: usize, row: usize, cubic: &Cubic| {
            for (column, value) in cubic.iter().enumerate() {
                parts[power][(row, column)] = *value;
            }
        };
        for i in 0..3 {
            for j in 0..3 {
                let mut row = [[0.0; 10]; 3];
                for l in 0..3 {
                    for power in 0..2 {
                        add_triple(&mut row[power + l / 2], &gram[i][l][power], &f(l, j), 2.0);
                    }
                }
                for power in 0..3 {
                    add_triple(&mut row[power], &trace[power], &f(i, j), -1.0);
                    set(power, 3 * i + j, &row[power]);
                }
            }
        }
        let mut determinant = [0.0; 10];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let mut minor = [0.0; 6];
            add_product(&mut minor, &f(1, j), &f(2, k), 1.0);
            add_product(&mut minor, &f(1, k), &f(2, j), -1.0);
            add_triple(&mut determinant, &minor, &f(0, i), 1.0);
        }
        set(0, 9, &determinant);
        Self { parts }
    }

    /// Combines the parts with weights; the determinant of F has no w.
    fn combined(&self, weights: [f64; 3]) -> Square {
        let mut sum =
            self.parts[0] * weights[0] + self.parts[1] * weights[1] + self.parts[2] * weights[2];
        sum.set_row(9, &self.parts[0].row(9));
        sum
    }

    /// Returns the determinant as Chebyshev coefficients in s, where `w = (1 + s)/(1 − s)`: all
    /// positive w are in (−1, 1). Three roots at infinite w are divided out.
    pub(super) fn polynomial(&self) -> [f64; DEGREE + 1] {
        let count = (DEGREE + 1) as f64;
        let angle = |i: usize| core::f64::consts::PI * (i as f64 + 0.5) / count;
        let values: [f64; DEGREE + 1] = core::array::from_fn(|i| {
            let s = libm::cos(angle(i));
            let (down, up) = (1.0 - s, 1.0 + s);
            let matrix = self.combined([down * down, down * up, up * up]);
            matrix.lu().determinant() / (down * down * down)
        });
        core::array::from_fn(|k| {
            let factor = if k == 0 { 1.0 } else { 2.0 } / count;
            let term = |i: usize| values[i] * libm::cos(k as f64 * angle(i));
            factor * (0..=DEGREE).map(term).sum::<f64>()
        })
    }

    /// Returns (x, y, z), of length 1, of the monomials closest to the null space.
    pub(super) fn null_vector(&self, w: f64) -> Option<Vector3<f64>> {
        let per = 1.0 / ((1.0 + w) * (1.0 + w));
        let matrix = self.combined([per, w * per, w * w * per]);
        let lu = matrix.full_piv_lu();
        // Inverse iteration, with the smallest pivot replacing zero.
        let upper = lu.u();
        let mut m = SVector::<f64, 10>::zeros();
        m[9] = 1.0;
        for i in (0..9).rev() {
            let rest: f64 = (i + 1..10).map(|j| upper[(i, j)] * m[j]).sum();
            m[i] = -rest / upper[(i, i)];
        }
        lu.q().inv_permute_rows(&mut m);
        let places = [[0, 1, 2], [3, 6, 7], [5, 8, 9]];
        let largest = [0, 6, 9]
            .iter()
            .enumerate()
            .max_by(|a, b| m[*a.1].abs().total_cmp(&m[*b.1].abs()))?
            .0;
        let v = Vector3::from(places[largest].map(|place| m[place]));
        let length = v.norm();
        (length > 0.0 && length.is_finite()).then(|| v / length)
    }

    /// Returns the residuals, their derivatives by log w and by (x, y, z), and the size of their
    /// terms.
    pub(super) fn linearize(
        &self,
        w: f64,
        v: &Vector3<f64>,
    ) -> (SVector<f64, 10>, SVector<f64, 10>, SMatrix<f64, 10, 3>, f64) {
        let per = 1.0 / ((1.0 + w) * (1.0 + w));
        let matrix = self.combined([per, w * per, w * w * per]);
        let m = cubes(v);
        let mut by_log_w = (self.parts[1] * (w * per) + self.parts[2] * (2.0 * w * w * per)) * m;
        by_log_w[9] = 0.0;
        let size = matrix.norm() * m.norm();
        (matrix * m, by_log_w, matrix * cubes_derivatives(v), size)
    }
}
