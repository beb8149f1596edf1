//! Alignment of the reconstruction to control points, and their residuals.

use super::scale::{MAX_SIGMAS, Scale, ScaleSource};
use crate::project::{ControlPoint, Project};
use epipole::sfm::{AlignmentKind, align_points};
use nalgebra::{Matrix3, Point3, Similarity3, Vector3};

/// Similarity from the reconstruction to known coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// Transform to meters.
    pub control_from_world: Similarity3<f64>,
    /// Relative standard deviation of its scale.
    pub relative_sigma: f64,
    /// Index of each control point in use, and its place less its known coordinates, meters.
    pub residuals: Vec<(usize, Vector3<f64>)>,
}

impl Alignment {
    /// Returns its scale.
    pub(super) fn scale(&self) -> Scale {
        Scale {
            meters_per_unit: self.control_from_world.scaling(),
            relative_sigma: self.relative_sigma,
            source: ScaleSource::ControlPoints,
        }
    }

    /// Returns the root mean square of all residuals, meters.
    pub fn rms_m(&self) -> f64 {
        let sum: f64 = (self.residuals.iter())
            .map(|(_, by)| by.norm_squared())
            .sum();
        libm::sqrt(sum / self.residuals.len().max(1) as f64)
    }
}

/// A control point with coordinates.
#[derive(Debug, Clone, Copy)]
struct Known {
    index: usize,
    place: Point3<f64>,
    covariance: Matrix3<f64>,
    position_m: Point3<f64>,
}

fn align(known: &[Known]) -> Option<Similarity3<f64>> {
    let from: Vec<_> = known.iter().map(|point| point.place).collect();
    let to: Vec<_> = known.iter().map(|point| point.position_m).collect();
    // Points near a line would leave the rotation about it to their noise.
    crate::project::Plane::fit(&to)?;
    align_points(&from, &to, AlignmentKind::Similarity).ok()
}

fn center(known: &[Known]) -> Point3<f64> {
    let sum: Vector3<f64> = known.iter().map(|point| point.place.coords).sum();
    (sum / known.len().max(1) as f64).into()
}

fn spread_sq(known: &[Known], center: &Point3<f64>) -> f64 {
    (known.iter())
        .map(|point| (point.place - center).norm_squared())
        .sum()
}

/// Relative standard deviation of the scale: to first order it changes by `Σ aᵢᵀ δᵢ / Σ ‖aᵢ‖²` for
/// centered points `aᵢ` that move by `δᵢ`.
fn scale_sigma(known: &[Known]) -> f64 {
    let center = center(known);
    let mut variance = 0.0;
    for point in known {
        let arm = point.place - center;
        variance += arm.dot(&(point.covariance * arm));
    }
    libm::sqrt(variance.max(0.0)) / spread_sq(known, &center)
}

/// Finds the control point whose exclusion leaves the smallest residuals of the others, if it is
/// farther from its coordinates than the uncertainty allows. Returns its place in the list and the
/// distance, meters.
fn outlier(known: &[Known]) -> Option<(usize, f64)> {
    if known.len() < 4 {
        return None;
    }
    let mut best: Option<(f64, usize, f64, bool)> = None;
    for n in 0..known.len() {
        let mut others = known.to_vec();
        let point = others.remove(n);
        let Some(similarity) = align(&others) else {
            continue;
        };
        let off = |point: &Known| (similarity * point.place - point.position_m).norm();
        let sum_sq: f64 = others.iter().map(|other| off(other) * off(other)).sum();
        let freedom = (3 * others.len()).saturating_sub(7).max(1) as f64;
        let scale = similarity.scaling();
        let expected = |point: &Known| point.covariance.trace() / 3.0 * scale * scale;
        let mean = known.iter().map(expected).sum::<f64>() / known.len() as f64;
        let variance = (sum_sq / freedom).max(mean);
        // The alignment is less certain away from the points that determine it.
        let center = center(&others);
        let arm_sq = (point.place - center).norm_squared();
        let leverage = 1.0 / others.len() as f64 + arm_sq / spread_sq(&others, &center);
        let distance = off(&point);
        let rounding = 1e-9 * scale * libm::sqrt(spread_sq(known, &center));
        let sigma = libm::sqrt(3.0 * variance * (1.0 + leverage));
        let is_off = distance > (MAX_SIGMAS * sigma).max(rounding);
        if best.is_none_or(|(least, ..)| sum_sq < least) {
            best = Some((sum_sq, n, distance, is_off));
        }
    }
    let (_, n, distance, is_off) = best?;
    is_off.then_some((n, distance))
}

impl Project {
    /// Returns the control points with coordinates whose points exist.
    fn known_points(&self) -> Vec<Known> {
        let controls = self.document.control_points.iter().enumerate();
        let known = |(index, control): (usize, &ControlPoint)| {
            let position_m = control.position_m?.into();
            Some(Known {
                index,
                place: self.anchored(&control.point)?,
                covariance: self.covariance(&control.point)?,
                position_m,
            })
        };
        controls.filter_map(known).collect()
    }

