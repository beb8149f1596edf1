//! Meshes of exact depth maps of a ball.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use epipole::image::{DynamicImage, Rgb, RgbImage};
use epipole::mvs::{DepthMap, Mesh, MeshOptions, MvsView, mesh_depth_maps};
use nalgebra::{Point2, Point3, Vector3};
use std::collections::HashMap;
use std::ops::ControlFlow;

const SIDE: u32 = 160;
/// The volume below takes it as 1.
const RADIUS: f64 = 1.0;
const VOXEL_SIZE: f64 = 0.05;

/// Cameras at the corners of a cube and in the middles of its sides, which see all of the ball.
fn eyes() -> Vec<Point3<f64>> {
    let axes = (0..27).map(|n| Vector3::new(n % 3, n / 3 % 3, n / 9));
    let directions = axes.map(|axis| axis.map(|place| f64::from(place) - 1.0));
    let directions = directions.filter(|d| [1.0, 3.0].contains(&d.norm_squared()));
    directions
        .map(|d| Point3::from(d.normalize() * 4.0))
        .collect()
}

/// The ball as a camera sees it, red where x is positive and blue elsewhere.
fn view(n: usize, eye: Point3<f64>, count: usize) -> (MvsView, DepthMap) {
    let up = Vector3::new(0.3, 0.5, 0.8);
    let camera = PosedCamera {
        camera: Camera::pinhole(Intrinsics::centered(250.0, SIDE, SIDE).unwrap(), SIDE, SIDE),
        cam_from_world: look_at(&eye, &Point3::origin(), &up).unwrap(),
    };
    let mut map = DepthMap {
        depth: epipole::image::ImageBuffer::from_pixel(
            SIDE,
            SIDE,
            epipole::image::Luma([f32::NAN]),
        ),
        normals: vec![Vector3::zeros(); (SIDE * SIDE) as usize],
        num_views: vec![0; (SIDE * SIDE) as usize],
    };
    let mut image = RgbImage::new(SIDE, SIDE);
    let middle = camera.cam_from_world * Point3::origin();
    for (u, v, pixel) in image.enumerate_pixels_mut() {
        let place = Point2::new(f64::from(u), f64::from(v));
        let ray = camera.camera.intrinsics.ray(&place);
        // |t ray − middle|² = r².
        let (a, b) = (ray.norm_squared(), ray.dot(&middle.coords));
        let discriminant = b * b - a * (middle.coords.norm_squared() - RADIUS * RADIUS);
        if discriminant < 0.0 {
            continue;
        }
        let depth = (b - discriminant.sqrt()) / a;
        let point = Point3::from(ray * depth);
        let index = (v * SIDE + u) as usize;
        map.depth
            .put_pixel(u, v, epipole::image::Luma([depth as f32]));
        map.normals[index] = ((point - middle) / RADIUS).cast();
        map.num_views[index] = 3;
        let world = camera.cam_from_world.inverse_transform_point(&point);
        *pixel = if world.x > 0.0 {
            Rgb([255, 0, 0])
        } else {
            Rgb([0, 0, 255])
        };
    }
    let view = MvsView {
        photo: n,
        camera,
        image,
        neighbors: vec![(n + 1) % count],
        depth_range: [1.0, 6.0],
    };
    (view, map)
}

fn ball(eyes: &[Point3<f64>]) -> (Vec<MvsView>, Vec<DepthMap>) {
    let eyes_of = eyes.iter().enumerate();
    eyes_of.map(|(n, eye)| view(n, *eye, eyes.len())).unzip()
}

fn options() -> MeshOptions {
    MeshOptions::default().with_voxel_size(Some(VOXEL_SIZE))
}

