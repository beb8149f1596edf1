//! Numbers of the chapter on structure from motion.

use super::entry::Number::{Count, Real};
use super::entry::{Arguments, Entry};
use epipole::camera::RigidTransform;
use nalgebra::Vector3;

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
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
];

/// Returns the depths along two rays at their intersection; see `sfm.depth`.
fn crossing(a: &Arguments) -> Result<(f64, f64), String> {
    let half_turn = match a.count("turned")? {
        0 => 0.0,
        1 => core::f64::consts::PI,
        _ => return Err("turned must be 0 or 1".to_owned()),
    };
    // A camera motion to the right moves everything to the left.
    let t = Vector3::new(-a.get("sign"), 0.0, 0.0);
    let motion = RigidTransform::new(t, Vector3::new(half_turn, 0.0, 0.0));
    let (x1, x2) = (Vector3::z(), Vector3::new(a.get("x"), 0.0, 1.0));
    // λ1 R x1 + t = λ2 x2, multiplied by x2 × and by R x1 ×.
    let rotated = motion.rotation * x1;
    let normal = x2.cross(&rotated);
    let depth = |ray: &Vector3<f64>| ray.cross(&t).dot(&normal) / normal.norm_squared();
    let (depth1, depth2) = (-depth(&x2), -depth(&rotated));
    match depth1.is_finite() && depth2.is_finite() {
        true => Ok((depth1, depth2)),
        false => Err("the rays are parallel".to_owned()),
    }
}
