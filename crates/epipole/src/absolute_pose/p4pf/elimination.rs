//! Depth ratios of four points in space: four quadrics in three unknowns.

use crate::math::real_roots::{DEGREE as ROOT_DEGREE, real_roots};
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, SMatrix, Vector2, Vector3, Vector4};

/// Degree of the remaining polynomial, the maximum number of solutions.
const DEGREE: usize = 6;

/// A polynomial in the ratio to be eliminated last, from the constant term upwards.
type Polynomial = [f64; DEGREE + 1];

/// A quadratic form in three ratios and 1.
type Quadric = SMatrix<f64, 4, 4>;

/// Coefficients of y, w and 1 in an equation.
type Row = [Polynomial; 3];

/// Maximum value of an extremum to count as a root: noise makes pairs of roots complex.
const NEARLY_TOUCHING: f64 = 1e-6;

/// Number of Gauss–Newton steps.
const STEPS: usize = 8;

/// Solves for the depths of four points, all positive, relative to the first.
///
/// * `pixels`: pixels relative to the principal point
/// * `inverse`: inverse of the matrix with the sides from the first point to the others as columns
pub(super) fn depth_ratios(
    pixels: &[Vector2<f64>; 4],
    inverse: &Matrix3<f64>,
) -> ArrayVec<Vector4<f64>, DEGREE> {
    let mut solutions = ArrayVec::new();
    let Some(quadrics) = quadrics(pixels, inverse) else {
        return solutions;
    };
    // Any of the three unknowns can be eliminated last; the squares and the product of the other
    // two must be well separated.
    let orders = [[0, 1, 2, 3], [1, 0, 2, 3], [2, 0, 1, 3]];
    let eliminations = orders.map(|order| Elimination::new(&quadrics, order));
    let Some(best) =
        (eliminations.iter().flatten()).max_by(|a, b| a.distinctness.total_cmp(&b.distinctness))
    else {
        return solutions;
    };
    let mut coefficients = [0.0; ROOT_DEGREE + 1];
    coefficients[..=DEGREE].copy_from_slice(&best.determinant());
    let mut roots = [0.0; ROOT_DEGREE];
    let count = real_roots(&coefficients, NEARLY_TOUCHING, &mut roots);
    for root in &roots[..count] {
        if *root <= 0.0 || solutions.is_full() {
            continue;
        }
        if let Some(start) = best.rest(*root) {
            let [z2, z3, z4, z1] = polish_solution(&quadrics, start).data.0[0];
            let depths = Vector4::new(z1, z2, z3, z4);
            if depths.iter().all(|z| z.is_finite() && *z > 0.0) {
                solutions.push(depths);
            }
        }
    }
    solutions
}

/// Returns the quadrics in (z₂, z₃, z₄, 1) that make the first two rows of `diag(1, 1, f) s R`
/// orthogonal to each other and to the third, and equally long; `None` if they are not finite. The
/// matrix is the product of the image differences and the inverse of the sides, linear in the
/// depths.
fn quadrics(pixels: &[Vector2<f64>; 4], inverse: &Matrix3<f64>) -> Option<[Quadric; 4]> {
    let row = |c: [f64; 4]| {
        SMatrix::<f64, 3, 4>::from_fn(|i, j| match j {
            3 => -c[0] * (0..3).map(|k| inverse[(k, i)]).sum::<f64>(),
            _ => c[j + 1] * inverse[(j, i)],
        })
    };
    let (a, b, c) = (
        row(pixels.map(|p| p.x)),
        row(pixels.map(|p| p.y)),
        row([1.0; 4]),
    );
    let forms = [
        a.transpose() * b,
        a.transpose() * c,
        b.transpose() * c,
        a.transpose() * a - b.transpose() * b,
    ];
    let quadrics = forms.map(|m| {
        let symmetric = 0.5 * (m + m.transpose());
        symmetric / symmetric.norm()
    });
    let finite = quadrics.iter().flatten().all(|x| x.is_finite());
    finite.then_some(quadrics)
}

/// Equations in x, to be eliminated last, y and w.
struct Elimination {
    order: [usize; 4],
    /// y², y w and w² as combinations of y, w and 1 with polynomials in x as coefficients.
    products: [Row; 3],
    /// An equation without these products.
    linear: Row,
    /// Conditioning of the four equations for y², y w and w².
    distinctness: f64,
}

