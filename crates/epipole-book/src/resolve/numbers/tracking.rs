//! Numbers of the chapter on tracking.

use super::entry::Number::{Count, Real};
use super::entry::{Arguments, Entry};
use epipole::feature::WindowTensor;
use nalgebra::{Matrix2, Vector2};

/// Three gradients, and the motion of the window.
const MOVED: &[&str] = &["u1", "v1", "u2", "v2", "u3", "v3", "du", "dv"];

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "tracking.change",
        parameters: &["u", "v", "du", "dv"],
        summary: "change at a pixel with the gradient (u, v) whose image moves by (du, dv)",
        compute: |a| {
            let gradient = Vector2::new(a.get("u"), a.get("v"));
            Ok(Real(-gradient.dot(&motion(a)), 0))
        },
    },
    Entry {
        name: "tracking.right-u",
        parameters: MOVED,
        summary: "−Σ Iu It of three gradients whose image moves by (du, dv)",
        compute: |a| Ok(Real(right_side(a).x, 0)),
    },
    Entry {
        name: "tracking.right-v",
        parameters: MOVED,
        summary: "−Σ Iv It of three gradients whose image moves by (du, dv)",
        compute: |a| Ok(Real(right_side(a).y, 0)),
    },
    Entry {
        name: "tracking.found-u",
        parameters: MOVED,
        summary: "columns of the motion that solves M d = −Σ ∇I It",
        compute: |a| found(a).map(|d| Real(d.x, 1)),
    },
    Entry {
        name: "tracking.found-v",
        parameters: MOVED,
        summary: "rows of the motion that solves M d = −Σ ∇I It",
        compute: |a| found(a).map(|d| Real(d.y, 1)),
    },
    Entry {
        name: "tracking.turned-px",
        parameters: &["f", "deg"],
        summary: "motion at the principal point of a camera that turns by an angle, pixels",
        compute: |a| Ok(Real(a.get("f") * libm::tan(a.get("deg").to_radians()), 1)),
    },
    Entry {
        name: "tracking.level-px",
        parameters: &["px", "level"],
        summary: "a motion on a level of a pyramid, pixels of that level",
        compute: |a| Ok(Real(a.get("px") / libm::exp2(a.get("level")), 1)),
    },
    Entry {
        name: "tracking.levels",
        parameters: &["px", "reach"],
        summary: "levels of a pyramid that make a motion no longer than the reach",
        compute: |a| {
            let halvings = libm::ceil(libm::log2(a.get("px") / a.get("reach")));
            Ok(Count(1 + halvings.max(0.0) as u64))
        },
    },
    Entry {
        name: "tracking.drift-px",
        parameters: &["sigma", "steps"],
        summary: "standard deviation of a sum of independent errors, pixels",
        compute: |a| Ok(Real(a.get("sigma") * a.get("steps").sqrt(), 1)),
    },
];

fn motion(a: &Arguments) -> Vector2<f64> {
    Vector2::new(a.get("du"), a.get("dv"))
}

fn gradients(a: &Arguments) -> [Vector2<f64>; 3] {
    [("u1", "v1"), ("u2", "v2"), ("u3", "v3")].map(|(u, v)| Vector2::new(a.get(u), a.get(v)))
}

/// Returns `−Σ ∇I It`.
fn right_side(a: &Arguments) -> Vector2<f64> {
    let gradients = gradients(a);
    gradients.iter().map(|g| g * g.dot(&motion(a))).sum()
}

fn found(a: &Arguments) -> Result<Vector2<f64>, String> {
    let WindowTensor { uu, uv, vv } = WindowTensor::from_gradients(&gradients(a));
    let inverse = Matrix2::new(uu, uv, uv, vv).try_inverse();
    let inverse = inverse.ok_or("the gradients are all parallel, so M has no inverse")?;
    Ok(inverse * right_side(a))
}
