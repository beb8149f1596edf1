//! `epipole odometry` on rendered frames with known cameras.

use crate::common::lens;
use crate::common::{Folder, epipole, fails, json, k, motion, moved, numbers, parse, path};
use epipole::camera::{LensKind, PosedCamera, RigidTransform, look_at};
use epipole_io::trajectory::read_trajectory;
use nalgebra::{Point3, Vector3};
use serde_json::Value;

const SIZE: (u32, u32) = (400, 300);

/// A camera that moves to the right, and a little forward.
fn along(n: usize) -> PosedCamera {
    let step = n as f64;
    let motion = Vector3::new(-0.05 * step, 0.004 * step, -0.02 * step);
    moved(
        SIZE,
        &RigidTransform::new(motion, Vector3::new(0.0, 0.005 * step, 0.0)),
    )
}

/// `world_from_cam` of each frame, relative to the first.
fn truth(cameras: &[PosedCamera]) -> Vec<RigidTransform> {
    let first = cameras[0].cam_from_world;
    cameras
        .iter()
        .map(|camera| first * camera.cam_from_world.inverse())
        .collect()
}

fn path_of(result: &Value) -> Vec<RigidTransform> {
    let frames = result["frames"].as_array().unwrap();
    frames
        .iter()
        .map(|frame| motion(&frame["world_from_cam"]))
        .collect()
}

/// Error of each position after alignment of the scale by the last one, relative to the distance
/// between the first and the last, and error of each rotation in degrees.
fn off(found: &[RigidTransform], truth: &[RigidTransform]) -> Vec<[f64; 2]> {
    let length = |poses: &[RigidTransform]| poses[poses.len() - 1].translation.vector.norm();
    let scale = length(truth) / length(found);
    let each = found.iter().zip(truth).map(|(got, want)| {
        let error = (got.translation.vector * scale - want.translation.vector).norm();
        let angle = got.rotation.angle_to(&want.rotation).to_degrees();
        [error / length(truth), angle]
    });
    each.collect()
}

#[test]
fn a_moving_camera_is_followed_up_to_scale() {
    let folder = Folder::new("odometry");
    let cameras: Vec<PosedCamera> = (0..8).map(along).collect();
    folder.write_photos("left", &cameras, SIZE);
    let left = folder.file("left");
    let written = folder.file("path.txt");
    let camera = k(&cameras[0]);
    let result = json(&[
        "odometry",
        path(&left),
        "--k",
        &camera,
        "-o",
        path(&written),
    ]);
    assert_eq!(result["lost"], Value::Array(Vec::new()));
    assert_eq!(result["complete"], true);
    let text = std::fs::read_to_string(&written).unwrap();
    let times: Vec<&str> = text
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    assert_eq!(
        times,
        ["#", "0.0", "1.0", "2.0", "3.0", "4.0", "5.0", "6.0", "7.0"]
    );
    let (_, read) = read_trajectory(text.as_bytes()).unwrap();
    for (read, expected) in read.world_from_cam.iter().zip(path_of(&result)) {
        let off = read.to_homogeneous() - expected.to_homogeneous();
        assert!(off.amax() < 1e-12, "{off}");
    }
    assert_eq!(result["frames"][3]["name"], "3.png");
    let keyframes = numbers(&result["keyframes"]);
    assert!(keyframes.len() >= 2 && keyframes.windows(2).all(|pair| pair[0] < pair[1]));
    // One camera alone leaves the unit open: that of the last frame is taken from the truth.
    for [place, angle] in off(&path_of(&result), &truth(&cameras)) {
        assert!(place < 0.026 && angle < 0.3, "{place} {angle}");
    }
}

#[test]
fn a_stereo_rig_is_followed_in_meters() {
    let folder = Folder::new("odometry-stereo");
    let cameras: Vec<PosedCamera> = (0..6).map(along).collect();
    let right: Vec<PosedCamera> = cameras
        .iter()
        .map(|camera| PosedCamera {
            cam_from_world: RigidTransform::translation(-0.08, 0.0, 0.0) * camera.cam_from_world,
            ..*camera
        })
        .collect();
    folder.write_photos("left", &cameras, SIZE);
    folder.write_photos("right", &right, SIZE);
    let folders = [folder.file("left"), folder.file("right")];
    let camera = k(&cameras[0]);
    let rig = ["--right", path(&folders[1]), "--stereo-baseline-m", "0.08"];
    let result = json(&[&["odometry", path(&folders[0]), "--k", &camera], &rig[..]].concat());
    assert_eq!(result["lost"], Value::Array(Vec::new()));
    // No alignment: the frame is that of the first camera, the unit is the meter.
    for (got, want) in path_of(&result).iter().zip(&truth(&cameras)) {
        let error = (got.translation.vector - want.translation.vector).norm();
        let angle = got.rotation.angle_to(&want.rotation).to_degrees();
        assert!(error < 0.01 && angle < 0.3, "{error} {angle}");
    }
}

