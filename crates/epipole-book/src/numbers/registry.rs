//! The list itself. A new number is an entry here and its worked example in the tests of the
//! parent module.

use super::Number::{Count, Real};
use super::{Arguments, Entry, Number, triangulation};
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::epipolar::{
    EightPoint, Epipole, epipolar_line2, epipolar_row, epipoles, essential_from_motion,
    fundamental_8point_explained, fundamental_8point_unnormalized, fundamental_from_essential,
    sampson_px,
};
use epipole::feature::{
    Descriptors, Keypoint, Scaling, StructureTensorOptions, Window, WindowTensor, describe_patches,
    harris_response, nearest_few, nearest_two,
};
use epipole::imaging::{
    BT601_WEIGHTS, Border, DerivativeFilter, Gradient, GrayImage32, centered_difference,
    gaussian_derivative_kernels, gray_from_values, noise_gain, separable_filter, sobel,
};
use epipole::robust::{num_trials_with_replacement, num_trials_without_replacement};
use epipole::stereo::depth_from_disparity;
use nalgebra::{Matrix2, Matrix3, Point2, Point3, RowVector3, Vector2, Vector3};

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
        name: "camera.size-px",
        parameters: &["f", "h", "z"],
        summary: "how large h is seen at the distance z, f h / z, pixels",
        compute: |a| {
            let camera = Intrinsics::new(a.get("f"), a.get("f"), 0.0, 0.0).map_err(sentence)?;
            let point = Point3::new(a.get("h"), 0.0, a.get("z"));
            Ok(Real(camera.project(&point).map_err(sentence)?.x, 0))
        },
    },
    Entry {
        name: "camera.ray",
        parameters: &["f", "c", "u"],
        summary: "the ray of the column or row u, at the distance 1, for the principal point c",
        compute: |a| {
            let camera = Intrinsics::new(a.get("f"), a.get("f"), a.get("c"), 0.0);
            let ray = camera.map_err(sentence)?.ray(&Point2::new(a.get("u"), 0.0));
            Ok(Real(ray.x, 1))
        },
    },
    Entry {
        name: "camera.focal-px",
        parameters: &["width", "view"],
        summary: "focal length of an image so wide with this field of view in degrees, pixels",
        compute: |a| {
            let half_rad = a.get("view").to_radians() / 2.0;
            Ok(Real(a.get("width") / 2.0 / libm::tan(half_rad), 0))
        },
    },
    Entry {
        name: "rays.sigma",
        parameters: &["a", "b", "c", "d", "k"],
        summary: "singular value k, 1 or 2, of the matrix (a b; c d)",
        compute: |a| {
            let matrix = Matrix2::new(a.get("a"), a.get("b"), a.get("c"), a.get("d"));
            let values = matrix.singular_values();
            Ok(Real(values[index_below(a, 2)?], 2))
        },
    },
    Entry {
        name: "rays.least-sigma",
        parameters: THREE_COLUMNS,
        summary: "smallest singular value of the three rays' equations",
        compute: |a| Ok(Real(three_rays(a)?.0, 4)),
    },
    Entry {
        name: "rays.meeting",
        parameters: &["u1", "u2", "u3", "k"],
        summary: "X (k=1) or Z (k=2) of the place nearest to the three rays, meters",
        compute: |a| Ok(Real(three_rays(a)?.1[index_below(a, 2)?], 3)),
    },
    Entry {
        name: "gradients.slope",
        parameters: &["before", "after"],
        summary: "centered difference at a pixel with these neighbors, gray levels a pixel",
        compute: |a| {
            let row = gray_row(&[a.get("before"), 0.0, a.get("after")])?;
            let slopes = centered_difference(&row, Border::Replicate);
            Ok(Real(f64::from(slopes.du.get_pixel(1, 0).0[0]), 1))
        },
    },
    Entry {
        name: "gradients.magnitude",
        parameters: &["du", "dv"],
        summary: "length of the gradient (du, dv)",
        compute: |a| Ok(Real(at_first(&gradient_of(a)?.magnitude()), 2)),
    },
    Entry {
        name: "gradients.angle-deg",
        parameters: &["du", "dv"],
        summary: "direction of the gradient (du, dv), degrees from u toward v",
        compute: |a| {
            Ok(Real(
                at_first(&gradient_of(a)?.orientation()).to_degrees(),
                2,
            ))
        },
    },
    Entry {
        name: "gradients.along",
        parameters: &["du", "dv", "angle"],
        summary: "change over a step of one pixel in the direction `angle`, degrees, at the gradient (du, dv)",
        compute: |a| {
            let (sin, cos) = libm::sincos(a.get("angle").to_radians());
            Ok(Real(a.get("du") * cos + a.get("dv") * sin, 2))
        },
    },
    Entry {
        name: "gradients.sobel",
        parameters: &["axis"],
        summary: "Sobel's answer in the middle of the chapter's patch, along u (axis=1) or v (axis=2)",
        compute: |a| Ok(Real(sobel_of_patch(a)?, 0)),
    },
    Entry {
        name: "gradients.sobel-slope",
        parameters: &["axis"],
        summary: "the same divided by what a ramp of slope 1 answers",
        compute: |a| {
            let gain = f64::from(DerivativeFilter::Sobel3.gain());
            Ok(Real(sobel_of_patch(a)? / gain, 2))
        },
    },
    Entry {
        name: "gradients.sobel-noise",
        parameters: &["divisor"],
        summary: "what Sobel's filter, divided by this, leaves of noise of standard deviation 1",
        compute: |a| {
            let gain = noise_gain(&[-1.0, 0.0, 1.0]) * noise_gain(&[1.0, 2.0, 1.0]);
            Ok(Real(gain / a.get("divisor"), 2))
        },
    },
    Entry {
        name: "gradients.noise",
        parameters: &["sigma", "noise"],
        summary: "what the derivative of a Gaussian (sigma=0: the centered difference) leaves of noise",
        compute: |a| Ok(Real(noise_of_slope(a)?, 2)),
    },
    Entry {
        name: "gradients.edge-slope",
        parameters: &["sigma"],
        summary: "slope of the chapter's edge, 120 gray levels over 6 pixels, under such smoothing",
        compute: |a| Ok(Real(slope_of_edge(a)?, 2)),
    },
    Entry {
        name: "gradients.ratio",
        parameters: &["sigma", "noise"],
        summary: "the edge's slope over the noise of a slope, both under such smoothing",
        compute: |a| Ok(Real(slope_of_edge(a)? / noise_of_slope(a)?, 1)),
    },
    Entry {
        name: "gradients.kernel-size",
        parameters: &["sigma"],
        summary: "width of the kernel of a Gaussian, pixels",
        compute: |a| Ok(Count(kernels(a)?.0.len() as u64)),
    },
    Entry {
        name: "gradients.multiplications",
        parameters: &["sigma", "passes"],
        summary: "multiplications for each pixel, in one pass over the image or in two",
        compute: |a| {
            let width = kernels(a)?.0.len() as u64;
            match a.count("passes")? {
                1 => Ok(Count(width * width)),
                2 => Ok(Count(2 * width)),
                _ => Err("passes must be 1 or 2".to_owned()),
            }
        },
    },
    Entry {
        name: "gradients.root-of-squares",
        parameters: &["a", "b"],
        summary: "√(a² + b²)",
        compute: |a| Ok(Real(libm::hypot(a.get("a"), a.get("b")), 1)),
    },
    Entry {
        name: "gradients.gray",
        parameters: &["r", "g", "b"],
        summary: "the gray of a color, both in levels from 0 to 255",
        compute: |a| {
            let color = ["r", "g", "b"].map(|channel| a.get(channel));
            let weighed = color.iter().zip(BT601_WEIGHTS);
            Ok(Real(
                weighed
                    .map(|(level, weight)| level * f64::from(weight))
                    .sum(),
                0,
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
        name: "matching.patch-distance",
        parameters: &["a", "b", "c", "d", "e", "f", "g", "h", "normalized"],
        summary: "distance of the 2 × 2 patches (a, b, c, d) and (e, f, g, h), of gray values or normalized",
        compute: |a| {
            let [first, second] = [["a", "b", "c", "d"], ["e", "f", "g", "h"]]
                .map(|names| names.map(|name| a.get(name) as f32).to_vec());
            let described = |values: Vec<f32>| match a.count("normalized")? {
                0 => Descriptors::from_floats(4, values).map_err(sentence),
                _ => {
                    let image = gray_from_values(2, 2, values).map_err(sentence)?;
                    let middle = [Keypoint::at(0.5, 0.5, 1.0)];
                    describe_patches(&image, &middle, 2, 1.0).map_err(sentence)
                }
            };
            let query = described(first)?.get(0).unwrap_or_default();
            let found = nearest_few(&query, &described(second)?, 1).map_err(sentence)?;
            let distance = found.first().map_or(f64::NAN, |(_, far)| f64::from(*far));
            Ok(Real(distance, 1))
        },
    },
    Entry {
        name: "matching.ratio",
        parameters: &["d1", "d2"],
        summary: "distance of the nearest over that of the second nearest",
        compute: |a| {
            let list = |values| Descriptors::from_floats(1, values).map_err(sentence);
            let second = list(vec![a.get("d1") as f32, -a.get("d2") as f32])?;
            let near = nearest_two(&list(vec![0.0])?, &second).map_err(sentence)?[0];
            let second = near.second_distance.unwrap_or(f32::NAN);
            Ok(Real(f64::from(near.distance) / f64::from(second), 3))
        },
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
        name: "eight-point.row",
        parameters: &["u", "v", "u2", "v2", "k"],
        summary: "entry k, 1 to 9, of the equation that the match (u, v) – (u2, v2) gives for F",
        compute: |a| {
            let row = epipolar_row(&pixel1(a), &pixel2(a));
            Ok(Real(row[index_below(a, row.len())?], 0))
        },
    },
    Entry {
        name: "eight-point.sigma",
        parameters: &["normalized", "k"],
        summary: "singular value k, 1 to 9, of the stacked equations of the chapter's ten matches",
        compute: |a| {
            let values = ten_matches(a)?.singular_values;
            Ok(Real(values[index_below(a, values.len())?], 2))
        },
    },
    Entry {
        name: "eight-point.condition",
        parameters: &["normalized"],
        summary: "σ₁ / σ₈ of the stacked equations of the chapter's ten matches",
        compute: |a| Ok(Real(ten_matches(a)?.condition_number, 0)),
    },
    Entry {
        name: "eight-point.distance-px",
        parameters: &["normalized"],
        summary: "mean distance of the chapter's ten matches from their lines in picture 2, pixels",
        compute: |a| {
            let fundamental = ten_matches(a)?.fundamental;
            let mut sum = 0.0;
            for [u, v, u2, v2] in TEN_MATCHES {
                let line = epipolar_line2(&fundamental, &Point2::new(u, v)).map_err(sentence)?;
                sum += line.signed_distance(&Point2::new(u2, v2)).abs();
            }
            Ok(Real(sum / TEN_MATCHES.len() as f64, 2))
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
        name: "sfm.depth",
        parameters: &["camera", "turned", "sign", "x"],
        summary: "depth in camera 1 or 2 of the point on the rays (0, 0, 1) and (x, 0, 1), if \
            camera 2 moved by sign · 1 to the right and, with turned=1, made a half-turn about that",
        compute: |a| {
            let depths = crossing(a)?;
            match a.count("camera")? {
                1 => Ok(Real(depths.0, 0)),
                2 => Ok(Real(depths.1, 0)),
                _ => Err("camera must be 1 or 2".to_owned()),
            }
        },
    },
    Entry {
        name: "sfm.drift",
        parameters: &["rate", "steps"],
        summary: "length of a step after some, if each is longer than the last by a share `rate`",
        compute: |a| {
            Ok(Real(
                libm::exp(a.get("steps") * libm::log1p(a.get("rate"))),
                2,
            ))
        },
    },
    Entry {
        name: "sfm.matrix-gigabytes",
        parameters: &["unknowns"],
        summary: "memory of a square matrix of double precision, 10⁹ bytes",
        compute: |a| Ok(Real(8e-9 * a.get("unknowns") * a.get("unknowns"), 1)),
    },
    Entry {
        name: "sfm.unknowns",
        parameters: &["cameras", "points"],
        summary: "unknowns of a bundle adjustment with known intrinsics, 6 m + 3 n",
        compute: |a| {
            Ok(Count(
                (6 * a.count("cameras")? + 3 * a.count("points")?) as u64,
            ))
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
    Entry {
        name: "triangulation.point",
        parameters: &["f", "b", "u", "v", "u2", "v2", "axis"],
        summary: "X, Y or Z, axis = 1, 2, 3, of the match (u, v) – (u2, v2) by the DLT; equal cameras \
            side by side, a baseline b apart, principal point (320, 240); meters",
        compute: triangulation::point,
    },
    Entry {
        name: "triangulation.ahead-mm",
        parameters: &["method", "axis"],
        summary: "X, Y or Z, axis = 1, 2, 3, of the chapter's match by the midpoint, the DLT, angles or \
            the optimum, method = 1 to 4; millimeters",
        compute: triangulation::ahead_mm,
    },
    Entry {
        name: "triangulation.miss-px",
        parameters: &["method", "image"],
        summary: "how far that point lands from the pixel in image 1 or 2, pixels",
        compute: triangulation::miss_px,
    },
    Entry {
        name: "triangulation.error-px",
        parameters: &["method"],
        summary: "the root mean square of both, pixels",
        compute: triangulation::error_px,
    },
    Entry {
        name: "triangulation.sigma-mm",
        parameters: &["f", "r", "angle", "sigma", "axis"],
        summary: "half axis 1, 2 or 3 of a point's region of one standard deviation, 1 along the rays, 2 \
            across them; two cameras look at it from the distance r, their rays at an angle in degrees; \
            millimeters",
        compute: triangulation::sigma_mm,
    },
    Entry {
        name: "triangulation.sigma-depth",
        parameters: &["f", "b", "z", "sigma"],
        summary: "standard deviation along the rays of a point half-way between two cameras side by side, \
            a baseline b apart, and z away; meters",
        compute: triangulation::sigma_depth,
    },
];

/// What three equal cameras side by side see of one point: their columns.
const THREE_COLUMNS: &[&str] = &["u1", "u2", "u3"];

/// The smallest singular value of the rows (1, −m, −B), m = (u − 320) / 500, of cameras at B = 0, 0.4
/// and 0.8, and (X, Z) by its singular vector.
fn three_rays(a: &Arguments) -> Result<(f64, [f64; 2]), String> {
    let row =
        |name: &str, baseline: f64| RowVector3::new(1.0, -(a.get(name) - 320.0) / 500.0, -baseline);
    let rows = Matrix3::from_rows(&[row("u1", 0.0), row("u2", 0.4), row("u3", 0.8)]);
    let svd = rows.svd(false, true);
    let h = svd.v_t.map(|v_t| v_t.row(2).transpose());
    match h.filter(|h| h.z.abs() > 1e-12) {
        Some(h) => Ok((svd.singular_values[2], [h.x / h.z, h.y / h.z])),
        None => Err("the three rays are parallel".to_owned()),
    }
}

/// The patch that the chapter on gradients works by hand, rows from above.
const PATCH: [f32; 9] = [30.0, 60.0, 90.0, 40.0, 90.0, 140.0, 35.0, 120.0, 150.0];

fn gray_row(levels: &[f64]) -> Result<GrayImage32, String> {
    let levels: Vec<f32> = levels.iter().map(|&level| level as f32).collect();
    gray_from_values(levels.len() as u32, 1, levels).map_err(sentence)
}

fn at_first(image: &GrayImage32) -> f64 {
    image
        .as_raw()
        .first()
        .map_or(f64::NAN, |&value| value.into())
}

fn gradient_of(a: &Arguments) -> Result<Gradient, String> {
    let (du, dv) = (gray_row(&[a.get("du")])?, gray_row(&[a.get("dv")])?);
    Ok(Gradient { du, dv })
}

fn sobel_of_patch(a: &Arguments) -> Result<f64, String> {
    let patch = gray_from_values(3, 3, PATCH.to_vec()).map_err(sentence)?;
    let Gradient { du, dv } = sobel(&patch, Border::Replicate);
    let answer = match a.count("axis")? {
        1 => du,
        2 => dv,
        _ => return Err("axis must be 1 or 2".to_owned()),
    };
    Ok(answer.get_pixel(1, 1).0[0].into())
}

/// Smoothing and slope; for sigma=0 those of the centered difference.
fn kernels(a: &Arguments) -> Result<(Vec<f32>, Vec<f32>), String> {
    if a.get("sigma") == 0.0 {
        return Ok((vec![1.0], vec![-0.5, 0.0, 0.5]));
    }
    gaussian_derivative_kernels(a.get("sigma")).map_err(sentence)
}

fn noise_of_slope(a: &Arguments) -> Result<f64, String> {
    let (smooth, slope) = kernels(a)?;
    Ok(a.get("noise") * noise_gain(&smooth) * noise_gain(&slope))
}

fn slope_of_edge(a: &Arguments) -> Result<f64, String> {
    const HALF: i32 = 60;
    let ramp = |u: i32| 68.0 + 120.0 * (0.5 + f64::from(u) / 6.0).clamp(0.0, 1.0);
    let edge = gray_row(&(-HALF..=HALF).map(ramp).collect::<Vec<f64>>())?;
    let (smooth, slope) = kernels(a)?;
    let slopes = separable_filter(&edge, &slope, &smooth, Border::Replicate).map_err(sentence)?;
    Ok(slopes.get_pixel(HALF as u32, 0).0[0].into())
}

/// Two equal cameras that look the same way; t takes coordinates of camera 1 to camera 2.
const PAIR: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz"];
const MATCH: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz", "u", "v", "u2", "v2"];

/// The matches that the chapter on the eight-point algorithm works with: u, v, u2, v2, rounded to
/// whole pixels.
const TEN_MATCHES: [[f64; 4]; 10] = [
    [584.0, 385.0, 506.0, 399.0],
    [97.0, 341.0, 114.0, 338.0],
    [348.0, 351.0, 335.0, 355.0],
    [367.0, 137.0, 371.0, 143.0],
    [122.0, 60.0, 88.0, 88.0],
    [348.0, 304.0, 366.0, 308.0],
    [454.0, 201.0, 375.0, 214.0],
    [444.0, 264.0, 456.0, 269.0],
    [148.0, 194.0, 159.0, 203.0],
    [587.0, 368.0, 612.0, 381.0],
];

/// F from the ten matches, `normalized=1` or not.
fn ten_matches(a: &Arguments) -> Result<EightPoint, String> {
    let pixels1 = TEN_MATCHES.map(|[u, v, _, _]| Point2::new(u, v));
    let pixels2 = TEN_MATCHES.map(|[_, _, u2, v2]| Point2::new(u2, v2));
    match a.count("normalized")? {
        0 => fundamental_8point_unnormalized(&pixels1, &pixels2),
        _ => fundamental_8point_explained(&pixels1, &pixels2),
    }
    .map_err(sentence)
}

/// The parameter k, counted from 1, as an index.
fn index_below(a: &Arguments, length: usize) -> Result<usize, String> {
    let index = a.count("k")?.checked_sub(1);
    index
        .filter(|&index| index < length)
        .ok_or_else(|| format!("k must be 1 to {length}"))
}

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

pub(super) fn sentence(error: epipole::Error) -> String {
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

pub(super) fn pixel1(a: &Arguments) -> Point2<f64> {
    Point2::new(a.get("u"), a.get("v"))
}

pub(super) fn pixel2(a: &Arguments) -> Point2<f64> {
    Point2::new(a.get("u2"), a.get("v2"))
}

/// Depths along the two rays at which they cross; see `sfm.depth`.
fn crossing(a: &Arguments) -> Result<(f64, f64), String> {
    let half_turn = match a.count("turned")? {
        0 => 0.0,
        1 => core::f64::consts::PI,
        _ => return Err("turned must be 0 or 1".to_owned()),
    };
    // A step to the right moves everything to the left.
    let t = Vector3::new(-a.get("sign"), 0.0, 0.0);
    let motion = RigidTransform::new(t, Vector3::new(half_turn, 0.0, 0.0));
    let (x1, x2) = (Vector3::z(), Vector3::new(a.get("x"), 0.0, 1.0));
    // λ1 R x1 + t = λ2 x2, multiplied by x2 × and by R x1 ×.
    let turned = motion.rotation * x1;
    let normal = x2.cross(&turned);
    let depth = |ray: &Vector3<f64>| ray.cross(&t).dot(&normal) / normal.norm_squared();
    let (depth1, depth2) = (-depth(&x2), -depth(&turned));
    match depth1.is_finite() && depth2.is_finite() {
        true => Ok((depth1, depth2)),
        false => Err("the rays are parallel".to_owned()),
    }
}

/// Chance that a sample holds inliers only, wˢ, for 0 < w < 1.
fn all_inliers(a: &Arguments) -> Result<f64, String> {
    let (share, size) = (a.get("w"), a.count("s")?);
    if share <= 0.0 || share >= 1.0 || size == 0 {
        return Err("w must be between 0 and 1, and s at least 1".to_owned());
    }
    Ok(libm::pow(share, size as f64))
}
