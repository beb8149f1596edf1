//! Picture of the model with its measures for the report.

use super::contents::Export;
use super::frame::file_from_world;
use epipole::camera::PosedCamera;
use epipole::sfm::Reconstruction;
use epipole_canvas::cloud::{Frame, Line, Look, Orbit, Scene};
use image::RgbImage;
use nalgebra::{Point3, Vector3};

/// Width and height, pixels.
const SIZE: (usize, usize) = (1200, 900);
/// Maximum number of dense points.
const MAX_DENSE: usize = 1_000_000;
/// Angle to the mean viewing direction of the cameras.
const ASIDE_RAD: f64 = 0.35;
/// Color of the measures.
const COLOR: [u8; 3] = [204, 62, 29];

fn plain(place: &Point3<f64>) -> [f32; 3] {
    [place.x as f32, place.y as f32, place.z as f32]
}

/// Draws the points, dense ones if available, and the measures; `None` without points.
///
/// * `model`: in the frame of the files
pub(super) fn picture(export: &Export, model: &Reconstruction) -> Option<RgbImage> {
    let mut scene = Scene::default();
    let points = model.points.iter();
    (scene.points).extend(points.map(|point| (plain(&point.position), point.color)));
    if scene.points.is_empty() {
        return None;
    }
    let axis = |axis: Vector3<f64>| {
        let ahead = |camera: &PosedCamera| camera.cam_from_world.rotation.inverse() * axis;
        (model.cameras.iter().flatten().map(ahead)).sum::<Vector3<f64>>()
    };
    let down = match export.floor {
        Some(_) => -Vector3::z(),
        None => axis(Vector3::y()),
    };
    // The sparse points alone determine the view, as they have fewer outliers.
    let mut orbit = Orbit::around(&scene, down.into());
    orbit.look_along(axis(Vector3::z()).into());
    orbit.rotate(ASIDE_RAD, 0.0);
    orbit.fit(&nearest(&scene, &orbit));
    let frame = file_from_world(export);
    if let Some(cloud) = &export.all_views {
        let every = cloud.len().div_ceil(MAX_DENSE).max(1);
        let dense = cloud.points(every);
        (scene.points).extend(dense.map(|point| {
            let place = frame * Point3::from(point.position);
            (plain(&place), point.color)
        }));
    }
    scene.first_vertex = scene.points.len();
    let measures = &export.measures;
    let lengths = measures
        .lengths
        .iter()
        .map(|length| (&length.ends[..], false));
    let shapes = (measures.shapes.iter()).map(|shape| (&shape.points[..], shape.kind != "angle"));
    for (points, is_closed) in lengths.chain(shapes) {
        let places = points
            .iter()
            .map(|point| plain(&(frame * Point3::from(*point))));
        let places: Vec<_> = places.collect();
        let next = places.iter().cycle().skip(1);
        let count = places.len().saturating_sub(usize::from(!is_closed));
        let side = |(from, to): (&[f32; 3], &[f32; 3])| Line {
            from: *from,
            to: *to,
            color: COLOR,
        };
        scene
            .lines
            .extend(places.iter().zip(next).take(count).map(side));
    }
    let look = Look {
        point_px: 3.0,
        ..Look::default()
    };
    let mut frame = Frame::default();
    frame.draw(&scene, &orbit, SIZE, &look);
    let rgb = frame.rgba().chunks_exact(4).flat_map(|pixel| &pixel[..3]);
    RgbImage::from_raw(SIZE.0 as u32, SIZE.1 as u32, rgb.copied().collect())
}

/// Returns the points except for the tenth that is farthest from the middle.
fn nearest(scene: &Scene, orbit: &Orbit) -> Vec<[f64; 3]> {
    let places = scene.points.iter().map(|(place, _)| place.map(f64::from));
    let away = |place: &[f64; 3]| (Point3::from(*place) - orbit.middle).norm_squared();
    let mut places: Vec<_> = places.filter(|place| away(place).is_finite()).collect();
    places.sort_by(|a, b| away(a).total_cmp(&away(b)));
    places.truncate((places.len() * 9 / 10).max(1));
    places
}
