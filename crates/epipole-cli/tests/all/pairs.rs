//! `epipole two-view` and `fit` on special pairs: photographs of different shapes, rotation-only
//! motion, searches that ended early.

use crate::common::{
    Folder, angle_deg, epipole, fails, json, k, motion, moved, numbers, parse, path,
};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::math::random::Random;
use nalgebra::{Point2, Point3, Vector3};
use serde_json::Value;
use std::path::PathBuf;

const SIZE: (u32, u32) = (640, 480);
const K: &str = "600,600,319.5,239.5";

/// A translation to the right with a rotation back to the table.
fn step() -> RigidTransform {
    RigidTransform::new(
        Vector3::new(-0.25, 0.02, 0.03),
        Vector3::new(0.02, 0.17, 0.01),
    )
}

/// A camera that looks up, right and askew.
fn rotation_only() -> RigidTransform {
    RigidTransform::rotation(Vector3::new(0.03, 0.12, -0.02))
}

fn write_pair(folder: &Folder, motion: &RigidTransform) -> ([PosedCamera; 2], [PathBuf; 2]) {
    let cameras = [
        moved(SIZE, &RigidTransform::identity()),
        moved(SIZE, motion),
    ];
    let names = ["a.png", "b.png"];
    for (camera, name) in cameras.iter().zip(names) {
        folder.write_photo(name, camera, SIZE);
    }
    (cameras, names.map(|name| folder.file(name)))
}

