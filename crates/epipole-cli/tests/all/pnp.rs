//! `epipole pnp`: poses of known cameras and of cameras without a focal length.

use crate::common::{Folder, command, epipole, fails, json, motion, numbers, parse, path};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::math::random::Random;
use nalgebra::{Point2, Point3, Vector3};
use std::path::PathBuf;

const K: &str = "800,800,320,240";

fn camera() -> Camera {
    Camera::pinhole(
        Intrinsics::new(800.0, 800.0, 320.0, 240.0).unwrap(),
        640,
        480,
    )
}

fn truth() -> RigidTransform {
    RigidTransform::new(Vector3::new(0.2, -0.1, 5.0), Vector3::new(0.3, -0.2, 0.1))
}

fn rows(points: &[Point3<f64>], pixels: &[Point2<f64>]) -> String {
    (points.iter().zip(pixels))
        .map(|(x, p)| format!("{} {} {} {} {}\n", x.x, x.y, x.z, p.x, p.y))
        .collect()
}

/// Points in a cube of 2 m, of which every fourth has a wrong pixel.
fn points_file(folder: &Folder, name: &str, count: usize) -> PathBuf {
    let mut random = Random::new(3);
    let points: Vec<_> = (0..count)
        .map(|_| Point3::from(Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0))))
        .collect();
    let pixels: Vec<_> = (points.iter().zip(0..))
        .map(|(x, n)| match n % 4 {
            3 => Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)),
            _ => camera().project(&(truth() * x)).unwrap(),
        })
        .collect();
    folder.write(name, &rows(&points, &pixels))
}

fn is_truth(result: &serde_json::Value) {
    let found = motion(&result["cam_from_world"]);
    assert!(
        found.rotation.angle_to(&truth().rotation) < 1e-6,
        "{result}"
    );
    assert!((found.translation.vector - truth().translation.vector).norm() < 1e-5);
    let center = Vector3::from_row_slice(&numbers(&result["center"]));
    assert!((truth() * Point3::from(center)).coords.norm() < 1e-5);
}

#[test]
fn the_example_of_the_help_finds_the_pose_among_wrong_points() {
    let folder = Folder::new("pnp");
    points_file(&folder, "points.txt", 60);
    let help = String::from_utf8(epipole(&["pnp", "--help"]).stdout).unwrap();
    let example = "pnp points.txt --k 800,800,320,240";
    assert!(help.contains(&format!("Example: epipole {example}\n")));
    let words: Vec<&str> = example.split(' ').chain(["--json"]).collect();
    let result = parse(&command(&words).current_dir(&folder.0).output().unwrap());
    is_truth(&result);
    assert_eq!(result["num_inliers"], 45);
    assert!(result["mean_error_px"].as_f64().unwrap() < 1e-6);
    assert!(result["focal_px"].is_null());
    assert_eq!(result["alternatives"].as_array().unwrap().len(), 0);
    assert_eq!(numbers(&result["k"]), [800.0, 800.0, 320.0, 240.0]);
    assert_eq!(result["image"]["width"], 641);
    let short = String::from_utf8(epipole(&["pnp", "-h"]).stdout).unwrap();
    assert!(short.lines().count() <= 24, "{short}");
}

#[test]
fn a_focal_length_is_found_with_the_pose() {
    let folder = Folder::new("pnp-focal");
    let file = points_file(&folder, "points.txt", 60);
    for center in [["--center", "320,240"], ["--size", "641x481"]] {
        let arguments = [
            "pnp",
            path(&file),
            "--focal-px",
            "unknown",
            center[0],
            center[1],
        ];
        let result = json(&arguments);
        is_truth(&result);
        assert!((result["focal_px"].as_f64().unwrap() - 800.0).abs() < 1e-3);
        assert!(result["focal_std_px"].as_f64().unwrap() < 0.01);
    }
}

