//! Preparation of photographs before commands use them: downscaled, turned upright, undistorted,
//! selected from a video.

use crate::common::{Folder, epipole, exif, fails, json, moved, numbers, path};
use epipole::camera::RigidTransform;
use image::{RgbImage, imageops};
use nalgebra::Vector3;
use std::path::PathBuf;

/// A PNG file with an EXIF orientation.
fn oriented(folder: &Folder, name: &str, image: &RgbImage, orientation: u16) -> PathBuf {
    let file = folder.file(name);
    exif::write_png(&file, image, exif::orientation(orientation));
    file
}

/// Three photographs of the still life, from steps to the side.
fn three(folder: &Folder, size: (u32, u32)) -> Vec<PathBuf> {
    let take = |n: usize| {
        let name = format!("{n}.png");
        let step = RigidTransform::new(Vector3::new(-0.12 * n as f64, 0.0, 0.0), Vector3::zeros());
        folder.write_photo(&name, &moved(size, &step), size);
        folder.file(&name)
    };
    (0..3).map(take).collect()
}

#[test]
fn downscaled_photos_retain_the_focal_length_of_their_files() {
    let folder = Folder::new("reduced");
    let files = three(&folder, (480, 360));
    let out = folder.file("out");
    let sfm = |more: &[&str]| {
        let mut arguments = vec!["sfm"];
        arguments.extend(files.iter().map(|file| path(file)));
        arguments.extend(["-o", path(&out)]);
        arguments.extend(more);
        json(&arguments)
    };
    // 240 × 180, where a focal length of 600 is 300.
    let result = sfm(&["--max-megapixels", "0.0432", "--focal-px", "600"]);
    assert_eq!(result["num_registered"], 3);
    assert_eq!(result["images"][0]["focal_px"], 300.0);
    let k = sfm(&["--max-megapixels", "0.0432", "--k", "600,600,239.5,179.5"]);
    assert_eq!(k["images"], result["images"]);
    let each = sfm(&["--max-megapixels", "0.0432", "--focals-px", "600,600,600"]);
    assert_eq!(each["images"], result["images"]);
    let cameras = std::fs::read_to_string(out.join("cameras.txt")).unwrap();
    assert!(cameras.contains(" 240 180 "), "{cameras}");
    // A missing focal length is guessed, so all are refined.
    let guessed = sfm(&["--focals-px=600,-,600", "--keep-focal"]);
    assert_eq!(guessed["images"][0]["focal_px"], 600.0);
    assert_eq!(guessed["images"][1]["focal_px"], 576.0);
    assert_eq!(guessed["focal_refined"], false);
    assert_eq!(sfm(&["--focals-px=600,-,600"])["focal_refined"], true);

    // The same for pairs and features.
    let detected = json(&["detect", path(&files[0]), "--max-megapixels", "0.0432"]);
    assert_eq!(detected["image"]["width"], 240);
    let pair = [
        "two-view",
        path(&files[0]),
        path(&files[1]),
        "--max-megapixels",
        "0.0432",
    ];
    let essential = ["--focal-px", "600", "--model", "essential"];
    let found = json(&[&pair[..], &essential].concat());
    assert_eq!(numbers(&found["focals_px"]), [300.0, 300.0]);
    let right = found["matches"].as_array().unwrap().iter();
    assert!(right.map(|m| numbers(m)[0]).all(|u| u < 240.0));

    let base = ["sfm", path(&files[0]), path(&files[1]), "-o", path(&out)];
    let with = |more: &[&'static str]| [&base[..], more].concat();
    fails(
        &folder,
        &with(&["--focals-px", "600"]),
        2,
        "there are 1 for 2",
    );
    fails(&folder, &with(&["--focals-px", "600,-5"]), 2, "-5");
    fails(
        &folder,
        &with(&["--focals-px=600,-", "--focal-px", "5"]),
        2,
        "cannot be used",
    );
    for wrong in ["0", "-1", "nan", "inf"] {
        let wrong = format!("--max-megapixels={wrong}");
        let wrong = [&base[..], &[&wrong]].concat();
        fails(&folder, &wrong, 2, "max-megapixels");
    }
}

const CAMERA: &str = r#"{ "image": { "width": 80, "height": 60 }, "k": [70, 71, 42, 27],
    "distortion": { "model": "brown", "coefficients": [-0.2, 0.03, 0.004, -0.006, 0] } }"#;

