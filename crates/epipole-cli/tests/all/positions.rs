//! `epipole sfm` on photographs with known positions, and with different lenses.

use crate::common::{Folder, exif, fails, json, motion, moved, path};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::math::{Geodetic, local_from_geodetic};
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::path::PathBuf;

const SIZE: (u32, u32) = (400, 300);

/// Cameras around the table.
fn cameras() -> Vec<PosedCamera> {
    let around = |n: usize| {
        let angle = 0.1 * (n as f64 - 2.0);
        let pivot = Vector3::new(0.0, 0.06 * (n % 2) as f64, 1.3);
        let pose = RigidTransform::new(Vector3::zeros(), Vector3::y() * angle);
        moved(
            SIZE,
            &RigidTransform::new(
                pivot - pose * Vector3::new(0.0, 0.0, 1.3),
                Vector3::y() * angle,
            ),
        )
    };
    (0..6).map(around).collect()
}

fn write_photos(folder: &Folder, cameras: &[PosedCamera]) -> PathBuf {
    std::fs::create_dir_all(folder.file("photos")).unwrap();
    for (n, camera) in cameras.iter().enumerate() {
        folder.write_photo(&format!("photos/{n}.png"), camera, SIZE);
    }
    folder.file("photos")
}

/// Camera centers of a result.
fn centers(result: &Value) -> Vec<Point3<f64>> {
    let images = result["images"].as_array().unwrap().iter();
    images
        .map(|image| motion(&image["cam_from_world"]).inverse_transform_point(&Point3::origin()))
        .collect()
}

fn worst_m(found: &[Point3<f64>], truth: &[Point3<f64>]) -> f64 {
    assert_eq!(found.len(), truth.len());
    let off = found.iter().zip(truth).map(|(a, b)| (a - b).norm());
    off.fold(0.0, f64::max)
}

#[test]
fn positions_of_a_file_give_the_result_their_frame_and_meters() {
    let folder = Folder::new("positions");
    let cameras = cameras();
    let photos = write_photos(&folder, &cameras);
    let truth: Vec<Point3<f64>> = cameras.iter().map(PosedCamera::center_in_world).collect();
    let focal_px = cameras[0].camera.intrinsics.fu_px().to_string();
    let out = folder.file("out");
    let mut text = "# name, meters\n\n".to_owned();
    for (n, center) in truth.iter().enumerate() {
        // One line is a meter off, and one says how sure it is.
        let (wrong, sigma) = (f64::from(n == 4), if n == 1 { " 0.002" } else { "" });
        text += &format!(
            "{n}.png {} {} {}{sigma}\n",
            center.x + wrong,
            center.y,
            center.z
        );
    }
    text += "another.png 1 2 3\n";
    let file = folder.write("positions.txt", &text);
    let sfm = |more: &[&str]| {
        let arguments = [
            "sfm",
            path(&photos),
            "-o",
            path(&out),
            "--focal-px",
            &focal_px,
        ];
        json(&[&arguments, more].concat())
    };
    let result = sfm(&["--positions", path(&file), "--position-sigma-m", "0.01"]);
    assert_eq!(result["placed"], true);
    assert_eq!(result["num_registered"], 6);
    assert!(result["origin"].is_null());
    let worst = worst_m(&centers(&result), &truth);
    assert!(worst < 0.01, "{worst}");
    // One of six is a meter off.
    let rms_m = result["position_rms_m"].as_f64().unwrap();
    assert!((rms_m - (1.0_f64 / 6.0).sqrt()).abs() < 0.02, "{rms_m}");
    let without = sfm(&[]);
    assert!(without.get("placed").is_none());
    assert!(worst_m(&centers(&without), &truth) > 0.1);

    // Two positions do not determine the rotation.
    let two: String = text
        .lines()
        .take(4)
        .map(|line| format!("{line}\n"))
        .collect();
    let two = folder.write("two.txt", &two);
    let result = sfm(&["--positions", path(&two), "--position-sigma-m", "0.01"]);
    assert_eq!(result["placed"], false);
    assert!(result["position_rms_m"].is_null());

    let run = |text: &str, more: &[&str], status: i32, expected: &str| {
        let file = folder.write("bad.txt", text);
        let arguments = [
            "sfm",
            path(&photos),
            "-o",
            path(&out),
            "--positions",
            path(&file),
        ];
        fails(&folder, &[&arguments, more].concat(), status, expected);
    };
    run(
        "0.png 1 2\n",
        &[],
        1,
        "line 1: it is not a name and three numbers",
    );
    run(
        "\n0.png 1 2 x\n",
        &[],
        1,
        "line 2: it is not a name and three numbers",
    );
    run("0.png 1 2 3 -4\n", &[], 1, "greater than 0");
    run("0.png 1 2 1e200\n", &[], 1, "more than 10⁹ from 0");
    run(
        "0.png 1 2 3\n0.png 1 2 3\n",
        &[],
        1,
        "line 2: this is the second line for the image",
    );
    run(
        "a.png 1 2 3\n",
        &[],
        1,
        "none of its lines is for one of the images",
    );
    run(
        "0.png 95 2 3\n",
        &["--geodetic"],
        1,
        "a latitude must be from -90 to 90 degrees",
    );
    run(
        "0.png 1 2 3\n",
        &["--position-sigma-m", "0"],
        2,
        "not a number above 0",
    );
    // Degrees are not meters.
    let degrees: String = (0..6)
        .map(|n| format!("{n}.png 48.85{n} 2.29 80\n"))
        .collect();
    run(
        &degrees,
        &[],
        1,
        "if they are degrees, say so by --geodetic",
    );
    let missing = [
        "sfm",
        path(&photos),
        "-o",
        path(&out),
        "--positions",
        "missing.txt",
    ];
    fails(&folder, &missing, 1, "there is no such file");
    let without_positions = ["sfm", path(&photos), "-o", path(&out), "--geodetic"];
    fails(&folder, &without_positions, 2, "--positions");
    let silent = [
        "sfm",
        path(&photos),
        "-o",
        path(&out),
        "--positions",
        "exif",
    ];
    fails(&folder, &silent, 1, "no image has a GPS position");
}