/// Corners of a tennis court of 10.97 m × 23.77 m in a broadcast frame of 640 × 360. SciPy from 400
/// starts finds f = 533.94 px and the camera at (−0.03, −9.38, 6.12).
#[test]
fn four_corners_of_a_court_give_focal_length_and_place() {
    let folder = Folder::new("pnp-court");
    // As the problem was sent: intrinsics first, with a focal length of 1 for an unknown one.
    let court = "# the court\n1 1 319.5 179.5\n-5.485 23.77 0.0 229.0 60.0\n5.485 23.77 0.0 407.0 61.0\n\
                 5.485 0.0 0.0 584.0 274.0\n-5.485 0.0 0.0 53.0 275.0\n";
    let file = folder.write("court.txt", court);
    let arguments = [
        "pnp",
        path(&file),
        "--focal-px",
        "unknown",
        "--size",
        "640x360",
    ];
    let output = epipole(&arguments);
    assert!(output.stderr.is_empty(), "four corners need no warning");
    let result = json(&arguments);
    assert!(
        (result["focal_px"].as_f64().unwrap() - 533.94).abs() < 0.01,
        "{result}"
    );
    let center = Vector3::from_row_slice(&numbers(&result["center"]));
    assert!(
        (center - Vector3::new(-0.03, -9.38, 6.12)).amax() < 0.01,
        "{center}"
    );
    assert_eq!(result["num_inliers"], 4);
    assert_eq!(result["k"][0], result["focal_px"]);
    assert_eq!(result["image"]["height"], 360);
}

#[test]
fn both_poses_of_a_small_board_are_offered() {
    let folder = Folder::new("pnp-board");
    let pose = RigidTransform::new(Vector3::new(0.0, 0.0, 4.0), Vector3::new(0.4, 0.0, 0.0));
    let mut random = Random::new(1);
    let points: Vec<_> = (0..12)
        .map(|n| Point3::new(0.02 * f64::from(n % 4), 0.02 * f64::from(n / 4), 0.0))
        .collect();
    let pixels: Vec<_> = (points
        .iter()
        .map(|x| camera().project(&(pose * x)).unwrap()))
    .map(|p| Point2::new(p.x + 0.2 * random.normal(), p.y + 0.2 * random.normal()))
    .collect();
    let file = folder.write("board.txt", &rows(&points, &pixels));
    let result = json(&["pnp", path(&file), "--k", K]);
    let others = result["alternatives"].as_array().unwrap();
    assert_eq!(others.len(), 1, "{result}");
    let tilts =
        [&result, &others[0]].map(|pose| motion(&pose["cam_from_world"]).rotation.scaled_axis().x);
    assert!(tilts[0] * tilts[1] < 0.0, "{tilts:?}");
    // Nearer, perspective tells them apart.
    let pixels: Vec<_> = (points.iter())
        .map(|x| {
            camera()
                .project(&(RigidTransform::translation(0.0, 0.0, -3.8) * pose * x))
                .unwrap()
        })
        .collect();
    let file = folder.write("near.txt", &rows(&points, &pixels));
    let result = json(&["pnp", path(&file), "--k", K]);
    assert!(
        result["alternatives"].as_array().unwrap().is_empty(),
        "{result}"
    );
}

