//! `epipole calibrate`, `undistort` and `manual`.

use crate::common::{Folder, epipole, fails, json, motion, numbers, path};
use epipole::camera::{Distortion, Intrinsics, RigidTransform};
use epipole_io::camera::{CameraFormat, read_cameras};
use image::{GrayImage, Luma};
use nalgebra::{Point2, Point3, Vector3};
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (480, 360);
const SQUARE_M: f64 = 0.03;

fn lens() -> Distortion {
    Distortion {
        k1: -0.2,
        ..Distortion::NONE
    }
}

fn k() -> Intrinsics {
    Intrinsics::new(400.0, 402.0, 241.0, 178.0).unwrap()
}

/// A board of 7 × 5 inner corners, seen by a lens that bends.
fn render_board_photo(folder: &Folder, name: &str, cam_from_board: &RigidTransform) -> PathBuf {
    let board_from_cam = cam_from_board.inverse();
    let origin = board_from_cam * Point3::origin();
    let gray = |u: f64, v: f64| -> f64 {
        let ray = k().ray(&Point2::new(u, v));
        let Ok(ray) = lens().undistort(&ray.xy().into()) else {
            return 120.0;
        };
        let ray = board_from_cam.rotation * Vector3::new(ray.x, ray.y, 1.0);
        let depth = -origin.z / ray.z;
        let (x, y) = (
            (origin.x + depth * ray.x) / SQUARE_M,
            (origin.y + depth * ray.y) / SQUARE_M,
        );
        if x < -2.0 || y < -2.0 || x > 8.0 || y > 6.0 {
            120.0
        } else if x < -1.0 || y < -1.0 || x > 7.0 || y > 5.0 {
            230.0
        } else if (x.floor() + y.floor()).rem_euclid(2.0) == 0.0 {
            25.0
        } else {
            230.0
        }
    };
    let image = GrayImage::from_fn(SIZE.0, SIZE.1, |u, v| {
        let sum: f64 = (0..9)
            .map(|s| {
                let offset = |s: u32| (f64::from(s) - 1.0) / 3.0;
                gray(f64::from(u) + offset(s % 3), f64::from(v) + offset(s / 3))
            })
            .sum();
        Luma([(sum / 9.0).round() as u8])
    });
    let file = folder.file(name);
    image.save(&file).unwrap();
    file
}

fn poses() -> Vec<RigidTransform> {
    [
        [0.5, 0.0, 0.1, 0.0, 0.0],
        [-0.5, 0.1, 0.0, 0.02, 0.01],
        [0.0, 0.55, -0.1, -0.03, 0.0],
        [0.1, -0.5, 0.2, 0.0, -0.02],
        [0.3, 0.3, 0.0, 0.04, 0.02],
    ]
    .iter()
    .map(|[a, b, c, x, y]| {
        RigidTransform::new(
            Vector3::new(x - 0.09, y - 0.06, 0.36),
            Vector3::new(*a, *b, *c),
        )
    })
    .collect()
}

