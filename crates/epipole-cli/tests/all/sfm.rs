//! `epipole sfm` on rendered photographs with known cameras.

use crate::common::{Folder, fails, json, k, motion, moved, numbers, path};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::sfm::{AlignmentKind, absolute_trajectory_error};
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (400, 300);

/// A camera that moves around the table and looks at it.
fn around(n: usize) -> PosedCamera {
    let angle = 0.1 * (n as f64 - 2.0);
    // Rotations about a point 1.3 m in front of the camera.
    let pivot = Vector3::new(0.0, 0.0, 1.3);
    let pose = RigidTransform::new(Vector3::zeros(), Vector3::y() * angle);
    let shift = pivot - pose * pivot;
    moved(SIZE, &RigidTransform::new(shift, Vector3::y() * angle))
}

fn centers(cameras: &[PosedCamera]) -> Vec<Point3<f64>> {
    cameras.iter().map(PosedCamera::center_in_world).collect()
}

/// Lines that are no comments.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.starts_with('#'))
}

/// These photographs have no EXIF focal length, and the guess is 4 % off: it is refined, with a
/// message.
#[test]
fn an_unknown_focal_length_is_refined() {
    let folder = Folder::new("sfm-focal");
    let cameras: Vec<PosedCamera> = (0..5).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    let (photos, out) = (folder.file("photos"), folder.file("out"));
    let truth = cameras[0].camera.intrinsics.fu_px();
    let run = |more: &[&str]| {
        let result = json(&[&["sfm", path(&photos), "-o", path(&out)], more].concat());
        let found = result["images"][0]["focal_px"].as_f64().unwrap();
        let refined = result["focal_refined"].as_bool().unwrap();
        (
            found,
            refined,
            result["mean_reprojection_px"].as_f64().unwrap(),
        )
    };
    let guess = 480.0;
    let (fixed, refined, guessed_px) = run(&["--keep-focal"]);
    assert!(!refined && (fixed - guess).abs() < 1e-9);
    let (found, refined, refined_px) = run(&[]);
    println!("truth {truth}: found {found}, {guessed_px} px, then {refined_px} px");
    assert!(
        refined && (found / truth - 1.0).abs() < 0.05,
        "{found} of {truth}"
    );
    assert!((found / truth - 1.0).abs() < 0.5 * (guess / truth - 1.0).abs());
    assert!(refined_px < guessed_px);
}

/// Cameras that go straight ahead fit any focal length: the result is not said to be sound. Around
/// a table it is, and a given one is not judged.
#[test]
fn a_straight_path_does_not_determine_the_focal_length() {
    let folder = Folder::new("sfm-ahead");
    let ahead = |n: usize| {
        moved(
            SIZE,
            &RigidTransform::translation(0.0, 0.0, -0.08 * n as f64),
        )
    };
    for (name, cameras, determined) in [
        (
            "ahead",
            (0..6).map(ahead).collect::<Vec<_>>(),
            Value::Bool(false),
        ),
        ("around", (0..5).map(around).collect(), Value::Bool(true)),
    ] {
        folder.write_photos(name, &cameras, SIZE);
        let (photos, out) = (folder.file(name), folder.file("out"));
        let more = ["--min-start-angle-deg", "2"];
        let found = json(&[&["sfm", path(&photos), "-o", path(&out)], &more[..]].concat());
        assert_eq!(found["focal_determined"], determined, "{name}: {found}");
        let k = k(&cameras[0]);
        let known = json(
            &[
                &["sfm", path(&photos), "-o", path(&out), "--k", &k],
                &more[..],
            ]
            .concat(),
        );
        assert_eq!(known["focal_determined"], Value::Null);
        assert_eq!(known["lens_refined"], false);
    }
}

