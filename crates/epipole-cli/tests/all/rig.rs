//! `epipole rectify --rig`: photographs of a calibrated stereo rig.

use crate::common::lens::{self, KINDS, SIZE, camera_json, wall_photo};
use crate::common::{Folder, epipole, fails, json, numbers, parse, path};
use epipole::camera::{Camera, Intrinsics, LensKind, RigidTransform};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Distance of the right camera to the right of the left one, meters.
const BASELINE_M: f64 = 0.06;

/// Rotated a little, and not exactly beside the left one.
fn right_from_left() -> RigidTransform {
    RigidTransform::new(
        Vector3::new(-BASELINE_M, 0.002, -0.001),
        Vector3::new(0.01, -0.03, 0.02),
    )
}

fn rig_json(left: &Camera, right: &Camera) -> Value {
    let motion = right_from_left();
    let rotation = motion.rotation.to_rotation_matrix();
    let mut rig = camera_json(left);
    rig["right"] = camera_json(right);
    rig["stereo"] = json!({ "right_from_left": {
        "rotation": rotation.matrix().transpose().as_slice(),
        "translation": motion.translation.vector.as_slice(),
    } });
    rig
}

/// Two cameras of one kind, which are never quite the same.
fn cameras(kind: LensKind) -> [Camera; 2] {
    let left = lens::camera(kind);
    let k = &left.intrinsics;
    let (focal_px, center) = (1.03 * k.fu_px(), k.principal_point());
    let intrinsics = Intrinsics::new(focal_px, focal_px, center.x - 4.0, center.y + 5.0);
    let right = Camera {
        intrinsics: intrinsics.unwrap(),
        ..left
    };
    [left, right]
}

/// Distance of the wall from the left camera, meters.
const WALL_M: f64 = 0.8;

struct Rig {
    folder: Folder,
    photos: [PathBuf; 2],
    file: PathBuf,
}

fn rig(kind: LensKind, name: &str) -> Rig {
    let folder = Folder::new(name);
    let [left, right] = cameras(kind);
    // Not quite square to the wall.
    let rotation = RigidTransform::rotation(Vector3::new(0.1, -0.15, 0.05));
    let at = rotation * RigidTransform::translation(0.3, -0.2, WALL_M);
    let left_photo = wall_photo(&left, &at);
    let right_photo = wall_photo(&right, &(right_from_left() * at));
    let files = ["left-in.png", "right-in.png"].map(|name| folder.file(name));
    left_photo.save(&files[0]).unwrap();
    right_photo.save(&files[1]).unwrap();
    let file = folder.write("rig.json", &rig_json(&left, &right).to_string());
    Rig {
        folder,
        photos: files,
        file,
    }
}

/// Matches in the rectified images are in the same row, and Q gives their positions in meters, on a
/// wall at a known distance.
#[test]
fn photos_of_a_rig_are_rectified_in_meters() {
    for kind in KINDS {
        let Rig {
            folder,
            photos: [a, b],
            file,
        } = rig(kind, &format!("rig-{}", kind.name()));
        let out = folder.file("out");
        let [a, b] = [path(&a), path(&b)];
        let more = ["--rig", path(&file), "-o", path(&out)];
        let rectified = json(&[&["rectify", a, b], &more[..]].concat());
        assert_eq!(rectified["num_inliers"], Value::Null);
        let q = Matrix4::from_row_slice(&numbers(&rectified["q"]));
        let [left, right] = ["left.png", "right.png"].map(|name| out.join(name));
        let found = json(&["match", path(&left), path(&right), "--ratio", "0.7"]);
        let place = |side: &str, place: &Value| {
            let row = numbers(&found[side][place.as_u64().unwrap() as usize]);
            [row[0], row[1]]
        };
        // The plane n · X = 1 through the points that Q gives for the matches, by the normal
        // equations.
        let (mut off_px, mut squares, mut sums) = (Vec::new(), Matrix3::zeros(), Vector3::zeros());
        for pair in found["matches"].as_array().unwrap() {
            let [u, v] = place("keypoints1", &pair[0]);
            let [u2, v2] = place("keypoints2", &pair[1]);
            off_px.push((v - v2).abs());
            let point = q * Vector4::new(u, v, u - u2, 1.0);
            let point = point.xyz() / point.w;
            if (v - v2).abs() < 1.0 {
                squares += point * point.transpose();
                sums += point;
            }
        }
        assert!(off_px.len() > 40, "{kind:?}: {}", off_px.len());
        off_px.sort_by(f64::total_cmp);
        let median_px = off_px[off_px.len() / 2];
        assert!(median_px < 0.5, "{kind:?}: {median_px}");
        let normal = squares.try_inverse().unwrap() * sums;
        let wall_m = 1.0 / normal.norm();
        assert!((wall_m / WALL_M - 1.0).abs() < 0.03, "{kind:?}: {wall_m} m");
    }
}

