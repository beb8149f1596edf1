//! Photographs through a fisheye, from pixels to a model with its lens.

use crate::common::lens::photos;
use crate::common::{Folder, epipole, fails, json, motion, numbers, parse, path};
use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform, look_at};
use epipole::sfm::{AlignmentKind, align_points};
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::path::PathBuf;

const SIZE: u32 = 420;
const COEFFICIENTS: [f64; 4] = [-0.02, 0.006, -0.002, 0.0003];

/// 175° from border to border.
fn camera() -> Camera {
    Camera {
        intrinsics: Intrinsics::new(140.0, 141.0, 210.5, 208.0).unwrap(),
        lens: Lens::Fisheye(Fisheye {
            coefficients: COEFFICIENTS,
        }),
        width: SIZE,
        height: SIZE,
    }
}

/// Five views of the table from an arc.
fn poses() -> [RigidTransform; 5] {
    let up = Vector3::new(0.0, -1.0, 0.0);
    [-0.3, -0.15, 0.0, 0.15, 0.3].map(|x: f64| {
        let center = Point3::new(x, -0.35 - 0.1 * x.abs(), -0.55 + 0.3 * x.abs());
        look_at(&center, &Point3::new(0.03, -0.1, 0.05), &up).unwrap()
    })
}

fn camera_json(coefficients: &[f64]) -> String {
    format!(
        r#"{{ "image": {{ "width": {SIZE}, "height": {SIZE} }}, "k": [140, 141, 210.5, 208],
        "distortion": {{ "model": "fisheye", "coefficients": {coefficients:?} }} }}"#
    )
}

/// Largest error of the camera centers, meters.
fn off_m(result: &Value) -> f64 {
    let (mut found, mut truth) = (Vec::new(), Vec::new());
    for image in result["images"].as_array().unwrap() {
        let number: usize = image["name"].as_str().unwrap()[..1].parse().unwrap();
        let center = |pose: &RigidTransform| pose.inverse() * Point3::origin();
        found.push(center(&motion(&image["cam_from_world"])));
        truth.push(center(&poses()[number]));
    }
    let to_from = align_points(&found, &truth, AlignmentKind::Similarity).unwrap();
    let off = found
        .iter()
        .zip(&truth)
        .map(|(found, truth)| (to_from * found - truth).norm());
    off.fold(0.0, f64::max)
}

#[test]
fn a_fisheye_is_reconstructed_from_distorted_photos() {
    let folder = Folder::new("fisheye");
    let mut files: Vec<PathBuf> = Vec::new();
    let photos = photos(&camera(), poses());
    for (n, photo) in photos.iter().enumerate() {
        files.push(folder.file(&format!("{n}.png")));
        photo.save(&files[n]).unwrap();
    }
    let camera = folder.write("camera.json", &camera_json(&COEFFICIENTS));
    let out = folder.file("out");
    let sfm = |camera: &PathBuf, more: &[&str]| {
        let mut arguments = vec!["sfm"];
        arguments.extend(files.iter().map(|file| path(file)));
        arguments.extend(["--camera", path(camera), "-o", path(&out)]);
        arguments.extend(more);
        json(&arguments)
    };
    let cameras = || std::fs::read_to_string(out.join("cameras.txt")).unwrap();
    let distorted = sfm(&camera, &["--images"]);
    assert_eq!(distorted["num_registered"], 5);
    assert_eq!(distorted["images"][0]["lens"], "fisheye");
    assert_eq!(numbers(&distorted["images"][0]["distortion"]), COEFFICIENTS);
    assert!(off_m(&distorted) < 0.003, "{}", off_m(&distorted));
    let line =
        format!("1 OPENCV_FISHEYE {SIZE} {SIZE} 140 141 211 208.5 -0.02 0.006 -0.002 0.0003");
    assert!(cameras().lines().any(|l| l == line), "{}", cameras());
    // The photographs are copied unchanged beside the model.
    for file in &files {
        let copied = out.join("images").join(file.file_name().unwrap());
        assert_eq!(std::fs::read(copied).unwrap(), std::fs::read(file).unwrap());
    }
    // Without its border there is less to see.
    let flat = sfm(&camera, &["--undistort"]);
    assert!(cameras().contains("1 PINHOLE "), "{}", cameras());
    assert_eq!(flat["images"][0]["lens"], "brown");
    let [num_distorted, num_flat] =
        [&distorted, &flat].map(|result| result["num_points"].as_u64().unwrap());
    assert!(num_distorted > num_flat, "{num_distorted} {num_flat}");

    // A camera that is a little wrong is put right.
    let wrong = folder.write("wrong.json", &camera_json(&[0.0; 4]));
    let refined = sfm(&wrong, &["--refine-distortion"]);
    assert_eq!(refined["num_registered"], 5);
    let lens = Fisheye {
        coefficients: numbers(&refined["images"][0]["distortion"])
            .try_into()
            .unwrap(),
    };
    let ray = Vector3::new(1.0, 0.0, 0.6);
    let truth = camera_lens().project(&ray).unwrap();
    let off_px = 140.0 * (lens.project(&ray).unwrap() - truth).norm();
    assert!(off_px < 0.5, "{off_px}");

    // Photographs of another size are by another camera, and share no lens with it.
    let small = image::imageops::thumbnail(&photos[2], 200, 200);
    small.save(folder.file("5.png")).unwrap();
    let mut arguments = vec!["sfm", "--camera", path(&camera), "-o", path(&out), "--json"];
    arguments.extend(files.iter().map(|file| path(file)));
    let small = folder.file("5.png");
    arguments.push(path(&small));
    let output = epipole(&arguments);
    let stderr = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(stderr.contains("is used for 5 of 6 images"), "{stderr}");
    assert!(parse(&output)["num_registered"].as_u64().unwrap() >= 5);
}

fn camera_lens() -> Lens {
    camera().lens
}

#[test]
fn lenses_that_cannot_be_are_refused() {
    let folder = Folder::new("fisheye-bad");
    let photos = [
        folder.blank("a.png", (SIZE, SIZE)),
        folder.blank("b.png", (SIZE, SIZE)),
    ];
    let out = folder.file("out");
    let run = |text: &str, expected: &str, status: i32, more: &[&str]| {
        let camera = folder.write("camera.json", text);
        let mut arguments = vec!["sfm", path(&photos[0]), path(&photos[1]), "-o", path(&out)];
        arguments.extend(["--camera", path(&camera)]);
        arguments.extend(more);
        fails(&folder, &arguments, status, expected);
    };
    run(
        &camera_json(&[-3.0, 0.0, 0.0, 0.0]),
        "has no ray for 9",
        1,
        &[],
    );
    run(&camera_json(&[0.0; 3]), "coefficients", 1, &[]);
    run(
        &camera_json(&[0.0; 4]).replace("0.0, 0.0]", "1e999, 0.0]"),
        "JSON",
        1,
        &[],
    );
    let plain = [
        "sfm",
        path(&photos[0]),
        path(&photos[1]),
        "-o",
        path(&out),
        "--undistort",
    ];
    fails(&folder, &plain, 2, "--camera");
    // No tangential terms to refine.
    let camera = folder.write("camera.json", &camera_json(&[0.0; 4]));
    let mut arguments = vec!["sfm", path(&photos[0]), path(&photos[1]), "-o", path(&out)];
    arguments.extend(["--camera", path(&camera), "--refine-tangential"]);
    let stderr = String::from_utf8(epipole(&arguments).stderr).unwrap();
    assert!(
        stderr.contains("--refine-tangential makes no difference"),
        "{stderr}"
    );
}
