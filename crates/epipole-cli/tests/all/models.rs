//! Models of other programs: `convert` and `inspect`.

use crate::common::{Folder, fails, json, path};
use serde_json::{Value, json};
use std::path::Path;

const CAMERAS: &str =
    "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n5 RADIAL 640 480 500 320 240 -0.1 0.02\n";
const IMAGES: &str = "# IMAGE_ID\n2 1 0 0 0 0 0 0 5 my photo 1.jpg\n320 240 9 10.5 20.5 -1\n\
                      3 1 0 0 0 -1 0 0 5 my photo 2.jpg\n220 240 9\n8 1 0 0 0 0 1 0 5 é.png\n\n";
const POINTS: &str = "9 0 0 5 10 20 30 0.25 2 0 3 0\n";

fn text_model(folder: &Folder, name: &str) -> String {
    let place = folder.file(name);
    std::fs::create_dir_all(&place).unwrap();
    folder.write(&format!("{name}/cameras.txt"), CAMERAS);
    folder.write(&format!("{name}/images.txt"), IMAGES);
    folder.write(&format!("{name}/points3D.txt"), POINTS);
    path(&place).to_owned()
}

/// Names in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = files
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn notes(result: &Value) -> String {
    result["notes"].to_string()
}

#[test]
fn a_model_is_inspected() {
    let folder = Folder::new("inspect");
    let model = text_model(&folder, "model");
    let result = json(&["inspect", &model]);
    assert_eq!(result["kind"], "colmap-text");
    let counts = json!({
        "cameras": 1, "images": 3, "keypoints": 3, "points": 1, "observations": 2, "rigs": 0,
    });
    assert_eq!(result["counts"], counts);
    assert_eq!(
        result["cameras"][0]["k"],
        json!([500.0, 500.0, 319.5, 239.5])
    );
    assert_eq!(
        result["cameras"][0]["distortion"],
        json!([-0.1, 0.02, 0.0, 0.0, 0.0])
    );
    // It is seen exactly in the first image; in the second, 0.4 % of the offset are bent inwards.
    let bent = 1.0 - 0.1 * 0.04 + 0.02 * 0.0016;
    let mean_px = result["mean_reprojection_px"].as_f64().unwrap();
    assert!((mean_px - 50.0 * (1.0 - bent)).abs() < 1e-9, "{mean_px}");
    let notes = notes(&result);
    assert!(notes.contains("2 of 3 names have blanks"), "{notes}");
    assert!(notes.contains("1 of 3 images see no point"), "{notes}");
    // A file of the model stands for all of it.
    let file = json(&["inspect", &format!("{model}/images.txt")]);
    assert_eq!(file["counts"], counts);
}

