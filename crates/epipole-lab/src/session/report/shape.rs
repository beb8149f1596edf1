//! Angles, areas and volumes of measured figures, and their uncertainty.

use super::words::with_sigma;
use crate::project::{
    Anchor, Key, Plane, Project, Shape, ShapeKind, ShapeValue, bounds, height_weights, is_simple,
    prisms, signed_area,
};
use crate::tasks::DenseCloud;
use nalgebra::{Point3, Vector3};

/// Derivative of a value by the position of each point.
type Gradient = Vec<(Anchor, Vector3<f64>)>;

const GONE: &str = "one of its points is gone";
const ON_A_LINE: &str = "its points lie on a line: choose others";

impl Project {
    /// Returns the value of a figure: in meters if the scale is known, in units otherwise.
    ///
    /// # Errors
    /// A sentence on what is missing.
    pub fn shape_value(&self, shape: &Shape) -> Result<ShapeValue, String> {
        let found = self.shape_in_units(shape)?;
        let Some(scale) = self.scale() else {
            return Ok(found);
        };
        let dimension = shape.kind.dimension();
        let factor: f64 = (0..dimension).map(|_| scale.meters_per_unit).product();
        let value = found.value * factor;
        let of_scale = f64::from(dimension) * scale.relative_sigma * value;
        Ok(ShapeValue {
            value,
            sigma: libm::hypot(found.sigma * factor, of_scale),
            deviation: found.deviation.map(|by| by * scale.meters_per_unit),
            ..found
        })
    }

    fn shape_in_units(&self, shape: &Shape) -> Result<ShapeValue, String> {
        let places = shape.points.iter().map(|point| self.anchored(point));
        let places: Vec<_> = places.collect::<Option<_>>().ok_or(GONE)?;
        match (shape.kind, &places[..]) {
            (ShapeKind::Angle, [a, vertex, b]) => self.angle(shape, [*a, *vertex, *b]),
            (ShapeKind::Angle, _) => Err("an angle needs three points".to_owned()),
            (ShapeKind::Area, _) => self.area(shape, &places),
            _ => self.kept_volume(shape, &places),
        }
    }

    /// Returns the standard deviation of a value by its gradient.
    fn sigma_of(&self, gradient: Gradient) -> Result<f64, String> {
        // A point may be both in the outline and in the floor.
        let mut merged: Gradient = Vec::new();
        for (point, by) in gradient {
            match merged.iter_mut().find(|(other, _)| *other == point) {
                Some((_, sum)) => *sum += by,
                None => merged.push((point, by)),
            }
        }
        let mut variance = 0.0;
        for (point, by) in merged {
            variance += by.dot(&(self.covariance(&point).ok_or(GONE)? * by));
        }
        Ok(libm::sqrt(variance.max(0.0)))
    }

    fn angle(&self, shape: &Shape, [a, vertex, b]: [Point3<f64>; 3]) -> Result<ShapeValue, String> {
        let (one, two) = (a - vertex, b - vertex);
        let normal = one.cross(&two);
        let radians = libm::atan2(normal.norm(), one.dot(&two));
        // Each end moves the angle across its side, in the plane of both.
        let across = |arm: &Vector3<f64>, sign: f64| {
            let by = normal.cross(arm).try_normalize(0.0).unwrap_or_default();
            by * (sign / arm.norm())
        };
        let (by_a, by_b) = (across(&one, -1.0), across(&two, 1.0));
        let gradient = [by_a, -(by_a + by_b), by_b];
        let gradient = shape.points.iter().copied().zip(gradient).collect();
        let value = radians.to_degrees();
        let sigma = self.sigma_of(gradient)?.to_degrees();
        if !(value.is_finite() && sigma.is_finite()) {
            return Err("two of its points are at one place: choose others".to_owned());
        }
        Ok(ShapeValue {
            value,
            sigma,
            deviation: None,
            coverage: None,
        })
    }