#[test]
fn points_without_a_pose_are_refused_for_their_reason() {
    let folder = Folder::new("pnp-bad");
    let pixel = |n: u32| format!("{} {}", 100 + 37 * n, 80 + 11 * (n * n % 7));
    let all = |point: &dyn Fn(u32) -> String| -> String {
        (0..8)
            .map(|n| format!("{} {}\n", point(n), pixel(n)))
            .collect()
    };
    let cases = [
        (
            "1 2 3 4 5\n6 7 8 9 10\n3 1 2 1 4\n".to_owned(),
            "there are 3 points, and a pose needs 4",
        ),
        (String::new(), "there are 0 points"),
        (
            all(&|n| format!("{} 0 1", n % 2)),
            "only 2 of the 8 points are distinct",
        ),
        (
            all(&|n| format!("{n} {} 5", 2 * n)),
            "all points are collinear",
        ),
        ("1 2 3 4\n".to_owned(), "line 1: here should be 5 numbers"),
        (
            "1 2 3 4 nan\n".to_owned(),
            "line 1: here should be 5 numbers",
        ),
        (
            "u v x y\n1 2 3 4\n".to_owned(),
            "names no columns x y z u v, but u v x y",
        ),
        (
            "4 4 4 4 4\n"
                .repeat(9)
                .replacen("4 4 4 4 4", "4 4 4 1 2", 1),
            "only 1 of the 9 points",
        ),
        (
            all(&|n| format!("{} {} {}", n * 5 % 8, n * 3 % 7, n * n % 5)),
            "are the columns x y z u v",
        ),
    ];
    for (text, expected) in &cases {
        let file = folder.write("points.txt", text);
        let arguments = ["pnp", path(&file), "--k", K, "--quiet"];
        let shown = String::from_utf8(epipole(&arguments).stderr).unwrap();
        let output = epipole(&arguments[..4]);
        let warned = String::from_utf8(output.stderr).unwrap();
        assert!(
            shown.contains(expected) || warned.contains(expected),
            "{text}: {shown}{warned}"
        );
    }
    let file = folder.write("points.txt", &cases[8].0);
    for (options, status, expected) in [
        (vec![], 2, "--k"),
        (
            vec!["--focal-px", "unknown"],
            2,
            "needs the principal point",
        ),
        (
            vec!["--focal-px", "some"],
            2,
            "is not a number above 0, nor \"unknown\"",
        ),
        (vec!["--k", K, "--center", "320,240"], 2, "--center"),
        (vec!["--camera", "none.json"], 1, "there is no such file"),
    ] {
        fails(
            &folder,
            &[&["pnp", path(&file)], &options[..]].concat(),
            status,
            expected,
        );
    }
}

#[test]
fn wrong_units_of_pixels_are_reported() {
    let folder = Folder::new("pnp-units");
    let file = points_file(&folder, "points.txt", 40);
    let stderr_of =
        |k: &str| String::from_utf8(epipole(&["pnp", path(&file), "--k", k]).stderr).unwrap();
    assert!(stderr_of("100,100,40,30").contains("belongs to an image of about 80 pixels"));
    let text = std::fs::read_to_string(&file).unwrap();
    let fractions = text.lines().map(|line| {
        let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        let [x, y, z, u, v] = numbers[..] else {
            panic!()
        };
        format!("{x} {y} {z} {} {}\n", u / 640.0, v / 480.0)
    });
    folder.write("points.txt", &fractions.collect::<String>());
    assert!(stderr_of(K).contains("look like fractions of the image"));
}

#[test]
fn reversed_and_exchanged_axes_are_reported() {
    let folder = Folder::new("pnp-axes");
    let file = points_file(&folder, "points.txt", 40);
    let text = std::fs::read_to_string(&file).unwrap();
    let warnings_of = |change: &dyn Fn([f64; 5]) -> [f64; 5]| {
        let lines = text.lines().map(|line| {
            let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
            let row = change(numbers.try_into().unwrap());
            format!("{}\n", row.map(|x| x.to_string()).join(" "))
        });
        let file = folder.write("changed.txt", &lines.collect::<String>());
        String::from_utf8(epipole(&["pnp", path(&file), "--k", K]).stderr).unwrap()
    };
    type Change = fn([f64; 5]) -> [f64; 5];
    let mirrored: [Change; 3] = [
        |[x, y, z, u, v]| [x, y, z, u, 479.0 - v],
        |[x, y, z, u, v]| [x, y, -z, u, v],
        |[x, y, z, u, v]| [x, y, z, v, u],
    ];
    for change in mirrored {
        let sentence = warnings_of(&change);
        assert!(
            sentence.contains("where the image is mirrored"),
            "{sentence}"
        );
    }
    assert!(!warnings_of(&|row| row).contains("mirrored"));
}