#[test]
fn a_model_is_converted_and_back() {
    let folder = Folder::new("convert");
    let model = text_model(&folder, "model");
    let place = |name: &str| path(&folder.file(name)).to_owned();
    let (binary, text) = (place("binary"), place("text"));
    let result = json(&["convert", &model, &binary]);
    assert_eq!(
        (&result["read"], &result["kind"]),
        (&json!("colmap-text"), &json!("colmap-binary"))
    );
    assert_eq!(result["written"].as_array().unwrap().len(), 3);
    assert_eq!(result["notes"], json!([]));
    let back = json(&["convert", &binary, &text]);
    assert_eq!(back["kind"], "colmap-text");
    assert!(notes(&back).contains("2 names have blanks"));
    let read = |name: &str| std::fs::read_to_string(folder.file(name)).unwrap();
    assert_eq!(
        read("text/cameras.txt").lines().last(),
        Some("5 OPENCV 640 480 500 500 320 240 -0.1 0.02 0 0")
    );
    let list = read("text/images.txt");
    let list: Vec<&str> = list.lines().skip(2).collect();
    assert_eq!(list, IMAGES.lines().skip(1).collect::<Vec<_>>());
    assert_eq!(
        read("text/points3D.txt").lines().last(),
        Some("9 0 0 5 10 20 30 0.25 2 0 3 0")
    );
    for (name, kind) in [
        ("x.ply", "ply"),
        ("transforms.json", "transforms"),
        ("sfm_data.json", "openmvg"),
        ("bundle.out", "bundler"),
    ] {
        let result = json(&["convert", &binary, &place(name)]);
        assert_eq!(result["kind"], kind);
        let again = json(&["inspect", &place(name)]);
        assert_eq!(again["kind"], kind);
        assert_eq!(again["counts"]["points"], 1, "{name}");
        let images = if kind == "ply" { 0 } else { 3 };
        assert_eq!(again["counts"]["images"], images, "{name}");
    }
    // The name asks for cameras alone.
    for (name, kind) in [
        ("camera.json", "Epipole"),
        ("cameras.txt", "COLMAP"),
        ("c.yml", "OpenCV"),
    ] {
        let result = json(&["convert", &binary, &place(name)]);
        assert_eq!(result["kind"], kind, "{name}");
        let again = json(&["inspect", &place(name)]);
        assert_eq!(again["counts"], json!({ "cameras": 1 }), "{name}");
    }
    json(&["convert", &binary, &place("model.glb")]);
    assert_eq!(
        std::fs::read(folder.file("model.glb")).unwrap()[..4],
        *b"glTF"
    );
    let page = json(&["convert", &binary, &place("model.html")]);
    assert_eq!(page["kind"], "html");
    let text = std::fs::read_to_string(folder.file("model.html")).unwrap();
    assert!(text.contains("<title>3-D model: "), "{text}");
}

#[test]
fn a_folder_that_is_written_again_keeps_only_what_is_not_ours() {
    let folder = Folder::new("again");
    let model = text_model(&folder, "model");
    let out = folder.file("out");
    let to = |format: &str| json(&["convert", &model, path(&out), "--to", format]);
    to("transforms");
    folder.write("out/notes.txt", "mine");
    to("colmap-binary");
    to("colmap-text");
    let expected = [
        ".epipole-files",
        "cameras.txt",
        "images.txt",
        "notes.txt",
        "points3D.txt",
        "sparse_pc.ply",
        "transforms.json",
    ];
    assert_eq!(names(&out), expected);
    folder.write("out/cameras.bin", "mine");
    let arguments = ["convert", &model, path(&out), "--to", "colmap-text"];
    fails(&folder, &arguments, 1, "COLMAP would read this file");
}

#[test]
fn a_model_is_not_mixed_with_rigs_of_another_one() {
    let folder = Folder::new("rigs");
    let model = text_model(&folder, "model");
    for (format, name) in [
        ("colmap-binary", "rigs.bin"),
        ("colmap-binary", "frames.bin"),
        ("colmap-text", "rigs.txt"),
        ("colmap-text", "frames.txt"),
    ] {
        let out = folder.file(format);
        std::fs::create_dir_all(&out).unwrap();
        std::fs::write(out.join(name), "mine").unwrap();
        let arguments = ["convert", &model, path(&out), "--to", format];
        fails(
            &folder,
            &arguments,
            1,
            &format!("{name}: this file belongs to another model"),
        );
        std::fs::remove_file(out.join(name)).unwrap();
        json(&arguments);
    }
    let out = folder.file("sfm");
    std::fs::create_dir_all(out.join("component2")).unwrap();
    std::fs::write(out.join("component2/frames.bin"), "mine").unwrap();
    let photo = folder.blank("a.png", (64, 48));
    let arguments = ["sfm", path(&photo), path(&photo), "-o", path(&out)];
    fails(
        &folder,
        &arguments,
        1,
        "frames.bin: this file belongs to another model",
    );
}

#[test]
fn what_is_read_is_not_written_over() {
    let folder = Folder::new("over");
    let model = text_model(&folder, "model");
    fails(
        &folder,
        &["convert", &model, &model, "--to", "colmap-text"],
        2,
        "would be written over",
    );
    let points = folder.file("points.ply");
    json(&["convert", &model, path(&points)]);
    fails(
        &folder,
        &["convert", path(&points), path(&points)],
        2,
        "would be written over",
    );
    json(&["convert", &model, &model, "--to", "colmap-binary"]);
}