/// One set of defaults: `detect` and `match` give the same features and matches as `sfm`.
#[test]
fn commands_find_the_same_features() {
    let folder = Folder::new("sfm-features");
    let cameras: Vec<PosedCamera> = (0..2).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    let files = [0, 1].map(|n| folder.file(&format!("photos/{n}.png")));
    let options = epipole::sfm::PhotoOptions::default();
    let features = files.each_ref().map(|file| {
        let photo = epipole::sfm::Photo {
            image: image::open(file).unwrap().to_rgb8(),
            ..epipole::sfm::Photo::default()
        };
        epipole::sfm::photo_features(&photo, &options, &mut ()).unwrap()
    });
    let places = |rows: &Value| -> Vec<(f64, f64)> {
        let rows = rows.as_array().unwrap().iter().map(numbers);
        rows.map(|row| (row[0], row[1])).collect()
    };
    let found = json(&["detect", path(&files[0])]);
    let expected: Vec<_> = (features[0].keypoints.iter()).map(|k| (k.u, k.v)).collect();
    assert!(expected.len() > 100);
    assert_eq!(places(&found["keypoints"]), expected);
    let matched = json(&["match", path(&files[0]), path(&files[1])]);
    let pairs = epipole::sfm::match_features(&features, &options, &mut ()).unwrap();
    let expected: Vec<_> = (pairs[0].matches.iter())
        .map(|found| (found.index1 as f64, found.index2 as f64))
        .collect();
    assert!(expected.len() > 50);
    assert_eq!(places(&matched["matches"]), expected);
}

/// Options of features, matches and the reconstruction take effect.
#[test]
fn every_step_of_a_reconstruction_can_be_set() {
    let folder = Folder::new("sfm-set");
    let cameras: Vec<PosedCamera> = (0..3).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    let (photos, out) = (folder.file("photos"), folder.file("out"));
    let k = k(&cameras[0]);
    let run = |more: &[&str]| {
        let arguments = ["sfm", path(&photos), "--k", &k, "-o", path(&out)];
        json(&[&arguments[..], more].concat())["num_points"]
            .as_u64()
            .unwrap()
    };
    let default = run(&[]);
    for fewer in [
        &["--features", "orb", "--max-features", "500"][..],
        &["--max-features", "300"],
        &["--contrast-threshold", "0.06"],
        &["--ratio", "0.6"],
        &["--max-error-px", "0.2"],
        &["--min-angle-deg", "8"],
        &["--max-reprojection-error-px", "0.3"],
        &["--neighbors", "1"],
    ] {
        let count = run(fewer);
        assert!(
            count < default && count > 10,
            "{fewer:?}: {count} of {default}"
        );
    }
    // Other ways to find the pairs' geometry find it, too.
    for other in [
        &["--max-error-px", "auto"][..],
        &["--sampler", "prosac"],
        &["--score", "inliers"],
        &["--budget", "with-replacement", "--confidence", "0.9"],
        &["--min-iterations", "1000", "--inner-iterations", "8"],
        &["--local-optimization=false", "--max-iterations", "5000"],
    ] {
        let count = run(other);
        assert!(2 * count > default, "{other:?}: {count} of {default}");
    }
    std::fs::remove_dir_all(&out).unwrap();
    let arguments = ["sfm", path(&photos), "--k", &k, "-o", path(&out)];
    let many = [&arguments[..], &["--min-inliers", "100000"]].concat();
    fails(&folder, &many, 1, "no two images");
    let wrong = [&arguments[..], &["--min-angle-deg", "0"]].concat();
    fails(&folder, &wrong, 2, "--min-angle-deg");
}

