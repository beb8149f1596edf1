//! Numbers of the chapter on corners.

use super::entry::Number::Real;
use super::entry::{Arguments, Entry, Number, sentence};
use epipole::feature::{Scaling, StructureTensorOptions, Window, WindowTensor, harris_response};
use epipole::imaging::gray_from_values;
use nalgebra::Vector2;

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "corners.a",
        parameters: GRADIENTS,
        summary: "Σ Iu² of three gradients",
        compute: |a| Ok(Real(tensor(a).uu, 0)),
    },
    Entry {
        name: "corners.b",
        parameters: GRADIENTS,
        summary: "Σ Iv² of three gradients",
        compute: |a| Ok(Real(tensor(a).vv, 0)),
    },
    Entry {
        name: "corners.c",
        parameters: GRADIENTS,
        summary: "Σ Iu Iv of three gradients",
        compute: |a| Ok(Real(tensor(a).uv, 0)),
    },
    Entry {
        name: "corners.det",
        parameters: GRADIENTS,
        summary: "determinant of the structure tensor of three gradients",
        compute: |a| Ok(Real(tensor(a).determinant(), 0)),
    },
    Entry {
        name: "corners.trace",
        parameters: GRADIENTS,
        summary: "trace of the structure tensor of three gradients",
        compute: |a| Ok(Real(tensor(a).trace(), 0)),
    },
    Entry {
        name: "corners.lambda1",
        parameters: GRADIENTS,
        summary: "larger eigenvalue of the structure tensor of three gradients",
        compute: |a| Ok(Real(tensor(a).eigenvalues().0, 2)),
    },
    Entry {
        name: "corners.lambda2",
        parameters: GRADIENTS,
        summary: "smaller eigenvalue of the structure tensor of three gradients",
        compute: |a| Ok(Real(tensor(a).eigenvalues().1, 2)),
    },
    Entry {
        name: "corners.harris",
        parameters: &["u1", "v1", "u2", "v2", "u3", "v3", "k"],
        summary: "Harris' R = det M − k (tr M)² of three gradients",
        compute: |a| Ok(Real(tensor(a).harris(a.get("k")), 2)),
    },
    Entry {
        name: "corners.change",
        parameters: &["u1", "v1", "u2", "v2", "u3", "v3", "du", "dv"],
        summary: "Taylor's estimate of the squared change under the shift (du, dv)",
        compute: |a| {
            let shift = Vector2::new(a.get("du"), a.get("dv"));
            Ok(Real(tensor(a).change(&shift), 0))
        },
    },
    Entry {
        name: "corners.ratio-limit",
        parameters: &["k"],
        summary: "the ratio λ1 / λ2 at which Harris' R changes its sign, 0 < k < 0.25",
        compute: |a| {
            let k = a.get("k");
            if k <= 0.0 || k >= 0.25 {
                return Err("k must be between 0 and 0.25".to_owned());
            }
            // r / (1 + r)² = k
            Ok(Real(
                (1.0 - 2.0 * k + (1.0 - 4.0 * k).sqrt()) / (2.0 * k),
                2,
            ))
        },
    },
    Entry {
        name: "corners.opencv-divisor",
        parameters: &["block"],
        summary: "what OpenCV divides the answers of Sobel 3×3 by on 8-bit images, for a block of so many pixels",
        compute: |a| opencv_divisor(a.count("block")?),
    },
];

/// Three gradients (Iu, Iv).
const GRADIENTS: &[&str] = &["u1", "v1", "u2", "v2", "u3", "v3"];

fn tensor(a: &Arguments) -> WindowTensor {
    let gradients = [("u1", "v1"), ("u2", "v2"), ("u3", "v3")];
    WindowTensor::from_gradients(&gradients.map(|(u, v)| Vector2::new(a.get(u), a.get(v))))
}

/// Returns the divisor that converts gradients for OpenCV. Responses grow with the fourth power of
/// gradients, so it is the fourth root of the ratio of the formula's response to OpenCV's; 8-bit
/// images are also divided by 255.
fn opencv_divisor(block: usize) -> Result<Number, String> {
    let mut values = vec![0.0; 25];
    values[12] = 1.0;
    let dot = gray_from_values(5, 5, values).map_err(sentence)?;
    let at_dot = |scaling| {
        let options = StructureTensorOptions::default()
            .with_window(Window::Box(block))
            .with_scaling(scaling);
        let response = harris_response(&dot, 0.04, &options, &mut ()).map_err(sentence)?;
        Ok::<f64, String>(f64::from(response.get_pixel(2, 2).0[0]))
    };
    let ratio = at_dot(Scaling::Textbook)? / at_dot(Scaling::OpenCv)?;
    Ok(Real(255.0 * ratio.sqrt().sqrt(), 0))
}