#[test]
fn cameras_keep_their_numbers() {
    let folder = Folder::new("camera-numbers");
    let model = folder.file("model");
    std::fs::create_dir_all(&model).unwrap();
    folder.write(
        "model/cameras.txt",
        "7 PINHOLE 640 480 500 501 320 240\n3 PINHOLE 64 48 50 50 32 24\n",
    );
    folder.write(
        "model/images.txt",
        "1 1 0 0 0 0 0 0 3 a b.jpg\n\n2 1 0 0 0 1 0 0 7 c.jpg\n\n",
    );
    let [binary, text, cameras] = ["binary", "text", "cameras.txt"].map(|name| folder.file(name));
    json(&[
        "convert",
        path(&model),
        path(&binary),
        "--to",
        "colmap-binary",
    ]);
    json(&["convert", path(&binary), path(&text), "--to", "colmap-text"]);
    json(&["convert", path(&binary), path(&cameras)]);
    let ids = |file: &std::path::Path, place: usize| -> Vec<String> {
        let text = std::fs::read_to_string(file).unwrap();
        let lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty());
        lines
            .map(|line| line.split(' ').nth(place).unwrap().to_owned())
            .collect()
    };
    assert_eq!(ids(&text.join("cameras.txt"), 0), ["7", "3"]);
    assert_eq!(ids(&text.join("images.txt"), 8), ["3", "7"]);
    assert_eq!(ids(&cameras, 0), ["7", "3"]);
}

#[test]
fn a_damaged_model_is_not_taken_for_a_table() {
    let folder = Folder::new("damaged-model");
    let text = "# Bundle file v0.3\n1 0\n500 0 0\n1 0 0\n0 2 0\n0 0 1\n0 0 0\n";
    let file = folder.write("bundle.out", text);
    fails(
        &folder,
        &["inspect", path(&file)],
        1,
        "camera 0 has no rotation",
    );
    let packed = folder.file("problem.txt.bz2");
    std::fs::write(&packed, b"BZh91AY&SY").unwrap();
    let out = folder.file("out.txt");
    for arguments in [
        vec!["inspect", path(&packed)],
        vec!["ba", path(&packed), "-o", path(&out)],
    ] {
        fails(&folder, &arguments, 1, "compressed (bzip2): unpack it");
    }
}

#[test]
fn cameras_without_an_image_size_are_inspected() {
    let folder = Folder::new("without-size");
    let matrix = folder.write("K.txt", "500 0 320\n0 500 240\n0 0 1\n");
    let found = json(&["inspect", path(&matrix)]);
    assert_eq!(found["cameras"][0]["width"], Value::Null);
    assert_eq!(found["cameras"][0]["k"][0], 500.0);
    let note = found["notes"][0].as_str().unwrap();
    assert!(note.starts_with("the file has no image size"), "{note}");
    let damaged = folder.write("camera.yml", "camera_matrix: [[500, 0], [0, 500]]\n");
    fails(&folder, &["inspect", path(&damaged)], 1, "camera_matrix");
}

#[test]
fn cameras_are_inspected_with_convention_and_lens() {
    let folder = Folder::new("inspect-cameras");
    let lines = "1 PINHOLE 640 480 500 501 320 240\n2 RADIAL 640 480 500 320 240 -0.1 0.02\n";
    let file = folder.write("cameras.txt", lines);
    let stdout =
        String::from_utf8(crate::common::epipole(&["inspect", path(&file)]).stdout).unwrap();
    for words in [
        "pixel centers at halves in the file, converted to integers",
        "principal point (319.50, 239.50), no distortion",
        "brown lens -0.1, 0.02, 0, 0, 0",
    ] {
        assert!(stdout.contains(words), "{stdout}");
    }
}

