//! Measures besides lengths, and points with known coordinates.

use super::anchor::{Anchor, PhotoId};
use serde::{Deserialize, Serialize};

/// Quantity of a measured figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ShapeKind {
    /// Angle at the second of three points.
    Angle,
    /// Area of a polygon in its best-fitting plane.
    Area,
    /// Volume between the surface and the plane of a polygon.
    Volume,
    /// Volume between the surface and the floor, within a polygon.
    VolumeOverFloor,
}

impl ShapeKind {
    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Area => "area",
            Self::Volume => "volume",
            Self::VolumeOverFloor => "volume over the floor",
        }
    }

    /// Returns the exponent of the unit of length in its unit.
    pub fn dimension(self) -> u8 {
        match self {
            Self::Angle => 0,
            Self::Area => 2,
            Self::Volume | Self::VolumeOverFloor => 3,
        }
    }
}

/// A measured figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// Its quantity.
    pub kind: ShapeKind,
    /// Its points, in order.
    pub points: Vec<Anchor>,
}

impl Shape {
    /// Maximum number of points.
    pub const MAX_POINTS: usize = 200;

    /// Whether it has as many distinct points as its kind needs.
    pub fn is_valid(&self) -> bool {
        let count = self.points.len();
        let is_enough = match self.kind {
            ShapeKind::Angle => count == 3,
            _ => (3..=Self::MAX_POINTS).contains(&count),
        };
        let is_repeated = |n: usize| self.points[..n].contains(&self.points[n]);
        is_enough && !(0..count).any(is_repeated)
    }
}

/// Value of a measured figure: degrees, or the power of the unit of length that its kind has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeValue {
    /// The value.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Largest distance of its points from their plane, for an area and a volume over it.
    pub deviation: Option<f64>,
    /// Ratio of the outline that the surface covers, for a volume.
    pub coverage: Option<f64>,
}

/// A point with a name and known coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ControlPoint {
    /// The point.
    pub point: Anchor,
    /// Its name.
    pub name: String,
    /// Its coordinates, meters, once typed.
    pub position_m: Option<[f64; 3]>,
}

impl ControlPoint {
    /// Maximum number of bytes of a name.
    const MAX_NAME: usize = 80;

    /// Whether its coordinates are finite, and its name is a short line of text.
    pub fn is_valid(&self) -> bool {
        let is_finite = |position: [f64; 3]| position.iter().all(|x| x.is_finite());
        self.name.len() <= Self::MAX_NAME
            && !self.name.chars().any(char::is_control)
            && self.position_m.is_none_or(is_finite)
    }

    /// Whether it depends on a photograph.
    pub(crate) fn is_of(&self, photo: PhotoId) -> bool {
        self.point.photos().any(|other| other == photo)
    }
}
