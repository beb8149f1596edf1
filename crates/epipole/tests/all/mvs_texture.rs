//! Textures of meshes whose colors are known.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use epipole::image::{Rgb, RgbImage};
use epipole::mvs::{Mesh, MeshTexture, MvsView, TextureOptions, texture_mesh};
use epipole::stereo::PointCloud;
use nalgebra::{Point2, Point3, Vector2, Vector3};
use std::ops::ControlFlow;

const SIDE: u32 = 200;

/// Color of a point on the wall z = 0: smooth waves.
fn wall_color(x: f64, y: f64) -> Vector3<f64> {
    let wave = |a: f64, b: f64| 128.0 + 50.0 * libm::sin(a * x + b * y);
    Vector3::new(wave(9.0, 2.0), wave(-3.0, 7.0), wave(4.0, 5.0))
}

/// A square grid of triangles on z = `z` within ±`half`, which faces −z.
fn wall(half: f64, z: f64, cells: u32) -> Mesh {
    let side = cells + 1;
    let place = |n: u32| half * (2.0 * f64::from(n) / f64::from(cells) - 1.0);
    let points = (0..side * side).map(|n| Point3::new(place(n % side), place(n / side), z));
    let mut triangles = Vec::new();
    for row in 0..cells {
        for column in 0..cells {
            let a = row * side + column;
            // As seen from −z with y down: clockwise around +z.
            triangles.push([a, a + side, a + 1]);
            triangles.push([a + 1, a + side, a + side + 1]);
        }
    }
    Mesh {
        vertices: PointCloud {
            points: points.collect(),
            ..PointCloud::default()
        },
        triangles,
    }
}

/// A photo from −z, of the colors of `shade` along each ray, times a gain.
fn view(
    eye: Point3<f64>,
    gain: f64,
    shade: impl Fn(&Point3<f64>, &Vector3<f64>) -> Vector3<f64>,
) -> MvsView {
    let camera = PosedCamera {
        camera: Camera::pinhole(Intrinsics::centered(220.0, SIDE, SIDE).unwrap(), SIDE, SIDE),
        cam_from_world: look_at(&eye, &Point3::origin(), &Vector3::new(0.0, -1.0, 0.0)).unwrap(),
    };
    let image = RgbImage::from_fn(SIDE, SIDE, |u, v| {
        let ray = camera.ray_in_world(&Point2::new(f64::from(u), f64::from(v)));
        let color = shade(&eye, &ray) * gain;
        Rgb([0, 1, 2].map(|channel| color[channel].round().clamp(0.0, 255.0) as u8))
    });
    MvsView {
        photo: 0,
        camera,
        image,
        neighbors: vec![0],
        depth_range: [1.0, 9.0],
    }
}

fn of_wall(eye: &Point3<f64>, ray: &Vector3<f64>) -> Vector3<f64> {
    let place = eye + ray * (-eye.z / ray.z);
    wall_color(place.x, place.y)
}

fn texture(mesh: &Mesh, views: &[MvsView]) -> MeshTexture {
    texture_mesh(mesh, views, &TextureOptions::default(), &mut ()).unwrap()
}

/// Color of the texture at barycentric weights of a triangle.
fn color(texture: &MeshTexture, triangle: usize, weights: [f32; 3]) -> Vector3<f64> {
    let corners = &texture.corners[triangle];
    let place = (0..3).fold(Vector2::zeros(), |sum, n| {
        sum + corners[n].coords * weights[n]
    });
    let (left, top) = (place.x.floor(), place.y.floor());
    let (du, dv) = (f64::from(place.x - left), f64::from(place.y - top));
    let at = |du: u32, dv: u32| {
        let pixel = texture.image.get_pixel(left as u32 + du, top as u32 + dv);
        Vector3::from(pixel.0.map(f64::from))
    };
    (at(0, 0) * (1.0 - du) + at(1, 0) * du) * (1.0 - dv)
        + (at(0, 1) * (1.0 - du) + at(1, 1) * du) * dv
}

/// Largest difference between the texture and the wall's colors times a gain.
fn error(mesh: &Mesh, texture: &MeshTexture, gain: f64) -> f64 {
    let mut largest: f64 = 0.0;
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        for weights in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.2, 0.3, 0.5]] {
            let place = (0..3).fold(Vector3::zeros(), |sum, n| {
                sum + mesh.vertices.points[triangle[n] as usize].coords * f64::from(weights[n])
            });
            let truth = wall_color(place.x, place.y) * gain;
            largest = largest.max((color(texture, index, weights) - truth).amax());
        }
    }
    largest
}

fn eyes() -> [Point3<f64>; 3] {
    [(-0.9, 0.1), (0.05, -0.1), (0.9, 0.0)].map(|(x, y)| Point3::new(x, y, -2.0))
}

#[test]
fn the_texture_has_the_colors_of_the_surface() {
    let mesh = wall(0.7, 0.0, 24);
    let views: Vec<MvsView> = eyes().map(|eye| view(eye, 1.0, of_wall)).into();
    let found = texture(&mesh, &views);
    let largest = error(&mesh, &found, 1.0);
    // Interpolation of waves of some 70 pixels, and rounding.
    assert!(largest < 3.0, "{largest}");

    let small = TextureOptions::default().with_max_size_px(100);
    let small = texture_mesh(&mesh, &views, &small, &mut ()).unwrap();
    assert!(small.image.width() <= 100 && small.image.height() <= 100);
    let largest = error(&mesh, &small, 1.0);
    assert!(largest < 14.0, "{largest}");
}