#[test]
fn what_is_no_model_is_named() {
    let folder = Folder::new("no-model");
    let model = text_model(&folder, "model");
    let empty = folder.file("empty");
    std::fs::create_dir_all(&empty).unwrap();
    let note = folder.write("note.json", "{}");
    fails(
        &folder,
        &["inspect", path(&empty)],
        1,
        "there is no model in this folder",
    );
    fails(
        &folder,
        &["inspect", path(&note)],
        1,
        "note.json: this is no model",
    );
    fails(
        &folder,
        &["inspect", path(&folder.file("none"))],
        1,
        "there is no such file",
    );
    let out = folder.file("out.gltf");
    fails(
        &folder,
        &["convert", &model, path(&out)],
        2,
        "names no format",
    );
    let out = folder.file("out.json");
    let fisheye = CAMERAS.replace(
        "RADIAL 640 480 500 320 240 -0.1 0.02",
        "DIVISION 640 480 500 500 320 240 -0.1",
    );
    folder.write("model/cameras.txt", &fisheye);
    fails(
        &folder,
        &["convert", &model, path(&out)],
        1,
        "no division lens",
    );
    folder.write("model/images.txt", "1 1 0 0 0 0 0\n");
    fails(
        &folder,
        &["inspect", &model],
        1,
        "images.txt, line 1: the translation is missing",
    );
    std::fs::remove_file(folder.file("model/images.txt")).unwrap();
    fails(
        &folder,
        &["inspect", &model],
        1,
        "needs images.txt beside cameras.txt",
    );
}

const RIG: &str = "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   \
    dt: d\n   data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]\nD1: [ 0.1, 0.02, 0., 0. ]\n\
    M2: [510, 0, 321, 0, 511, 241, 0, 0, 1]\nD2: [ -0.1, 0.02, 0., 0. ]\n\
    R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [-0.25, 0., 0.]\n";

#[test]
fn cameras_are_inspected_and_converted() {
    let folder = Folder::new("convert-cameras");
    let rig = folder.write("rig.yml", RIG);
    let result = json(&["inspect", path(&rig)]);
    assert_eq!(result["kind"], "cameras of OpenCV");
    assert_eq!(result["counts"], json!({ "cameras": 2 }));
    assert_eq!(
        result["cameras"][1]["k"],
        json!([510.0, 511.0, 321.0, 241.0])
    );
    assert_eq!(result["right_from_left"], json!([-0.25, 0.0, 0.0]));
    // To our own file and back, every number stays.
    let place = |name: &str| path(&folder.file(name)).to_owned();
    let ours = json(&["convert", path(&rig), &place("rig.json")]);
    assert_eq!(ours["kind"], "Epipole");
    let back = json(&["convert", &place("rig.json"), &place("back.yaml")]);
    assert_eq!(back["read"], "cameras of Epipole");
    let again = json(&["inspect", &place("back.yaml")]);
    assert_eq!(again["cameras"][0]["k"], result["cameras"][0]["k"]);
    assert_eq!(again["right_from_left"], result["right_from_left"]);
    // COLMAP's file has no motion.
    json(&["convert", path(&rig), &place("cameras.txt")]);
    let text = std::fs::read_to_string(folder.file("cameras.txt")).unwrap();
    assert!(
        text.contains("1 OPENCV 640 480 500 501 320.5 240.5 0.1 0.02 0 0\n"),
        "{text}"
    );
    fails(
        &folder,
        &["convert", path(&rig), &place("model")],
        2,
        "names no format",
    );
    fails(
        &folder,
        &["convert", path(&rig), &place("x.ply")],
        2,
        "cannot become a model",
    );
}