    fn area(&self, shape: &Shape, places: &[Point3<f64>]) -> Result<ShapeValue, String> {
        let plane = Plane::fit(places).ok_or(ON_A_LINE)?;
        let value = checked_area(&plane.outline(places))?;
        let sign = value.signum();
        let count = places.len();
        let gradient = (0..count).map(|n| {
            let chord = places[(n + 1) % count] - places[(n + count - 1) % count];
            (shape.points[n], chord.cross(&plane.normal()) * (0.5 * sign))
        });
        Ok(ShapeValue {
            value: value.abs(),
            sigma: self.sigma_of(gradient.collect())?,
            deviation: Some(plane.deviation(places)),
            coverage: None,
        })
    }

    /// Returns a volume from the cache: panels show it in every frame, and a surface may have
    /// millions of triangles.
    fn kept_volume(&self, shape: &Shape, places: &[Point3<f64>]) -> Result<ShapeValue, String> {
        let Some((key, cloud)) = self.all_views().filter(|(_, c)| !c.triangles.is_empty()) else {
            return Err("there is no surface yet: compute \"Depth of all views\" first".to_owned());
        };
        let floor = (shape.kind == ShapeKind::VolumeOverFloor).then_some(self.document.floor);
        let key = Key::of(&(key.0, self.view.component, shape, floor));
        if let Some(known) = self.volumes.borrow().get(&key) {
            return known.clone();
        }
        let found = self.volume(shape, places, cloud);
        let mut volumes = self.volumes.borrow_mut();
        if volumes.len() > 1000 {
            volumes.clear();
        }
        volumes.insert(key, found.clone());
        found
    }

    fn volume(
        &self,
        shape: &Shape,
        places: &[Point3<f64>],
        cloud: &DenseCloud,
    ) -> Result<ShapeValue, String> {
        let (plane, corners) = match shape.kind {
            ShapeKind::VolumeOverFloor => {
                let floor = self.floor().ok_or("the floor is not set")?;
                let corners = self.document.floor.ok_or("the floor is not set")?;
                let plane = Plane::through(floor.origin, floor.up);
                (plane, corners.to_vec())
            }
            _ => {
                let plane = Plane::fit(places).ok_or(ON_A_LINE)?;
                let cameras = self.component().map(|found| found.cameras.iter().flatten());
                let centers: Vec<_> = (cameras.into_iter().flatten())
                    .map(|camera| camera.center().coords)
                    .collect();
                let mean = centers.iter().sum::<Vector3<f64>>() / centers.len().max(1) as f64;
                (plane.facing(&mean.into()), shape.points.clone())
            }
        };
        let outline = plane.outline(places);
        let area = checked_area(&outline)?.abs();
        let (low, high) = bounds(&outline);
        let step = 1e-4 * libm::hypot(high[0] - low[0], high[1] - low[1]);
        let triangles = triangles_near(&plane, cloud, (low, high), step);
        let found = prisms(&outline, triangles.iter().copied());
        if found.covered <= 0.0 || found.covered.is_nan() {
            return Err("the surface has no part within its outline".to_owned());
        }
        // Only triangles at the outline change their part within it.
        let at_edge: Vec<_> = (triangles.iter().copied())
            .filter(|triangle| is_at_edge(&outline, triangle, step))
            .collect();
        let axis = |n: usize| -> Vector3<f64> { plane.axes.column(n).into() };
        let mut gradient = Gradient::new();
        for (n, point) in shape.points.iter().enumerate() {
            for side in 0..2 {
                let volume_at = |by: f64| {
                    let mut moved = outline.clone();
                    moved[n][side] += by;
                    prisms(&moved, at_edge.iter().copied()).volume
                };
                let slope = (volume_at(step) - volume_at(-step)) / (2.0 * step);
                gradient.push((*point, axis(side) * slope));
            }
        }
        // A raised plane lowers the surface above it.
        let corner_places = corners.iter().map(|corner| self.anchored(corner));
        let corner_places: Vec<_> = corner_places.collect::<Option<_>>().ok_or(GONE)?;
        let middle = found.moments.map(|moment| moment / found.covered);
        let weights = height_weights(&plane.outline(&corner_places), middle).ok_or(ON_A_LINE)?;
        for (corner, weight) in corners.iter().zip(weights) {
            gradient.push((*corner, plane.normal() * (-found.covered * weight)));
        }
        Ok(ShapeValue {
            value: found.volume,
            sigma: self.sigma_of(gradient)?,
            deviation: match shape.kind {
                ShapeKind::VolumeOverFloor => None,
                _ => Some(plane.deviation(places)),
            },
            coverage: Some(found.covered / area),
        })
    }