impl Elimination {
    fn new(quadrics: &[Quadric; 4], order: [usize; 4]) -> Option<Self> {
        let entry = |q: usize, i: usize, j: usize| quadrics[q][(order[i], order[j])];
        let leading = SMatrix::<f64, 4, 3>::from_fn(|q, column| match column {
            0 => entry(q, 1, 1),
            1 => 2.0 * entry(q, 1, 2),
            _ => entry(q, 2, 2),
        });
        let rest = |q: usize| -> Row {
            [
                polynomial([2.0 * entry(q, 1, 3), 2.0 * entry(q, 0, 1), 0.0]),
                polynomial([2.0 * entry(q, 2, 3), 2.0 * entry(q, 0, 2), 0.0]),
                polynomial([entry(q, 3, 3), 2.0 * entry(q, 0, 3), entry(q, 0, 0)]),
            ]
        };
        let rest: [Row; 4] = core::array::from_fn(rest);
        let qr = leading.qr();
        let (q, r) = (qr.q(), qr.r());
        let diagonal = r.diagonal().abs();
        let solve = r.try_inverse()? * q.transpose();
        let products = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                core::array::from_fn(|k| {
                    -(0..4).map(|e| solve[(i, e)] * rest[e][j][k]).sum::<f64>()
                })
            })
        });
        // Direction least spanned by the leading columns: the longest remainder of a unit vector.
        let remainder = |e: usize| -> Vector4<f64> {
            let unit = Vector4::from_fn(|i, _| f64::from(u8::from(i == e)));
            unit - q * (q.transpose() * unit)
        };
        let longest = (0..4)
            .map(remainder)
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let linear = core::array::from_fn(|j| {
            core::array::from_fn(|k| (0..4).map(|e| longest[e] * rest[e][j][k]).sum())
        });
        Some(Self {
            order,
            products,
            linear,
            distinctness: diagonal.min() / diagonal.max(),
        })
    }

    /// Returns `(y²) w = y (y w)` and `y (w²) = w (y w)`, with the products substituted.
    fn identities(&self) -> [Row; 2] {
        let [yy, yw, ww] = &self.products;
        let y_and_1 = minus(&yy[0], &yw[1]);
        let w_and_1 = minus(&ww[1], &yw[0]);
        let zero = [0.0; DEGREE + 1];
        let sum = |a: &Polynomial, b: &Polynomial, c: &Polynomial| {
            core::array::from_fn(|k| a[k] + b[k] + c[k])
        };
        let first = core::array::from_fn(|j| {
            let extra = [minus(&zero, &yw[2]), yy[2], zero][j];
            let two = minus(&times(&yy[1], &ww[j]), &times(&yw[0], &yy[j]));
            sum(&times(&y_and_1, &yw[j]), &two, &extra)
        });
        let second = core::array::from_fn(|j| {
            let extra = [ww[2], minus(&zero, &yw[2]), zero][j];
            let two = minus(&times(&ww[0], &yy[j]), &times(&yw[1], &ww[j]));
            sum(&times(&w_and_1, &yw[j]), &two, &extra)
        });
        [first, second]
    }

    /// Returns the determinant of the linear equation and the two identities.
    fn determinant(&self) -> Polynomial {
        let [a, b] = self.identities();
        let minor = |i: usize, j: usize| minus(&times(&a[i], &b[j]), &times(&a[j], &b[i]));
        let l = &self.linear;
        let terms = [
            times(&l[0], &minor(1, 2)),
            times(&l[1], &minor(2, 0)),
            times(&l[2], &minor(0, 1)),
        ];
        core::array::from_fn(|k| terms.iter().map(|term| term[k]).sum())
    }

    /// Returns the unknowns, in the order of the quadrics, for a root x.
    fn rest(&self, x: f64) -> Option<Vector4<f64>> {
        let [first, second] = self.identities();
        let at =
            |row: &Row| Vector3::from_fn(|j, _| row[j].iter().rev().fold(0.0, |s, c| s * x + c));
        let rows = [&self.linear, &first, &second].map(|row| at(row).normalize());
        let crosses = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| rows[i].cross(&rows[j]));
        let null = crosses
            .into_iter()
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
        let mut unknowns = Vector4::zeros();
        for (place, value) in self
            .order
            .iter()
            .zip([x, null.x / null.z, null.y / null.z, 1.0])
        {
            unknowns[*place] = value;
        }
        unknowns.iter().all(|z| z.is_finite()).then_some(unknowns)
    }
}

/// Improves a solution by a few Gauss–Newton steps on the four quadrics.
fn polish_solution(quadrics: &[Quadric; 4], start: Vector4<f64>) -> Vector4<f64> {
    let value = |z: &Vector4<f64>| Vector4::from_fn(|q, _| z.dot(&(quadrics[q] * z)));
    let mut z = start;
    for _ in 0..STEPS {
        let slopes =
            SMatrix::<f64, 4, 3>::from_fn(|q, i| 2.0 * quadrics[q].row(i).dot(&z.transpose()));
        let Some(step) = (slopes.transpose() * slopes)
            .lu()
            .solve(&(slopes.transpose() * value(&z)))
        else {
            break;
        };
        for i in 0..3 {
            z[i] -= step[i];
        }
        if step.amax() < 1e-15 * z.amax() {
            break;
        }
    }
    z
}

fn polynomial([c0, c1, c2]: [f64; 3]) -> Polynomial {
    [c0, c1, c2, 0.0, 0.0, 0.0, 0.0]
}

fn minus(a: &Polynomial, b: &Polynomial) -> Polynomial {
    core::array::from_fn(|k| a[k] - b[k])
}

/// Products here have degree six or less.
fn times(a: &Polynomial, b: &Polynomial) -> Polynomial {
    core::array::from_fn(|k| (0..=k).map(|i| a[i] * b[k - i]).sum())
}