#[test]
fn frames_without_a_path_are_refused() {
    let folder = Folder::new("odometry-bad");
    let cameras: Vec<PosedCamera> = (0..3).map(along).collect();
    folder.write_photos("three", &cameras, SIZE);
    folder.write_photos("two", &cameras[..2], SIZE);
    folder.write_photos("one", &cameras[..1], SIZE);
    let rotated = |n: f64| {
        moved(
            SIZE,
            &RigidTransform::new(Vector3::zeros(), Vector3::y() * 0.03 * n),
        )
    };
    folder.write_photos("turned", &[0.0, 1.0, 2.0, 3.0].map(rotated), SIZE);
    std::fs::create_dir(folder.file("sizes")).unwrap();
    folder.blank("sizes/0.png", SIZE);
    folder.blank("sizes/1.png", (100, 80));
    std::fs::create_dir(folder.file("blank")).unwrap();
    for name in ["blank/0.png", "blank/1.png"] {
        folder.blank(name, SIZE);
    }
    std::fs::create_dir(folder.file("empty")).unwrap();
    let [three, two] = ["three", "two"].map(|name| folder.file(name));
    for (name, expected) in [
        ("one", "the path of a camera from frames needs at least 2"),
        (
            "turned",
            "no two pictures see enough points under a sufficient angle",
        ),
        ("blank", "is not determined"),
        (
            "sizes",
            "1.png: all frames must have the size of the first, 400 × 300, but this one is 100 × 80",
        ),
        ("empty", "there are no images"),
        ("missing", "there is no such file"),
    ] {
        let frames = folder.file(name);
        fails(
            &folder,
            &["odometry", path(&frames), "--focal-px", "500"],
            1,
            expected,
        );
    }
    let rig = [
        "--right",
        path(&two),
        "--stereo-baseline-m",
        "0.1",
        "--focal-px",
        "500",
    ];
    let arguments = [&["odometry", path(&three)], &rig[..]].concat();
    fails(
        &folder,
        &arguments,
        1,
        "there are 3 of the left one and 2 of the right one",
    );
    // A name that is wrong is not one frame.
    let nowhere = folder.file("nowhere");
    let rig = [&["--right", path(&nowhere)], &rig[2..]].concat();
    let arguments = [&["odometry", path(&three)], &rig[..]].concat();
    fails(&folder, &arguments, 1, "nowhere: there is no such file");
    for (options, expected) in [
        (&["--right", path(&two)][..], "--stereo-baseline-m"),
        (&["--stereo-baseline-m", "0.1"], "--right"),
        (&["--right", path(&two), "--stereo-baseline-m", "0"], "0"),
    ] {
        let arguments = [&["odometry", path(&two), "--focal-px", "500"], options].concat();
        fails(&folder, &arguments, 2, expected);
    }
    // Two cameras at the same place: the same images on both sides.
    let rig = [
        "--right",
        path(&three),
        "--stereo-baseline-m",
        "0.1",
        "--focal-px",
        "500",
    ];
    fails(
        &folder,
        &[&["odometry", path(&three)], &rig[..]].concat(),
        1,
        "is not determined",
    );
}

/// Frames of a lens of any model are followed as they are, by the rays which their pixels see.
#[test]
fn frames_through_any_lens_are_followed() {
    for kind in lens::KINDS {
        let folder = Folder::new(&format!("odometry-{}", kind.name()));
        let camera = lens::camera(kind);
        let up = Vector3::new(0.0, -1.0, 0.0);
        let back = (camera.intrinsics.fu_px() / 140.0).min(3.0) * 0.55;
        let poses = [0.0, 1.0, 2.0, 3.0, 4.0].map(|n: f64| {
            let center = Point3::new((n - 2.0) * 0.12 * back, -0.35, -back + 0.02 * n);
            look_at(&center, &Point3::new(0.03, -0.1, 0.05), &up).unwrap()
        });
        std::fs::create_dir_all(folder.file("frames")).unwrap();
        for (n, frame) in lens::photos(&camera, poses).iter().enumerate() {
            let file = folder.file(&format!("frames/{n}.png"));
            frame.save(file).unwrap();
        }
        let (frames, file) = (folder.file("frames"), lens::write(&folder, &camera));
        let arguments = ["odometry", path(&frames), "--camera", path(&file)];
        let result = json(&arguments);
        assert_eq!(result["lost"], Value::Array(Vec::new()), "{kind:?}");
        assert_eq!(result["lens"], kind.name());
        assert_eq!(numbers(&result["distortion"]), camera.lens.coefficients());
        assert_eq!(result["focal_px"], camera.intrinsics.fu_px());
        assert_eq!(result["focal_refined"], false);
        let truth: Vec<RigidTransform> = (poses.iter())
            .map(|pose| poses[0] * pose.inverse())
            .collect();
        // More than that is not in the matches of the narrowest: PoseLib finds .87° there between
        // two photographs.
        let most_deg = if kind == LensKind::Division { 1.0 } else { 0.3 };
        for [place, angle] in off(&path_of(&result), &truth) {
            assert!(
                place < 0.05 && angle < most_deg,
                "{kind:?}: {place} {angle}"
            );
        }
        // The requested distortion terms are refined, if the lens model has them.
        let more = ["--refine-distortion", "--refine-tangential", "--json"];
        let output = epipole(&[&arguments[..], &more].concat());
        let refined = numbers(&parse(&output)["distortion"]);
        assert_ne!(refined, camera.lens.coefficients());
        let stderr = String::from_utf8(output.stderr).unwrap();
        let has_none = matches!(kind, LensKind::Fisheye | LensKind::Division);
        assert_eq!(stderr.contains("no tangential terms"), has_none, "{kind:?}");
    }
}