/// A result and the messages beside it.
fn run(arguments: &[&str]) -> (Value, String) {
    let output = epipole(&[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    (parse(&output), String::from_utf8(output.stderr).unwrap())
}

/// Both cameras have one focal length, but the second photograph is in portrait format.
#[test]
fn each_photo_has_its_own_center() {
    let folder = Folder::new("pair-middle");
    let (cameras, [a, b]) = write_pair(&folder, &step());
    let upright = folder.file("upright.png");
    let rotated = image::imageops::rotate90(&image::open(&b).unwrap().to_rgb8());
    rotated.save(&upright).unwrap();
    let focal = cameras[0].camera.intrinsics.fu_px().to_string();
    // Clockwise in the picture: x goes down, y goes left.
    let roll = RigidTransform::rotation(Vector3::z() * core::f64::consts::FRAC_PI_2);
    let truth = roll * step();
    for model in ["auto", "essential"] {
        let result = json(&[
            "two-view",
            path(&a),
            path(&upright),
            "--focal-px",
            &focal,
            "--model",
            model,
        ]);
        let found = motion(&result["cam2_from_cam1"]);
        let off = found.rotation.angle_to(&truth.rotation).to_degrees();
        let direction = angle_deg(&found.translation.vector, &truth.translation.vector);
        assert!(off < 0.2 && direction < 1.0, "{model}: {off} {direction}");
    }
    let k1 = k(&cameras[0]);
    for model in ["auto", "essential", "homography"] {
        let arguments = [
            "two-view",
            path(&a),
            path(&upright),
            "--k",
            &k1,
            "--model",
            model,
        ];
        fails(
            &folder,
            &arguments,
            1,
            "--k cannot be right for both images, as one is 640 × 480 and the other 480 × 640",
        );
    }
}

/// Rows `u1 v1 u2 v2` of points at 3 to 7 units, half a pixel of noise.
fn rows(random: &mut Random, motion: &RigidTransform, noise_px: f64) -> String {
    let project = |x: &Point3<f64>| {
        let p = Point2::new(600.0 * x.x / x.z + 319.5, 600.0 * x.y / x.z + 239.5);
        format!("{} {} ", p.x, p.y)
    };
    let mut text = String::new();
    for _ in 0..150 {
        let depth = random.uniform(3.0, 7.0);
        let (x, y) = (random.uniform(-0.4, 0.4), random.uniform(-0.3, 0.3));
        let x1 = Point3::new(x * depth, y * depth, depth);
        let mut x2 = motion * x1;
        x2.x += noise_px / 600.0 * random.normal() * x2.z;
        x2.y += noise_px / 600.0 * random.normal() * x2.z;
        text += &format!("{}{}\n", project(&x1), project(&x2));
    }
    text
}

#[test]
fn fits_of_essential_matrices_warn_of_pure_rotations() {
    let folder = Folder::new("fit-turn");
    let mut random = Random::new(6);
    let unmoved = RigidTransform::identity();
    for (motion, noise_px, expected) in [
        (step(), 0.5, false),
        (rotation_only(), 0.5, true),
        (rotation_only(), 0.0, true),
        (unmoved, 0.0, true),
        (unmoved, 0.3, true),
    ] {
        let file = folder.write("matches.txt", &rows(&mut random, &motion, noise_px));
        let (result, stderr) = run(&["fit", "--model", "essential", path(&file), "--k", K]);
        assert_eq!(result["could_be_rotation"], expected, "{motion} {noise_px}");
        let warned = stderr.contains("warning: a pure rotation explains 1");
        assert_eq!(warned, expected, "{motion} {noise_px}: {stderr}");
        assert_eq!(result["could_be_random"], false);
    }
    let file = folder.write("matches.txt", &rows(&mut random, &step(), 0.5));
    let (result, _) = run(&["fit", "--model", "fundamental", path(&file)]);
    assert!(result.get("could_be_rotation").is_none());
}

/// Inliers on one line do not constrain the model beside it, and a homography fits any two matches
/// there.
#[test]
fn homographies_of_lines_are_reported() {
    let folder = Folder::new("fit-line");
    let mut random = Random::new(8);
    let mut matches = |num_beside: usize, noise_px: f64| -> String {
        let mut row = |u: f64, v: f64| {
            let mut noisy = |x: f64| x + noise_px * random.normal();
            let numbers = [
                noisy(u),
                noisy(v),
                noisy(1.1 * u + 20.0),
                noisy(0.9 * v + 0.1 * u),
            ];
            format!(
                "{} {} {} {}\n",
                numbers[0], numbers[1], numbers[2], numbers[3]
            )
        };
        let on_line = (0..60).map(|i| f64::from(i) * 9.0);
        let mut text: String = on_line.map(|u| row(30.0 + u, 400.0 - 0.5 * u)).collect();
        for place in 0..num_beside {
            let angle_rad = 2.4 * place as f64;
            text += &row(
                300.0 + 250.0 * libm::cos(angle_rad),
                120.0 + 90.0 * libm::sin(angle_rad),
            );
        }
        text
    };
    for noise_px in [1e-9, 0.1, 0.5] {
        for (num_beside, expected) in [(0, true), (2, true), (20, false)] {
            let file = folder.write("matches.txt", &matches(num_beside, noise_px));
            let (result, stderr) = run(&["fit", "--model", "homography", path(&file)]);
            let sentence = result["not_determined"].as_str().unwrap_or_default();
            let is_line = sentence.contains("are collinear in image 1");
            assert_eq!(is_line, expected, "{noise_px} {num_beside}: {sentence}");
            assert_eq!(stderr.contains("are collinear"), expected, "{stderr}");
        }
    }
}

/// Without intrinsics a rotation cannot be distinguished from a plane, but both can from a scene
/// with depth.
#[test]
fn fits_without_intrinsics_report_what_is_undetermined() {
    let folder = Folder::new("fit-open");
    let mut random = Random::new(7);
    let unmoved = RigidTransform::identity();
    for (model, motion, noise_px, expected) in [
        ("fundamental", step(), 0.5, None),
        (
            "fundamental",
            rotation_only(),
            0.5,
            Some("a plane, or the camera only rotated"),
        ),
        (
            "fundamental",
            rotation_only(),
            0.0,
            Some("a plane, or the camera only rotated"),
        ),
        ("fundamental", unmoved, 0.3, Some("hardly moved")),
        ("homography", rotation_only(), 0.3, None),
        ("homography", unmoved, 0.0, Some("hardly moved")),
        ("homography", unmoved, 0.3, Some("hardly moved")),
    ] {
        let file = folder.write("matches.txt", &rows(&mut random, &motion, noise_px));
        let (result, stderr) = run(&["fit", "--model", model, path(&file)]);
        let sentence = result["not_determined"].as_str();
        match expected {
            Some(words) => {
                assert!(
                    sentence.unwrap().contains(words),
                    "{model} {motion}: {sentence:?}"
                );
                assert!(stderr.contains(words), "{model} {motion}: {stderr}");
            }
            None => {
                assert!(sentence.is_none(), "{model} {motion}: {sentence:?}");
                assert!(result.get("not_determined").is_some());
            }
        }
    }
}

/// A row far beyond all images is left out, counted, and reported.
#[test]
fn a_row_beyond_all_images_is_left_out() {
    let folder = Folder::new("fit-far");
    let mut random = Random::new(8);
    let text = rows(&mut random, &step(), 0.3) + "1e12 5 7 9\n";
    let file = folder.write("matches.txt", &text);
    for model in ["fundamental", "essential", "similarity"] {
        let intrinsics: &[&str] = if model == "essential" {
            &["--k", K]
        } else {
            &[]
        };
        let (result, _) = run(&[&["fit", "--model", model, path(&file)], intrinsics].concat());
        assert_eq!(result["num_left_out"], 1, "{model}");
        let mask = numbers(&result["inliers"]);
        assert!(mask.len() == 151 && mask[150] == 0.0, "{model}");
    }
}

#[test]
fn photos_of_a_rotation_have_no_direction() {
    let folder = Folder::new("pair-turn");
    let (cameras, [a, b]) = write_pair(&folder, &rotation_only());
    let k = k(&cameras[0]);
    let pair = |second: &PathBuf, model: &str, more: &[&str]| {
        let arguments = ["two-view", path(&a), path(second), "--model", model];
        run(&[&arguments, more].concat())
    };
    for (second, truth) in [(&a, RigidTransform::identity()), (&b, rotation_only())] {
        let (result, stderr) = pair(second, "essential", &["--k", &k]);
        assert!(stderr.contains("warning: a pure rotation"), "{stderr}");
        assert_eq!(result["model_kind"], "essential");
        assert_eq!(result["configuration"], "panoramic");
        let found = motion(&result["cam2_from_cam1"]);
        assert!(found.rotation.angle_to(&truth.rotation).to_degrees() < 0.2);
        assert_eq!(numbers(&result["cam2_from_cam1"]["translation"]), [0.0; 3]);
    }
    // Known intrinsics distinguish a rotation from a plane, pixels alone do not.
    let (result, stderr) = pair(&b, "homography", &["--k", &k]);
    assert!(stderr.is_empty(), "{stderr}");
    assert_eq!(result["configuration"], "panoramic");
    let found = motion(&result["cam2_from_cam1"]);
    assert!(
        found
            .rotation
            .angle_to(&rotation_only().rotation)
            .to_degrees()
            < 0.2
    );
    let (result, stderr) = pair(&b, "homography", &[]);
    assert_eq!(result["configuration"], "planar");
    assert_eq!(result["cam2_from_cam1"], Value::Null);
    // With an unknown focal length, though, a rotation explains them.
    let focal_px: f64 = k.split(',').next().unwrap().parse().unwrap();
    let sentence = stderr.split("with a focal length near ").nth(1).unwrap();
    let near_px: f64 = sentence.split(' ').next().unwrap().parse().unwrap();
    assert!((near_px / focal_px - 1.0).abs() < 0.05, "{stderr}");
}

#[test]
fn automatic_choices_report_that_they_ended_early() {
    let folder = Folder::new("pair-exhausted");
    let (cameras, [a, b]) = write_pair(&folder, &step());
    let k = k(&cameras[0]);
    for camera in [&[][..], &["--k", &k]] {
        let base = ["two-view", path(&a), path(&b)];
        let (_, enough) = run(&[&base, camera].concat());
        assert!(enough.is_empty(), "{enough}");
        let (_, few) = run(&[&base, camera, &["--max-iterations", "2"]].concat());
        assert!(
            few.contains("warning: ended by --max-iterations 2: with so few inliers "),
            "{few}"
        );
        assert!(
            few.contains("samples are needed for a confidence of 0.999"),
            "{few}"
        );
    }
}
