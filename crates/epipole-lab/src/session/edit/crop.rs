//! A box around the model without its outliers.

use crate::project::{CropBox, Project};
use crate::tasks::{Query, ReconstructionOfAll};
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

/// Maximum number of points of each dense cloud that determine the box.
const MAX_DENSE: usize = 20_000;
/// Points this many median distances from the median do not determine the axes.
const FAR: f64 = 3.0;
/// Points beyond the middle nine tenths by more than this multiple of their width are outliers.
const REACH: f64 = 0.5;
/// Margin around the points, relative to the sides of the box.
const MARGIN: f64 = 0.01;

impl Project {
    /// Returns a box around the model without far outliers: upright on the floor if it is set,
    /// along the axes of known poses, or else along the principal axes of the points. `None`
    /// without points.
    pub fn fitted_crop(&self) -> Option<CropBox> {
        let places = self.places();
        let center = median(&places)?;
        let principal = principal_axes(&places, center);
        let floor = self.floor();
        let axes = match (&floor, &self.document.poses) {
            (Some(floor), _) => upright(&floor.up, &principal),
            (None, Some(_)) => Matrix3::identity(),
            (None, None) => principal,
        };
        let origin = floor.map_or(center, |floor| floor.origin);
        let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            let along = |place: &Point3<f64>| axes.row(axis).dot(&(place - origin).transpose());
            [low[axis], high[axis]] = extent(places.iter().map(along).collect())?;
        }
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        Some(CropBox {
            of: ReconstructionOfAll.key(self)?.0,
            component: self.view.component as u32,
            origin: origin.coords.into(),
            rotation: rotation.coords.into(),
            low,
            high,
        })
    }

    /// Returns the positions of all points that are not deleted, of dense clouds some.
    fn places(&self) -> Vec<Point3<f64>> {
        let remaining = self.not_deleted();
        let points = self
            .component()
            .map_or(&[][..], |component| &component.points);
        let sparse = points.iter().filter(|point| remaining.has_point(point));
        let mut places: Vec<[f64; 3]> = sparse.map(|point| point.position).collect();
        if let Some((key, cloud)) = self.all_views() {
            let (has, every) = (
                remaining.of_cloud(key),
                cloud.len().div_ceil(MAX_DENSE).max(1),
            );
            let points = (0..).step_by(every).zip(cloud.points(every));
            let points = points.map(|(index, point)| (index, point.position));
            places.extend(
                points
                    .filter(|(n, place)| has(*n, *place))
                    .map(|(_, place)| place),
            );
        }
        for (key, _, _, pair) in self.dense_pairs() {
            let has = remaining.of_cloud(key);
            let pixels = f64::from(pair.num_shown) * pair.density;
            let every = libm::ceil(libm::sqrt(pixels / MAX_DENSE as f64)).max(1.0) as u32;
            let points = pair.places(every).filter(|(n, place)| has(*n, *place));
            places.extend(points.map(|(_, place)| place));
        }
        let places = places.into_iter().map(Point3::from);
        places
            .filter(|place| place.iter().all(|x| x.is_finite()))
            .collect()
    }
}

fn quantile(values: &mut [f64], ratio: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = (ratio * last as f64).round() as usize;
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

fn median(places: &[Point3<f64>]) -> Option<Point3<f64>> {
    let along = |axis: usize| {
        let mut values: Vec<f64> = places.iter().map(|place| place[axis]).collect();
        quantile(&mut values, 0.5)
    };
    Some(Point3::new(along(0)?, along(1)?, along(2)?))
}

/// Returns the principal axes of the points near their center as rows of a rotation, the longest
/// first.
fn principal_axes(places: &[Point3<f64>], center: Point3<f64>) -> Matrix3<f64> {
    let mut away: Vec<f64> = places.iter().map(|place| (place - center).norm()).collect();
    let far = FAR * quantile(&mut away, 0.5).unwrap_or(0.0);
    let near = || {
        places
            .iter()
            .map(|place| place - center)
            .filter(|p| p.norm() <= far)
    };
    let count = near().count().max(1) as f64;
    let mean = near().sum::<Vector3<f64>>() / count;
    let scatter: Matrix3<f64> = near().map(|p| (p - mean) * (p - mean).transpose()).sum();
    let found = scatter.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| found.eigenvalues[*b].total_cmp(&found.eigenvalues[*a]));
    let axis = |n: usize| found.eigenvectors.column(order[n]).into_owned();
    rotation(axis(0), axis(1))
}

/// Returns axes with z up and x along the longest principal axis that is not vertical.
fn upright(up: &Vector3<f64>, principal: &Matrix3<f64>) -> Matrix3<f64> {
    let flat = |row: usize| {
        let axis = principal.row(row).transpose();
        axis - up * axis.dot(up)
    };
    let x = [0, 1, 2]
        .map(flat)
        .into_iter()
        .find(|axis| axis.norm() > 0.5);
    let x = x.unwrap_or_else(Vector3::x).normalize();
    rotation(x, up.cross(&x))
}

/// Returns a rotation with these first two rows.
fn rotation(x: Vector3<f64>, y: Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()])
}

/// Returns the range of the values without outliers, with a margin.
fn extent(mut values: Vec<f64>) -> Option<[f64; 2]> {
    let (low, high) = (quantile(&mut values, 0.05)?, quantile(&mut values, 0.95)?);
    let width = high - low;
    let [least, most] = [low - REACH * width, high + REACH * width];
    let near = values
        .iter()
        .filter(|value| (least..=most).contains(*value));
    let [mut low, mut high] = [low, high];
    for value in near {
        low = low.min(*value);
        high = high.max(*value);
    }
    // Points in a plane have a box with a thickness, too.
    let margin = (MARGIN * (high - low)).max(1e-9 * (1.0 + high.abs()));
    Some([low - margin, high + margin])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_far_outlier_is_not_in_the_range() {
        let mut values: Vec<f64> = (0..=100).map(f64::from).collect();
        values.extend([5000.0, -300.0]);
        assert_eq!(extent(values), Some([-1.0, 101.0]));
        let flat = extent(vec![2.0; 50]).unwrap_or_default();
        assert!(flat[0] < 2.0 && 2.0 < flat[1]);
        assert_eq!(extent(Vec::new()), None);
    }

    #[test]
    fn axes_are_those_of_the_points_and_upright_on_a_floor() {
        let at = |n: u32| {
            let [a, b, c] = [n % 10, n / 10 % 6, n / 60 % 3].map(f64::from);
            // Longest along y, then z, then x.
            Point3::new(c, 5.0 * a, 2.0 * b)
        };
        let mut places: Vec<Point3<f64>> = (0..180).map(at).collect();
        places.push(Point3::new(1e6, 0.0, 0.0));
        let axes = principal_axes(&places, median(&places).unwrap_or_default());
        assert!((axes.determinant() - 1.0).abs() < 1e-9);
        assert!(
            axes[(0, 1)].abs() > 0.999 && axes[(1, 2)].abs() > 0.999,
            "{axes}"
        );
        let up = Vector3::new(0.0, 1.0, 0.0);
        let axes = upright(&up, &axes);
        assert!((axes.row(2).transpose() - up).norm() < 1e-9, "{axes}");
        assert!(axes[(0, 2)].abs() > 0.999 && (axes.determinant() - 1.0).abs() < 1e-9);
    }
}
