//! Files as people have them: photographs of telephones, webcams and thermal cameras, folders,
//! spreadsheets.

use crate::common::{Folder, epipole, fails, field, json, matrix, numbers, path};
use image::{GrayImage, Luma};
use nalgebra::{Point2, Vector3};
use serde_json::json;

/// Standard error of a command that succeeds.
fn stderr_of(arguments: &[&str]) -> String {
    let output = epipole(arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{stderr}");
    stderr
}

#[test]
fn a_frame_of_a_webcam_has_features() {
    let Some(file) = field("28/mjpeg_no_dht.jpg") else {
        return;
    };
    let result = json(&["detect", path(&file)]);
    assert!(result["keypoints"].as_array().unwrap().len() > 100);
}

#[test]
fn thermal_pictures_are_as_their_twins_in_eight_bits() {
    let folder = Folder::new("thermal");
    let mut files = Vec::new();
    for n in 0..5 {
        let Some(file) = field(&format!("11/thermal0{n}.png")) else {
            return;
        };
        files.push(file);
    }
    // Linear from the least value to the largest.
    let deep = image::open(&files[0]).unwrap().into_luma16();
    let (least, most) = (deep.iter().min().unwrap(), deep.iter().max().unwrap());
    let scaled = |value: u16| f64::from(value - least) / f64::from(most - least);
    let twin = GrayImage::from_fn(deep.width(), deep.height(), |u, v| {
        Luma([(255.0 * scaled(deep.get_pixel(u, v).0[0])).round() as u8])
    });
    let twin_file = folder.file("twin.png");
    twin.save(&twin_file).unwrap();
    let features = json(&["detect", path(&files[0])]);
    assert_eq!(
        features["keypoints"],
        json(&["detect", path(&twin_file)])["keypoints"]
    );
    assert!(features["keypoints"].as_array().unwrap().len() > 160);
    let sentence = stderr_of(&["detect", path(&files[0])]);
    assert!(
        sentence.contains("the values from 51241 to 52181 are in use"),
        "{sentence}"
    );
    let full = json(&["detect", path(&files[0]), "--range", "full"]);
    assert!(full["keypoints"].as_array().unwrap().is_empty());
    let arguments = ["detect", path(&files[0]), "--range", "51241,52181"];
    assert_eq!(json(&arguments)["keypoints"], features["keypoints"]);
    assert_eq!(stderr_of(&arguments), "");
    fails(
        &folder,
        &["detect", path(&files[0]), "--range", "9,5"],
        2,
        "above the first",
    );

    let mut calibrate = vec!["calibrate", "--board", "7x5"];
    calibrate.extend(files.iter().map(|file| path(file)));
    let result = json(&calibrate);
    let views = result["views"].as_array().unwrap();
    assert_eq!(views.len(), 5);
    assert!(views.iter().all(|view| view["found"] == true));
}

#[test]
fn frames_follow_each_other_by_their_numbers() {
    let (Some(frames), Some(truth)) = (field("09/frames"), field("09/truth_centers.txt")) else {
        return;
    };
    let k = "320,320,159.5,119.5";
    let result = json(&["odometry", path(&frames), "--k", k]);
    let frames: Vec<_> = result["frames"].as_array().unwrap().iter().collect();
    let expected: Vec<String> = (1..=12).map(|n| format!("frame{n}.jpg")).collect();
    let names: Vec<&str> = frames
        .iter()
        .map(|one| one["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, expected);
    let truth: Vec<Vector3<f64>> = (std::fs::read_to_string(truth).unwrap().lines())
        .filter(|line| line.starts_with("frame"))
        .map(|line| {
            let words = line.split_whitespace().skip(1);
            Vector3::from_iterator(words.map(|word| word.parse().unwrap()))
        })
        .collect();
    let centers: Vec<Vector3<f64>> = (frames.iter())
        .map(|one| Vector3::from_row_slice(&numbers(&one["world_from_cam"]["translation"])))
        .collect();
    let length = |centers: &[Vector3<f64>]| -> f64 {
        centers.windows(2).map(|two| (two[1] - two[0]).norm()).sum()
    };
    // The path in units of the distance from its start to its end: no step leads back.
    let shape = |centers: &[Vector3<f64>]| length(centers) / (centers[11] - centers[0]).norm();
    assert!((length(&truth) - 1.49).abs() < 0.01);
    assert!((shape(&centers) / shape(&truth) - 1.0).abs() < 0.01);
}

/// The exact fundamental matrix has its only minimum at 319.9 px.
#[test]
fn two_frames_determine_the_focal_length_and_its_deviation() {
    let Some(frames) = field("09/frames") else {
        return;
    };
    let files = ["frame1.jpg", "frame6.jpg"].map(|name| frames.join(name));
    let pair = ["two-view", path(&files[0]), path(&files[1])];
    let essential = [&pair[..], &["--model", "essential"]].concat();
    let result = json(&essential);
    let focal_px = numbers(&result["focals_px"])[0];
    let message = stderr_of(&essential);
    let std_px = message.split("± ").nth(1).unwrap().trim();
    let std_px: f64 = std_px.split_whitespace().next().unwrap().parse().unwrap();
    assert!(std_px < 10.0, "{message}");
    assert!(
        (focal_px - 320.0).abs() < 2.0 * std_px,
        "{focal_px}: {message}"
    );
}

#[test]
fn photos_of_two_folders_have_distinct_names() {
    let Some(frames) = field("09/frames") else {
        return;
    };
    let folder = Folder::new("two-folders");
    for (part, first) in [("A", 1), ("B", 5)] {
        std::fs::create_dir_all(folder.file(&format!("images/{part}"))).unwrap();
        for n in 0..4 {
            let copy = folder.file(&format!("images/{part}/00000{n}.jpg"));
            std::fs::copy(frames.join(format!("frame{}.jpg", first + n)), copy).unwrap();
        }
    }
    let (images, out) = (folder.file("images"), folder.file("out"));
    let k = "320,320,159.5,119.5";
    fails(
        &folder,
        &["sfm", path(&images), "--k", k, "-o", path(&out)],
        1,
        "--recursive",
    );
    let sfm = [
        "sfm",
        path(&images),
        "--recursive",
        "--k",
        k,
        "--images",
        "-o",
        path(&out),
    ];
    let result = json(&sfm);
    assert_eq!(result["num_registered"], 8);
    let names: Vec<String> = (result["images"].as_array().unwrap().iter())
        .map(|image| image["name"].as_str().unwrap().to_owned())
        .collect();
    let expected: Vec<String> = ["A", "B"]
        .iter()
        .flat_map(|part| (0..4).map(move |n| format!("{part}/00000{n}.jpg")))
        .collect();
    assert_eq!(names, expected);
    let model = std::fs::read_to_string(out.join("images.txt")).unwrap();
    for name in &expected {
        assert!(model.contains(&format!(" {name}\n")), "{name}");
        let written = std::fs::read(out.join("images").join(name)).unwrap();
        assert_eq!(written, std::fs::read(images.join(name)).unwrap());
    }
    let chosen = folder.file("chosen");
    let frames = [
        "frames",
        path(&images),
        "--recursive",
        "--num-frames",
        "8",
        "-o",
        path(&chosen),
    ];
    assert_eq!(json(&frames)["chosen"].as_array().unwrap().len(), 8);
    assert!(chosen.join("B/000003.jpg").exists());
}

#[test]
fn matches_are_read_as_spreadsheets_and_programs_write_them() {
    let folder = Folder::new("spreadsheets");
    let shift = |file: &str| {
        let file = field(&format!("17/{file}"))?;
        let result = json(&["fit", "--model", "similarity", path(&file)]);
        let model = numbers(&result["model"]);
        let expected = [1.0, 0.0, 10.0, 0.0, 1.0, -5.0, 0.0, 0.0, 1.0];
        let off = model.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9, "{file:?}: {model:?}");
        Some(())
    };
    for file in [
        "fortran_d.txt",
        "numpy_brackets.txt",
        "pandas_index.csv",
        "points.csv",
        "quoted.csv",
        "semicolon.csv",
        "semicolon_comma.csv",
        "tab_comma.txt",
    ] {
        if shift(file).is_none() {
            return;
        }
    }
    for (file, why) in [
        ("index_no_header.csv", "the first column counts the rows"),
        ("space_comma.txt", "line 1: decimal comma in \"154,92\""),
    ] {
        let file = field(&format!("17/{file}")).unwrap();
        fails(
            &folder,
            &["fit", "--model", "similarity", path(&file)],
            1,
            why,
        );
    }
}

#[test]
fn four_matches_give_their_homography() {
    let folder = Folder::new("four");
    let text = "141 131 318 256\n480 159 534 372\n493 630 316 670\n64 601 73 473\n";
    let file = folder.write("four.txt", text);
    let fit = ["fit", "--model", "homography", path(&file)];
    let h = matrix(&json(&fit)["model"]);
    for line in text.lines() {
        let row: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        let mapped = h * Point2::new(row[0], row[1]).to_homogeneous();
        let mapped = Point2::from_homogeneous(mapped).unwrap();
        assert!(
            (mapped - Point2::new(row[2], row[3])).norm() < 1e-9,
            "{mapped}"
        );
    }
    let sentence = stderr_of(&fit);
    assert!(sentence.contains("nothing verifies it"), "{sentence}");
    assert!(!sentence.contains("not significant"), "{sentence}");
    // A fifth one that does not agree is another matter.
    let wrong = folder.write("five.txt", &format!("{text}300 300 900 20\n"));
    let sentence = stderr_of(&["fit", "--model", "homography", path(&wrong)]);
    assert!(sentence.contains("not significant"), "{sentence}");
}

#[test]
fn pose_graphs_have_priors_or_name_the_cause() {
    let folder = Folder::new("graphs");
    let (Some(commas), Some(prior)) = (field("12/commas.g2o"), field("12/prior.g2o")) else {
        return;
    };
    let why = "line 1: “0,000000” has a decimal comma";
    fails(&folder, &["posegraph", path(&commas)], 1, why);
    // The prior places vertex 1 at (5, 0, 0); the edges carry the others along, as in g2o.
    let placed = folder.file("placed.g2o");
    let result = json(&["posegraph", path(&prior), "-o", path(&placed)]);
    assert_eq!(result["num_priors"], 1);
    assert!(result["final_chi2"].as_f64().unwrap() < 1e-12, "{result}");
    let text = std::fs::read_to_string(&placed).unwrap();
    for (id, x, y, z) in [
        (1, 5.0, 0.0, 0.0),
        (2, 5.12, 0.03, -0.02),
        (3, 5.28, 0.03, -0.01),
    ] {
        let start = format!("VERTEX_SE3:QUAT {id} ");
        let line = text
            .lines()
            .find_map(|line| line.strip_prefix(&start))
            .unwrap();
        let found: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        for (found, expected) in found.iter().zip([x, y, z]) {
            assert!((found - expected).abs() < 1e-6, "{line}");
        }
    }
    let lines = text.lines();
    assert_eq!(
        lines
            .filter(|line| line.starts_with("EDGE_SE3_PRIOR 1 0 5 0 0"))
            .count(),
        1
    );
}

#[test]
fn landmarks_of_pose_graphs_count_and_others_get_a_sentence() {
    let folder = Folder::new("landmarks");
    let graph = folder.write(
        "landmarks.g2o",
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 2 0 0\nVERTEX_XY 2 4 4\n\
         EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 2 4 0 1 0 1\n\
         EDGE_SE2_XY 1 2 2 0 1 0 1\nEDGE_BEARING_SE2_XY 1 2 0.7 1\n",
    );
    let sentence = stderr_of(&["posegraph", path(&graph)]);
    assert!(
        sentence.contains("warning: left out: 1 measurement. "),
        "{sentence}"
    );
    let result = json(&["posegraph", path(&graph)]);
    // Measured 4 ahead of the start, and 2 ahead of what is 1 ahead: each bears a third of 1.
    assert!(
        (result["final_chi2"].as_f64().unwrap() - 1.0 / 3.0).abs() < 1e-9,
        "{result}"
    );
    assert_eq!(
        (&result["num_vertices"], &result["num_landmarks"]),
        (&json!(2), &json!(1))
    );
}

#[test]
fn a_phone_photo_of_any_size_is_downscaled() {
    let folder = Folder::new("telephone");
    // 64.1 megapixels.
    let large = GrayImage::from_fn(9248, 6936, |u, v| Luma([(u / 64 * 31 + v / 64 * 57) as u8]));
    let file = folder.file("photo.jpg");
    large.save(&file).unwrap();
    let result = json(&["detect", path(&file), "--max-megapixels", "1"]);
    // 1154 × 866 is the largest size below a megapixel.
    assert_eq!(result["image"]["width"], 1154);
    let detect = ["detect", path(&file), "--max-memory-gb", "0.3"];
    let why = "the image has 64.1 megapixels, more than --max-memory-gb 0.3 holds: 0.4 would do";
    fails(&folder, &detect, 1, why);
}

#[test]
fn a_rig_whose_right_camera_is_upside_down_knows_its_baseline() {
    let mut arguments = vec!["calibrate".to_owned()];
    for side in ["left", "right"] {
        if side == "right" {
            arguments.push("--right".to_owned());
        }
        for n in 0..8 {
            let Some(file) = field(&format!("05/{side}0{n}.png")) else {
                return;
            };
            arguments.push(path(&file).to_owned());
        }
    }
    let board = ["--board", "7x5", "--square-m", "0.03"].map(str::to_owned);
    arguments.extend(board);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = json(&arguments);
    let stereo = &result["stereo"];
    let [baseline_m, rms_px] = ["baseline_m", "rms_px"].map(|name| stereo[name].as_f64().unwrap());
    assert!((baseline_m - 0.1202).abs() < 0.0006, "{baseline_m}");
    assert!(rms_px < 0.1, "{rms_px}");
    assert!(!result["warnings"].to_string().contains("do not agree"));
}

#[test]
fn vertical_pairs_are_reported_to_agree_in_columns() {
    let [Some(upper), Some(lower)] = ["16/upper.jpg", "16/lower.jpg"].map(field) else {
        return;
    };
    let folder = Folder::new("vertical");
    let out = folder.file("rectified");
    let k = "320,320,159.5,119.5";
    let arguments = [
        "rectify",
        path(&upper),
        path(&lower),
        "--k",
        k,
        "-o",
        path(&out),
    ];
    assert!(stderr_of(&arguments).contains("columns agree, not rows"));
    assert_eq!(json(&arguments)["is_vertical"], true);
}