/// Photographs of a garden in Sydney say where they were taken, some meters apart; the still life
/// is its model.
#[test]
fn photos_contain_their_positions() {
    let folder = Folder::new("positions-exif");
    let cameras = cameras();
    let photos = write_photos(&folder, &cameras);
    let out = folder.file("out");
    let origin = Geodetic {
        latitude_deg: -33.86,
        longitude_deg: 151.21,
        height_m: 20.0,
    };
    // Twenty times as large as the table, and y of the camera's world is down.
    let per_meter = 1.0 / 111_000.0;
    let mut places = Vec::new();
    let mut text = String::new();
    for (n, camera) in cameras.iter().enumerate() {
        let at = 20.0 * camera.center_in_world().coords;
        let place = Geodetic {
            latitude_deg: origin.latitude_deg + at.z * per_meter,
            longitude_deg: origin.longitude_deg + at.x * per_meter / 0.83,
            height_m: origin.height_m - at.y,
        };
        let file = photos.join(format!("{n}.png"));
        let image = image::open(&file).unwrap().to_rgb8();
        exif::write_png(&file, &image, exif::place(&place));
        text += &format!(
            "{n}.png {} {} {}\n",
            place.latitude_deg, place.longitude_deg, place.height_m
        );
        places.push(place);
    }
    let truth: Vec<Point3<f64>> = (places.iter())
        .map(|place| local_from_geodetic(place, &places[0]).unwrap())
        .collect();
    let focal_px = cameras[0].camera.intrinsics.fu_px().to_string();
    let file = folder.write("places.txt", &text);
    for source in [&["exif"][..], &[path(&file), "--geodetic"]] {
        let arguments = [
            "sfm",
            path(&photos),
            "-o",
            path(&out),
            "--focal-px",
            &focal_px,
            "--position-sigma-m",
            "0.1",
            "--positions",
        ];
        let result = json(&[&arguments, source].concat());
        assert_eq!(result["placed"], true, "{result}");
        let latitude_deg = result["origin"]["latitude_deg"].as_f64().unwrap();
        assert!((latitude_deg - places[0].latitude_deg).abs() < 1e-8);
        let worst = worst_m(&centers(&result), &truth);
        assert!(worst < 0.1, "{source:?}: {worst}");
    }
}

/// Half of the photographs are smaller: another lens, whose focal length is refined by itself.
#[test]
fn lenses_that_are_not_alike_are_refined_by_themselves() {
    let folder = Folder::new("lenses");
    let cameras = cameras();
    let photos = write_photos(&folder, &cameras);
    for n in [1, 3, 5] {
        let file = photos.join(format!("{n}.png"));
        let image = image::open(&file).unwrap();
        let part = image.crop_imm(20, 15, SIZE.0 - 40, SIZE.1 - 30);
        part.save(&file).unwrap();
    }
    let truth = cameras[0].camera.intrinsics.fu_px();
    let out = folder.file("out");
    // Both guesses are off, into different directions.
    let guesses: Vec<String> = (0..6)
        .map(|n| (truth * if n % 2 == 0 { 1.04 } else { 0.95 }).to_string())
        .collect();
    let focals = guesses.join(",");
    let worst = |lenses: &str| {
        let arguments = [
            "sfm",
            path(&photos),
            "-o",
            path(&out),
            "--focals-px",
            &focals,
            "--refine-focal",
            "--lenses",
            lenses,
        ];
        let result = json(&arguments);
        assert_eq!(result["num_registered"], 6);
        assert_eq!(
            result["images"][0]["distortion"],
            serde_json::json!([0.0, 0.0, 0.0, 0.0, 0.0])
        );
        let off = result["images"]
            .as_array()
            .unwrap()
            .iter()
            .map(|image| (image["focal_px"].as_f64().unwrap() / truth - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    let (one, alike, each) = (worst("one"), worst("alike"), worst("each"));
    println!("off by at most {one} with one lens, {alike} with two, {each} with six");
    assert!(
        one > 0.04 && alike < 0.02 && each < 0.03,
        "{one} {alike} {each}"
    );
    let wrong = ["sfm", path(&photos), "-o", path(&out), "--lenses", "some"];
    fails(&folder, &wrong, 2, "some");
}
