//! The ten cubic equations for an essential matrix in a four-dimensional space.

/// A linear form in (x, y, z, 1).
type Linear = [f64; 4];
type Quadratic = [f64; 10];
pub(super) type Cubic = [f64; 20];

// Order of the quadratic's terms: x² xy xz x y² yz y z² z 1.
#[inline(always)]
fn add_product(a: &Linear, b: &Linear, q: &mut Quadratic) {
    q[0] += a[0] * b[0];
    q[1] += a[0] * b[1] + a[1] * b[0];
    q[2] += a[0] * b[2] + a[2] * b[0];
    q[3] += a[0] * b[3] + a[3] * b[0];
    q[4] += a[1] * b[1];
    q[5] += a[1] * b[2] + a[2] * b[1];
    q[6] += a[1] * b[3] + a[3] * b[1];
    q[7] += a[2] * b[2];
    q[8] += a[2] * b[3] + a[3] * b[2];
    q[9] += a[3] * b[3];
}

// Order of the cubic's terms: x³ y³ x²y xy² x²z x² y²z y² xyz xy | xz² xz x yz² yz y z³ z² z 1.
#[inline(always)]
fn add_cubic(q: &Quadratic, a: &Linear, c: &mut Cubic) {
    c[0] += q[0] * a[0];
    c[1] += q[4] * a[1];
    c[2] += q[0] * a[1] + q[1] * a[0];
    c[3] += q[1] * a[1] + q[4] * a[0];
    c[4] += q[0] * a[2] + q[2] * a[0];
    c[5] += q[0] * a[3] + q[3] * a[0];
    c[6] += q[4] * a[2] + q[5] * a[1];
    c[7] += q[4] * a[3] + q[6] * a[1];
    c[8] += q[1] * a[2] + q[2] * a[1] + q[5] * a[0];
    c[9] += q[1] * a[3] + q[3] * a[1] + q[6] * a[0];
    c[10] += q[2] * a[2] + q[7] * a[0];
    c[11] += q[2] * a[3] + q[3] * a[2] + q[8] * a[0];
    c[12] += q[3] * a[3] + q[9] * a[0];
    c[13] += q[5] * a[2] + q[7] * a[1];
    c[14] += q[5] * a[3] + q[6] * a[2] + q[8] * a[1];
    c[15] += q[6] * a[3] + q[9] * a[1];
    c[16] += q[7] * a[2];
    c[17] += q[7] * a[3] + q[8] * a[2];
    c[18] += q[8] * a[3] + q[9] * a[2];
    c[19] += q[9] * a[3];
}

/// Returns the ten cubics, one per row.
pub(super) fn constraints(basis: &[[f64; 9]; 4]) -> [Cubic; 10] {
    // Entry (i, j) of E as a linear form.
    let mut e = [[[0.0; 4]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            e[i][j] = [0, 1, 2, 3].map(|k| basis[k][3 * i + j]);
        }
    }
    let mut equations = [[0.0; 20]; 10];
    // det E by its first row.
    for j in 0..3 {
        let (k, l) = ((j + 1) % 3, (j + 2) % 3);
        let mut minor = [0.0; 10];
        add_product(&e[1][k], &e[2][l], &mut minor);
        let negative = e[1][l].map(|x| -x);
        add_product(&negative, &e[2][k], &mut minor);
        add_cubic(&minor, &e[0][j], &mut equations[0]);
    }
    // E Eᵀ is symmetric; 2 E Eᵀ E − tr(E Eᵀ) E = 2 (E Eᵀ − ½ tr) E.
    let mut eet = [[[0.0; 10]; 3]; 3];
    for i in 0..3 {
        for j in i..3 {
            let mut q = [0.0; 10];
            for k in 0..3 {
                add_product(&e[i][k], &e[j][k], &mut q);
            }
            eet[i][j] = q;
            eet[j][i] = q;
        }
    }
    let mut half_trace = [0.0; 10];
    for (i, h) in half_trace.iter_mut().enumerate() {
        *h = 0.5 * (eet[0][0][i] + eet[1][1][i] + eet[2][2][i]);
    }
    for i in 0..3 {
        for (q, h) in eet[i][i].iter_mut().zip(&half_trace) {
            *q -= h;
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            let equation = &mut equations[1 + 3 * i + j];
            for k in 0..3 {
                add_cubic(&eet[i][k], &e[k][j], equation);
            }
        }
    }
    equations
}
