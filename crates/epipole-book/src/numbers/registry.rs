//! The list itself. A new number is an entry here and its worked example in the tests of the
//! parent module.

use super::Number::{Count, Real};
use super::{Arguments, Entry, Number};
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::epipolar::{
    Epipole, epipolar_line2, epipoles, essential_from_motion, fundamental_from_essential,
    sampson_px,
};
use epipole::feature::{Scaling, StructureTensorOptions, Window, WindowTensor, harris_response};
use epipole::imaging::gray_from_values;
use epipole::robust::{num_trials_with_replacement, num_trials_without_replacement};
use epipole::stereo::depth_from_disparity;
use nalgebra::{Matrix3, Point2, Point3, Vector2};

/// All numbers that chapters may print, by name.
pub const REGISTRY: &[Entry] = &[
    Entry {
        name: "camera.project-u",
        parameters: &["f", "cu", "x", "z"],
        summary: "column of the point (x, 0, z) for the focal length f and the principal point cu",
        compute: |a| {
            let camera = Intrinsics::new(a.get("f"), a.get("f"), a.get("cu"), 0.0);
            let point = Point3::new(a.get("x"), 0.0, a.get("z"));
            Ok(Real(
                camera
                    .and_then(|camera| camera.project(&point))
                    .map_err(sentence)?
                    .x,
                1,
            ))
        },
    },
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
    Entry {
        name: "epipolar.epipole2-u",
        parameters: PAIR,
        summary: "column of the epipole of picture 2, two equal cameras that look the same way",
        compute: |a| Ok(Real(epipole2(a)?.x, 0)),
    },
    Entry {
        name: "epipolar.epipole2-v",
        parameters: PAIR,
        summary: "row of the epipole of picture 2",
        compute: |a| Ok(Real(epipole2(a)?.y, 0)),
    },
    Entry {
        name: "epipolar.slope",
        parameters: &["f", "cu", "cv", "tx", "ty", "tz", "u", "v"],
        summary: "slope dv/du of the epipolar line in picture 2 of the pixel (u, v)",
        compute: |a| {
            let line = epipolar_line2(&fundamental(a)?, &pixel1(a)).map_err(sentence)?;
            if line.b == 0.0 {
                return Err("the line is vertical".to_owned());
            }
            Ok(Real(-line.a / line.b, 2))
        },
    },
    Entry {
        name: "epipolar.distance2-px",
        parameters: MATCH,
        summary: "distance of the pixel (u2, v2) from the epipolar line of (u, v), pixels",
        compute: |a| {
            let line = epipolar_line2(&fundamental(a)?, &pixel1(a)).map_err(sentence)?;
            Ok(Real(line.signed_distance(&pixel2(a)).abs(), 2))
        },
    },
    Entry {
        name: "epipolar.sampson-px",
        parameters: MATCH,
        summary: "Sampson distance of the match (u, v) – (u2, v2), pixels",
        compute: |a| {
            Ok(Real(
                sampson_px(&fundamental(a)?, &pixel1(a), &pixel2(a)),
                2,
            ))
        },
    },
    Entry {
        name: "ransac.trials",
        parameters: &["s", "w", "p"],
        summary: "samples of size s for confidence p when a share w of the data are inliers",
        compute: |a| {
            num_trials_with_replacement(a.get("w"), a.count("s")?, a.get("p"))
                .map(Count)
                .map_err(sentence)
        },
    },
    Entry {
        name: "ransac.trials-exact",
        parameters: &["s", "w", "p"],
        summary: "the same before rounding up, log(1 − p) / log(1 − wˢ)",
        compute: |a| {
            let good = all_inliers(a)?;
            Ok(Real(libm::log1p(-a.get("p")) / libm::log1p(-good), 3))
        },
    },
    Entry {
        name: "ransac.trials-without-replacement",
        parameters: &["inliers", "data", "s", "p"],
        summary: "samples of s different data for confidence p, counted exactly",
        compute: |a| {
            let (inliers, data) = (a.count("inliers")?, a.count("data")?);
            num_trials_without_replacement(inliers, data, a.count("s")?, a.get("p"))
                .map(Count)
                .map_err(sentence)
        },
    },
    Entry {
        name: "ransac.confidence-percent",
        parameters: &["s", "w", "n"],
        summary: "chance that one of n samples holds inliers only, percent",
        compute: |a| {
            let all_spoiled = libm::exp(a.get("n") * libm::log1p(-all_inliers(a)?));
            Ok(Real(100.0 * (1.0 - all_spoiled), 1))
        },
    },
    Entry {
        name: "stereo.disparity",
        parameters: &["left", "right"],
        summary: "difference of the columns, pixels",
        compute: |a| Ok(Real(a.get("left") - a.get("right"), 0)),
    },
    Entry {
        name: "stereo.depth",
        parameters: &["f", "b", "d"],
        summary: "depth from the disparity d, meters",
        compute: |a| {
            depth_from_disparity(a.get("f"), a.get("b"), a.get("d"))
                .map(|depth_m| Real(depth_m, 2))
                .map_err(sentence)
        },
    },
    Entry {
        name: "stereo.depth-error",
        parameters: &["f", "b", "z"],
        summary: "what one pixel of disparity costs at the depth z, Z² / (f B), meters",
        compute: |a| {
            let (focal_px, baseline_m, depth_m) = (a.get("f"), a.get("b"), a.get("z"));
            Ok(Real(depth_m * depth_m / (focal_px * baseline_m), 2))
        },
    },
];