#[test]
fn photos_become_cameras_and_points() {
    let folder = Folder::new("sfm");
    let cameras: Vec<PosedCamera> = (0..5).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    // Files that are not photographs are skipped.
    folder.write("photos/notes.txt", "not a photograph");
    let (photos, out) = (folder.file("photos"), folder.file("out"));
    let result = json(&[
        "sfm",
        path(&photos),
        "--k",
        &k(&cameras[0]),
        "-o",
        path(&out),
    ]);
    assert_eq!(
        (&result["num_registered"], &result["num_images"]),
        (&5.into(), &5.into())
    );
    assert_eq!(result["complete"], true);
    assert!(result["mean_reprojection_px"].as_f64().unwrap() < 0.7);
    let images = result["images"].as_array().unwrap();
    let mut found = Vec::new();
    for (n, image) in images.iter().enumerate() {
        assert_eq!(image["name"], format!("{n}.png"));
        let cam_from_world = motion(&image["cam_from_world"]);
        found.push(Point3::from(cam_from_world.inverse().translation.vector));
    }
    let kind = AlignmentKind::Similarity;
    let (errors, _) = absolute_trajectory_error(&found, &centers(&cameras), kind).unwrap();
    // The cameras go half a meter.
    assert!(errors.max < 0.005, "{errors:?}");

    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let camera = read("cameras.txt");
    let words: Vec<&str> = lines(&camera).next().unwrap().split(' ').collect();
    assert_eq!(words[2..4], ["400", "300"]);
    // The format has pixel centers at halves, we at integers.
    let center: Vec<f64> = words[words.len() - 2..]
        .iter()
        .map(|w| w.parse().unwrap())
        .collect();
    let ours = cameras[0].camera.intrinsics.principal_point();
    let names: Vec<String> = lines(&read("images.txt"))
        .step_by(2)
        .map(|line| line.split(' ').nth(9).unwrap().to_owned())
        .collect();
    assert_eq!(names, ["0.png", "1.png", "2.png", "3.png", "4.png"]);
    if words[1] == "PINHOLE" {
        assert!((center[0] - ours.x - 0.5).abs() < 1e-9 && (center[1] - ours.y - 0.5).abs() < 1e-9);
    }
    let points = lines(&read("points3D.txt")).count();
    assert_eq!(result["num_points"].as_u64(), Some(points as u64));
    assert!(points > 200, "{points}");
    let ply = std::fs::read(out.join("points.ply")).unwrap();
    let header = format!("element vertex {points}\n");
    assert!(ply.windows(header.len()).any(|w| w == header.as_bytes()));
    let expected = [
        ".epipole-files",
        "cameras.txt",
        "images.txt",
        "points.ply",
        "points3D.txt",
    ];
    let names: BTreeSet<String> = std::fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(
        names.iter().eq(expected),
        "no part is left behind: {names:?}"
    );
}

