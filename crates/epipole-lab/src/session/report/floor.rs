//! Floor plane through three points: the up direction, and heights above it.

use crate::project::{Anchor, Project};
use nalgebra::{Point3, Vector3};

/// Minimum sine of the angle between the sides of three points: points nearly on a line do not
/// determine a plane.
const LEAST_SINE: f64 = 0.02;

/// A plane in the frame of the reconstruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// Point on it.
    pub origin: Point3<f64>,
    /// Unit normal, towards the cameras.
    pub up: Vector3<f64>,
}

impl Project {
    /// Returns the floor, if three points were chosen, are in the current component, and are not
    /// collinear.
    pub fn floor(&self) -> Option<Floor> {
        let component = self.component()?;
        let mut corners = [Point3::origin(); 3];
        for (corner, anchor) in corners.iter_mut().zip(self.document.floor.as_ref()?) {
            *corner = self.anchored(anchor)?;
        }
        let [origin, b, c] = corners;
        let (one, two) = (b - origin, c - origin);
        let normal = one.cross(&two);
        let is_plane = normal.norm() > LEAST_SINE * one.norm() * two.norm();
        if !is_plane {
            return None;
        }
        let up = normal.normalize();
        let cameras = component.cameras.iter().flatten();
        let heights: f64 = cameras
            .map(|camera| (camera.center() - origin).dot(&up))
            .sum();
        let up = if heights < 0.0 { -up } else { up };
        Some(Floor { origin, up })
    }

    /// Height of an anchor above the floor, in units of the reconstruction.
    pub fn height_in_units(&self, anchor: &Anchor) -> Option<f64> {
        let floor = self.floor()?;
        Some((self.anchored(anchor)? - floor.origin).dot(&floor.up))
    }

    /// Formats the height of an anchor; empty without a floor.
    pub fn height_words(&self, anchor: &Anchor) -> String {
        let Some(height) = self.height_in_units(anchor) else {
            return String::new();
        };
        match self.scale() {
            Some(scale) => format!("{:.4} m above the floor", height * scale.meters_per_unit),
            None => format!("{height:.4} units above the floor"),
        }
    }

    /// Describes the state of the floor.
    pub fn floor_words(&self) -> &'static str {
        match (self.document.floor.is_some(), self.floor().is_some()) {
            (false, _) => "",
            (true, true) => " The floor is set: heights are above it.",
            (true, false) => {
                " The three points of the floor lie on a line, or one of them is gone: choose others."
            }
        }
    }
}