    /// Returns the alignment to control points; `None` for fewer than three with coordinates, and
    /// for points on a line.
    pub fn alignment(&self) -> Option<Alignment> {
        let known = self.known_points();
        if known.len() < 3 {
            return None;
        }
        let control_from_world = align(&known)?;
        let residual = |point: &Known| {
            let by = control_from_world * point.place - point.position_m;
            (point.index, by)
        };
        Some(Alignment {
            control_from_world,
            relative_sigma: scale_sigma(&known),
            residuals: known.iter().map(residual).collect(),
        })
    }

    /// Returns the index of the control point that is clearly off, and its distance from where the
    /// others put it, meters.
    pub fn bad_control(&self) -> Option<(usize, f64)> {
        let known = self.known_points();
        let (place, distance) = outlier(&known)?;
        Some((known[place].index, distance))
    }

    /// Describes the state of a control point.
    pub fn control_words(&self, index: usize) -> String {
        let Some(control) = self.document.control_points.get(index) else {
            return String::new();
        };
        if self.anchored(&control.point).is_none() {
            return "its point is gone".to_owned();
        }
        let Some(alignment) = self.alignment() else {
            return match control.position_m {
                Some(_) => "has coordinates".to_owned(),
                None => "has no coordinates yet".to_owned(),
            };
        };
        let mut residuals = alignment.residuals.iter();
        match residuals.find(|(other, _)| *other == index) {
            Some((_, by)) => format!("{:.1} mm from its coordinates", 1000.0 * by.norm()),
            None => {
                let place = self.anchored(&control.point).unwrap_or_default();
                let [x, y, z] = (alignment.control_from_world * place).coords.into();
                format!("at {x:.4}, {y:.4}, {z:.4} m")
            }
        }
    }

    /// Describes the alignment to control points; empty without any.
    pub fn alignment_words(&self) -> String {
        if self.document.control_points.is_empty() {
            return String::new();
        }
        let known = self.known_points();
        let Some(alignment) = self.alignment() else {
            return match known.len() {
                0..3 => format!("{} of 3 control points have coordinates.", known.len()),
                _ => "The control points lie on a line: give coordinates to one beside it."
                    .to_owned(),
            };
        };
        let mut words = format!(
            "The model is aligned to {} control points, {:.1} mm off in the root mean square.",
            alignment.residuals.len(),
            1000.0 * alignment.rms_m()
        );
        if let Some((index, distance)) = self.bad_control() {
            words.push_str(&format!(
                " {} is {:.1} mm from where the others put it: check its coordinates and its point.",
                self.document.control_points[index].name,
                1000.0 * distance
            ));
        }
        words
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use nalgebra::UnitQuaternion;

    fn known() -> Vec<Known> {
        let rotation = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
        let truth = Similarity3::from_parts(Vector3::new(4.0, -2.0, 9.0).into(), rotation, 2.5);
        let places = [
            [0.0, 0.0, 0.0],
            [1.0, 0.1, 0.0],
            [0.2, 1.1, 0.1],
            [0.9, 0.8, 0.4],
            [0.4, 0.3, 0.8],
        ];
        let one = |(index, place): (usize, &[f64; 3])| Known {
            index,
            place: (*place).into(),
            covariance: Matrix3::identity() * 1e-6,
            position_m: truth * Point3::from(*place),
        };
        places.iter().enumerate().map(one).collect()
    }

    #[test]
    fn a_wrong_coordinate_is_named_and_small_errors_are_not() {
        let mut points = known();
        assert_eq!(outlier(&points), None);
        // Errors of about a standard deviation, 2.5 mm.
        for (n, point) in points.iter_mut().enumerate() {
            let sign = [1.0, -1.0][n % 2];
            point.position_m += Vector3::new(0.002, -0.001, 0.0015) * sign;
        }
        assert_eq!(outlier(&points), None);
        for bad in 0..5 {
            let mut points = points.clone();
            points[bad].position_m.y += 0.3;
            let (place, distance) = outlier(&points).unwrap();
            assert_eq!(place, bad);
            assert!((distance - 0.3).abs() < 0.05, "{distance}");
        }
        // With three points, none can be told from the others.
        points.truncate(3);
        points[0].position_m.y += 0.3;
        assert_eq!(outlier(&points), None);
    }

    #[test]
    fn the_uncertainty_of_the_scale_is_that_of_moved_points() {
        let points = known();
        let base = align(&points).unwrap().scaling();
        let mut variance = 0.0;
        for n in 0..points.len() {
            for axis in 0..3 {
                let step = 1e-6;
                let mut moved = points.clone();
                moved[n].place[axis] += step;
                let change = (align(&moved).unwrap().scaling() / base - 1.0) / step;
                variance += change * change * 1e-6;
            }
        }
        let sigma = scale_sigma(&points);
        assert!(
            (sigma / variance.sqrt() - 1.0).abs() < 1e-3,
            "{sigma} {variance}"
        );
    }
}
