//! `epipole stitch`: panoramas of a rendered world with known rotations.

use crate::common::{Folder, command, epipole, fails, json, matrix, numbers, parse, path};
use epipole::camera::Intrinsics;
use image::{Rgb, RgbImage};
use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::Value;

const SIZE: (u32, u32) = (320, 240);
const FOCAL_PX: f64 = 300.0;

/// A number from 0 to 1 for each point of a lattice.
fn noise(x: i32, y: i32, z: i32) -> f64 {
    let mut bits = (x.wrapping_mul(73_856_093)
        ^ y.wrapping_mul(19_349_663)
        ^ z.wrapping_mul(83_492_791)) as u32;
    for _ in 0..3 {
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    }
    f64::from(bits >> 8) / f64::from(1 << 24)
}

/// Smooth noise between the points of the lattice.
fn smooth(x: Vector3<f64>) -> f64 {
    let base = x.map(f64::floor);
    let [a, b, c] = (x - base).map(|t| t * t * (3.0 - 2.0 * t)).into();
    let at =
        |i: i32, j: i32, k: i32| noise(base.x as i32 + i, base.y as i32 + j, base.z as i32 + k);
    let mix = |t: f64, p: f64, q: f64| p + t * (q - p);
    let row = |j, k| mix(a, at(0, j, k), at(1, j, k));
    mix(
        c,
        mix(b, row(0, 0), row(1, 0)),
        mix(b, row(0, 1), row(1, 1)),
    )
}

/// Color of the world in a direction.
fn world(d: &Vector3<f64>) -> [f64; 3] {
    let d = d.normalize();
    let gray = 0.6 * smooth(d * 25.0) + 0.4 * smooth(d * 50.0 + Vector3::repeat(7.0));
    [
        40.0 + 180.0 * gray,
        30.0 + 170.0 * gray,
        60.0 + 120.0 * gray,
    ]
}

fn k() -> Intrinsics {
    Intrinsics::centered(FOCAL_PX, SIZE.0, SIZE.1).unwrap()
}

/// Cameras that turn to the right by 0.35 each, a little up and down.
fn rotations() -> Vec<Matrix3<f64>> {
    let rotation = |yaw: f64, pitch: f64| {
        let [x, y] = [Vector3::x() * pitch, Vector3::y() * -yaw].map(Rotation3::from_scaled_axis);
        (x * y).into_inner()
    };
    vec![
        rotation(0.0, 0.03),
        rotation(0.35, -0.02),
        rotation(0.7, 0.01),
    ]
}

/// A photo of 2 × 2 samples a pixel.
fn photo(
    pixel_from_direction: &Matrix3<f64>,
    gain: f64,
    color: fn(&Vector3<f64>) -> [f64; 3],
) -> RgbImage {
    let inverse = pixel_from_direction.try_inverse().unwrap();
    RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| {
        let mut sum = [0.0; 3];
        for (du, dv) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
            let pixel = Vector3::new(f64::from(u) + du, f64::from(v) + dv, 1.0);
            let color = color(&(inverse * pixel));
            (0..3).for_each(|c| sum[c] += 0.25 * gain * color[c]);
        }
        Rgb(sum.map(|value| value.round().clamp(0.0, 255.0) as u8))
    })
}

fn photos(folder: &Folder) {
    let names = ["left.jpg", "middle.jpg", "right.jpg"];
    for ((rotation, name), gain) in rotations().iter().zip(names).zip([1.0, 0.9, 1.05]) {
        let photo = photo(&(k().matrix() * rotation), gain, world);
        // The content tells the format, not the name.
        photo
            .save_with_format(folder.file(name), image::ImageFormat::Png)
            .unwrap();
    }
}

/// Angle between two turns, radians.
fn apart(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    Rotation3::from_matrix_unchecked(a * b.transpose()).angle()
}

fn assert_rotations(result: &Value) {
    let rows = result["photos"].as_array().unwrap();
    let found: Vec<_> = rows.iter().map(|row| matrix(&row["rotation"])).collect();
    let truth = rotations();
    for n in 1..3 {
        let (found, truth) = (
            found[n] * found[0].transpose(),
            truth[n] * truth[0].transpose(),
        );
        let off = apart(&found, &truth);
        println!("photo {n}: {off:.6} rad off");
        assert!(off < 0.003, "{off}");
    }
}

