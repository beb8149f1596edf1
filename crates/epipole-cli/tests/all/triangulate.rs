//! `epipole triangulate`: points from matches with cameras of models, rigs and camera files.

use crate::common::{Folder, command, epipole, fails, json, numbers, parse, path};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::math::random::Random;
use epipole_io::camera::{CameraFormat, Cameras, write_cameras};
use epipole_io::model::{Model, ModelFormat, ModelImage};
use nalgebra::{Point2, Point3, Vector3};
use serde_json::Value;
use std::path::PathBuf;

fn camera() -> Camera {
    Camera::pinhole(
        Intrinsics::new(700.0, 700.0, 320.0, 240.0).unwrap(),
        640,
        480,
    )
}

/// Poses of three cameras: the third only turned from the first.
fn poses() -> [RigidTransform; 3] {
    [
        RigidTransform::new(Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 0.1, 0.0)),
        RigidTransform::new(Vector3::new(-0.6, 0.1, 0.05), Vector3::new(0.0, -0.1, 0.02)),
        RigidTransform::new(Vector3::zeros(), Vector3::new(0.05, 0.0, 0.0))
            * RigidTransform::new(Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 0.1, 0.0)),
    ]
}

fn points() -> Vec<Point3<f64>> {
    let mut random = Random::new(4);
    let point = |_| {
        let mut to = |reach: f64| random.uniform(-reach, reach);
        Point3::new(to(0.8), to(0.6), 5.0 + to(1.0))
    };
    (0..40).map(point).collect()
}

fn pixels(pose: &RigidTransform) -> Vec<Point2<f64>> {
    points()
        .iter()
        .map(|x| camera().project(&(pose * x)).unwrap())
        .collect()
}

fn matches_file(folder: &Folder, [first, second]: [usize; 2]) -> PathBuf {
    let [a, b] = [first, second].map(|n| pixels(&poses()[n]));
    let rows = a
        .iter()
        .zip(&b)
        .map(|(a, b)| format!("{} {} {} {}\n", a.x, a.y, b.x, b.y));
    folder.write("matches.txt", &rows.collect::<String>())
}

/// COLMAP's text model of the three cameras.
fn model(folder: &Folder) -> PathBuf {
    let image = |(n, pose): (usize, &RigidTransform)| ModelImage {
        id: n as u32 + 1,
        name: format!("photos/{n}, left.jpg"),
        camera: 0,
        cam_from_world: *pose,
        keypoints: Vec::new(),
    };
    let model = Model {
        cameras: vec![camera()],
        images: poses().iter().enumerate().map(image).collect(),
        points: Vec::new(),
        ..Model::default()
    };
    let path = folder.file("model");
    std::fs::create_dir_all(&path).unwrap();
    for file in model.to_files(ModelFormat::ColmapText).unwrap() {
        std::fs::write(path.join(&file.name), &file.bytes).unwrap();
    }
    path
}

fn are_true(result: &Value) {
    let found = result["points"].as_array().unwrap();
    assert_eq!(found.len(), points().len());
    for (row, x) in found.iter().zip(points()) {
        let row = numbers(row);
        assert!(
            (Vector3::new(row[0], row[1], row[2]) - x.coords).norm() < 1e-5,
            "{row:?} {x}"
        );
        assert!(row[3] < 1e-5 && row[4] > 5.0 && row[4] < 12.0, "{row:?}");
    }
}

#[test]
fn a_model_gives_the_points_of_two_of_its_images() {
    let folder = Folder::new("triangulate");
    let (matches, model) = (matches_file(&folder, [0, 1]), model(&folder));
    let ply = folder.file("points.ply");
    let csv = folder.file("points.csv");
    // The end of a name will do, and it may have commas.
    let images = "photos/0, left.jpg,1, left.jpg";
    let arguments = [
        "triangulate",
        path(&matches),
        path(&model),
        "--images",
        images,
        "-o",
    ];
    let result = json(&[&arguments[..], &[path(&ply)]].concat());
    are_true(&result);
    assert_eq!(result["images"][1], "photos/1, left.jpg");
    assert_eq!(result["num_points"], 40);
    assert!((result["baseline"].as_f64().unwrap() - 0.7).abs() < 0.2);
    let (cloud, _) = epipole_io::cloud::read_ply(&std::fs::read(&ply).unwrap()).unwrap();
    assert_eq!(cloud.points.len(), 40);
    json(&[&arguments[..], &[path(&csv)]].concat());
    let text = std::fs::read_to_string(&csv).unwrap();
    assert!(text.starts_with("x,y,z,error_px,angle_deg\n") && text.lines().count() == 41);
    let short = String::from_utf8(epipole(&["triangulate", "-h"]).stdout).unwrap();
    assert!(short.lines().count() <= 24, "{short}");
}

