//! The 3D view: cameras with their photographs, the still life as a cloud, and the plane.

use super::style::{LINE, LIT, lines, stroke};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Model, Panel};
use crate::gallery::epipolar_plane::model::{EpipolarPlane, Lit, SUBJECT};
use crate::gallery::epipolar_plane::scenery::{Plane, Scenery};
use crate::kit::pair::CAMERAS;
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture, still_life};
use crate::kit::space::{Space, draw_handles};
use crate::theme::{Rgb, Role};
use epipole::camera::{PosedCamera, look_at};
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use epipole_scenes::{Sampling, still_life_camera};
use image::RgbImage;
use nalgebra::{Point2, Point3, Vector3};

/// Distance of the photographs from the camera centers, meters.
const PICTURE_M: f64 = 0.58;
/// Extent of the plane's sheet from the baseline, and beyond its ends, meters.
const SHEET_M: f64 = 1.75;
const BEYOND_M: f64 = 0.12;
/// Maximum length of the line from a center toward its epipole, meters.
const TOWARDS_M: f64 = 3.0;
/// Columns and rows of the render whose pixels become the cloud of the still life.
const CLOUD: (u32, u32) = (84, 63);
/// Eye, target and up vector of that render, meters.
const CLOUD_SEEN: [[f64; 3]; 3] = [[0.0, -0.95, -1.1], [0.03, -0.12, 0.0], [0.0, -1.0, 0.0]];
/// Maximum z of the cloud, meters, which excludes the walls.
const CLOUD_END_Z_M: f64 = 0.62;

/// Returns the still life as colored points, seen from above to avoid occlusions.
pub(super) fn cloud() -> Vec<(Point3<f64>, Rgb)> {
    let [eye, target, up] = CLOUD_SEEN.map(Vector3::from);
    let Ok(cam_from_world) = look_at(&eye.into(), &target.into(), &up) else {
        return Vec::new();
    };
    let camera = PosedCamera {
        cam_from_world,
        ..still_life_camera(CLOUD.0, CLOUD.1)
    };
    let Ok(photograph) = still_life().render(&camera, CLOUD.0, CLOUD.1, Sampling::Draft) else {
        return Vec::new();
    };
    let center = camera.center_in_world();
    let pixels = photograph
        .image
        .enumerate_pixels()
        .zip(photograph.depth_m.pixels());
    let points = pixels.map(|((u, v, color), depth)| {
        let ray = camera.ray_in_world(&Point2::new(f64::from(u), f64::from(v)));
        (center + ray * f64::from(depth.0[0]), color.0)
    });
    points
        .filter(|(point, _)| point.z < CLOUD_END_Z_M)
        .collect()
}

pub(super) fn draw_space(
    model: &EpipolarPlane,
    scenery: &Scenery,
    cloud: &[(Point3<f64>, Rgb)],
    pictures: [&RgbImage; 2],
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let Some(mut space) = Space::new(panel, &model.orbit, &SUBJECT) else {
        return;
    };
    let lit = model.lit();
    space.ground(&SUBJECT.middle, 0.0, 0.25, 6);
    space.stand(scenery.cameras.iter().zip(pictures), PICTURE_M);
    for (point, color) in cloud {
        space.dot(point, 2.4, *color);
    }
    let [one, two] = scenery.cameras.map(|camera| camera.center_in_world());
    if let Some(plane) = scenery.plane.as_ref().filter(|_| lit != Lit::Point) {
        draw_plane(&mut space, scenery, plane, lit == Lit::Plane);
    }
    space.line(&one, &two, stroke(lit == Lit::Baseline));
    for (index, camera) in scenery.cameras.iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        space.frustum(camera, PHOTO_SIZE, PICTURE_M, role, shape);
        let center = camera.center_in_world();
        space.label(&center, ["O", "O′"][index], role);
        if let Some(pixel) = scenery.pixels[index].filter(in_picture) {
            let image = space.on_picture(camera, &pixel, PICTURE_M);
            let is_lit = lit == Lit::Point;
            space.line(
                &center,
                &scenery.point,
                Stroke::solid(role, if is_lit { 2.5 } else { 1.5 }),
            );
            space.marker(&image, if is_lit { 5.5 } else { 4.0 }, shape, role);
            space.label(&image, ["p", "p′"][index], Role::Ink);
        }
        if let Some([from, to]) = lines(scenery, lit)[index].and_then(|line| across(&line)) {
            let ends = [from, to].map(|pixel| space.on_picture(camera, &pixel, PICTURE_M));
            let is_lit = matches!(lit, Lit::Line | Lit::Plane);
            space.line(
                &ends[0],
                &ends[1],
                Stroke::solid(LINE, if is_lit { 3.0 } else { 1.5 }),
            );
        }
    }
    if lit == Lit::Epipole {
        draw_epipoles(&mut space, scenery);
    }
    // The whole ray of p, on which P lies.
    let ray = scenery.point - one;
    if ray.norm() > 1e-9 {
        let far = one + ray.normalize() * (SHEET_M + 0.4);
        space.line(&one, &far, Stroke::solid(CAMERAS[0].0, 1.25).dotted());
    }
    if let Some(surface) = scenery
        .surface
        .filter(|_| scenery.before_surface_m() != Some(0.0))
    {
        space.marker(&surface.point, 5.0, Shape::Ring, Role::Ink);
    }
    space.label(&scenery.point, "P", LIT);
    space.draw(canvas, panel);
    draw_handles(canvas, panel, &model.orbit);
    let handles = model.handles();
    let things = handles
        .iter()
        .filter(|handle| handle.panel == panel.id)
        .skip(2);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        for handle in things {
            canvas.grip(panel.canvas_from_world((handle.x, handle.y)), Role::Grip);
        }
    });
}

