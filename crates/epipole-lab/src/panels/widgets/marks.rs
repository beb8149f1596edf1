//! Additions to the points: cameras, viewing rays and observations of a point, dense points.

use super::shade::Shade;
use crate::project::{Anchor, DensePixel, Key, Project};
use crate::tasks::{CameraFound, Component, Dense, DenseCloud, FeaturesOf, Thumbnail};
use epipole_canvas::cloud::{Line, Picture, Scene};
use std::sync::Arc;

/// Draws the edges of a camera's frustum up to a distance.
pub(crate) fn frustum(
    lines: &mut Vec<Line>,
    camera: &CameraFound,
    (width, height): (u32, u32),
    reach: f64,
    color: [u8; 3],
) {
    let center = camera.center();
    let (right, bottom) = (f64::from(width) - 0.5, f64::from(height) - 0.5);
    let corners = [[-0.5, -0.5], [right, -0.5], [right, bottom], [-0.5, bottom]];
    let corner = |pixel| plain(&(center + camera.ray(pixel) * reach));
    let corners = corners.map(corner);
    for n in 0..4 {
        let to = corners[n];
        lines.push(Line {
            from: plain(&center),
            to,
            color,
        });
        lines.push(Line {
            from: corners[(n + 1) % 4],
            to,
            color,
        });
    }
}

/// Places a photograph at the far end of its camera's frustum.
pub(crate) fn standing(
    camera: &CameraFound,
    (width, height): (u32, u32),
    reach: f64,
    small: &Thumbnail,
) -> Picture {
    let place = |pixel| camera.center() + camera.ray(pixel) * reach;
    let corner = place([-0.5, -0.5]);
    let side = |pixel| (place(pixel) - corner).map(|x| x as f32).into();
    Picture {
        corner: plain(&corner),
        right: side([f64::from(width) - 0.5, -0.5]),
        down: side([-0.5, f64::from(height) - 0.5]),
        size: (small.width as usize, small.height as usize),
        rgb: Arc::clone(&small.rgb.0),
    }
}

fn plain(place: &nalgebra::Point3<f64>) -> [f32; 3] {
    [place.x as f32, place.y as f32, place.z as f32]
}

/// Draws lines from a point to all cameras that see it.
pub(crate) fn rays(lines: &mut Vec<Line>, component: &Component, point: usize, color: [u8; 3]) {
    let Some(point) = component.points.get(point) else {
        return;
    };
    for (image, _) in &point.track {
        if let Some(Some(camera)) = component.cameras.get(*image as usize) {
            lines.push(Line {
                from: plain(&camera.center()),
                to: point.position.map(|x| x as f32),
                color,
            });
        }
    }
}

/// Returns the observations of a point: photograph, keypoint, and reprojection error in pixels.
pub(crate) fn observations(project: &Project, point: usize) -> Vec<(String, [f64; 2], f64)> {
    let (Some(component), photos) = (project.component(), project.taking_part()) else {
        return Vec::new();
    };
    let Some(point) = component.points.get(point) else {
        return Vec::new();
    };
    let sight = |&(image, keypoint): &(u32, u32)| {
        let photo = photos.get(image as usize)?;
        let features = project.get(FeaturesOf(photo.id))?;
        let seen = features.list.get(keypoint as usize)?;
        let camera = component.cameras.get(image as usize)?.as_ref()?;
        let [u, v] = camera.project(point.position, &component.lens)?;
        let error_px = libm::hypot(u - seen.u, v - seen.v);
        Some((photo.name.clone(), [seen.u, seen.v], error_px))
    };
    point.track.iter().filter_map(sight).collect()
}

/// Maximum number of points shown from the depth of all views, and the same from that of all pairs.
const MAX_DENSE: usize = 1_000_000;

/// Whether dense points are shown.
pub(crate) fn has_dense(project: &Project) -> bool {
    !dense_keys(project).is_empty()
}

/// Returns the keys of the shown depth.
pub(super) fn dense_keys(project: &Project) -> Vec<Key> {
    let pairs = project.dense_pairs().into_iter().map(|(key, ..)| key);
    let all_views = project.all_views().map(|(key, _)| key);
    all_views.into_iter().chain(pairs).collect()
}

/// Whether the surface of all views is shown: it is selected and has triangles.
pub(super) fn shows_surface(project: &Project, is_wanted: bool) -> bool {
    let cloud = project.all_views().filter(|_| is_wanted);
    cloud.is_some_and(|(_, cloud)| !cloud.triangles.is_empty())
}

