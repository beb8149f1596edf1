//! Numbers of the chapter on triangulation.

use super::entry::Number::{self, Real};
use super::entry::{Arguments, Entry, sentence};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at};
use epipole::triangulation::{
    point_covariance, triangulate_angular, triangulate_dlt, triangulate_midpoint,
    triangulate_optimal,
};
use nalgebra::{Point2, Point3, Vector3};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "triangulation.point",
        parameters: &["f", "b", "u", "v", "u2", "v2", "axis"],
        summary: "X, Y or Z, axis = 1, 2, 3, of the match (u, v) – (u2, v2) by the DLT; equal cameras \
            side by side, a baseline b apart, principal point (320, 240); meters",
        compute: point,
    },
    Entry {
        name: "triangulation.ahead-mm",
        parameters: &["method", "axis"],
        summary: "X, Y or Z, axis = 1, 2, 3, of the chapter's match by the midpoint, the DLT, angles or \
            the optimum, method = 1 to 4; millimeters",
        compute: ahead_mm,
    },
    Entry {
        name: "triangulation.miss-px",
        parameters: &["method", "image"],
        summary: "how far that point lands from the pixel in image 1 or 2, pixels",
        compute: miss_px,
    },
    Entry {
        name: "triangulation.error-px",
        parameters: &["method"],
        summary: "the root mean square of both, pixels",
        compute: error_px,
    },
    Entry {
        name: "triangulation.sigma-mm",
        parameters: &["f", "r", "angle", "sigma", "axis"],
        summary: "half axis 1, 2 or 3 of a point's region of one standard deviation, 1 along the rays, 2 \
            across them; two cameras look at it from the distance r, their rays at an angle in degrees; \
            millimeters",
        compute: sigma_mm,
    },
    Entry {
        name: "triangulation.sigma-depth",
        parameters: &["f", "b", "z", "sigma"],
        summary: "standard deviation along the rays of a point half-way between two cameras side by side, \
            a baseline b apart, and z away; meters",
        compute: sigma_depth,
    },
];

/// Returns two identical cameras with parallel axes, the second one at (x, 0, z).
fn looking_ahead(focal_px: f64, x: f64, z: f64) -> Result<[PosedCamera; 2], String> {
    let intrinsics = Intrinsics::new(focal_px, focal_px, 320.0, 240.0).map_err(sentence)?;
    Ok([(0.0, 0.0), (x, z)].map(|(x, z)| PosedCamera {
        camera: Camera::pinhole(intrinsics, 640, 480),
        cam_from_world: RigidTransform::translation(-x, 0.0, -z),
    }))
}

fn point(a: &Arguments) -> Result<Number, String> {
    let [left, right] = looking_ahead(a.get("f"), a.get("b"), 0.0)?;
    let (left, right) = (left.projection_matrix(), right.projection_matrix());
    let point = triangulate_dlt(&left, &right, &a.pixel1(), &a.pixel2()).map_err(sentence)?;
    Ok(Real(point[a.index("axis", 3)?], 3))
}

/// Triangulates the match used in the chapter, by one method: camera 2 is 0.1 m to the right and 2
/// m ahead, the pixels are (320, 242) and (220, 238). Returns the point, and its distance from each
/// pixel.
fn ahead(a: &Arguments) -> Result<(Point3<f64>, [f64; 2]), String> {
    let cameras = looking_ahead(500.0, 0.1, 2.0)?;
    let pixels = [Point2::new(320.0, 242.0), Point2::new(220.0, 238.0)];
    let [first, second] = &cameras;
    let [x1, x2] = &pixels;
    // Camera 1 is the world frame, and the axes are parallel.
    let (ray1, ray2) = (first.ray_in_world(x1), second.ray_in_world(x2));
    let motion = second.cam_from_world;
    let matrices = cameras.map(|camera| camera.projection_matrix());
    let point = match a.count("method")? {
        1 => triangulate_midpoint(&motion, &ray1, &ray2),
        2 => triangulate_dlt(&matrices[0], &matrices[1], x1, x2),
        3 => triangulate_angular(&motion, &ray1, &ray2),
        4 => triangulate_optimal(first, second, x1, x2),
        _ => return Err("method must be 1 to 4".to_owned()),
    };
    let point = point.map_err(sentence)?;
    let mut misses_px = [0.0; 2];
    for (index, camera) in cameras.iter().enumerate() {
        misses_px[index] = (camera.project(&point).map_err(sentence)? - pixels[index]).norm();
    }
    Ok((point, misses_px))
}

fn ahead_mm(a: &Arguments) -> Result<Number, String> {
    Ok(Real(1000.0 * ahead(a)?.0[a.index("axis", 3)?], 1))
}

fn miss_px(a: &Arguments) -> Result<Number, String> {
    let misses_px = ahead(a)?.1;
    match misses_px.get(a.index("image", 3)?) {
        Some(&miss_px) => Ok(Real(miss_px, 2)),
        None => Err("image must be 1 or 2".to_owned()),
    }
}

fn error_px(a: &Arguments) -> Result<Number, String> {
    let [one, two] = ahead(a)?.1;
    Ok(Real(((one * one + two * two) / 2.0).sqrt(), 2))
}

/// Returns the lengths of the semi-axes of the one-sigma ellipsoid, longest first.
fn half_axes(
    cameras: &[PosedCamera],
    point: &Point3<f64>,
    sigma_px: f64,
) -> Result<[f64; 3], String> {
    let covariance = point_covariance(cameras, point, sigma_px).map_err(sentence)?;
    let mut squares: [f64; 3] = covariance.symmetric_eigenvalues().into();
    squares.sort_by(|x, y| y.total_cmp(x));
    Ok(squares.map(|square| square.max(0.0).sqrt()))
}

fn sigma_mm(a: &Arguments) -> Result<Number, String> {
    let (sin, cos) = libm::sincos((a.get("angle") / 2.0).to_radians());
    let camera = |side: f64| {
        let center = Point3::new(side * sin, 0.0, -cos) * a.get("r");
        let up = Vector3::new(0.0, -1.0, 0.0);
        Ok(PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::new(a.get("f"), a.get("f"), 320.0, 240.0)?,
                640,
                480,
            ),
            cam_from_world: look_at(&center, &Point3::origin(), &up)?,
        })
    };
    let cameras = camera(-1.0).and_then(|left| Ok([left, camera(1.0)?]));
    let axes = half_axes(
        &cameras.map_err(sentence)?,
        &Point3::origin(),
        a.get("sigma"),
    )?;
    // In the plane of the rays the width is never smaller than out of that plane.
    Ok(Real(1000.0 * axes[a.index("axis", 3)?], 1))
}

fn sigma_depth(a: &Arguments) -> Result<Number, String> {
    let cameras = looking_ahead(a.get("f"), a.get("b"), 0.0)?;
    let middle = Point3::new(a.get("b") / 2.0, 0.0, a.get("z"));
    Ok(Real(half_axes(&cameras, &middle, a.get("sigma"))?[0], 2))
}