#[test]
fn photos_of_other_exposure_agree_along_seams() {
    let mesh = wall(0.7, 0.0, 24);
    let gains = [0.85, 1.0, 1.15];
    let views: Vec<MvsView> = (eyes().iter().zip(gains))
        .map(|(eye, gain)| view(*eye, gain, of_wall))
        .collect();
    let found = texture(&mesh, &views);
    // Colors on both sides of each edge, where it is in two pieces.
    let (mut largest, mut num_seams) = (0.0_f64, 0);
    for (first, a) in mesh.triangles.iter().enumerate() {
        for (second, b) in mesh.triangles.iter().enumerate().skip(first + 1) {
            let shared: Vec<u32> = a.iter().copied().filter(|v| b.contains(v)).collect();
            if shared.len() < 2 {
                continue;
            }
            let weights =
                |triangle: &[u32; 3]| triangle.map(|v| if shared.contains(&v) { 0.5 } else { 0.0 });
            let corner = |triangle: usize, list: &[u32; 3], vertex: u32| {
                let place = list.iter().position(|v| *v == vertex).unwrap();
                found.corners[triangle][place]
            };
            if corner(first, a, shared[0]) == corner(second, b, shared[0]) {
                continue;
            }
            let difference = color(&found, first, weights(a)) - color(&found, second, weights(b));
            largest = largest.max(difference.amax());
            num_seams += 1;
        }
    }
    assert!(num_seams >= 24, "{num_seams}");
    // 15% of 128 before.
    assert!(largest < 4.0, "{largest}");
}

#[test]
fn hidden_surfaces_take_no_color_of_those_before_them() {
    // A red square in front of the middle of the wall.
    let mut mesh = wall(0.9, 0.0, 36);
    let back = mesh.triangles.len();
    let front = wall(0.25, -0.5, 10);
    let offset = mesh.vertices.points.len() as u32;
    mesh.vertices.points.extend(front.vertices.points);
    let moved = front
        .triangles
        .iter()
        .map(|triangle| triangle.map(|v| v + offset));
    mesh.triangles.extend(moved);
    let red = Vector3::new(250.0, 5.0, 5.0);
    let blue = Vector3::new(10.0, 20.0, 200.0);
    let shade = |eye: &Point3<f64>, ray: &Vector3<f64>| {
        let place = eye + ray * ((-0.5 - eye.z) / ray.z);
        match place.x.abs() <= 0.25 && place.y.abs() <= 0.25 {
            true => red,
            false => blue,
        }
    };
    let views: Vec<MvsView> = eyes().map(|eye| view(eye, 1.0, shade)).into();
    let found = texture(&mesh, &views);
    let is_red = |triangle: usize| color(&found, triangle, [0.4, 0.3, 0.3]).x > 128.0;
    let wrong = (0..back).filter(|&triangle| is_red(triangle)).count();
    // Pixels at the outline mix both colors.
    assert!(wrong * 50 < back, "{wrong} of {back}");
    let right = (back..mesh.triangles.len())
        .filter(|&triangle| is_red(triangle))
        .count();
    assert!(right * 10 >= 9 * (mesh.triangles.len() - back), "{right}");

    // One photo alone: its shadow is filled from the neighborhood, without a panic.
    let single = texture(&mesh, &views[..1]);
    assert_eq!(single.corners.len(), mesh.triangles.len());
    let (width, height) = single.image.dimensions();
    for corner in single.corners.iter().flatten() {
        assert!(
            corner.x >= 2.0 && corner.x <= width as f32 - 3.0,
            "{corner}"
        );
        assert!(
            corner.y >= 2.0 && corner.y <= height as f32 - 3.0,
            "{corner}"
        );
    }
}

#[test]
fn a_mesh_that_no_photo_shows_has_one_color() {
    let mut mesh = wall(0.5, -9.0, 4);
    mesh.vertices.colors = vec![[10, 20, 30]; mesh.vertices.points.len()];
    let views = [view(eyes()[1], 1.0, of_wall)];
    let found = texture(&mesh, &views);
    assert_eq!(
        color(&found, 7, [0.2, 0.4, 0.4]),
        Vector3::new(10.0, 20.0, 30.0)
    );
}

#[test]
fn bad_input_is_refused() {
    let views = [view(eyes()[0], 1.0, of_wall)];
    let options = TextureOptions::default();
    let run = |mesh: &Mesh, views: &[MvsView], options: &TextureOptions| {
        texture_mesh(mesh, views, options, &mut ())
            .unwrap_err()
            .to_string()
    };
    let mesh = wall(0.5, 0.0, 4);
    assert!(
        run(&mesh, &[], &options).contains("needs at least 1"),
        "{}",
        run(&mesh, &[], &options)
    );
    assert!(run(&Mesh::default(), &views, &options).contains("texture of triangles"));
    let mut wrong = mesh.clone();
    wrong.triangles[3][1] = 99;
    assert!(run(&wrong, &views, &options).contains("index of a vertex"));
    assert!(run(&mesh, &views, &options.clone().with_max_size_px(1)).contains("size of a texture"));
    let mut infinite = mesh.clone();
    infinite.vertices.points[0] = Point3::new(f64::NAN, f64::INFINITY, 0.0);
    assert!(texture_mesh(&infinite, &views, &options, &mut ()).is_ok());
    let mut cancel = |_| ControlFlow::Break(());
    let canceled = texture_mesh(&mesh, &views, &options, &mut cancel);
    assert_eq!(canceled.unwrap_err(), Error::Canceled);
}