/// Returns the cloud of all views, its key, and the stride of its shown points.
fn shown_cloud(project: &Project) -> Option<(Key, &DenseCloud, usize)> {
    let (key, cloud) = project.all_views()?;
    Some((key, cloud, cloud.len().div_ceil(MAX_DENSE).max(1)))
}

/// Returns the number of pixels of pairs with dense depth, and the stride of shown ones along rows
/// and columns.
fn shown_pixels(project: &Project) -> (f64, u32) {
    let all: f64 = (project.dense_pairs().iter())
        .map(|(.., pair)| f64::from(pair.num_shown) * pair.density)
        .sum();
    let every = libm::ceil(libm::sqrt(all / MAX_DENSE as f64)).max(1.0);
    (all, every as u32)
}

/// Returns the anchor of a vertex of the surface.
pub(crate) fn vertex_anchor(project: &Project, vertex: usize) -> Option<Anchor> {
    let (key, cloud) = project.all_views()?;
    project.anchor_of_cloud(key, (cloud.len() + vertex) as u32)
}

/// Returns the anchor of a shown dense point, counted from the first one.
///
/// * `as_surface`: whether the surface is selected, not the points of all views
pub(crate) fn dense_anchor(project: &Project, index: usize, as_surface: bool) -> Option<Anchor> {
    let as_surface = shows_surface(project, as_surface);
    let num_fused = match shown_cloud(project).filter(|_| !as_surface) {
        Some((key, cloud, every)) => {
            let num_shown = cloud.len().div_ceil(every);
            if index < num_shown {
                return project.anchor_of_cloud(key, (index * every) as u32);
            }
            num_shown
        }
        None => 0,
    };
    let (_, every) = shown_pixels(project);
    let of_pair = |(first, second, pair)| {
        let pixels = Dense::deep_pixels(pair, every);
        pixels.map(move |(at, _)| (first, second, at))
    };
    let pairs = project.dense_pairs().into_iter();
    let mut all = pairs
        .map(|(_, first, second, pair)| (first.id, second.id, pair))
        .flat_map(of_pair);
    let (photo, second, at) = all.nth(index - num_fused)?;
    Some(Anchor {
        photo,
        keypoint: 0,
        pixel: Some(DensePixel { second, at }),
        cloud: None,
    })
}

/// Adds dense points of all views and of pairs after the sparse points. Points that are not kept
/// have no place, so that indices stay.
///
/// * `as_surface`: whether to add the surface of all views in place of their points
pub(super) fn add_dense(scene: &mut Scene, project: &Project, as_surface: bool, shade: &Shade<'_>) {
    let as_surface = shows_surface(project, as_surface);
    let points = &mut scene.points;
    if let Some((key, cloud, every)) = shown_cloud(project).filter(|_| !as_surface) {
        points.reserve_exact(cloud.len() / every + 1);
        let shaded = shade.of_cloud(key);
        let fused = (0..).step_by(every).zip(cloud.points(every));
        points.extend(fused.map(|(index, point)| shaded(index, point.position, point.color)));
    }
    let (all, every) = shown_pixels(project);
    // Reserved at once: growth by doubling would waste up to half of the memory.
    points.reserve_exact((all / f64::from(every * every)) as usize + 1000);
    for (key, .., pair) in project.dense_pairs() {
        let shaded = shade.of_cloud(key);
        let pixels = pair.deep_pixels(every).zip(pair.points(every));
        points.extend(pixels.map(|((at, _), (place, color))| shaded(pair.index(at), place, color)));
    }
    scene.first_vertex = points.len();
    if let Some((key, cloud)) = project.all_views().filter(|_| as_surface) {
        let shaded = shade.of_cloud(key);
        points.reserve_exact(cloud.vertices().len());
        let vertices = (cloud.len() as u32..).zip(cloud.vertices());
        points.extend(vertices.map(|(index, v)| shaded(index, v.position, v.color)));
        let vertices = &points[scene.first_vertex..];
        let is_kept = |vertex: &u32| {
            let vertex = vertices.get(*vertex as usize);
            vertex.is_some_and(|(place, _)| place[0].is_finite())
        };
        let triangles = cloud.triangles();
        scene
            .triangles
            .extend(triangles.filter(|triangle| triangle.iter().all(is_kept)));
    }
}
