//! The nonlinear regression problems of NIST's Statistical Reference Datasets, from both of their
//! starts: the far one and the near one. Certified values: <https://www.itl.nist.gov/div898/strd/>.

use epipole::optim::{DenseProblem, LmOptions, check_jacobian, minimize_dense};
use libm::{atan, exp, log, pow};
use nalgebra::{DMatrix, DVector};

type Model = fn(f64, &[f64]) -> f64;
type Gradient = fn(f64, &[f64], &mut [f64]);

struct DataSet {
    name: &'static str,
    model: Model,
    gradient: Gradient,
    x: Vec<f64>,
    y: Vec<f64>,
    starts: [Vec<f64>; 2],
    certified: Vec<f64>,
    /// Residual sum of squares.
    certified_rss: f64,
}

impl DenseProblem for DataSet {
    fn num_residuals(&self) -> usize {
        self.x.len()
    }
    fn residuals(&self, p: &DVector<f64>, r: &mut DVector<f64>) {
        for (i, (x, y)) in self.x.iter().zip(&self.y).enumerate() {
            r[i] = (self.model)(*x, p.as_slice()) - y;
        }
    }
    fn jacobian(&self, p: &DVector<f64>, j: &mut DMatrix<f64>) {
        let mut row = vec![0.0; p.len()];
        for (i, x) in self.x.iter().enumerate() {
            (self.gradient)(*x, p.as_slice(), &mut row);
            for (k, g) in row.iter().enumerate() {
                j[(i, k)] = *g;
            }
        }
    }
}

fn misra_x() -> Vec<f64> {
    vec![
        77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
        760.0,
    ]
}

fn misra_y() -> Vec<f64> {
    vec![
        10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
        81.78,
    ]
}

/// The Lanczos sets are sums of three exponentials, printed with 14 digits, 6 digits and 4
/// decimals.
fn lanczos_x() -> Vec<f64> {
    (0..24).map(|i| f64::from(i) * 0.05).collect()
}

const LANCZOS_14: [f64; 24] = [
    2.513400000000e+00,
    2.044333373291e+00,
    1.668404436564e+00,
    1.366418021208e+00,
    1.123232487372e+00,
    9.268897180037e-01,
    7.679338563728e-01,
    6.388775523106e-01,
    5.337835317402e-01,
    4.479363617347e-01,
    3.775847884350e-01,
    3.197393199326e-01,
    2.720130773746e-01,
    2.324965529032e-01,
    1.996589546065e-01,
    1.722704126914e-01,
    1.493405660168e-01,
    1.300700206922e-01,
    1.138119324644e-01,
    1.000415587559e-01,
    8.833209084540e-02,
    7.833544019350e-02,
    6.976693743449e-02,
    6.239312536719e-02,
];

/// Six significant digits.
fn lanczos2_y() -> Vec<f64> {
    let print = |y: &f64| format!("{y:.5e}").parse().expect("a printed number");
    LANCZOS_14.iter().map(print).collect()
}

/// Four decimals.
fn lanczos3_y() -> Vec<f64> {
    let print = |y: &f64| format!("{y:.4}").parse().expect("a printed number");
    LANCZOS_14.iter().map(print).collect()
}

fn lanczos(x: f64, b: &[f64]) -> f64 {
    b[0] * exp(-b[1] * x) + b[2] * exp(-b[3] * x) + b[4] * exp(-b[5] * x)
}

fn lanczos_gradient(x: f64, b: &[f64], g: &mut [f64]) {
    for k in [0, 2, 4] {
        g[k] = exp(-b[k + 1] * x);
        g[k + 1] = -b[k] * x * exp(-b[k + 1] * x);
    }
}

fn lanczos_starts() -> [Vec<f64>; 2] {
    [
        vec![1.2, 0.3, 5.6, 5.5, 6.5, 7.6],
        vec![0.5, 0.7, 3.6, 4.2, 4.0, 6.3],
    ]
}

