//! Numbers of the chapter on planes.

use super::entry::Number::Real;
use super::entry::{Arguments, Entry, sentence};
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::homography::{homography_from_motion, transfer};
use nalgebra::{Matrix3, Point2, Vector3};

/// A level camera at height h, and a point of the floor or a pixel.
const FLOOR: &[&str] = &["f", "cu", "cv", "h", "x", "z"];
const PIXEL: &[&str] = &["f", "cu", "cv", "h", "u", "v"];

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "planes.floor-u",
        parameters: FLOOR,
        summary: "column of the place (x, z) of the floor, seen by a level camera",
        compute: |a| Ok(Real(floor_pixel(a)?.x, 0)),
    },
    Entry {
        name: "planes.floor-v",
        parameters: FLOOR,
        summary: "row of the place (x, z) of the floor, seen by a level camera",
        compute: |a| Ok(Real(floor_pixel(a)?.y, 0)),
    },
    Entry {
        name: "planes.floor-x",
        parameters: PIXEL,
        summary: "place of the floor at a pixel of a level camera, to the right, meters",
        compute: |a| Ok(Real(floor_place(a)?.x, 2)),
    },
    Entry {
        name: "planes.floor-z",
        parameters: PIXEL,
        summary: "place of the floor at a pixel of a level camera, ahead, meters",
        compute: |a| Ok(Real(floor_place(a)?.y, 2)),
    },
    Entry {
        name: "planes.cross-ratio",
        parameters: &["a", "b", "c", "d"],
        summary: "cross-ratio (AC · BD) / (BC · AD) of four places on a line",
        compute: |a| {
            let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| a.get(name));
            Ok(Real((c - a) * (d - b) / ((c - b) * (d - a)), 3))
        },
    },
    Entry {
        name: "planes.focal",
        parameters: &["cu", "cv", "u1", "v1", "u2", "v2"],
        summary: "focal length from the vanishing points of two directions at right angles, pixels",
        compute: |a| {
            let middle = Point2::new(a.get("cu"), a.get("cv"));
            let [first, second] =
                [("u1", "v1"), ("u2", "v2")].map(|(u, v)| Point2::new(a.get(u), a.get(v)) - middle);
            let focal_sq = -first.dot(&second);
            match focal_sq > 0.0 {
                true => Ok(Real(focal_sq.sqrt(), 0)),
                false => Err("these directions are not at right angles".to_owned()),
            }
        },
    },
    Entry {
        name: "planes.angle-deg",
        parameters: &["f", "cu", "u"],
        summary: "angle of the ray of the column u, to the right of the optical axis, degrees",
        compute: |a| {
            let ray = (a.get("u") - a.get("cu")) / a.get("f");
            Ok(Real(libm::atan(ray).to_degrees(), 1))
        },
    },
    Entry {
        name: "planes.turned-u",
        parameters: &["f", "cu", "u", "deg"],
        summary: "column, in the row of the middle, after the camera turned right by deg degrees",
        compute: |a| {
            let intrinsics = camera(a.get("f"), a.get("cu"), 0.0)?;
            let rotation = RigidTransform::rotation(Vector3::y() * -a.get("deg").to_radians());
            let homography = of_plane(&rotation, f64::INFINITY, &intrinsics);
            Ok(Real(transferred(&homography, a.get("u"), 0.0)?.x, 1))
        },
    },
    Entry {
        name: "planes.parallax-px",
        parameters: &["f", "b", "z", "wall"],
        summary: "parallax of a point at the depth z against a wall, after a step b to the right, pixels",
        compute: |a| {
            let intrinsics = camera(a.get("f"), 0.0, 0.0)?;
            let step = RigidTransform::translation(-a.get("b"), 0.0, 0.0);
            let predicted = transferred(&of_plane(&step, a.get("wall"), &intrinsics), 0.0, 0.0)?;
            let pixel = transferred(&of_plane(&step, a.get("z"), &intrinsics), 0.0, 0.0)?;
            Ok(Real((pixel - predicted).norm(), 0))
        },
    },
];

fn camera(focal_px: f64, cu: f64, cv: f64) -> Result<Intrinsics, String> {
    Intrinsics::new(focal_px, focal_px, cu, cv).map_err(sentence)
}

/// Returns the homography of a wall at this distance, perpendicular to the optical axis.
fn of_plane(motion: &RigidTransform, distance: f64, intrinsics: &Intrinsics) -> Matrix3<f64> {
    homography_from_motion(motion, &-Vector3::z(), distance, intrinsics, intrinsics)
}

/// Returns the homography from points (x, z) of the floor to pixels.
fn pixel_from_floor(a: &Arguments) -> Result<Matrix3<f64>, String> {
    let intrinsics = camera(a.get("f"), a.get("cu"), a.get("cv"))?;
    let columns = [Vector3::x(), Vector3::z(), Vector3::y() * a.get("h")];
    Ok(intrinsics.matrix() * Matrix3::from_columns(&columns))
}

fn floor_pixel(a: &Arguments) -> Result<Point2<f64>, String> {
    transferred(&pixel_from_floor(a)?, a.get("x"), a.get("z"))
}

fn floor_place(a: &Arguments) -> Result<Point2<f64>, String> {
    let inverse = pixel_from_floor(a)?.try_inverse();
    let inverse = inverse.ok_or("the camera is on the floor")?;
    transferred(&inverse, a.get("u"), a.get("v"))
}

fn transferred(homography: &Matrix3<f64>, x: f64, y: f64) -> Result<Point2<f64>, String> {
    let found = transfer(homography, &Point2::new(x, y));
    found.ok_or_else(|| "it is infinitely far away".to_owned())
}
