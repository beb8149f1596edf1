//! Numbers of the chapter on calibration.

use super::entry::Number::Real;
use super::entry::{Arguments, Entry};
use epipole::camera::{Distortion, Fisheye};
use nalgebra::{Point2, Vector3};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "calibration.factor",
        parameters: &["x", "y", "k1"],
        summary: "factor by which a lens with k1 moves the ray (x, y, 1)",
        compute: |a| {
            let ray = Point2::new(a.get("x"), a.get("y"));
            Ok(Real(bent(a).coords.norm() / ray.coords.norm(), 3))
        },
    },
    Entry {
        name: "calibration.bent-u",
        parameters: &["x", "y", "k1", "f", "cu"],
        summary: "column of the ray (x, y, 1) through a lens with k1",
        compute: |a| Ok(Real(a.get("f") * bent(a).x + a.get("cu"), 0)),
    },
    Entry {
        name: "calibration.bent-v",
        parameters: &["x", "y", "k1", "f", "cv"],
        summary: "row of the ray (x, y, 1) through a lens with k1",
        compute: |a| Ok(Real(a.get("f") * bent(a).y + a.get("cv"), 0)),
    },
    Entry {
        name: "calibration.pinhole-px",
        parameters: &["f", "deg"],
        summary: "distance from the middle of a ray at an angle, without a lens, pixels",
        compute: |a| {
            let angle = a.get("deg").to_radians();
            Ok(Real(a.get("f") * libm::tan(angle), 0))
        },
    },
    Entry {
        name: "calibration.fisheye-px",
        parameters: &["f", "deg"],
        summary: "distance from the middle of a ray at an angle, through an equidistant fisheye, pixels",
        compute: |a| {
            let (sin, cos) = libm::sincos(a.get("deg").to_radians());
            let projected = Fisheye::default().project(&Vector3::new(sin, 0.0, cos));
            let projected = projected.ok_or("the lens does not see this ray")?;
            Ok(Real(a.get("f") * projected.coords.norm(), 0))
        },
    },
    Entry {
        name: "calibration.exif-px",
        parameters: &["mm", "sensor", "width"],
        summary: "focal length of a photograph this wide, from that in millimeters, pixels",
        compute: |a| Ok(Real(a.get("mm") / a.get("sensor") * a.get("width"), 0)),
    },
];

/// Returns the ray (x, y, 1) distorted by a lens with k1.
fn bent(a: &Arguments) -> Point2<f64> {
    let lens = Distortion {
        k1: a.get("k1"),
        ..Distortion::NONE
    };
    lens.distort(&Point2::new(a.get("x"), a.get("y")))
}