fn data_sets() -> Vec<DataSet> {
    vec![
        DataSet {
            name: "Misra1a",
            model: |x, b| b[0] * (1.0 - exp(-b[1] * x)),
            gradient: |x, b, g| {
                g[0] = 1.0 - exp(-b[1] * x);
                g[1] = b[0] * x * exp(-b[1] * x);
            },
            x: misra_x(),
            y: misra_y(),
            starts: [vec![500.0, 0.0001], vec![250.0, 0.0005]],
            certified: vec![2.3894212918e+02, 5.5015643181e-04],
            certified_rss: 1.2455138894e-01,
        },
        DataSet {
            name: "Misra1b",
            model: |x, b| b[0] * (1.0 - pow(1.0 + b[1] * x / 2.0, -2.0)),
            gradient: |x, b, g| {
                let base = 1.0 + b[1] * x / 2.0;
                g[0] = 1.0 - pow(base, -2.0);
                g[1] = b[0] * x * pow(base, -3.0);
            },
            x: misra_x(),
            y: misra_y(),
            starts: [vec![500.0, 0.0001], vec![300.0, 0.0002]],
            certified: vec![3.3799746163e+02, 3.9039091287e-04],
            certified_rss: 7.5464681533e-02,
        },
        DataSet {
            name: "Misra1c",
            model: |x, b| b[0] * (1.0 - pow(1.0 + 2.0 * b[1] * x, -0.5)),
            gradient: |x, b, g| {
                let base = 1.0 + 2.0 * b[1] * x;
                g[0] = 1.0 - pow(base, -0.5);
                g[1] = b[0] * x * pow(base, -1.5);
            },
            x: misra_x(),
            y: misra_y(),
            starts: [vec![500.0, 0.0001], vec![600.0, 0.0002]],
            certified: vec![6.3642725809e+02, 2.0813627256e-04],
            certified_rss: 4.0966836971e-02,
        },
        DataSet {
            name: "Misra1d",
            model: |x, b| b[0] * b[1] * x / (1.0 + b[1] * x),
            gradient: |x, b, g| {
                let base = 1.0 + b[1] * x;
                g[0] = b[1] * x / base;
                g[1] = b[0] * x / (base * base);
            },
            x: misra_x(),
            y: misra_y(),
            starts: [vec![500.0, 0.0001], vec![450.0, 0.0003]],
            certified: vec![4.3736970754e+02, 3.0227324449e-04],
            certified_rss: 5.6419295283e-02,
        },
        DataSet {
            name: "DanWood",
            model: |x, b| b[0] * pow(x, b[1]),
            gradient: |x, b, g| {
                g[0] = pow(x, b[1]);
                g[1] = b[0] * pow(x, b[1]) * log(x);
            },
            x: vec![1.309, 1.471, 1.490, 1.565, 1.611, 1.680],
            y: vec![2.138, 3.421, 3.597, 4.340, 4.882, 5.660],
            starts: [vec![1.0, 5.0], vec![0.7, 4.0]],
            certified: vec![7.6886226176e-01, 3.8604055871e+00],
            certified_rss: 4.3173084083e-03,
        },
        DataSet {
            name: "Lanczos1",
            model: lanczos,
            gradient: lanczos_gradient,
            x: lanczos_x(),
            y: LANCZOS_14.to_vec(),
            starts: lanczos_starts(),
            certified: vec![
                9.5100000027e-02,
                1.0000000001e+00,
                8.6070000013e-01,
                3.0000000002e+00,
                1.5575999998e+00,
                5.0000000001e+00,
            ],
            certified_rss: 1.4307867721e-25,
        },
        DataSet {
            name: "Lanczos2",
            model: lanczos,
            gradient: lanczos_gradient,
            x: lanczos_x(),
            y: lanczos2_y(),
            starts: lanczos_starts(),
            certified: vec![
                9.6251029939e-02,
                1.0057332849e+00,
                8.6424689056e-01,
                3.0078283915e+00,
                1.5529016879e+00,
                5.0028798100e+00,
            ],
            certified_rss: 2.2299428125e-11,
        },
        DataSet {
            name: "Lanczos3",
            model: lanczos,
            gradient: lanczos_gradient,
            x: lanczos_x(),
            y: lanczos3_y(),
            starts: lanczos_starts(),
            certified: vec![
                8.6816414977e-02,
                9.5498101505e-01,
                8.4400777463e-01,
                2.9515951832e+00,
                1.5825685901e+00,
                4.9863565084e+00,
            ],
            certified_rss: 1.6117193594e-08,
        },
        DataSet {
            name: "MGH09",
            model: |x, b| b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]),
            gradient: |x, b, g| {
                let factor = 1.0 / (x * x + x * b[2] + b[3]);
                let top = x * x + x * b[1];
                g[0] = top * factor;
                g[1] = b[0] * x * factor;
                g[2] = -b[0] * top * x * factor * factor;
                g[3] = -b[0] * top * factor * factor;
            },
            x: vec![
                4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625,
            ],
            y: vec![
                0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235,
                0.0246,
            ],
            starts: [vec![25.0, 39.0, 41.5, 39.0], vec![0.25, 0.39, 0.415, 0.39]],
            certified: vec![
                1.9280693458e-01,
                1.9128232873e-01,
                1.2305650693e-01,
                1.3606233068e-01,
            ],
            certified_rss: 3.0750560385e-04,
        },
        DataSet {
            name: "MGH10",
            model: |x, b| b[0] * exp(b[1] / (x + b[2])),
            gradient: |x, b, g| {
                let factor = 1.0 / (x + b[2]);
                let e = exp(b[1] * factor);
                g[0] = e;
                g[1] = b[0] * factor * e;
                g[2] = -b[1] * b[0] * factor * factor * e;
            },
            x: (0..16).map(|i| 50.0 + 5.0 * f64::from(i)).collect(),
            y: vec![
                34780.0, 28610.0, 23650.0, 19630.0, 16370.0, 13720.0, 11540.0, 9744.0, 8261.0,
                7030.0, 6005.0, 5147.0, 4427.0, 3820.0, 3307.0, 2872.0,
            ],
            starts: [vec![2.0, 400000.0, 25000.0], vec![0.02, 4000.0, 250.0]],
            certified: vec![5.6096364710e-03, 6.1813463463e+03, 3.4522363462e+02],
            certified_rss: 8.7945855171e+01,
        },
        DataSet {
            name: "MGH17",
            model: |x, b| b[0] + b[1] * exp(-x * b[3]) + b[2] * exp(-x * b[4]),
            gradient: |x, b, g| {
                g[0] = 1.0;
                g[1] = exp(-b[3] * x);
                g[2] = exp(-b[4] * x);
                g[3] = -x * b[1] * exp(-b[3] * x);
                g[4] = -x * b[2] * exp(-b[4] * x);
            },
            x: (0..33).map(|i| 10.0 * f64::from(i)).collect(),
            y: vec![
                0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751, 0.718,
                0.685, 0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490, 0.478, 0.467,
                0.457, 0.448, 0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406,
            ],
            starts: [
                vec![50.0, 150.0, -100.0, 1.0, 2.0],
                vec![0.5, 1.5, -1.0, 0.01, 0.02],
            ],
            certified: vec![
                3.7541005211e-01,
                1.9358469127e+00,
                -1.4646871366e+00,
                1.2867534640e-02,
                2.2122699662e-02,
            ],
            certified_rss: 5.4648946975e-05,
        },
        DataSet {
            name: "BoxBOD",
            model: |x, b| b[0] * (1.0 - exp(-b[1] * x)),
            gradient: |x, b, g| {
                g[0] = 1.0 - exp(-b[1] * x);
                g[1] = b[0] * x * exp(-b[1] * x);
            },
            x: vec![1.0, 2.0, 3.0, 5.0, 7.0, 10.0],
            y: vec![109.0, 149.0, 149.0, 191.0, 213.0, 224.0],
            starts: [vec![1.0, 1.0], vec![100.0, 0.75]],
            certified: vec![2.1380940889e+02, 5.4723748542e-01],
            certified_rss: 1.1680088766e+03,
        },
        DataSet {
            name: "Rat42",
            model: |x, b| b[0] / (1.0 + exp(b[1] - b[2] * x)),
            gradient: |x, b, g| {
                let e = exp(b[1] - b[2] * x);
                g[0] = 1.0 / (1.0 + e);
                g[1] = -b[0] * e / ((1.0 + e) * (1.0 + e));
                g[2] = b[0] * e * x / ((1.0 + e) * (1.0 + e));
            },
            x: vec![9.0, 14.0, 21.0, 28.0, 42.0, 57.0, 63.0, 70.0, 79.0],
            y: vec![
                8.930, 10.800, 18.590, 22.330, 39.350, 56.110, 61.730, 64.620, 67.080,
            ],
            starts: [vec![100.0, 1.0, 0.1], vec![75.0, 2.5, 0.07]],
            certified: vec![7.2462237576e+01, 2.6180768402e+00, 6.7359200066e-02],
            certified_rss: 8.0565229338e+00,
        },
        DataSet {
            name: "Rat43",
            model: |x, b| b[0] * pow(1.0 + exp(b[1] - b[2] * x), -1.0 / b[3]),
            gradient: |x, b, g| {
                let e = exp(b[1] - b[2] * x);
                let power = -1.0 / b[3];
                g[0] = pow(1.0 + e, power);
                g[1] = power * b[0] * e * pow(1.0 + e, power - 1.0);
                g[2] = -power * b[0] * e * x * pow(1.0 + e, power - 1.0);
                g[3] = b[0] * power * power * log(1.0 + e) * pow(1.0 + e, power);
            },
            x: (1..=15).map(f64::from).collect(),
            y: vec![
                16.08, 33.83, 65.80, 97.20, 191.55, 326.20, 386.87, 520.53, 590.03, 651.92, 724.93,
                699.56, 689.96, 637.56, 717.41,
            ],
            starts: [vec![100.0, 10.0, 1.0, 1.0], vec![700.0, 5.0, 0.75, 1.3]],
            certified: vec![
                6.9964151270e+02,
                5.2771253025e+00,
                7.5962938329e-01,
                1.2792483859e+00,
            ],
            certified_rss: 8.7864049080e+03,
        },
        DataSet {
            name: "Eckerle4",
            model: |x, b| {
                let z = (x - b[2]) / b[1];
                b[0] / b[1] * exp(-0.5 * z * z)
            },
            gradient: |x, b, g| {
                let z = (x - b[2]) / b[1];
                let e = exp(-0.5 * z * z);
                g[0] = e / b[1];
                g[1] = (z * z - 1.0) * b[0] * e / (b[1] * b[1]);
                g[2] = z * b[0] * e / (b[1] * b[1]);
            },
            x: vec![
                400.0, 405.0, 410.0, 415.0, 420.0, 425.0, 430.0, 435.0, 436.5, 438.0, 439.5, 441.0,
                442.5, 444.0, 445.5, 447.0, 448.5, 450.0, 451.5, 453.0, 454.5, 456.0, 457.5, 459.0,
                460.5, 462.0, 463.5, 465.0, 470.0, 475.0, 480.0, 485.0, 490.0, 495.0, 500.0,
            ],
            y: vec![
                0.0001575, 0.0001699, 0.0002350, 0.0003102, 0.0004917, 0.0008710, 0.0017418,
                0.0046400, 0.0065895, 0.0097302, 0.0149002, 0.0237310, 0.0401683, 0.0712559,
                0.1264458, 0.2073413, 0.2902366, 0.3445623, 0.3698049, 0.3668534, 0.3106727,
                0.2078154, 0.1164354, 0.0616764, 0.0337200, 0.0194023, 0.0117831, 0.0074357,
                0.0022732, 0.0008800, 0.0004579, 0.0002345, 0.0001586, 0.0001143, 0.0000710,
            ],
            starts: [vec![1.0, 10.0, 500.0], vec![1.5, 5.0, 450.0]],
            certified: vec![1.5543827178e+00, 4.0888321754e+00, 4.5154121844e+02],
            certified_rss: 1.4635887487e-03,
        },
        DataSet {
            name: "Thurber",
            model: |x, b| {
                (b[0] + x * (b[1] + x * (b[2] + x * b[3])))
                    / (1.0 + x * (b[4] + x * (b[5] + x * b[6])))
            },
            gradient: |x, b, g| {
                let factor = 1.0 / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
                let value = (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) * factor;
                g[0] = factor;
                g[1] = x * factor;
                g[2] = x * x * factor;
                g[3] = x * x * x * factor;
                g[4] = -value * x * factor;
                g[5] = -value * x * x * factor;
                g[6] = -value * x * x * x * factor;
            },
            x: vec![
                -3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481,
                -2.363, -2.322, -1.501, -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714,
                -0.566, -0.545, -0.400, -0.309, -0.109, -0.103, 0.010, 0.119, 0.377, 0.790, 0.963,
                1.006, 1.115, 1.572, 1.841, 2.047, 2.200,
            ],
            y: vec![
                80.574, 84.248, 87.264, 87.195, 89.076, 89.608, 89.868, 90.101, 92.405, 95.854,
                100.696, 101.060, 401.672, 390.724, 567.534, 635.316, 733.054, 759.087, 894.206,
                990.785, 1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339,
                1327.543, 1353.863, 1414.509, 1425.208, 1421.384, 1442.962, 1464.350, 1468.705,
                1447.894, 1457.628,
            ],
            starts: [
                vec![1000.0, 1000.0, 400.0, 40.0, 0.7, 0.3, 0.03],
                vec![1300.0, 1500.0, 500.0, 75.0, 1.0, 0.4, 0.05],
            ],
            certified: vec![
                1.2881396800e+03,
                1.4910792535e+03,
                5.8323836877e+02,
                7.5416644291e+01,
                9.6629502864e-01,
                3.9797285797e-01,
                4.9727297349e-02,
            ],
            certified_rss: 5.6427082397e+03,
        },
        DataSet {
            name: "Roszman1",
            model: |x, b| b[0] - b[1] * x - atan(b[2] / (x - b[3])) * std::f64::consts::FRAC_1_PI,
            gradient: |x, b, g| {
                let (dx, pi_inverse) = (x - b[3], std::f64::consts::FRAC_1_PI);
                let slope = 1.0 / (dx * dx + b[2] * b[2]);
                g[0] = 1.0;
                g[1] = -x;
                g[2] = -dx * slope * pi_inverse;
                g[3] = -b[2] * slope * pi_inverse;
            },
            x: vec![
                -4868.68, -4868.09, -4867.41, -3375.19, -3373.14, -3372.03, -2473.74, -2472.35,
                -2469.45, -1894.65, -1893.40, -1497.24, -1495.85, -1493.41, -1208.68, -1206.18,
                -1206.04, -997.92, -996.61, -996.31, -834.94, -834.66, -710.03, -530.16, -464.17,
            ],
            y: vec![
                0.252429, 0.252141, 0.251809, 0.297989, 0.296257, 0.295319, 0.339603, 0.337731,
                0.333820, 0.389510, 0.386998, 0.438864, 0.434887, 0.427893, 0.471568, 0.461699,
                0.461144, 0.513532, 0.506641, 0.505062, 0.535648, 0.533726, 0.568064, 0.612886,
                0.624169,
            ],
            starts: [
                vec![0.1, -0.00001, 1000.0, -100.0],
                vec![0.2, -0.000005, 1200.0, -150.0],
            ],
            certified: vec![
                2.0196866396e-01,
                -6.1953516256e-06,
                1.2044556708e+03,
                -1.8134269537e+02,
            ],
            certified_rss: 4.9484847331e-04,
        },
        DataSet {
            name: "Chwirut2",
            model: |x, b| exp(-b[0] * x) / (b[1] + b[2] * x),
            gradient: |x, b, g| {
                let (e, factor) = (exp(-b[0] * x), 1.0 / (b[1] + b[2] * x));
                g[0] = -x * e * factor;
                g[1] = -e * factor * factor;
                g[2] = -x * e * factor * factor;
            },
            x: vec![
                0.5, 1.0, 1.75, 3.75, 5.75, 0.875, 2.25, 3.25, 5.25, 0.75, 1.75, 2.75, 4.75, 0.625,
                1.25, 2.25, 4.25, 0.5, 3.0, 0.75, 3.0, 1.5, 6.0, 3.0, 6.0, 1.5, 3.0, 0.5, 2.0, 4.0,
                0.75, 2.0, 5.0, 0.75, 2.25, 3.75, 5.75, 3.0, 0.75, 2.5, 4.0, 0.75, 2.5, 4.0, 0.75,
                2.5, 4.0, 0.5, 6.0, 3.0, 0.5, 2.75, 0.5, 1.75,
            ],
            y: vec![
                92.9, 57.1, 31.05, 11.5875, 8.025, 63.6, 21.4, 14.25, 8.475, 63.8, 26.8, 16.4625,
                7.125, 67.3, 41.0, 21.15, 8.175, 81.5, 13.12, 59.9, 14.62, 32.9, 5.44, 12.56, 5.44,
                32.0, 13.95, 75.8, 20.0, 10.42, 59.5, 21.67, 8.55, 62.0, 20.2, 7.76, 3.75, 11.81,
                54.7, 23.7, 11.55, 61.3, 17.7, 8.74, 59.2, 16.3, 8.62, 81.0, 4.87, 14.62, 81.7,
                17.17, 81.3, 28.9,
            ],
            starts: [vec![0.1, 0.01, 0.02], vec![0.15, 0.008, 0.010]],
            certified: vec![1.6657666537e-01, 5.1653291286e-03, 1.2150007096e-02],
            certified_rss: 5.1304802941e+02,
        },
    ]
}