/// Two equal cameras that look the same way; t takes coordinates of camera 1 to camera 2.
const PAIR: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz"];
const MATCH: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz", "u", "v", "u2", "v2"];

/// Three gradients (Iu, Iv).
const GRADIENTS: &[&str] = &["u1", "v1", "u2", "v2", "u3", "v3"];

fn tensor(a: &Arguments) -> WindowTensor {
    let gradients = [("u1", "v1"), ("u2", "v2"), ("u3", "v3")];
    WindowTensor::from_gradients(&gradients.map(|(u, v)| Vector2::new(a.get(u), a.get(v))))
}

/// Responses go with the fourth power of gradients: the divisor is the fourth root of how much
/// smaller OpenCV's are than the formula's, and 8-bit images are divided by 255 before.
fn opencv_divisor(block: usize) -> Result<Number, String> {
    let mut values = vec![0.0; 25];
    values[12] = 1.0;
    let dot = gray_from_values(5, 5, values).map_err(sentence)?;
    let at_dot = |scaling| {
        let options = StructureTensorOptions {
            window: Window::Box(block),
            scaling,
            ..StructureTensorOptions::default()
        };
        let response = harris_response(&dot, 0.04, &options).map_err(sentence)?;
        Ok::<f64, String>(f64::from(response.get_pixel(2, 2).0[0]))
    };
    let ratio = at_dot(Scaling::Textbook)? / at_dot(Scaling::OpenCv)?;
    Ok(Real(255.0 * ratio.sqrt().sqrt(), 0))
}

fn sentence(error: epipole::Error) -> String {
    error.to_string()
}

fn fundamental(a: &Arguments) -> Result<Matrix3<f64>, String> {
    let camera = Intrinsics::new(a.get("f"), a.get("f"), a.get("cu"), a.get("cv"));
    let camera = camera.map_err(sentence)?;
    let motion = RigidTransform::translation(a.get("tx"), a.get("ty"), a.get("tz"));
    essential_from_motion(&motion)
        .and_then(|essential| fundamental_from_essential(&essential, &camera, &camera))
        .map_err(sentence)
}

fn epipole2(a: &Arguments) -> Result<Point2<f64>, String> {
    match epipoles(&fundamental(a)?).map_err(sentence)?.1 {
        Epipole::Finite(pixel) => Ok(pixel),
        Epipole::AtInfinity(_) => Err("this epipole is infinitely far away".to_owned()),
    }
}

fn pixel1(a: &Arguments) -> Point2<f64> {
    Point2::new(a.get("u"), a.get("v"))
}

fn pixel2(a: &Arguments) -> Point2<f64> {
    Point2::new(a.get("u2"), a.get("v2"))
}

/// Chance that a sample holds inliers only, wˢ, for 0 < w < 1.
fn all_inliers(a: &Arguments) -> Result<f64, String> {
    let (share, size) = (a.get("w"), a.count("s")?);
    if share <= 0.0 || share >= 1.0 || size == 0 {
        return Err("w must be between 0 and 1, and s at least 1".to_owned());
    }
    Ok(libm::pow(share, size as f64))
}