#[test]
fn rigs_that_do_not_fit_get_a_sentence() {
    let rig = rig(LensKind::Brown, "rig-bad");
    let folder = &rig.folder;
    let [a, b] = rig.photos.each_ref().map(|file| path(file));
    let out = folder.file("out");
    let [left, right] = cameras(LensKind::Brown);
    let whole = rig_json(&left, &right);
    let with = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut changed = whole.clone();
        change(&mut changed);
        folder.write(name, &changed.to_string())
    };
    let refused = |file: &PathBuf, photos: [&str; 2], expected: &str| {
        let [a, b] = photos;
        let arguments = ["rectify", a, b, "--rig", path(file), "-o", path(&out)];
        fails(folder, &arguments, 1, expected);
    };
    let motion = |value: &mut Value, name: &str, with: Value| {
        value["stereo"]["right_from_left"][name] = with;
    };
    type Case<'a> = (&'a str, &'a dyn Fn(&mut Value), &'a str);
    let cases: [Case<'_>; 7] = [
        (
            "one.json",
            &|v| v["right"] = Value::Null,
            "there is no right camera in it",
        ),
        (
            "still.json",
            &|v| v["stereo"] = Value::Null,
            "rotation is not nine numbers",
        ),
        (
            "sheared.json",
            &|v| motion(v, "rotation", json!([1, 0.1, 0, 0, 1, 0, 0, 0, 1])),
            "rotation is not nine numbers of a rotation",
        ),
        (
            "mirrored.json",
            &|v| motion(v, "rotation", json!([-1, 0, 0, 0, 1, 0, 0, 0, 1])),
            "rotation is not nine numbers of a rotation",
        ),
        (
            "short.json",
            &|v| motion(v, "translation", json!([1, 2])),
            "translation is not three numbers",
        ),
        (
            "far.json",
            &|v| motion(v, "translation", json!([1e300, 0, 0])),
            "translation is not three numbers",
        ),
        (
            "together.json",
            &|v| motion(v, "translation", json!([0, 0, 0])),
            "both cameras are at the same place",
        ),
    ];
    for (name, change, expected) in cases {
        refused(&with(name, change), [a, b], expected);
    }
    let small = folder.blank("small.png", (SIZE, SIZE - 20));
    refused(
        &rig.file,
        [a, path(&small)],
        "small.png: the right camera of --rig was calibrated for 420 × 420 as the sensor gives them, but this image is 420 × 400",
    );
    refused(
        &folder.file("none.json"),
        [a, b],
        "none.json: there is no such file",
    );
    let both = ["rectify", a, b, "--rig", path(&rig.file), "-o", path(&out)];
    for more in [
        ["--k", "400,400,210,210"],
        ["--baseline-m", "2"],
        ["--camera", "c.json"],
    ] {
        fails(folder, &[&both[..], &more].concat(), 2, "--rig");
    }
    // The other options of rectification also apply here.
    let shaped = [
        &both[..],
        &["--size", "200x100", "--alpha", "0.5", "--json"],
    ]
    .concat();
    let output = epipole(&shaped);
    assert_eq!(output.status.code(), Some(0), "{}", parse(&output));
    let written = image::open(out.join("left.png")).unwrap();
    assert_eq!((written.width(), written.height()), (200, 100));
}