#[test]
fn trajectories_are_inspected_and_converted() {
    let folder = Folder::new("convert-paths");
    let tum = folder.write(
        "path.txt",
        "1.5 0 0 0 0 0 0 1\n1.6 3 4 0 0 0 0 1\n1.8 3 4 2 0 0 1 0\n",
    );
    let result = json(&["inspect", path(&tum)]);
    assert_eq!(result["kind"], "trajectory of TUM");
    assert_eq!(result["counts"], json!({ "poses": 3 }));
    assert_eq!(result["length"], json!(7.0));
    assert!((result["seconds"].as_f64().unwrap() - 0.3).abs() < 1e-12);
    let place = |name: &str| path(&folder.file(name)).to_owned();
    json(&["convert", path(&tum), &place("path.csv")]);
    let back = json(&[
        "convert",
        &place("path.csv"),
        &place("back.txt"),
        "--to",
        "tum",
    ]);
    assert_eq!(back["read"], "trajectory of EuRoC");
    let same = json(&["compare", path(&tum), &place("back.txt"), "--align", "none"]);
    assert_eq!(same["ate_rmse_m"], json!(0.0));
    json(&["convert", path(&tum), &place("kitti.txt"), "--to", "kitti"]);
    // The poses of a model have no times.
    let model = text_model(&folder, "model");
    json(&["convert", &model, &place("poses.txt"), "--to", "kitti"]);
    let poses = json(&["inspect", &place("poses.txt")]);
    assert_eq!(poses["counts"], json!({ "poses": 3 }));
    fails(
        &folder,
        &["convert", &model, &place("poses.tum"), "--to", "tum"],
        1,
        "needs a time for each pose",
    );
    fails(
        &folder,
        &["convert", path(&tum), &place("x.yml")],
        2,
        "has no cameras",
    );
}

#[test]
fn other_files_are_inspected() {
    let folder = Folder::new("inspect-others");
    let photo = folder.blank("photo.png", (40, 30));
    let result = json(&["inspect", path(&photo)]);
    assert_eq!(result["kind"], "photograph");
    assert_eq!(result["counts"], json!({ "width": 40, "height": 30 }));
    let graph = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 4 4\nFIX 0\n\
                 EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_PRIOR_SE2 1 1 0 0 1 0 0 1 0 1\n";
    let result = json(&["inspect", path(&folder.write("graph", graph))]);
    let counts = json!({ "vertices": 2, "landmarks": 1, "edges": 1, "priors": 1, "fixed": 1 });
    assert_eq!(result["counts"], counts);
    let bal = "1 1 1\n0 0 5 6\n0 0 0 0 0 0 500 0 0\n1 2 3\n";
    let result = json(&["inspect", path(&folder.write("bal.txt", bal))]);
    let counts = json!({ "cameras": 1, "points": 1, "observations": 1 });
    assert_eq!(result["counts"], counts);
    for (table, kind) in [
        ("1 2 3 4\n5 6 7 8\n", "matches of two images (u1 v1 u2 v2)"),
        (
            "1;2;3;4;5,5\n5;6;7;8;9\n",
            "points of the world with their pixels (x y z u v)",
        ),
        ("1 2\n3 4\n", "points of an image (u v)"),
    ] {
        let result = json(&["inspect", path(&folder.write("table.txt", table))]);
        assert_eq!(result["kind"], kind);
        assert_eq!(result["counts"], json!({ "rows": 2 }));
    }
    for (name, text, why) in [
        (
            "graph",
            "VERTEX_SE2 0 0 0\n",
            "graph: line 1: VERTEX_SE2 needs 4 values",
        ),
        (
            "c.txt",
            "1 FOV 4 4 5 5 2 2 .9\n",
            "c.txt: camera 1 is left out: camera model FOV is not supported",
        ),
        (
            "cut.yml",
            "%YAML:1.0\n---\nK: [1, 2",
            "cut.yml: line 4: while parsing",
        ),
        (
            "path.txt",
            "0 0 0 0 0 0 0 0\n",
            "path.txt: line 1: the quaternion is zero",
        ),
        ("cut.ply", "ply\nformat ascii 1.0\n", "cut.ply: the header"),
        (
            "a.heic",
            "\0\0\0\u{18}ftypheic",
            "a.heic: the image cannot be read: it is a HEIC file",
        ),
        ("none", "", "none: the file is empty"),
        ("words", "hello\n", "words: this is no model"),
    ] {
        let file = folder.write(name, text);
        fails(&folder, &["inspect", path(&file)], 1, why);
    }
    let place = folder.file("out.txt");
    let why = "photo.png: this is an image, where a model, cameras or a trajectory is expected";
    fails(&folder, &["convert", path(&photo), path(&place)], 1, why);
}
