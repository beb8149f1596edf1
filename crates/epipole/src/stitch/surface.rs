//! Projection surfaces of panoramas.

use nalgebra::Vector3;

/// Minimum z of a unit direction on a plane.
const LEAST_AHEAD: f64 = 0.1;

/// Maximum slope on a cylinder: about 80° above the horizon.
const STEEPEST: f64 = 6.0;

/// Projection surface around the camera, with a focal length of 1. x points to the right, y down, z
/// ahead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Surface {
    /// (x/z, y/z): lines stay straight; up to about 120°.
    Plane,
    /// (atan2(x, z), y/√(x² + z²)): verticals stay straight; covers 360°, but not up and down.
    #[default]
    Cylinder,
    /// (atan2(x, z), atan2(y, √(x² + z²))): covers all directions.
    Sphere,
}

impl Surface {
    /// Projects a direction; `None` if it is beyond the surface.
    pub(super) fn place(self, d: &Vector3<f64>) -> Option<[f64; 2]> {
        let level = libm::hypot(d.x, d.z);
        match self {
            Self::Plane => (d.z > LEAST_AHEAD * d.norm()).then(|| [d.x / d.z, d.y / d.z]),
            Self::Cylinder => {
                let is_reached = d.y.abs() <= STEEPEST * level && level > 0.0;
                is_reached.then(|| [libm::atan2(d.x, d.z), d.y / level])
            }
            Self::Sphere => Some([libm::atan2(d.x, d.z), libm::atan2(d.y, level)]),
        }
    }

    /// Returns the components of directions in a column: sine and cosine of the angle, or x and 1.
    pub(super) fn column(self, x: f64) -> [f64; 2] {
        match self {
            Self::Plane => [x, 1.0],
            Self::Cylinder | Self::Sphere => libm::sincos(x).into(),
        }
    }

    /// Returns the components of directions in a row: y, and the length of the column components.
    pub(super) fn row(self, y: f64) -> [f64; 2] {
        match self {
            Self::Plane | Self::Cylinder => [y, 1.0],
            Self::Sphere => libm::sincos(y).into(),
        }
    }

    /// Returns whether columns are angles.
    pub(super) fn is_round(self) -> bool {
        self != Self::Plane
    }
}

/// Returns the direction of a column and a row.
pub(super) fn direction([sin, cos]: [f64; 2], [down, level]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(sin * level, down, cos * level)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lead_back_to_their_directions() {
        for surface in [Surface::Plane, Surface::Cylinder, Surface::Sphere] {
            for d in [Vector3::new(0.3, -0.2, 1.0), Vector3::new(-0.8, 0.5, 0.4)] {
                let [x, y] = surface.place(&d).unwrap();
                let back = direction(surface.column(x), surface.row(y));
                assert!(back.normalize().dot(&d.normalize()) > 1.0 - 1e-12);
            }
        }
        let behind = Vector3::new(0.1, 0.0, -1.0);
        assert!(Surface::Plane.place(&behind).is_none());
        assert!(Surface::Sphere.place(&behind).is_some());
        assert!(Surface::Cylinder.place(&Vector3::y()).is_none());
    }
}