#[test]
fn a_lens_belongs_to_the_sensor_however_the_camera_was_held() {
    let folder = Folder::new("upright");
    let camera = folder.write("camera.json", CAMERA);
    let image = RgbImage::from_fn(80, 60, |u, v| {
        image::Rgb([(3 * u) as u8, (4 * v) as u8, (u + v) as u8])
    });
    let lying = oriented(&folder, "lying.png", &image, 1);
    let upright = oriented(&folder, "upright.png", &image, 6);
    let out = folder.file("flat");
    let result = json(&[
        "undistort",
        path(&lying),
        path(&upright),
        "--camera",
        path(&camera),
        "-o",
        path(&out),
    ]);
    assert_eq!(result["files"].as_array().unwrap().len(), 2);
    let read = |name: &str| image::open(out.join(name)).unwrap().to_rgb8();
    assert_eq!(read("upright.png"), imageops::rotate90(&read("lying.png")));
    // Upright pixels without a word of how they came to be so are of no camera that is known.
    let silent = oriented(&folder, "silent.png", &imageops::rotate90(&image), 1);
    let other = folder.file("other");
    let arguments = [
        "undistort",
        path(&silent),
        "--camera",
        path(&camera),
        "-o",
        path(&other),
    ];
    fails(&folder, &arguments, 1, "the file has no orientation");
    // Structure from motion continues without the camera for that photograph, with a warning.
    let result = folder.file("result");
    let output = epipole(&[
        "sfm",
        path(&silent),
        path(&lying),
        "--camera",
        path(&camera),
        "-o",
        path(&result),
    ]);
    let output = String::from_utf8(output.stderr).unwrap();
    assert!(output.contains("is used for 1 of 2 images"), "{output}");
    assert!(
        output.contains("is upright, and its file has no orientation"),
        "{output}"
    );
}