#[test]
fn the_example_of_the_help_makes_a_panorama_of_the_world() {
    let folder = Folder::new("stitch");
    photos(&folder);
    let help = String::from_utf8(epipole(&["stitch", "--help"]).stdout).unwrap();
    let example = help
        .lines()
        .find_map(|line| line.strip_prefix("Example: epipole "))
        .unwrap();
    let words: Vec<&str> = example.split(' ').chain(["--json"]).collect();
    let output = command(&words).current_dir(&folder.0).output().unwrap();
    let result = parse(&output);
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_rotations(&result);
    let focal_px = result["focal_px"].as_f64().unwrap();
    assert!((focal_px - FOCAL_PX).abs() < 0.01 * FOCAL_PX, "{focal_px}");
    assert!(result["mean_error_px"].as_f64().unwrap() < 0.5, "{result}");
    assert_eq!(result["num_stitched"], 3);

    // Colors of the cylinder are those of the world, but for one exposure.
    let picture = image::open(folder.file("panorama.jpg"))
        .unwrap()
        .into_rgb8();
    assert_eq!(result["width"], picture.width());
    assert_eq!(result["height"], picture.height());
    let rows = result["photos"].as_array().unwrap();
    let first = matrix(&rows[0]["rotation"]);
    let matrices: Vec<_> = rows
        .iter()
        .map(|row| matrix(&row["pixel_from_direction"]))
        .collect();
    let (mut pairs, mut sums) = (Vec::new(), [0.0; 2]);
    for n in 0..3 {
        // The middle of each photo, found on the picture by its angle from the first one's.
        for (u, v) in [(160.0, 120.0), (100.0, 80.0), (220.0, 150.0)] {
            let d = matrices[n].try_inverse().unwrap() * Vector3::new(u, v, 1.0);
            let truth = world(&(rotations()[0].transpose() * first * d))[0];
            let place = place(&matrices, &picture, &d, focal_px);
            let value = f64::from(picture.get_pixel(place.0, place.1).0[0]);
            pairs.push((value, truth));
            sums = [sums[0] + value, sums[1] + truth];
        }
    }
    let gain = sums[0] / sums[1];
    assert!((gain - 1.0).abs() < 0.15, "{gain}");
    for (value, truth) in pairs {
        assert!((value - gain * truth).abs() < 16.0, "{value} and {truth}");
    }
    let short = String::from_utf8(epipole(&["stitch", "-h"]).stdout).unwrap();
    assert!(short.lines().count() <= 24, "{short}");
}

/// Pixel of a direction on the cylinder: the first column and row are the least of all photos.
fn place(
    matrices: &[Matrix3<f64>],
    picture: &RgbImage,
    d: &Vector3<f64>,
    focal_px: f64,
) -> (u32, u32) {
    let on = |d: &Vector3<f64>| [libm::atan2(d.x, d.z), d.y / libm::hypot(d.x, d.z)];
    let mut least = [f64::INFINITY; 2];
    for matrix in matrices {
        let inverse = matrix.try_inverse().unwrap();
        let (last_u, last_v) = (f64::from(SIZE.0) - 1.0, f64::from(SIZE.1) - 1.0);
        for n in 0..=400 {
            let fraction = f64::from(n) / 400.0;
            let border = [
                (fraction * last_u, 0.0),
                (fraction * last_u, last_v),
                (0.0, fraction * last_v),
                (last_u, fraction * last_v),
            ];
            for (u, v) in border {
                let place = on(&(inverse * Vector3::new(u, v, 1.0)));
                (0..2).for_each(|n| least[n] = least[n].min(place[n]));
            }
        }
    }
    let place = on(d);
    let at =
        |n: usize, size: u32| (((place[n] - least[n]) * focal_px).round() as u32).min(size - 1);
    (at(0, picture.width()), at(1, picture.height()))
}

#[test]
fn photos_of_a_plane_are_joined_by_homographies() {
    let folder = Folder::new("stitch-plane");
    // A wall at z = 1, seen from two places.
    fn wall(d: &Vector3<f64>) -> [f64; 3] {
        world(&Vector3::new(d.x / d.z, d.y / d.z, 0.4))
    }
    let shift = Matrix3::new(1.0, 0.0, -0.3, 0.0, 1.0, 0.05, 0.0, 0.0, 1.0);
    let slant = Rotation3::from_scaled_axis(Vector3::new(0.05, 0.1, 0.02)).into_inner();
    let k = k().matrix();
    for (name, matrix) in [("a.png", k), ("b.png", k * slant * shift)] {
        photo(&matrix, 1.0, wall).save(folder.file(name)).unwrap();
    }
    let [a, b, out] = ["a.png", "b.png", "wall.png"].map(|name| folder.file(name));
    let arguments = [
        "stitch",
        path(&a),
        path(&b),
        "--model",
        "homography",
        "-o",
        path(&out),
    ];
    let result = json(&arguments);
    assert!(result["focal_px"].is_null());
    assert!(result["mean_error_px"].as_f64().unwrap() < 0.5);
    let overlap = &result["overlaps"][0];
    assert!(overlap["num_inliers"].as_u64().unwrap() > 50);
    // The homography from one photo to the other is the true one.
    let rows = result["photos"].as_array().unwrap();
    let matrices: Vec<_> = rows
        .iter()
        .map(|row| matrix(&row["pixel_from_direction"]))
        .collect();
    let found = matrices[1] * matrices[0].try_inverse().unwrap();
    let truth = k * slant * shift * k.try_inverse().unwrap();
    for (u, v) in [(150.0, 60.0), (300.0, 200.0)] {
        let at = |h: &Matrix3<f64>| {
            let p = h * Vector3::new(u, v, 1.0);
            p / p.z
        };
        assert!((at(&found) - at(&truth)).norm() < 0.5);
    }
    let bent = [&arguments[..], &["--projection", "sphere"]].concat();
    fails(&folder, &bent, 2, "photos of a plane have no cylinder");
}

