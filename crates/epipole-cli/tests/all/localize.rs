//! `epipole localize`: new photos in a model of rendered ones.

use crate::common::{
    Folder, command, epipole, fails, json, k, motion, moved, parse, path, write_model,
};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole_io::model::{Model, ModelFormat, read_model_folder};
use nalgebra::Vector3;

const SIZE: (u32, u32) = (400, 300);

/// A camera that moves around the table and looks at it.
fn around(n: usize) -> PosedCamera {
    let angle = 0.1 * (n as f64 - 2.0);
    let pivot = Vector3::new(0.0, 0.0, 1.3);
    let pose = RigidTransform::new(Vector3::zeros(), Vector3::y() * angle);
    let shift = pivot - pose * pivot;
    moved(SIZE, &RigidTransform::new(shift, Vector3::y() * angle))
}

/// A model without one of its images.
fn without(model: &Model, left_out: usize) -> Model {
    let mut model = model.clone();
    model.images.remove(left_out);
    for point in &mut model.points {
        point.track.retain(|(image, _)| *image != left_out);
        for (image, _) in &mut point.track {
            *image -= usize::from(*image > left_out);
        }
    }
    model.points.retain(|point| point.track.len() > 1);
    model
}

#[test]
fn a_photo_is_localized_where_it_was_reconstructed() {
    let folder = Folder::new("localize");
    let cameras: Vec<PosedCamera> = (0..5).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    let (photos, out) = (folder.file("photos"), folder.file("out"));
    let result = json(&[
        "sfm",
        path(&photos),
        "--k",
        &k(&cameras[0]),
        "-o",
        path(&out),
    ]);
    assert_eq!(result["num_registered"], 5);
    let read = read_model_folder(&|name: &str| std::fs::read(out.join(name)).ok());
    let model = read.unwrap().unwrap().model;
    let place = model
        .images
        .iter()
        .position(|image| image.name == "3.png")
        .unwrap();
    let truth = model.images[place].cam_from_world;
    let less = folder.file("reconstruction");
    write_model(&without(&model, place), ModelFormat::ColmapBinary, &less);

    // As the help shows it.
    let new = folder.file("new.jpg");
    std::fs::copy(photos.join("3.png"), &new).unwrap();
    let help = String::from_utf8(epipole(&["localize", "--help"]).stdout).unwrap();
    let example = help
        .lines()
        .find_map(|line| line.strip_prefix("Example: epipole "))
        .unwrap();
    let words: Vec<&str> = example.split(' ').chain(["--json"]).collect();
    let output = command(&words).current_dir(&folder.0).output().unwrap();
    let result = parse(&output);
    let found = &result["photos"][0];
    assert_eq!(found["name"], "new.jpg");
    let pose = motion(&found["cam_from_world"]);
    // The still life is about 1.3 away.
    let unit = (model.images[0].center_in_world() - model.images[4].center_in_world()).norm();
    let off = (pose.translation.vector - truth.translation.vector).norm() / unit;
    println!("{off:.5} of the path, {} inliers", found["num_inliers"]);
    assert!(off < 0.01, "{off}");
    assert!(pose.rotation.angle_to(&truth.rotation) < 0.005);
    assert!(found["num_inliers"].as_u64().unwrap() > 50);
    let [first, again] =
        ["num_observations", "num_found_again"].map(|n| result[n].as_u64().unwrap());
    assert!(again * 10 > first * 8, "{again} of {first}");

    // Of twice the size: its camera is that of the model.
    let large = folder.file("large.png");
    let (width, height) = (2 * SIZE.0, 2 * SIZE.1);
    let photo = image::open(photos.join("3.png")).unwrap();
    let filter = image::imageops::FilterType::CatmullRom;
    photo
        .resize_exact(width, height, filter)
        .save(&large)
        .unwrap();
    let arguments = [
        "localize",
        path(&large),
        path(&less),
        "--images",
        path(&photos),
    ];
    let result = json(&arguments);
    let (focal_px, expected) = (
        result["photos"][0]["focal_px"].as_f64().unwrap(),
        2.0 * model.cameras[0].intrinsics.fu_px(),
    );
    assert!((focal_px - expected).abs() < 1e-6, "{focal_px} {expected}");
    let pose = motion(&result["photos"][0]["cam_from_world"]);
    let off = (pose.translation.vector - truth.translation.vector).norm() / unit;
    assert!(off < 0.02, "{off}");

    // One that shows nothing of it, beside one that does.
    let blank = folder.blank("blank.png", SIZE);
    let arguments = ["localize", path(&blank), path(&new), path(&less)];
    let images = ["--images", path(&photos)];
    let both = json(&[&arguments[..], &images].concat());
    assert_eq!(both["num_localized"], 1);
    assert!(both["photos"][0]["cam_from_world"].is_null());
    assert!(
        both["photos"][0]["reason"]
            .as_str()
            .unwrap()
            .contains("needs at least 15")
    );
    let without_output = ["localize", path(&blank), path(&less), images[0], images[1]];
    fails(&folder, &without_output, 1, "needs at least 15");
    let unfound = ["localize", path(&blank), path(&less)];
    fails(&folder, &unfound, 2, "give --images DIR");
    let elsewhere = [
        "localize",
        path(&blank),
        path(&less),
        "--images",
        path(&less),
    ];
    fails(
        &folder,
        &elsewhere,
        1,
        "none of the model's 4 images is there",
    );
    write_model(
        &without(&model, place),
        ModelFormat::Transforms,
        &folder.file("nerf"),
    );
    let nerf = folder.file("nerf");
    let untracked = ["localize", path(&blank), path(&nerf), images[0], images[1]];
    fails(&folder, &untracked, 1, "no observations");
    let short = String::from_utf8(epipole(&["localize", "-h"]).stdout).unwrap();
    assert!(short.lines().count() <= 24, "{short}");
}