#[test]
fn certified_values_from_both_starts() {
    let options = LmOptions::default()
        .with_max_iterations(10_000)
        .with_gradient_tolerance(0.0)
        .with_step_tolerance(1e-15)
        .with_cost_tolerance(0.0)
        .with_initial_damping(1e3)
        .with_patience(0);
    let mut sum_of_digits = 0.0;
    let mut fits = 0.0;
    for set in data_sets() {
        for start in &set.starts {
            let mut b = DVector::from_vec(start.clone());
            let report = minimize_dense(&set, &mut b, &options, &mut ()).unwrap();
            let mut digits: f64 = 11.0;
            for (got, want) in b.iter().zip(&set.certified) {
                digits = digits.min(-libm::log10(((got - want) / want).abs() + 1e-11));
            }
            println!(
                "{:9} {digits:5.2} digits, {:4} iterations, {:?}",
                set.name, report.iterations, report.termination
            );
            assert!(digits >= 4.0, "{} from {start:?}: {b}", set.name);
            let rss = 2.0 * report.final_cost;
            // The first Lanczos set is rounding noise at its optimum.
            if set.certified_rss > 1e-20 {
                let relative = (rss - set.certified_rss).abs() / set.certified_rss;
                assert!(relative < 1e-8, "{}: {rss}", set.name);
            }
            sum_of_digits += digits;
            fits += 1.0;
        }
    }
    println!("mean {:.2} digits over {fits} fits", sum_of_digits / fits);
    assert!(sum_of_digits / fits > 8.0);
}

#[test]
fn their_jacobians_are_right() {
    for set in data_sets() {
        let b = DVector::from_vec(set.certified.clone());
        // Parameters of such different sizes are differentiated in units of their own size.
        let scale = b.clone();
        let mut jacobian = DMatrix::zeros(set.x.len(), b.len());
        set.jacobian(&b, &mut jacobian);
        for k in 0..b.len() {
            jacobian.column_mut(k).scale_mut(scale[k]);
        }
        let largest = jacobian.amax().max(1.0);
        jacobian /= largest;
        let residuals = |delta: &DVector<f64>| {
            let mut r = DVector::zeros(set.x.len());
            set.residuals(&(&b + delta.component_mul(&scale)), &mut r);
            r / largest
        };
        let worst = check_jacobian(&jacobian, &residuals, 1e-6);
        assert!(worst < 1e-6, "{}: {worst}", set.name);
    }
}