/// Number of triangles of each directed edge.
fn edges(mesh: &Mesh) -> HashMap<[u32; 2], usize> {
    let mut edges = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for edge in [[*a, *b], [*b, *c], [*c, *a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

#[test]
fn a_ball_observed_from_all_sides_is_closed_and_round() {
    let (views, maps) = ball(&eyes());
    let mesh = mesh_depth_maps(&views, &maps, &options(), &mut ()).unwrap();
    let points = &mesh.vertices.points;
    // Each edge has a triangle on either side, and the surface has no handle.
    let edges = edges(&mesh);
    assert!(
        edges
            .iter()
            .all(|([a, b], count)| *count == 1 && edges.contains_key(&[*b, *a]))
    );
    let euler = points.len() as i64 - edges.len() as i64 / 2 + mesh.triangles.len() as i64;
    assert_eq!(euler, 2);
    let errors = points
        .iter()
        .map(|point| (point.coords.norm() - RADIUS).abs() / VOXEL_SIZE);
    let errors: Vec<f64> = errors.collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let largest = errors.iter().copied().fold(0.0, f64::max);
    println!("{mean:.3} voxels from the ball in the mean, at most {largest:.3}");
    assert!(mean < 0.1 && largest < 0.3, "{mean}, {largest}");
    for (point, normal) in points.iter().zip(&mesh.vertices.normals) {
        let cosine = normal.dot(&point.coords.normalize());
        assert!(cosine > 0.98, "{cosine} at {point}");
    }
    let volume = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| points[vertex as usize].coords);
        a.dot(&b.cross(&c)) / 6.0
    });
    let ratio = volume.sum::<f64>() / (4.0 / 3.0 * std::f64::consts::PI);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    for (point, [red, _, blue]) in points.iter().zip(&mesh.vertices.colors) {
        if point.x.abs() > 3.0 * VOXEL_SIZE {
            assert_eq!(red > blue, point.x > 0.0, "{point}");
        }
    }
}

#[test]
fn unseen_sides_are_open_and_small_pieces_left_out() {
    let (views, mut maps) = ball(&eyes()[..2]);
    let open = mesh_depth_maps(&views, &maps, &options(), &mut ()).unwrap();
    let edges_of_open = edges(&open);
    assert!(
        edges_of_open
            .keys()
            .any(|[a, b]| !edges_of_open.contains_key(&[*b, *a]))
    );
    assert!(
        open.vertices
            .points
            .iter()
            .all(|point| (point.coords.norm() - RADIUS).abs() < VOXEL_SIZE)
    );
    // A few pixels in front of it.
    for v in 0..16 {
        for u in 0..16 {
            let pixel = (v * SIDE + u) as usize;
            maps[0].depth.put_pixel(u, v, epipole::image::Luma([2.0]));
            maps[0].normals[pixel] = -Vector3::z();
            maps[0].num_views[pixel] = 3;
        }
    }
    let all = options().with_voxel_size(Some(0.02)).with_min_triangles(1);
    let all = mesh_depth_maps(&views, &maps, &all, &mut ()).unwrap();
    let fine = options().with_voxel_size(Some(0.02));
    let fine = mesh_depth_maps(&views, &maps, &fine, &mut ()).unwrap();
    let is_far = |mesh: &Mesh| {
        let mut points = mesh.vertices.points.iter();
        points.any(|point| point.coords.norm() > 1.5 * RADIUS)
    };
    assert!(is_far(&all) && !is_far(&fine));
}

#[test]
fn meshes_are_reproducible_and_can_be_canceled() {
    let (views, maps) = ball(&eyes()[..3]);
    let options = MeshOptions::default();
    let mut fractions = Vec::new();
    let mut watch = |status: epipole::progress::Status| {
        fractions.push(status.fraction);
        ControlFlow::Continue(())
    };
    let once = mesh_depth_maps(&views, &maps, &options, &mut watch).unwrap();
    assert!(fractions.is_sorted() && fractions.len() > 10);
    assert_eq!(
        once,
        mesh_depth_maps(&views, &maps, &options, &mut ()).unwrap()
    );
    let canceled = mesh_depth_maps(&views, &maps, &options, &mut |_| ControlFlow::Break(()));
    assert_eq!(canceled, Err(Error::Canceled));
}

#[test]
fn input_without_a_surface_is_refused() {
    let (views, maps) = ball(&eyes()[..2]);
    let refused = |views: &[MvsView], maps: &[DepthMap], options: &MeshOptions| {
        mesh_depth_maps(views, maps, options, &mut ())
            .unwrap_err()
            .to_string()
    };
    let tiny = options().with_voxel_size(Some(1e-4));
    let message = refused(&views, &maps, &tiny);
    assert!(
        message.contains("at least a quarter of a pixel"),
        "{message}"
    );
    assert!(refused(&views, &maps[1..], &options()).contains("same size"));
    assert!(
        refused(&views, &maps, &options().with_voxel_size(Some(0.0))).contains("greater than 0")
    );
    let mut empty = maps.clone();
    for map in &mut empty {
        map.depth = DynamicImage::new_luma8(SIDE, SIDE).to_luma32f();
        map.depth.fill(f32::NAN);
    }
    assert!(refused(&views, &empty, &options()).contains("there are none"));
}