#[test]
fn of_each_part_of_a_video_the_sharpest_frame_is_taken() {
    let folder = Folder::new("frames");
    let sharp = RgbImage::from_fn(120, 90, |u, v| {
        image::Rgb([if (u / 7 + v / 5) % 2 == 0 { 20 } else { 230 }; 3])
    });
    std::fs::create_dir_all(folder.file("walk")).unwrap();
    for (n, blur) in [3.0, 0.4, 2.0, 2.0, 3.0, 0.5, 0.4].into_iter().enumerate() {
        let name = format!("walk/{n:03}.png");
        imageops::blur(&sharp, blur)
            .save(folder.file(&name))
            .unwrap();
    }
    let (walk, out) = (folder.file("walk"), folder.file("photos"));
    let result = json(&["frames", path(&walk), "--num-frames", "2", "-o", path(&out)]);
    assert_eq!(result["num_frames"], 7);
    let names: Vec<&str> = (result["chosen"].as_array().unwrap().iter())
        .map(|one| one["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["001.png", "006.png"]);
    let copied = std::fs::read(out.join("006.png")).unwrap();
    assert!(copied == std::fs::read(walk.join("006.png")).unwrap());
    // More parts than frames: each is the sharpest of its own.
    let all = folder.file("all");
    let result = json(&[
        "frames",
        path(&walk),
        "--num-frames",
        "40",
        "-o",
        path(&all),
    ]);
    assert_eq!(result["files"].as_array().unwrap().len(), 7);
    let none = folder.file("none");
    fails(
        &folder,
        &["frames", path(&none), "-o", path(&out)],
        1,
        "there is no such file",
    );
}

#[test]
fn photos_are_written_as_the_model_describes_them() {
    let folder = Folder::new("images");
    let files = three(&folder, (480, 360));
    let out = folder.file("out");
    let sfm = |files: &[PathBuf], out: &PathBuf, more: &[&str]| {
        let mut arguments = vec!["sfm"];
        arguments.extend(files.iter().map(|file| path(file)));
        arguments.extend(["--images", "--focal-px", "600", "-o", path(out)]);
        arguments.extend(more);
        arguments.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    let run = |arguments: &[String]| json(&arguments.iter().map(|a| &**a).collect::<Vec<_>>());
    let listed = |out: &PathBuf| std::fs::read_to_string(out.join("images.txt")).unwrap();

    // As they are: the same bytes.
    let result = run(&sfm(&files, &out, &[]));
    assert_eq!(result["num_registered"], 3);
    for (n, file) in files.iter().enumerate() {
        let written = out.join(format!("images/{n}.png"));
        assert_eq!(
            std::fs::read(written).unwrap(),
            std::fs::read(file).unwrap()
        );
        assert!(listed(&out).contains(&format!(" {n}.png\n")));
    }
    // Reduced: as large as the camera, under another name; the result names those given.
    let result = run(&sfm(&files, &out, &["--max-megapixels", "0.0432"]));
    assert_eq!(result["images"][0]["name"], "0.png");
    for (n, file) in files.iter().enumerate() {
        let written = image::open(out.join(format!("images/{n}.jpg")))
            .unwrap()
            .into_rgb8();
        assert_eq!(written.dimensions(), (240, 180));
        assert!(listed(&out).contains(&format!(" {n}.jpg\n")));
        let small = image::open(file).unwrap().into_rgb8();
        let small = imageops::resize(&small, 240, 180, imageops::FilterType::Triangle);
        let off = written
            .iter()
            .zip(small.iter())
            .map(|(a, b)| f64::from(a.abs_diff(*b)));
        assert!(off.sum::<f64>() / (240.0 * 180.0 * 3.0) < 4.0);
    }
    // Neither input files nor other results are overwritten.
    let inputs: Vec<PathBuf> = (0..3)
        .map(|n| out.join(format!("images/{n}.jpg")))
        .collect();
    let refused = |arguments: &[String], why: &str| {
        let arguments: Vec<&str> = arguments.iter().map(|a| &**a).collect();
        fails(&folder, &arguments, 2, why);
    };
    let before = std::fs::read(&inputs[0]).unwrap();
    let smaller = ["--max-megapixels", "0.03"];
    refused(&sfm(&inputs, &out, &smaller), "would overwrite it");
    assert_eq!(std::fs::read(&inputs[0]).unwrap(), before);
    let beside = folder.file("0.jpg");
    std::fs::copy(&inputs[0], &beside).unwrap();
    let twice = [files[0].clone(), beside];
    let other = folder.file("other");
    refused(
        &sfm(&twice, &other, &smaller),
        "two images would be written to ",
    );
}

#[test]
fn a_sensor_width_gives_the_focal_length_of_millimeters() {
    let folder = Folder::new("millimeters");
    let files = three(&folder, (320, 240));
    for file in &files {
        let image = image::open(file).unwrap().into_rgb8();
        exif::write_png(file, &image, exif::millimeters(5));
    }
    let output = |more: &[&str]| {
        let photos = [path(&files[0]), path(&files[1])];
        let out = folder.file("out");
        let arguments = [&["sfm", "-o", path(&out)], &photos[..], more].concat();
        String::from_utf8(epipole(&arguments).stderr).unwrap()
    };
    let without = output(&[]);
    assert!(
        without.contains("taking 384 px") && without.contains("have 5.0 mm"),
        "{without}"
    );
    let with = output(&["--sensor-width-mm", "4"]);
    assert!(
        with.contains("taking 400 px, from the image's EXIF data"),
        "{with}"
    );
    let inspected = json(&["inspect", path(&files[0])]);
    assert!(
        inspected["notes"]
            .to_string()
            .contains("give --sensor-width-mm")
    );
}
