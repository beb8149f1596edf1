//! Numbers of the chapter on cameras and rays.

use super::entry::Number::Real;
use super::entry::{Arguments, Entry, sentence};
use epipole::camera::Intrinsics;
use nalgebra::{Matrix2, Matrix3, Point2, Point3, RowVector3};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
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
            Ok(Real(values[a.index("k", 2)?], 2))
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
        compute: |a| Ok(Real(three_rays(a)?.1[a.index("k", 2)?], 3)),
    },
];

/// Columns of one point in three identical cameras side by side.
const THREE_COLUMNS: &[&str] = &["u1", "u2", "u3"];

/// Returns the smallest singular value of the rows (1, −m, −B), m = (u − 320) / 500, of cameras at
/// B = 0, 0.4 and 0.8, and (X, Z) from its singular vector.
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
