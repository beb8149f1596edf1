//! Measures of the zip file, in the frame of the reconstruction.

use serde::{Deserialize, Serialize};

/// A measured length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Positions of both ends.
    pub ends: [[f64; 3]; 2],
    /// The length, in meters if the scale is known.
    pub length: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Length typed by the reader, meters.
    pub typed_m: Option<f64>,
    /// The length and its difference from the typed one, in words.
    pub words: String,
}

/// A measured angle, area or volume.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasuredShape {
    /// Its quantity.
    pub kind: String,
    /// Its name.
    pub name: String,
    /// Its points.
    pub points: Vec<[f64; 3]>,
    /// Its value.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Its unit.
    pub unit: String,
    /// Its value in words.
    pub words: String,
}

/// A control point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasuredControl {
    /// Its name.
    pub name: String,
    /// Its position in the reconstruction.
    pub place: [f64; 3],
    /// Its known coordinates, meters.
    pub position_m: Option<[f64; 3]>,
    /// Distance of its aligned position from them, meters.
    pub residual_m: Option<f64>,
    /// Its state in words.
    pub words: String,
}

/// Similarity from the reconstruction to the coordinates of control points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Aligned {
    /// Rotation, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Translation, meters.
    pub translation: [f64; 3],
    /// Meters per unit.
    pub scale: f64,
}

/// Mark of a measured point in photographs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Short name beside it.
    pub label: String,
    /// Its position in the reconstruction.
    pub place: [f64; 3],
    /// Indices of the images that see it.
    pub images: Vec<u32>,
}

/// All measures of the zip file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Measures {
    /// Lengths.
    pub lengths: Vec<Measured>,
    /// Angles, areas and volumes.
    pub shapes: Vec<MeasuredShape>,
    /// Control points.
    pub control_points: Vec<MeasuredControl>,
    /// Alignment to the control points, which replaces scale and floor.
    pub aligned: Option<Aligned>,
    /// Sentences on the scale, the alignment, and what disagrees.
    pub findings: Vec<String>,
    /// Marks of all measured points.
    pub marks: Vec<Mark>,
}

impl Measures {
    /// Whether nothing was measured.
    pub fn is_empty(&self) -> bool {
        self.lengths.is_empty() && self.shapes.is_empty() && self.control_points.is_empty()
    }
}
