//! Numbers of the chapters on epipolar geometry and on the eight-point algorithm.

use super::entry::Number::Real;
use super::entry::{Arguments, Entry, sentence};
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::epipolar::{
    EightPoint, Epipole, epipolar_line2, epipolar_row, epipoles, essential_from_motion,
    fundamental_8point_explained, fundamental_8point_unnormalized, fundamental_from_essential,
    sampson_px,
};
use nalgebra::{Matrix3, Point2};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
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
            let line = epipolar_line2(&fundamental(a)?, &a.pixel1()).map_err(sentence)?;
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
            let line = epipolar_line2(&fundamental(a)?, &a.pixel1()).map_err(sentence)?;
            Ok(Real(line.signed_distance(&a.pixel2()).abs(), 2))
        },
    },
    Entry {
        name: "epipolar.sampson-px",
        parameters: MATCH,
        summary: "Sampson distance of the match (u, v) – (u2, v2), pixels",
        compute: |a| {
            Ok(Real(
                sampson_px(&fundamental(a)?, &a.pixel1(), &a.pixel2()),
                2,
            ))
        },
    },
    Entry {
        name: "eight-point.row",
        parameters: &["u", "v", "u2", "v2", "k"],
        summary: "entry k, 1 to 9, of the equation that the match (u, v) – (u2, v2) gives for F",
        compute: |a| {
            let row = epipolar_row(&a.pixel1(), &a.pixel2());
            Ok(Real(row[a.index("k", row.len())?], 0))
        },
    },
    Entry {
        name: "eight-point.sigma",
        parameters: &["normalized", "k"],
        summary: "singular value k, 1 to 9, of the stacked equations of the chapter's ten matches",
        compute: |a| {
            let values = ten_matches(a)?.singular_values;
            Ok(Real(values[a.index("k", values.len())?], 2))
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
];

/// Two identical cameras with parallel axes; t transforms coordinates from camera 1 to camera 2.
const PAIR: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz"];
const MATCH: &[&str] = &["f", "cu", "cv", "tx", "ty", "tz", "u", "v", "u2", "v2"];

/// The matches used in the chapter on the eight-point algorithm: u, v, u2, v2, rounded to whole
/// pixels.
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

/// Estimates F from the ten matches, with normalization if `normalized=1`.
fn ten_matches(a: &Arguments) -> Result<EightPoint, String> {
    let pixels1 = TEN_MATCHES.map(|[u, v, _, _]| Point2::new(u, v));
    let pixels2 = TEN_MATCHES.map(|[_, _, u2, v2]| Point2::new(u2, v2));
    match a.count("normalized")? {
        0 => fundamental_8point_unnormalized(&pixels1, &pixels2),
        _ => fundamental_8point_explained(&pixels1, &pixels2),
    }
    .map_err(sentence)
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
