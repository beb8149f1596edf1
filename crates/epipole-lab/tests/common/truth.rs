//! Points of the table, with where the photographs were rendered from.

use super::depth::true_camera;
use epipole_lab::project::{Anchor, ControlPoint, Measure, Project, Shape, ShapeKind};
use epipole_lab::session::Event;
use epipole_lab::tasks::FeaturesOf;
use epipole_scenes::Scene;
use nalgebra::{Point2, Point3};

/// A reconstructed point and its true position, meters.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TruePoint {
    pub(crate) anchor: Anchor,
    /// Its position in the reconstruction.
    pub(crate) found: Point3<f64>,
    pub(crate) truth: Point3<f64>,
}

/// Largest distance of the places at which the views of a point meet the table from their mean.
pub(crate) const MAX_SPREAD_M: f64 = 0.003;

/// Well observed points on the top of the table.
pub(crate) fn table_points(project: &Project) -> Vec<TruePoint> {
    let scene = Scene::still_life();
    let component = project.component().unwrap();
    let mut all = Vec::new();
    for (index, point) in component.points.iter().enumerate() {
        if point.track.len() < 4 || point.error_px > 0.5 {
            continue;
        }
        // The mean of all views: a keypoint is at its place up to a fraction of a pixel.
        let mut hits: Vec<Point3<f64>> = Vec::new();
        let (mut sum, mut count) = (nalgebra::Vector3::zeros(), 0.0);
        for (image, keypoint) in &point.track {
            let photo = &project.document().photos[*image as usize];
            let feature = &project.get(FeaturesOf(photo.id)).unwrap().list[*keypoint as usize];
            let camera = true_camera(*image as usize);
            let from = camera.cam_from_world.inverse() * Point3::origin();
            let ray = camera.ray_in_world(&Point2::new(feature.u, feature.v));
            let hit = scene
                .cast(&from, &ray)
                .filter(|hit| hit.point.y.abs() < 0.002 && hit.point.z < 0.5);
            let Some(hit) = hit else {
                count = f64::NAN;
                break;
            };
            hits.push(hit.point);
            sum += hit.point.coords;
            count += 1.0;
        }
        // Seen at a grazing angle, half a pixel is a centimeter: such points have no known place.
        let mean = Point3::from(sum / count);
        let is_known = hits.iter().all(|hit| (hit - mean).norm() < MAX_SPREAD_M);
        if count > 0.0 && is_known {
            all.push(TruePoint {
                anchor: project.anchor_of(index).unwrap(),
                found: point.position.into(),
                truth: mean,
            });
        }
    }
    all
}

/// The four corners of a large quadrilateral: the ends of its longest diagonal, and the points
/// farthest from it on either side.
pub(crate) fn corners(points: &[TruePoint]) -> [TruePoint; 4] {
    let length = |(a, b): &(TruePoint, TruePoint)| (a.truth - b.truth).norm();
    let pairs = points
        .iter()
        .flat_map(|a| points.iter().map(move |b| (*a, *b)));
    let (a, c) = pairs
        .max_by(|p, q| length(p).total_cmp(&length(q)))
        .unwrap();
    let along = c.truth - a.truth;
    let side = |p: &TruePoint| {
        let off = p.truth - a.truth;
        along.x * off.z - along.z * off.x
    };
    let b = points.iter().min_by(|p, q| side(p).total_cmp(&side(q)));
    let d = points.iter().max_by(|p, q| side(p).total_cmp(&side(q)));
    [a, *b.unwrap(), c, *d.unwrap()]
}

/// Adds a known length: the true one times a factor.
pub(crate) fn length(project: &mut Project, a: &TruePoint, b: &TruePoint, factor: f64) {
    project.update(Event::Measure(Measure {
        ends: [a.anchor, b.anchor],
        length_m: Some(factor * (a.truth - b.truth).norm()),
    }));
}

/// A figure of points.
pub(crate) fn shape(kind: ShapeKind, points: &[TruePoint]) -> Shape {
    Shape {
        kind,
        points: points.iter().map(|point| point.anchor).collect(),
    }
}

/// Makes points control points with their true coordinates, named T0, T1 and so on.
pub(crate) fn control(points: &[TruePoint], project: &mut Project) {
    for (index, point) in points.iter().enumerate() {
        project.update(Event::AddControl(ControlPoint {
            point: point.anchor,
            name: format!("P{}", index + 1),
            position_m: None,
        }));
        let position = point.truth.coords.into();
        project.update(Event::ChangeControl(
            index,
            format!("T{index}"),
            Some(position),
        ));
    }
}