#[test]
fn photos_that_do_not_fit_are_named() {
    let folder = Folder::new("stitch-bad");
    photos(&folder);
    let elsewhere = folder.file("elsewhere.png");
    let away = Rotation3::from_scaled_axis(Vector3::y() * 2.5).into_inner();
    photo(&(k().matrix() * away), 1.0, world)
        .save(&elsewhere)
        .unwrap();
    let [left, middle, out, text] =
        ["left.jpg", "middle.jpg", "out.png", "out.txt"].map(|name| folder.file(name));
    let [l, m, e, o] = [&left, &middle, &elsewhere, &out].map(|file| path(file));
    for (arguments, status, expected) in [
        (vec![l, e, "-o", o], 1, "no two photos overlap"),
        (vec![l, "-o", o], 2, "needs two photos"),
        (
            vec![l, m, "-o", path(&text)],
            2,
            "must be a .png or .jpg file",
        ),
        (vec![l, "none.jpg", "-o", o], 1, "there is no such file"),
    ] {
        fails(
            &folder,
            &[&["stitch"], &arguments[..]].concat(),
            status,
            expected,
        );
    }
    let output = epipole(&["stitch", l, m, e, "-o", o]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(
        stderr.contains("left out, for they overlap none of the others: elsewhere.png"),
        "{stderr}"
    );
    let known = json(&[
        "stitch",
        l,
        m,
        "-o",
        o,
        "--focal-px",
        "300",
        "--projection",
        "plane",
    ]);
    assert_eq!(known["focal_px"], 300.0);
    let rotation = numbers(&known["photos"][0]["rotation"]);
    assert_eq!(rotation.len(), 9);
}

/// Photos of the still life from two places have depth.
#[test]
fn a_camera_that_moved_is_reported() {
    use crate::common::moved;
    use epipole::camera::RigidTransform;
    let folder = Folder::new("stitch-moved");
    for (name, shift) in [("a.png", 0.0), ("b.png", 0.3)] {
        let camera = moved((400, 300), &RigidTransform::translation(-shift, 0.0, 0.0));
        folder.write_photo(name, &camera, (400, 300));
    }
    let [a, b, out] = ["a.png", "b.png", "out.png"].map(|name| folder.file(name));
    let output = epipole(&["stitch", path(&a), path(&b), "-o", path(&out)]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(
        stderr.contains("the camera moved between a.png and b.png") || stderr.contains("overlap"),
        "{stderr}"
    );
}

/// A sign that hangs at both ends of the panorama.
#[test]
fn matches_that_contradict_all_others_are_no_parallax() {
    let folder = Folder::new("stitch-repeats");
    let mut photos: Vec<RgbImage> = (0..4)
        .map(|n| {
            let yaw = Rotation3::from_scaled_axis(Vector3::y() * (-0.35 * f64::from(n)));
            photo(&(k().matrix() * yaw.matrix()), 1.0, world)
        })
        .collect();
    let sign = image::imageops::crop_imm(&photos[0], 0, 60, 90, 120).to_image();
    image::imageops::replace(&mut photos[3], &sign, 225, 70);
    let names = ["a.png", "b.png", "c.png", "d.png"].map(|name| folder.file(name));
    for (photo, name) in photos.iter().zip(&names) {
        photo.save(name).unwrap();
    }
    let out = folder.file("out.png");
    let [a, b, c, d] = names.each_ref().map(|name| path(name));
    let arguments = ["stitch", a, b, c, d, "-o", path(&out)];
    let output = epipole(&[&arguments[..], &["--json"]].concat());
    let result = parse(&output);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(
        stderr.contains("matches of a.png and d.png contradict all others")
            && !stderr.contains("moved"),
        "{stderr}"
    );
    assert_eq!(result["num_stitched"], 4);
    assert!(result["mean_error_px"].as_f64().unwrap() < 0.5, "{result}");
}