#[test]
fn the_example_of_the_help_runs() {
    let folder = Folder::new("triangulate-example");
    matches_file(&folder, [0, 1]);
    std::fs::rename(model(&folder), folder.file("reconstruction")).unwrap();
    let images = folder.file("reconstruction/images.txt");
    let text = std::fs::read_to_string(&images).unwrap();
    let text = text
        .replace("photos/0, left.jpg", "a.jpg")
        .replace("photos/1, left.jpg", "b.jpg");
    std::fs::write(&images, text).unwrap();
    let help = String::from_utf8(epipole(&["triangulate", "--help"]).stdout).unwrap();
    let example = help
        .lines()
        .find_map(|line| line.strip_prefix("Example: epipole "))
        .unwrap();
    let words: Vec<&str> = example.split(' ').chain(["--json"]).collect();
    let output = command(&words).current_dir(&folder.0).output().unwrap();
    are_true(&parse(&output));
    assert!(folder.file("points.ply").exists());
}

/// Poses from known points, by `epipole pnp`, are those of two camera files.
#[test]
fn poses_that_pnp_printed_triangulate() {
    let folder = Folder::new("triangulate-pnp");
    let mut files = Vec::new();
    for n in 0..2 {
        let rows = pixels(&poses()[n]).into_iter().zip(points());
        let rows = rows.map(|(p, x)| format!("{} {} {} {} {}\n", x.x, x.y, x.z, p.x, p.y));
        let file = folder.write(&format!("points{n}.txt"), &rows.collect::<String>());
        let output = epipole(&["pnp", path(&file), "--k", "700,700,320,240", "--json"]);
        let text = String::from_utf8(output.stdout).unwrap();
        files.push(folder.write(&format!("camera{n}.json"), &text));
    }
    let matches = matches_file(&folder, [0, 1]);
    let result = json(&[
        "triangulate",
        path(&matches),
        path(&files[0]),
        path(&files[1]),
    ]);
    are_true(&result);
    assert!(result["images"].is_null());
}

#[test]
fn the_world_of_a_rig_is_its_left_camera() {
    let folder = Folder::new("triangulate-rig");
    let [left, right, _] = poses();
    let right_from_left = right * left.inverse();
    let cameras = Cameras::of_rig([camera(), camera()], right_from_left);
    let text = write_cameras(CameraFormat::Epipole, &cameras).unwrap();
    let rig = folder.write("rig.json", &text);
    let matches = matches_file(&folder, [0, 1]);
    let result = json(&["triangulate", path(&matches), path(&rig)]);
    for (row, x) in result["points"].as_array().unwrap().iter().zip(points()) {
        let row = numbers(row);
        let x = left * x;
        assert!((Vector3::new(row[0], row[1], row[2]) - x.coords).norm() < 1e-5);
    }
}

#[test]
fn rays_without_a_point_are_reported() {
    let folder = Folder::new("triangulate-bad");
    let model = model(&folder);
    let matches = matches_file(&folder, [0, 1]);
    let [m, model] = [path(&matches), path(&model)];
    let images = ["--images", "0, left.jpg,2, left.jpg"];
    for (arguments, status, expected) in [
        (
            vec![m, model],
            2,
            "the model has 3 images: name two by --images",
        ),
        (
            vec![m, model, "--images", "0, left.jpg,none.jpg"],
            1,
            "the model has no image",
        ),
        (
            vec![m, model, "--images", "none"],
            2,
            "two names with a comma",
        ),
        (
            vec![m, model, images[0], images[1]],
            1,
            "both cameras are at the same position",
        ),
        (
            vec![m, model, images[0], images[1], "-o", "a.txt"],
            2,
            "must be a .ply or .csv file",
        ),
        (vec![m, "none.json"], 1, "there is no such file"),
    ] {
        fails(
            &folder,
            &[&["triangulate"], &arguments[..]].concat(),
            status,
            expected,
        );
    }
    let text = write_cameras(CameraFormat::Epipole, &Cameras::of(camera())).unwrap();
    let single = folder.write("alone.json", &text);
    let without_pose = ["triangulate", m, path(&single), path(&single)];
    fails(&folder, &without_pose, 1, "there is no pose in it");

    let images = ["--images", "0, left.jpg,1, left.jpg"];
    let stderr_of = |text: &str| {
        let file = folder.write("odd.txt", text);
        let output = epipole(&["triangulate", path(&file), model, images[0], images[1]]);
        String::from_utf8(output.stderr).unwrap()
    };
    // Far away: the rays turn by the angle between the cameras alone.
    let far = |pose: &RigidTransform| {
        camera()
            .project(&(pose * Point3::new(0.0, 0.0, 1e4)))
            .unwrap()
    };
    let [a, b] = [far(&poses()[0]), far(&poses()[1])];
    let message = stderr_of(&format!("{} {} {} {}\n", a.x, a.y, b.x, b.y));
    assert!(
        message.contains("rays of 1 of 1 matches are near parallel"),
        "{message}"
    );
    let swapped = std::fs::read_to_string(&matches).unwrap();
    let swapped = swapped.lines().map(|line| {
        let n: Vec<&str> = line.split(' ').collect();
        format!("{} {} {} {}\n", n[2], n[3], n[0], n[1])
    });
    let message = stderr_of(&swapped.collect::<String>());
    assert!(
        message.contains("meet behind a camera") || message.contains("on average"),
        "{message}"
    );
    let message = stderr_of("5000 100 320 240\n320 240 320 240\n");
    assert!(
        message.contains("1 pixels are outside image 1, which has 640 × 480"),
        "{message}"
    );
    assert!(stderr_of("").contains("there is no match in it"));
}
