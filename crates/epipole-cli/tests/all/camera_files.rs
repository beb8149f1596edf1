//! `--camera` with files of other programs.

use crate::common::{Folder, fails, json, path};
use serde_json::{Value, json};

const EPIPOLE: &str = r#"{"image": {"width": 64, "height": 48}, "k": [50, 51, 31.5, 23.5],
    "distortion": {"model": "brown", "coefficients": [-0.1, 0.02, 0.001, -0.002, 0]}}"#;
const K: &str = "[50, 0, 31.5, 0, 51, 23.5, 0, 0, 1]";
const D: &str = "[-0.1, 0.02, 0.001, -0.002]";

fn k_of(result: &Value) -> Vec<f64> {
    let k = result["k"].as_array().unwrap();
    k.iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn one_camera_in_the_files_of_eight_programs() {
    let folder = Folder::new("camera-files");
    let photo = folder.blank("photo.png", (64, 48));
    let out = folder.file("out");
    let undistort = |file: &str, text: &str| {
        let file = folder.write(file, text);
        json(&[
            "undistort",
            path(&photo),
            "--camera",
            path(&file),
            "-o",
            path(&out),
        ])
    };
    let expected = k_of(&undistort("epipole.json", EPIPOLE));
    let sized = |keys: &str| format!("image_width: 64\nimage_height: 48\n{keys}");
    let matlab = json!({
        "K": [[50, 0, 32.5], [0, 51, 24.5], [0, 0, 1]], "ImageSize": [48, 64],
        "RadialDistortion": [-0.1, 0.02], "TangentialDistortion": [0.001, -0.002],
    });
    for (name, text) in [
        ("opencv.yml", sized(&format!("camera_matrix: {K}\ndistortion_coefficients: {D}\n"))),
        // Without a size it is the camera of the photograph.
        ("opencv.yaml", format!("K: {K}\nD: {D}\n")),
        ("ros.yaml", sized(&format!("distortion_model: plumb_bob\nK: {K}\nD: {D}\n"))),
        (
            "kalibr.yaml",
            format!("cam0:\n  camera_model: pinhole\n  intrinsics: [50, 51, 31.5, 23.5]\n  distortion_model: radtan\n  distortion_coeffs: {D}\n  resolution: [64, 48]\n"),
        ),
        ("cameras.txt", "1 OPENCV 64 48 50 51 32 24 -0.1 0.02 0.001 -0.002\n".to_owned()),
        (
            "transforms.json",
            r#"{"fl_x": 50, "fl_y": 51, "cx": 32, "cy": 24, "w": 64, "h": 48, "k1": -0.1, "k2": 0.02, "p1": 0.001, "p2": -0.002}"#.to_owned(),
        ),
        (
            "metashape.xml",
            "<calibration><projection>frame</projection><width>64</width><height>48</height><f>51</f><b1>-1</b1>\
             <k1>-0.1</k1><k2>0.02</k2><p1>-0.002</p1><p2>0.001</p2></calibration>".to_owned(),
        ),
        ("matlab.json", matlab.to_string()),
    ] {
        let found = k_of(&undistort(name, &text));
        let off = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9, "{name}: {found:?}, not {expected:?}");
    }
}

#[test]
fn one_of_several_cameras_is_chosen_by_size_or_name() {
    let folder = Folder::new("camera-chosen");
    let photo = folder.blank("photo.png", (64, 48));
    let out = folder.file("out");
    let text =
        "7 PINHOLE 32 24 25 25 16 12\n8 PINHOLE 64 48 50 50 32 24\n9 PINHOLE 64 48 70 70 32 24\n";
    let file = folder.write("cameras.txt", text);
    let file = path(&file);
    let arguments = |camera: &str| {
        [
            "undistort",
            path(&photo),
            "--camera",
            camera,
            "-o",
            path(&out),
        ]
        .map(str::to_owned)
    };
    let first = |camera: &str| {
        let arguments = arguments(camera);
        k_of(&json(&arguments.each_ref().map(|word| &**word)))[0]
    };
    assert!((first(file) - 50.0).abs() < 1e-9);
    assert!((first(&format!("{file}#9")) - 70.0).abs() < 1e-9);
    // A file may have the sign in its name.
    let unusual = folder.write("a#9", "7 PINHOLE 64 48 25 25 32 24\n");
    assert!((first(path(&unusual)) - 25.0).abs() < 1e-9);
    let refused = |camera: &str, message: &str| {
        let arguments = arguments(camera);
        fails(
            &folder,
            &arguments.each_ref().map(|word| &**word),
            1,
            message,
        );
    };
    refused(
        &format!("{file}#10"),
        "there is no camera 10 in it; there are 7, 8, 9",
    );
    let fov = folder.write("fov.txt", "1 FOV 64 48 50 50 32 24 0.5\n");
    refused(path(&fov), "camera model FOV is not supported");
    let other = folder.write("other.yaml", "a: 1\n");
    refused(path(&other), "its keys are a");
}

#[test]
fn a_rig_needs_a_motion() {
    let folder = Folder::new("camera-rig");
    let photo = folder.blank("photo.png", (64, 48));
    let out = folder.file("out");
    let text = format!("M1: {K}\nD1: {D}\nM2: {}\nD2: {D}\n", K.replace("50", "60"));
    let file = folder.write("intrinsics.yml", &text);
    let rectify = [
        "rectify",
        path(&photo),
        path(&photo),
        "--rig",
        path(&file),
        "-o",
        path(&out),
    ];
    fails(
        &folder,
        &rectify,
        1,
        "no motion between them (such as R and T)",
    );
    let right = [
        "undistort",
        path(&photo),
        "--camera",
        path(&file),
        "--right",
        "-o",
        path(&out),
    ];
    assert!(k_of(&json(&right))[0] > 55.0);
}