/// Draws the plane as a sheet attached to the baseline, with the triangle of both centers and P.
fn draw_plane(space: &mut Space<'_>, scenery: &Scenery, plane: &Plane, is_lit: bool) {
    let [one, two] = scenery.cameras.map(|camera| camera.center_in_world());
    let (back, on) = (plane.along * -BEYOND_M, plane.along * BEYOND_M);
    let out = plane.towards * SHEET_M;
    let sheet = [one + back, two + on, two + on + out, one + back + out];
    let (role, opacity) = if is_lit {
        (LIT, 0.2)
    } else {
        (Role::Muted, 0.12)
    };
    space.face(&sheet, role, opacity);
    space.face(&[one, two, scenery.point], role, opacity);
    for index in 0..4 {
        let edge = Stroke::solid(role, if is_lit { 1.5 } else { 1.0 });
        space.line(&sheet[index], &sheet[(index + 1) % 4], edge);
    }
}

/// Draws the line from each center to its epipole in the picture's plane, if that is near.
fn draw_epipoles(space: &mut Space<'_>, scenery: &Scenery) {
    let Some(geometry) = &scenery.geometry else {
        return;
    };
    let epipoles = [geometry.epipole1, geometry.epipole2];
    for (index, camera) in scenery.cameras.iter().enumerate() {
        let Epipole::Finite(pixel) = epipoles[index] else {
            continue;
        };
        let center = camera.center_in_world();
        let towards = camera.ray_in_world(&pixel) * PICTURE_M;
        let reach = towards.norm();
        let end = center + towards * (TOWARDS_M / reach).min(1.0);
        space.line(&center, &end, Stroke::solid(LIT, 2.0).dashed());
        if reach <= TOWARDS_M {
            space.marker(&end, 5.5, Shape::Ring, LIT);
            space.label(&end, ["e", "e′"][index], LIT);
        }
    }
}

/// Returns the pixels at which a line enters and leaves the photograph.
fn across(line: &Line2) -> Option<[Point2<f64>; 2]> {
    let (right, bottom) = (f64::from(PHOTO_WIDTH) - 0.5, f64::from(PHOTO_HEIGHT) - 0.5);
    let at_u = |u: f64| Point2::new(u, -(line.a * u + line.c) / line.b);
    let at_v = |v: f64| Point2::new(-(line.b * v + line.c) / line.a, v);
    let inside = |pixel: &Point2<f64>| {
        let slack = 1e-6;
        (-0.5 - slack..=right + slack).contains(&pixel.x)
            && (-0.5 - slack..=bottom + slack).contains(&pixel.y)
    };
    let border = [at_u(-0.5), at_u(right), at_v(-0.5), at_v(bottom)];
    let mut found = border.into_iter().filter(inside);
    let first = found.next()?;
    let far = |other: &Point2<f64>| (other - first).norm();
    let other = found.max_by(|a, b| far(a).total_cmp(&far(b)))?;
    Some([first, other])
}