/// These frames have no EXIF focal length, and the guess is 4 % off: it is refined at the end, with
/// a message.
#[test]
fn a_focal_length_that_is_a_guess_is_refined_at_the_end() {
    let folder = Folder::new("odometry-focal");
    let pivot = Vector3::new(0.0, 0.0, 1.3);
    let cameras: Vec<PosedCamera> = (0..6)
        .map(|n| {
            let angle = Vector3::y() * (0.1 * (f64::from(n) - 2.0));
            let shift = pivot - RigidTransform::new(Vector3::zeros(), angle) * pivot;
            moved(SIZE, &RigidTransform::new(shift, angle))
        })
        .collect();
    folder.write_photos("frames", &cameras, SIZE);
    let frames = folder.file("frames");
    let run = |more: &[&str]| {
        let result = json(&[&["odometry", path(&frames)], more].concat());
        let focal_px = result["focal_px"].as_f64().unwrap();
        (focal_px, result["focal_refined"].as_bool().unwrap())
    };
    let (truth_px, guess_px) = (cameras[0].camera.intrinsics.fu_px(), 480.0);
    for fixed in [&["--keep-focal"][..], &["--final-adjustment=false"]] {
        let (focal_px, is_refined) = run(fixed);
        assert!(
            !is_refined && (focal_px - guess_px).abs() < 1e-9,
            "{fixed:?}"
        );
    }
    let (focal_px, is_refined) = run(&[]);
    let off = |px: f64| (px / truth_px - 1.0).abs();
    assert!(
        is_refined && off(focal_px) < 0.5 * off(guess_px),
        "{focal_px}"
    );
    let arguments = [
        "odometry",
        path(&frames),
        "--final-adjustment=false",
        "--refine-focal",
    ];
    let stderr = String::from_utf8(epipole(&arguments).stderr).unwrap();
    assert!(stderr.contains("no lens parameter is refined"), "{stderr}");
    // From far away it takes several rounds.
    let (from_far_px, _) = run(&["--focal-px", "800", "--refine-focal"]);
    assert!(off(from_far_px) < off(guess_px), "{from_far_px}");
    let stderr = String::from_utf8(epipole(&["odometry", path(&frames)]).stderr).unwrap();
    assert!(
        stderr.contains("taking 480 px") && stderr.contains("to be refined"),
        "{stderr}"
    );
    // Reduced frames are a quarter as large; numbers are in their pixels.
    let (reduced_px, _) = run(&["--max-megapixels", "0.03", "--keep-focal"]);
    assert!((reduced_px - 0.5 * guess_px).abs() < 1.0, "{reduced_px}");
}

#[test]
fn cameras_that_do_not_fit_the_frames_are_refused() {
    let folder = Folder::new("odometry-camera");
    let cameras: Vec<PosedCamera> = (0..2).map(along).collect();
    folder.write_photos("frames", &cameras, SIZE);
    let camera = lens::write(&folder, &lens::camera(LensKind::Brown));
    let frames = folder.file("frames");
    let arguments = ["odometry", path(&frames), "--camera", path(&camera)];
    fails(
        &folder,
        &arguments,
        1,
        "0.png: the camera of --camera was calibrated for 420 × 420, but this frame is 400 × 300",
    );
    let rig = ["--right", path(&frames), "--stereo-baseline-m", "0.1"];
    fails(&folder, &[&arguments[..], &rig].concat(), 2, "--camera");
    let missing = folder.file("missing.json");
    let arguments = ["odometry", path(&frames), "--camera", path(&missing)];
    fails(
        &folder,
        &arguments,
        1,
        "missing.json: there is no such file",
    );
}