    /// Formats the value of a figure, or the sentence on what is missing.
    pub fn shape_words(&self, index: usize) -> String {
        match self.document.shapes.get(index) {
            Some(shape) => match self.shape_value(shape) {
                Ok(found) => {
                    let (words, note) = (self.value_words(shape.kind, &found), self.note(&found));
                    format!("{words}{note}")
                }
                Err(why) => why,
            },
            None => String::new(),
        }
    }

    /// Returns the unit of a quantity.
    pub(super) fn shape_unit(&self, kind: ShapeKind) -> &'static str {
        match (kind.dimension(), self.scale().is_some()) {
            (0, _) => "°",
            (2, true) => "m²",
            (2, false) => "square units",
            (_, true) => "m³",
            (_, false) => "cubic units",
        }
    }

    fn value_words(&self, kind: ShapeKind, found: &ShapeValue) -> String {
        let number = with_sigma(found.value, found.sigma);
        match self.shape_unit(kind) {
            "°" => format!("{number}°"),
            unit => format!("{number} {unit}"),
        }
    }

    /// Describes the deviation from a plane and the coverage.
    pub(super) fn note(&self, found: &ShapeValue) -> String {
        let mut note = String::new();
        if let Some(by) = found.deviation {
            note.push_str(&match self.scale() {
                Some(_) => format!(", points within {:.1} mm of a plane", 1000.0 * by),
                None => format!(", points within {by:.4} units of a plane"),
            });
        }
        if let Some(coverage) = found.coverage {
            let percent = 100.0 * coverage;
            note.push_str(&format!(
                ", the surface covers {percent:.0}% of the outline"
            ));
        }
        note
    }
}

/// Returns the signed area of an outline.
fn checked_area(outline: &[[f64; 2]]) -> Result<f64, String> {
    if !is_simple(outline) {
        return Err("its sides cross: choose its corners in order around it".to_owned());
    }
    let area = signed_area(outline);
    match area.abs() > 0.0 && area.is_finite() {
        true => Ok(area),
        false => Err(ON_A_LINE.to_owned()),
    }
}

/// Returns the triangles of a surface near a box, in the frame of the plane.
fn triangles_near(
    plane: &Plane,
    cloud: &DenseCloud,
    (low, high): ([f64; 2], [f64; 2]),
    margin: f64,
) -> Vec<[[f64; 3]; 3]> {
    let vertices = cloud.vertices();
    let local: Vec<_> = vertices
        .map(|vertex| plane.local(&vertex.position.into()))
        .collect();
    let corners = |triangle: [u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| local.get(vertex as usize).copied());
        Some([a?, b?, c?])
    };
    let is_near = |triangle: &[[f64; 3]; 3]| overlaps(triangle, low, high, margin);
    cloud
        .triangles()
        .filter_map(corners)
        .filter(is_near)
        .collect()
}

/// Whether the bounding box of a triangle overlaps a box.
fn overlaps(triangle: &[[f64; 3]; 3], low: [f64; 2], high: [f64; 2], margin: f64) -> bool {
    (0..2).all(|axis| {
        let values = triangle.map(|corner| corner[axis]);
        values.iter().any(|x| *x >= low[axis] - margin)
            && values.iter().any(|x| *x <= high[axis] + margin)
    })
}

/// Whether a triangle may overlap a side of an outline.
fn is_at_edge(outline: &[[f64; 2]], triangle: &[[f64; 3]; 3], margin: f64) -> bool {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).any(|(a, b)| {
        let (low, high) = bounds(&[*a, *b]);
        overlaps(triangle, low, high, margin)
    })
}