#[test]
fn a_rig_is_calibrated_and_its_images_undistorted() {
    let folder = Folder::new("calibrate");
    let right_from_left = RigidTransform::new(
        Vector3::new(-0.05, 0.002, 0.003),
        Vector3::new(0.01, 0.03, -0.02),
    );
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for (i, pose) in poses().iter().enumerate() {
        left.push(render_board_photo(&folder, &format!("left{i}.png"), pose));
        let pose = right_from_left * pose;
        right.push(render_board_photo(&folder, &format!("right{i}.png"), &pose));
    }
    let file = folder.file("camera.json");
    let mut arguments = vec!["calibrate"];
    arguments.extend(left.iter().map(|p| path(p)));
    arguments.extend([
        "--board",
        "7x5",
        "--square-m",
        "0.03",
        "-o",
        path(&file),
        "--right",
    ]);
    arguments.extend(right.iter().map(|p| path(p)));
    let result = json(&arguments);
    for camera in [&result, &result["right"]] {
        assert!(camera["rms_px"].as_f64().unwrap() < 0.2, "{camera}");
        let found = numbers(&camera["k"]);
        for (value, truth) in found.iter().zip([400.0, 402.0, 241.0, 178.0]) {
            assert!((value - truth).abs() < 3.0, "{found:?}");
        }
        let views = camera["views"].as_array().unwrap();
        assert!(
            views
                .iter()
                .all(|v| v["found"] == true && v["num_marks"] == 35)
        );
        assert_eq!(camera["std_dev"].as_array().unwrap().len(), 4 + 5);
        assert_eq!(camera["distortion"]["model"], "brown");
    }
    let stereo = &result["stereo"];
    let off = motion(&stereo["right_from_left"]).inverse() * right_from_left;
    assert!(
        off.translation.vector.norm() < 5e-4 && off.rotation.angle() < 2e-3,
        "{stereo}"
    );
    let baseline = stereo["baseline_m"].as_f64().unwrap();
    assert!((baseline - right_from_left.translation.vector.norm()).abs() < 3e-4);

    // As YAML it is the same rig.
    let yaml = folder.file("camera.yml");
    let output = arguments
        .iter()
        .position(|word| *word == path(&file))
        .unwrap();
    arguments[output] = path(&yaml);
    json(&arguments);
    let rig = |file: &Path| read_cameras(&std::fs::read(file).unwrap(), None).unwrap();
    let ((format, as_yaml), (_, as_json)) = (rig(&yaml), rig(&file));
    assert_eq!(format, CameraFormat::OpenCv);
    assert_eq!(as_yaml.cameras.len(), 2);
    for (a, b) in as_yaml.cameras.iter().zip(&as_json.cameras) {
        assert_eq!(a.camera, b.camera);
    }
    let motions = [as_yaml, as_json].map(|rig| rig.right_from_left.unwrap());
    assert_eq!(motions[0].translation, motions[1].translation);
    assert!(motions[0].rotation.angle_to(&motions[1].rotation) < 1e-15);

    // The file is read again, for both sides.
    let flat = folder.file("flat");
    for keep in ["valid", "all"] {
        let arguments = [
            "undistort",
            path(&right[0]),
            "--camera",
            path(&file),
            "--right",
            "--keep",
            keep,
            "-o",
            path(&flat),
        ];
        let result = json(&arguments);
        assert_eq!(result["files"].as_array().unwrap().len(), 1);
        let picture = image::open(flat.join("right0.png")).unwrap();
        assert_eq!((picture.width(), picture.height()), SIZE);
        let valid = &result["valid"];
        let (width, height) = (
            valid["width"].as_f64().unwrap(),
            valid["height"].as_f64().unwrap(),
        );
        let whole = width > 478.0 && height > 358.0;
        assert_eq!(whole, keep == "valid", "{valid}");
    }
    // A photograph of another size, and no camera at all.
    let small = folder.blank("small.png", (100, 80));
    let camera = path(&file);
    fails(
        &folder,
        &[
            "undistort",
            path(&small),
            "--camera",
            camera,
            "-o",
            path(&flat),
        ],
        1,
        "calibrated for 480 × 360",
    );
    let text = folder.write("not.json", "{ \"k\": 1 }");
    fails(
        &folder,
        &[
            "undistort",
            path(&left[0]),
            "--camera",
            path(&text),
            "-o",
            path(&flat),
        ],
        1,
        "not.json",
    );
    let both = [path(&left[0]), path(&left[0])];
    fails(
        &folder,
        &[
            "undistort",
            both[0],
            both[1],
            "--camera",
            camera,
            "-o",
            path(&flat),
        ],
        2,
        "left0.png is given twice",
    );
}

#[test]
fn bad_sets_of_images_are_rejected() {
    let folder = Folder::new("calibrate-bad");
    let good = render_board_photo(&folder, "good.png", &poses()[0]);
    let other = render_board_photo(&folder, "other.png", &poses()[1]);
    let half = RigidTransform::translation(0.22, 0.0, 0.0) * poses()[0];
    let out = render_board_photo(&folder, "out.png", &half);
    let blank = folder.blank("blank.png", SIZE);
    let small = folder.blank("small.png", (64, 48));
    let board = ["--board", "7x5"];
    let run = |photos: &[&PathBuf], board: &[&str], status: i32, expected: &str| {
        let mut arguments = vec!["calibrate"];
        arguments.extend(photos.iter().map(|p| path(p)));
        arguments.extend(board);
        fails(&folder, &arguments, status, expected);
    };
    run(&[&good], &board, 1, "needs at least 2");
    run(&[&good], &board, 1, "another way in each");
    run(&[&good, &blank], &board, 1, "no board of 7 × 5");
    run(&[&good, &out], &board, 1, "outside of the picture");
    run(&[&good, &out], &board, 1, "show more of it");
    run(&[&good, &other], &["--board", "6x5"], 1, "another size");
    run(&[&good, &other], &["--board", "6x5"], 1, "once more");
    run(&[&good, &small], &board, 1, "must have the same size");
    run(&[&good, &other], &["--board", "7by5"], 2, "is not like 9x6");
    run(&[&good, &other], &["--board", "1x5"], 2, "columns");
    run(
        &[&good, &other],
        &["--board", "7x5", "--right", path(&good)],
        2,
        "as many images",
    );
    // One of three shows nothing: the others do, and a warning names it.
    let third = render_board_photo(&folder, "third.png", &poses()[2]);
    let photos = [&good, &other, &third, &blank].map(|p| path(p));
    let output = epipole(&[&["calibrate"], &photos[..], &board[..]].concat());
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(stderr.contains("blank.png: no board of 7 × 5"), "{stderr}");
}

#[test]
fn the_manual_is_written() {
    let folder = Folder::new("manual");
    let result = json(&["manual", "-o", path(&folder.0)]);
    assert!(result["files"].as_array().unwrap().len() > 15);
    let page = std::fs::read_to_string(folder.file("man1/epipole-calibrate.1")).unwrap();
    assert!(page.contains(".TH") && page.contains("square"));
    let bash = std::fs::read_to_string(folder.file("completions/epipole.bash")).unwrap();
    assert!(bash.contains("two-view") && bash.contains("--square-m"));
}
