//! Numbers of the chapter on gradients.

use super::entry::Number::{Count, Real};
use super::entry::{Arguments, Entry, sentence};
use epipole::imaging::{
    BT601_WEIGHTS, Border, DerivativeFilter, Gradient, GrayImage32, centered_difference,
    gaussian_derivative_kernels, gray_from_values, noise_gain, separable_filter, sobel,
};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
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
];

/// The patch that the chapter on gradients computes by hand, rows from the top.
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

/// Returns the smoothing and derivative kernels; for sigma=0 those of the central difference.
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
    let slopes =
        separable_filter(&edge, &slope, &smooth, Border::Replicate, &mut ()).map_err(sentence)?;
    Ok(slopes.get_pixel(HALF as u32, 0).0[0].into())
}