#[test]
fn photos_that_do_not_fit_together_are_rejected() {
    let folder = Folder::new("sfm-bad");
    folder.write_photos("photos", &[around(0)], SIZE);
    std::fs::create_dir(folder.file("empty")).unwrap();
    let photo = folder.file("photos/0.png");
    let back = RigidTransform::new(Vector3::zeros(), Vector3::new(0.0, 3.0, 0.0));
    folder.write_photo("back.png", &moved(SIZE, &back), SIZE);
    let (out, back) = (folder.file("out"), folder.file("back.png"));
    let blank = [
        folder.blank("blank1.png", SIZE),
        folder.blank("blank2.png", SIZE),
    ];
    let sfm = |files: &[&str]| {
        let options = ["--focal-px", "500", "-o", path(&out)];
        [&["sfm"], files, &options]
            .concat()
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let empty = folder.file("empty");
    let missing = folder.file("missing.png");
    let again = folder.file("photos/again.png");
    std::fs::copy(&photo, &again).unwrap();
    for (files, expected) in [
        (vec![path(&photo)], "needs at least 2, but there is only 1"),
        (
            vec![path(&photo), path(&back)],
            "no two images overlap enough",
        ),
        (
            vec![path(&blank[0]), path(&blank[1])],
            "no two images overlap enough; blank1.png: it has only 0 features",
        ),
        (
            vec![path(&photo), path(&again)],
            "no two images can start a reconstruction; 0.png: it was taken from nearly the same position",
        ),
        (vec![path(&empty)], "there are no images in this folder"),
        (
            vec![path(&photo), path(&missing)],
            "missing.png: there is no such file",
        ),
    ] {
        let arguments = sfm(&files);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        fails(&folder, &arguments, 1, expected);
    }
    fails(&folder, &["sfm", "-o", path(&out)], 2, "required");
    fails(&folder, &["sfm", path(&photo)], 2, "--output");
    let wrong = ["sfm", path(&photo), "-o", path(&out), "--focal-px", "-3"];
    fails(&folder, &wrong, 2, "-3");
}

/// Four photographs, and the model of them that a run found.
struct Known {
    folder: Folder,
    photos: PathBuf,
    model: PathBuf,
    num_points: u64,
}

impl Known {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let cameras: Vec<PosedCamera> = (0..4).map(around).collect();
        folder.write_photos("photos", &cameras, SIZE);
        let (photos, model) = (folder.file("photos"), folder.file("model"));
        let focal_px = cameras[0].camera.intrinsics.fu_px().to_string();
        let words = ["sfm", path(&photos), "--focal-px", &focal_px, "-o"];
        let found = json(&[&words[..], &[path(&model)]].concat());
        let num_points = num_points(&found);
        Self {
            folder,
            photos,
            model,
            num_points,
        }
    }

    /// Arguments of a run with the poses of a model.
    fn words(&self, photos: &Path, model: &Path) -> Vec<String> {
        let out = self.folder.file("out");
        let words = [
            "sfm",
            path(photos),
            "--poses",
            path(model),
            "-o",
            path(&out),
        ];
        words.map(str::to_owned).to_vec()
    }

    fn run(&self, photos: &Path, model: &Path) -> Value {
        let words = self.words(photos, model);
        json(&words.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn fails(&self, photos: &Path, model: &Path, more: &[&str], status: i32, expected: &str) {
        let words = self.words(photos, model);
        let words: Vec<&str> = words
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        fails(&self.folder, &words, status, expected);
    }
}

fn num_points(result: &Value) -> u64 {
    result["num_points"].as_u64().unwrap()
}

/// The lines of all poses of a model.
fn poses(model: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(model.join("images.txt")).unwrap();
    lines(&text).step_by(2).map(str::to_owned).collect()
}

/// Poses stay to the last digit, and points are many.
#[test]
fn points_are_found_where_a_model_has_the_cameras() {
    let known = Known::new("sfm-poses");
    let result = known.run(&known.photos, &known.model);
    println!("{} points, then {}", known.num_points, num_points(&result));
    assert_eq!(result["num_registered"], 4);
    assert!(num_points(&result) * 10 >= known.num_points * 9);
    assert!(result["mean_reprojection_px"].as_f64().unwrap() < 1.0);
    assert_eq!(result["focal_determined"], Value::Null);
    let out = known.folder.file("out");
    assert_eq!(poses(&known.model), poses(&out));
    let cameras = |folder: &Path| std::fs::read_to_string(folder.join("cameras.txt")).unwrap();
    assert_eq!(cameras(&known.model), cameras(&out));
}

#[test]
fn poses_of_other_photos_are_reported() {
    let known = Known::new("sfm-other-poses");
    let rename = |from: &str, to: &str| {
        std::fs::rename(known.photos.join(from), known.photos.join(to)).unwrap();
    };
    rename("3.png", "other.png");
    let result = known.run(&known.photos, &known.model);
    assert_eq!(result["num_registered"], 3);
    assert_eq!(result["unregistered"][0]["name"], "other.png");
    let reason = result["unregistered"][0]["reason"].as_str().unwrap();
    assert!(reason.starts_with("it has no pose in "), "{reason}");
    // Cameras that move ahead see points move away from the middle, these move to the side.
    let ahead = known.folder.file("ahead");
    std::fs::create_dir(&ahead).unwrap();
    let pose = |n: usize| format!("{} 1 0 0 0 0 0 -0.{n} 1 {n}.png\n\n", n + 1);
    let text: String = (0..3).map(pose).collect();
    std::fs::write(ahead.join("images.txt"), text).unwrap();
    std::fs::copy(known.model.join("cameras.txt"), ahead.join("cameras.txt")).unwrap();
    let few = num_points(&known.run(&known.photos, &ahead));
    assert!(few * 3 < known.num_points, "{few}");
    // One photograph, points without images, a focal length beside the model's, no name in common.
    let (photos, model) = (&known.photos, &known.model);
    let one = "points need at least two images, but the input has 1";
    known.fails(&photos.join("0.png"), model, &[], 1, one);
    let cloud = model.join("points.ply");
    known.fails(
        photos,
        &cloud,
        &[],
        1,
        "it has no images with poses, only points",
    );
    let more = ["--focal-px", "500"];
    known.fails(photos, model, &more, 2, "cannot be used with");
    for n in 0..3 {
        rename(&format!("{n}.png"), &format!("y{n}.png"));
    }
    let none = "it has poses of 0 of the 4 images, and two are needed";
    known.fails(photos, model, &[], 1, none);
}
