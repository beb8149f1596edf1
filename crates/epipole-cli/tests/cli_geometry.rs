//! `epipole fit`, `two-view` and `rectify` against known geometry.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;

use common::{
    Folder, angle_deg, epipole, fails, json, k, matrix, motion, moved, numbers, parse, path,
};
use epipole::camera::{Camera, RigidTransform};
use epipole::epipolar::{fundamental_from_cameras, symmetric_epipolar_px};
use epipole::math::random::Random;
use epipole::robust::num_trials_without_replacement;
use epipole::synthetic::{Scene, Structure, Transfer, TwoViewProblem, TwoViewProblemOptions};
use nalgebra::{Matrix3, Point2, Vector3};
use serde_json::Value;
use std::path::PathBuf;

const SIZE: (u32, u32) = (640, 480);
const K: &str = "600,600,319.5,239.5";

/// Matches of which two in five are wrong.
fn problem(structure: Structure) -> TwoViewProblem {
    TwoViewProblem::new(&TwoViewProblemOptions {
        num_points: 250,
        structure,
        outlier_fraction: 0.4,
        seed: 5,
        ..TwoViewProblemOptions::default()
    })
    .unwrap()
}

fn cube() -> Structure {
    Structure::Cube { half_side_m: 1.0 }
}

fn matches_file(folder: &Folder, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> PathBuf {
    let rows = pixels1.iter().zip(pixels2).map(|(a, b)| {
        // Commas, further columns and comments are part of the format.
        format!("{} {}, {}\t{} 0.5 extra # a match\n", a.x, a.y, b.x, b.y)
    });
    let text = format!("# u1 v1 u2 v2\n\n{}", rows.collect::<String>());
    folder.write("matches.txt", &text)
}

fn file_of(folder: &Folder, problem: &TwoViewProblem) -> PathBuf {
    matches_file(folder, &problem.pixels1, &problem.pixels2)
}

fn mask(result: &Value) -> Vec<bool> {
    numbers(&result["inliers"])
        .iter()
        .map(|i| *i == 1.0)
        .collect()
}

fn transfer(h: &Matrix3<f64>, pixel: &Point2<f64>) -> Point2<f64> {
    Point2::from_homogeneous(h * pixel.to_homogeneous()).unwrap()
}

fn cam2_from_cam1(camera1: &Camera, camera2: &Camera) -> RigidTransform {
    camera2.cam_from_world * camera1.cam_from_world.inverse()
}

/// Degrees between the rotations, and between the directions of the translations.
fn errors_deg(found: &RigidTransform, truth: &RigidTransform) -> (f64, f64) {
    (
        found.rotation.angle_to(&truth.rotation).to_degrees(),
        angle_deg(&found.translation.vector, &truth.translation.vector),
    )
}

#[test]
fn fit_finds_the_motion_between_two_cameras() {
    let folder = Folder::new("fit-essential");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let result = json(&["fit", "--model", "essential", path(&file), "--k", K]);
    let truth = cam2_from_cam1(&problem.camera1, &problem.camera2);
    let (turn, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &truth);
    assert!(turn < 1e-4 && direction < 1e-3, "{turn} {direction}");
    // No true match is missed; a wrong one may lie on its epipolar line by chance.
    let found = mask(&result);
    assert!(
        found
            .iter()
            .zip(&problem.is_inlier)
            .all(|(found, is)| *found || !is)
    );
    let by_chance = found
        .iter()
        .zip(&problem.is_inlier)
        .filter(|(f, is)| **f && !**is);
    assert!(by_chance.count() < 10);
    let count = found.iter().filter(|found| **found).count();
    assert_eq!(result["num_inliers"].as_u64(), Some(count as u64));
    assert!(result["iterations"].as_u64().unwrap() > 0);
    // Equal seeds give equal results.
    let mut again = json(&["fit", "--model", "essential", path(&file), "--k", K]);
    again["time_ms"] = result["time_ms"].clone();
    assert_eq!(again, result);
}

#[test]
fn fit_finds_the_motion_where_gravity_is_known() {
    let folder = Folder::new("fit-gravity");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let down = |camera: &Camera| {
        let down = camera.cam_from_world.rotation * Vector3::new(0.1, 1.0, -0.2);
        format!("{},{},{}", down.x, down.y, down.z)
    };
    let (down1, down2) = (down(&problem.camera1), down(&problem.camera2));
    let known = ["--gravity", &down1, "--gravity2", &down2];
    let fit = ["fit", "--model", "essential", path(&file), "--k", K];
    let result = json(&[&fit[..], &known].concat());
    let truth = cam2_from_cam1(&problem.camera1, &problem.camera2);
    let (turn, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &truth);
    assert!(turn < 1e-4 && direction < 1e-3, "{turn} {direction}");
    let free = json(&fit);
    let samples = |result: &Value| result["required_iterations"].as_u64().unwrap();
    assert!(samples(&result) < samples(&free));
    // One without the other, none, and for another model.
    for (more, words) in [
        (vec!["--gravity", "0,1,0"], "--gravity2"),
        (
            vec!["--gravity", "0,0,0", "--gravity2", "0,1,0"],
            "direction",
        ),
        (vec!["--gravity", "0,1", "--gravity2", "0,1,0"], "x,y,z"),
    ] {
        fails(&folder, &[&fit[..], &more].concat(), 2, words);
    }
    let other = ["fit", "--model", "fundamental", path(&file)];
    fails(&folder, &[&other[..], &known].concat(), 2, "essential only");
}

#[test]
fn fit_finds_the_fundamental_matrix() {
    let folder = Folder::new("fit-fundamental");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let result = json(&["fit", "--model", "fundamental", path(&file)]);
    let f = matrix(&result["model"]);
    let truth = fundamental_from_cameras(&problem.camera1, &problem.camera2).unwrap();
    let difference = (f - truth).norm().min((f + truth).norm());
    assert!(difference < 1e-6, "{difference}");
    assert!(result["mean_error_px"].as_f64().unwrap() < 0.1);
    assert!(result.get("cam2_from_cam1").is_none());
}

#[test]
fn fit_finds_the_homography_of_a_plane() {
    let folder = Folder::new("fit-homography");
    let problem = problem(Structure::Plane { half_side_m: 1.0 });
    let file = file_of(&folder, &problem);
    let result = json(&["fit", "--model", "homography", path(&file)]);
    let h = matrix(&result["model"]);
    for n in (0..problem.pixels1.len()).filter(|n| problem.is_inlier[*n]) {
        let error = (transfer(&h, &problem.pixels1[n]) - problem.pixels2[n]).norm();
        assert!(error < 1e-6, "{error}");
    }
    assert_eq!(mask(&result), problem.is_inlier);
}

#[test]
fn fit_finds_similarities_and_lines() {
    let folder = Folder::new("fit-similarity");
    let mut random = Random::new(9);
    let (scale, (sin, cos)) = (1.5, libm::sincos(0.3));
    let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
    for n in 0..60 {
        let p = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        let mut q = Point2::new(
            scale * (cos * p.x - sin * p.y) + 7.0,
            scale * (sin * p.x + cos * p.y) - 20.0,
        );
        if n % 3 == 0 {
            q.x += random.uniform(30.0, 200.0);
        }
        pixels1.push(p);
        pixels2.push(q);
    }
    let file = matches_file(&folder, &pixels1, &pixels2);
    let result = json(&["fit", "--model", "similarity", path(&file)]);
    let found = matrix(&result["model"]);
    let truth = Matrix3::new(
        scale * cos,
        -scale * sin,
        7.0,
        scale * sin,
        scale * cos,
        -20.0,
        0.0,
        0.0,
        1.0,
    );
    assert!((found - truth).norm() < 1e-6, "{found}");
    assert_eq!(result["num_inliers"], 40);

    // On 3 u + 4 v = 50, but for every fifth; two columns are enough for points.
    let rows = (0..50).map(|n| {
        let u = f64::from(n);
        let off = if n % 5 == 0 { 20.0 + u } else { 0.0 };
        format!("{u} {}\n", (50.0 - 3.0 * u) / 4.0 + off)
    });
    let file = folder.write("points.txt", &rows.collect::<String>());
    let result = json(&["fit", "--model", "line", path(&file)]);
    let line = Vector3::from_row_slice(&numbers(&result["model"]));
    let truth = Vector3::new(3.0, 4.0, -50.0) / 5.0;
    let difference = (line - truth).norm().min((line + truth).norm());
    assert!(difference < 1e-9, "{line}");
    assert_eq!(result["num_inliers"], 40);
}

#[test]
fn files_of_matches_that_say_nothing_are_refused() {
    let folder = Folder::new("fit-bad");
    let good = "10 20 30 40\n50 60 70 80\n15 70 33 21\n90 11 40 44\n";
    let same = "10 20 30 40\n".repeat(30);
    let along: String = (0..30).map(|n| format!("{n} {n} {n} {n}\n")).collect();
    for (model, text, expected) in [
        (
            "homography",
            "1 2 3 4\n\n5 6 7\n".to_owned(),
            ":3: here should be 4 numbers, not \"5 6 7\"",
        ),
        (
            "homography",
            format!("{good}1 nan 2 3"),
            ":5: here should be 4 numbers",
        ),
        (
            "fundamental",
            format!("{good}1 2 inf 3"),
            "here should be 4 numbers",
        ),
        ("line", "1\n".to_owned(), "here should be 2 numbers"),
        ("homography", String::new(), "needs at least 4"),
        ("fundamental", good.to_owned(), "but there are only 4"),
        (
            "homography",
            "# only a comment\n1 2 3 4".to_owned(),
            "needs at least 4, but there is only 1",
        ),
        ("homography", same.clone(), "error"),
        ("fundamental", same, "error"),
        ("homography", along.clone(), "error"),
        ("fundamental", along, "error"),
    ] {
        let file = folder.write("bad.txt", &text);
        let expected = if expected == "error" { "" } else { expected };
        fails(
            &folder,
            &["fit", "--model", model, path(&file)],
            1,
            expected,
        );
    }
    let good = folder.write("good.txt", good);
    let missing = folder.file("missing.txt");
    fails(
        &folder,
        &["fit", "--model", "line", path(&missing)],
        1,
        "there is no such file",
    );
    fails(
        &folder,
        &["fit", "--model", "essential", path(&good)],
        2,
        "needs --k",
    );
    for (option, value) in [
        ("--k", "600,600,1"),
        ("--max-error-px", "-1"),
        ("--max-error-px", "1e300"),
        ("--max-error-px", "1e-300"),
        ("--confidence", "1"),
        ("--sampler", "best"),
    ] {
        let arguments = ["fit", "--model", "essential", path(&good), option, value];
        fails(&folder, &arguments, 2, value);
    }
}

/// Noise of 0.4 pixels in both images: 99 of 100 Sampson errors are below 2.58 times that. In an image, H has the
/// noise of both, in two dimensions: 3.03 √2 times that.
#[test]
fn fit_finds_the_threshold_from_the_noise() {
    let folder = Folder::new("fit-auto");
    for (structure, model, ratio) in [
        (cube(), "fundamental", 2.576),
        (Structure::Plane { half_side_m: 1.0 }, "homography", 4.292),
    ] {
        let problem = problem(structure);
        let mut random = Random::new(3);
        let mut noisy = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let moved = |p: &Point2<f64>| {
                Point2::new(p.x + 0.4 * random.normal(), p.y + 0.4 * random.normal())
            };
            pixels.iter().map(moved).collect()
        };
        let (p1, p2) = (noisy(&problem.pixels1), noisy(&problem.pixels2));
        let file = matches_file(&folder, &p1, &p2);
        let fit = |threshold: &str| {
            let options = [
                "fit",
                "--model",
                model,
                path(&file),
                "--max-error-px",
                threshold,
            ];
            json(&options)
        };
        let found = fit("auto");
        let max_error_px = found["max_error_px"].as_f64().unwrap();
        let expected = 0.4 * ratio;
        assert!(
            (0.7..1.3).contains(&(max_error_px / expected)),
            "{model}: {max_error_px} {expected}"
        );
        let inliers = mask(&found);
        let agree = (inliers.iter().zip(&problem.is_inlier)).filter(|(a, b)| a == b);
        assert!(agree.count() > 235, "{model}");
        assert_eq!(fit("0.5")["max_error_px"].as_f64(), Some(0.5));
        let words = epipole(&[
            "fit",
            "--model",
            model,
            path(&file),
            "--max-error-px",
            "auto",
        ]);
        let words = String::from_utf8(words.stdout).unwrap();
        assert!(words.contains("px, found from the noise"), "{words}");
    }
}

/// Each option of the core's loop can be said, and does what it says.
#[test]
fn fit_says_how_the_loop_is_to_run() {
    let folder = Folder::new("fit-loop");
    let file = file_of(&folder, &problem(cube()));
    let fit = |options: &[&str]| {
        json(&[&["fit", "--model", "fundamental", path(&file)], options].concat())
    };
    let samples = |options: &[&str]| fit(options)["iterations"].as_u64().unwrap();
    assert_eq!(samples(&["--min-iterations", "777"]), 777);
    let required = |options: &[&str]| fit(options)["required_iterations"].as_u64().unwrap();
    assert!(required(&["--budget", "with-replacement"]) < required(&[]));
    let inliers = |options: &[&str]| fit(options)["num_inliers"].as_u64().unwrap();
    let plain = inliers(&["--local-optimization=false", "--min-iterations", "0"]);
    assert!(plain <= inliers(&["--score", "inliers", "--inner-iterations", "8"]));
    let file = path(&file);
    for (option, value) in [
        ("--score", "best"),
        ("--budget", "none"),
        ("--inner-iterations", "-1"),
    ] {
        let arguments = ["fit", "--model", "fundamental", file, option, value];
        fails(&folder, &arguments, 2, value);
    }
}

/// What would be left unused is refused, and so is half of what is needed.
#[test]
fn intrinsics_where_none_are_needed_are_refused() {
    let folder = Folder::new("fit-k");
    let good = folder.write("good.txt", &"1 2 3 4\n".repeat(9));
    for model in ["line", "homography", "fundamental", "similarity"] {
        for option in ["--k", "--k2"] {
            let arguments = ["fit", "--model", model, path(&good), option, K];
            fails(&folder, &arguments, 2, "for --model essential only");
        }
    }
    let arguments = ["fit", "--model", "essential", path(&good), "--k2", K];
    fails(&folder, &arguments, 2, "needs --k");
    let blank = folder.blank("blank.png", (64, 64));
    let out = folder.file("out");
    for arguments in [
        &["two-view", path(&blank), path(&blank), "--k2", K][..],
        &[
            "two-view",
            path(&blank),
            path(&blank),
            "--k2",
            K,
            "--model",
            "essential",
        ],
        &[
            "rectify",
            path(&blank),
            path(&blank),
            "--k2",
            K,
            "-o",
            path(&out),
        ],
    ] {
        fails(&folder, arguments, 2, "the first needs --k or --focal-px");
    }
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_row() {
    let folder = Folder::new("fit-bom");
    let rows = "10 20 30 40\n50 60 70 80\n15 70 35 90\n";
    let fit = |text: &str| {
        let file = folder.write("matches.txt", text);
        json(&["fit", "--model", "similarity", path(&file)])
    };
    let (with, without) = (fit(&format!("\u{feff}{rows}")), fit(rows));
    assert_eq!(with["num_inliers"], 3);
    assert_eq!(with["model"], without["model"]);
    // Anywhere else it is.
    let file = folder.write("matches.txt", &format!("{rows}\u{feff}1 2 3 4"));
    let arguments = ["fit", "--model", "similarity", path(&file)];
    fails(&folder, &arguments, 1, ":4: here should be 4 numbers");
}

/// A run says why it ended, how many samples so many inliers ask for, and warns if these were not
/// allowed.
#[test]
fn fits_tell_whether_they_are_confident() {
    let folder = Folder::new("fit-stop");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let fit = |more: &[&str]| {
        let arguments = ["fit", "--model", "fundamental", path(&file), "--json"];
        let output = epipole(&[&arguments, more].concat());
        assert_eq!(output.status.code(), Some(0));
        (parse(&output), String::from_utf8(output.stderr).unwrap())
    };
    let (result, told) = fit(&[]);
    assert_eq!(result["stop"], "confident");
    let num_inliers = usize::try_from(result["num_inliers"].as_u64().unwrap()).unwrap();
    let required = num_trials_without_replacement(num_inliers, 250, 7, 0.999).unwrap();
    assert_eq!(result["required_iterations"], required);
    assert!(result["iterations"].as_u64().unwrap() >= required);
    assert!(told.is_empty(), "{told}");

    let (result, told) = fit(&["--max-iterations", "30"]);
    assert_eq!(
        (&result["stop"], &result["iterations"]),
        (&"exhausted".into(), &30.into())
    );
    let required = result["required_iterations"].as_u64().unwrap();
    assert!(required > 30);
    let sentence = format!("warning: ended by --max-iterations 30: with so few inliers {required}");
    assert!(told.contains(&sentence), "{told}");
    let (_, told) = fit(&["--max-iterations", "30", "--quiet"]);
    assert!(told.is_empty(), "{told}");

    // A line through 2 of 2 000 points: more samples than can be counted in seconds, still a number.
    let mut random = Random::new(1);
    let rows = (0..2000).map(|_| {
        format!(
            "{} {}\n",
            random.uniform(0.0, 1e6),
            random.uniform(0.0, 1e6)
        )
    });
    let points = folder.write("points.txt", &rows.collect::<String>());
    let arguments = [
        "fit",
        "--model",
        "line",
        path(&points),
        "--max-iterations",
        "5",
        "--max-error-px",
        "1e-9",
    ];
    let result = json(&arguments);
    assert_eq!(result["stop"], "exhausted");
    assert_eq!(result["num_inliers"], 2);
    assert!(result["required_iterations"].as_u64().unwrap() > 1_000_000);
}

/// Rows that come best first give PROSAC its answer while uniform samples are still searching.
/// Rows that have nothing to do with one another: some agree nevertheless, and that is said.
#[test]
fn chance_is_told_from_a_model() {
    let folder = Folder::new("fit-chance");
    let mut random = Random::new(3);
    let mut anywhere = || -> Vec<Point2<f64>> {
        let mut pixel = || Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        (0..300).map(|_| pixel()).collect()
    };
    let file = matches_file(&folder, &anywhere(), &anywhere());
    for model in ["homography", "fundamental", "essential", "similarity"] {
        let mut arguments = vec!["--json", "fit", "--model", model, path(&file)];
        if model == "essential" {
            arguments.extend(["--k", K]);
        }
        let output = epipole(&arguments);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains("by chance"), "{model}: {told}");
        assert_eq!(parse(&output)["could_be_chance"], true, "{model}");
    }
    let file = file_of(&folder, &problem(cube()));
    let result = json(&["fit", "--model", "fundamental", path(&file)]);
    assert_eq!(result["could_be_chance"], false);
}

#[test]
fn the_sampler_can_be_chosen() {
    let folder = Folder::new("fit-sampler");
    let mut problem = problem(cube());
    // Behind the true rows the wrong ones, and many more of these.
    let mut random = Random::new(4);
    let mut order: Vec<usize> = (0..250).collect();
    order.sort_by_key(|&n| !problem.is_inlier[n]);
    let sorted =
        |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> { order.iter().map(|&n| pixels[n]).collect() };
    (problem.pixels1, problem.pixels2) = (sorted(&problem.pixels1), sorted(&problem.pixels2));
    for _ in 0..2750 {
        let mut pixel = || Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        problem.pixels1.push(pixel());
        problem.pixels2.push(pixel());
    }
    let file = file_of(&folder, &problem);
    let fit = |sampler: &[&str]| {
        let arguments = [
            "fit",
            "--model",
            "fundamental",
            path(&file),
            "--max-iterations",
            "20",
        ];
        json(&[&arguments, sampler].concat())
    };
    let num_true = 150;
    let best_first = fit(&["--sampler", "prosac"]);
    assert!(best_first["num_inliers"].as_u64().unwrap() >= num_true);
    let uniform = fit(&["--sampler", "uniform"]);
    assert!(uniform["num_inliers"].as_u64().unwrap() < num_true);
    assert_eq!(
        uniform["model"],
        fit(&[])["model"],
        "uniform is the default"
    );
}

/// Two photographs with enough parallax, and their cameras.
fn pair(folder: &Folder, motion: &RigidTransform) -> [Camera; 2] {
    let cameras = [
        moved(SIZE, &RigidTransform::identity()),
        moved(SIZE, motion),
    ];
    for (camera, name) in cameras.iter().zip(["a.png", "b.png"]) {
        folder.photograph(name, camera, SIZE);
    }
    cameras
}

/// A step to the right with a turn back to the table.
fn step() -> RigidTransform {
    RigidTransform::new(
        Vector3::new(-0.25, 0.02, 0.03),
        Vector3::new(0.02, 0.17, 0.01),
    )
}

/// Where the second camera sees what the first sees at every 32nd pixel.
fn true_matches(cameras: &[Camera; 2]) -> Vec<(Point2<f64>, Point2<f64>)> {
    let scene = Scene::still_life();
    let mut matches = Vec::new();
    for v in (16..SIZE.1).step_by(32) {
        for u in (16..SIZE.0).step_by(32) {
            let pixel1 = Point2::new(f64::from(u), f64::from(v));
            if let Transfer::Visible { pixel2, .. } =
                scene.transfer(&cameras[0], &cameras[1], &pixel1)
                && (0.0..f64::from(SIZE.0)).contains(&pixel2.x)
                && (0.0..f64::from(SIZE.1)).contains(&pixel2.y)
            {
                matches.push((pixel1, pixel2));
            }
        }
    }
    assert!(matches.len() > 50);
    matches
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn two_photographs_give_the_motion_of_the_camera() {
    let folder = Folder::new("two-view");
    let cameras = pair(&folder, &step());
    let [a, b] = ["a.png", "b.png"].map(|name| folder.file(name));
    for model in ["auto", "essential"] {
        let camera = k(&cameras[0]);
        let result = json(&[
            "two-view",
            path(&a),
            path(&b),
            "--model",
            model,
            "--k",
            &camera,
        ]);
        let (turn, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &step());
        assert!(turn < 0.1 && direction < 0.3, "{model}: {turn} {direction}");
        // F may gain some matches that are wrong; the motion is that of E in any case.
        let kind = result["model_kind"].as_str().unwrap();
        assert!(
            kind == "essential" || (model == "auto" && kind == "fundamental"),
            "{kind}"
        );
        assert_eq!(result["configuration"], "general");
        let rows: Vec<Vec<f64>> = result["matches"]
            .as_array()
            .unwrap()
            .iter()
            .map(numbers)
            .collect();
        assert_eq!(result["num_matches"].as_u64(), Some(rows.len() as u64));
        let inliers: Vec<_> = rows.iter().filter(|row| row[4] == 1.0).collect();
        assert_eq!(result["num_inliers"].as_u64(), Some(inliers.len() as u64));
        assert!(inliers.len() > 60, "{}", inliers.len());
        let f = fundamental_from_cameras(&cameras[0], &cameras[1]).unwrap();
        let distances = inliers.iter().map(|row| {
            let (p, q) = (Point2::new(row[0], row[1]), Point2::new(row[2], row[3]));
            symmetric_epipolar_px(&f, &p, &q)
        });
        let typical = median(distances.collect());
        assert!(typical < 0.7, "{typical}");
        assert!(result["mean_sampson_px"].as_f64().unwrap() < 1.0);
        assert_eq!(numbers(&result["num_keypoints"]).len(), 2);
    }
    let camera = k(&cameras[0]);
    let auto = [
        "two-view",
        path(&a),
        path(&b),
        "--k",
        &camera,
        "--max-error-px",
        "auto",
    ];
    let result = json(&auto);
    let (turn, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &step());
    assert!(turn < 0.1 && direction < 0.3, "{turn} {direction}");
    // 99 of 100 Sampson errors are within it, which have a mean of 0.8 standard deviations.
    let max_error_px = result["max_error_px"].as_f64().unwrap();
    let mean_px = result["mean_sampson_px"].as_f64().unwrap();
    assert!(
        (1.5..6.0).contains(&(max_error_px / mean_px)),
        "{max_error_px} {mean_px}"
    );
    let result = json(&["two-view", path(&a), path(&b)]);
    assert_eq!(result["max_error_px"].as_f64(), Some(2.0));
    let best_first = json(&["two-view", path(&a), path(&b), "--sampler", "prosac"]);
    assert_eq!(best_first["model_kind"], "fundamental");
    let (uniform, prosac) = (&result["num_inliers"], &best_first["num_inliers"]);
    let ratio = prosac.as_f64().unwrap() / uniform.as_f64().unwrap();
    assert!((0.95..1.05).contains(&ratio), "{prosac} {uniform}");
    assert_eq!(result["model_kind"], "fundamental");
    assert_eq!(result["cam2_from_cam1"], Value::Null);
    let f = matrix(&result["model"]);
    let distances = true_matches(&cameras)
        .into_iter()
        .map(|(p, q)| symmetric_epipolar_px(&f, &p, &q));
    let typical = median(distances.collect());
    assert!(typical < 1.0, "{typical}");
}

/// Nobody says how long the lens is. Where the camera rolls and rises on its way, the matches tell; where it only
/// steps aside, they do not, and the guess of 1.2 times the longer side stands.
#[test]
fn matches_tell_a_focal_length_that_nobody_gave() {
    let folder = Folder::new("two-view-focal");
    let run = |motion: &RigidTransform| {
        let cameras = pair(&folder, motion);
        let [a, b] = ["a.png", "b.png"].map(|name| folder.file(name));
        let arguments = [
            "two-view",
            path(&a),
            path(&b),
            "--model",
            "essential",
            "--json",
        ];
        let output = epipole(&arguments);
        let words = String::from_utf8(output.stderr.clone()).unwrap();
        let focals_px = numbers(&parse(&output)["focals_px"]);
        assert_eq!(focals_px[0], focals_px[1]);
        (focals_px[0], cameras[0].intrinsics.fu_px(), words)
    };
    let rising = RigidTransform::new(
        Vector3::new(-0.2, 0.15, 0.15),
        Vector3::new(0.02, 0.12, 0.15),
    );
    let (found, truth, words) = run(&rising);
    assert!(words.contains("which the matches tell to"), "{words}");
    assert!((found / truth - 1.0).abs() < 0.05, "{found} {truth}");
    let aside = RigidTransform::new(Vector3::new(-0.3, 0.0, 0.0), Vector3::zeros());
    let (found, _, words) = run(&aside);
    assert!(words.contains("the matches do not tell it"), "{words}");
    assert!((found - 768.0).abs() < 1e-9, "{found}");
}

#[test]
fn a_camera_that_only_turned_is_told_from_one_that_moved() {
    let folder = Folder::new("panorama");
    let turn = RigidTransform::new(Vector3::zeros(), Vector3::new(0.03, 0.12, -0.02));
    let cameras = pair(&folder, &turn);
    let [a, b] = ["a.png", "b.png"].map(|name| folder.file(name));
    let result = json(&["two-view", path(&a), path(&b), "--k", &k(&cameras[0])]);
    assert_eq!(result["configuration"], "panoramic");
    assert_eq!(result["model_kind"], "homography");
    let h = matrix(&result["model"]);
    for (p, q) in true_matches(&cameras) {
        let error = (transfer(&h, &p) - q).norm();
        assert!(error < 1.0, "{error}");
    }
    if !result["cam2_from_cam1"].is_null() {
        let found = motion(&result["cam2_from_cam1"]);
        assert!(found.rotation.angle_to(&turn.rotation).to_degrees() < 0.2);
    }
}

#[test]
fn pictures_without_a_common_thing_are_refused() {
    let folder = Folder::new("two-view-bad");
    let back = RigidTransform::new(Vector3::zeros(), Vector3::new(0.0, 3.0, 0.0));
    pair(&folder, &back);
    let [a, b] = ["a.png", "b.png"].map(|name| folder.file(name));
    let blank = folder.blank("blank.png", SIZE);
    let missing = folder.file("missing.png");
    // Two pictures of noise have features enough, of which a few look alike by chance.
    let noise = [1, 2].map(|seed| {
        let mut random = Random::new(seed);
        let file = folder.file(&format!("noise{seed}.png"));
        let gray = |_, _| image::Luma([random.uniform(0.0, 256.0) as u8]);
        let picture = image::GrayImage::from_fn(SIZE.0, SIZE.1, gray);
        picture.save(&file).unwrap();
        file
    });
    let arguments = [
        "two-view",
        path(&noise[0]),
        path(&noise[1]),
        "--focal-px",
        "600",
    ];
    let strict = [&arguments[..], &["--ratio", "0.6"]].concat();
    fails(&folder, &strict, 1, "needs at least");
    for model in ["auto", "fundamental", "essential", "homography"] {
        let arguments = ["two-view", path(&a), path(&blank), "--model", model];
        fails(&folder, &arguments, 1, "needs at least");
    }
    fails(
        &folder,
        &["two-view", path(&a), path(&missing)],
        1,
        "missing.png: there is no such file",
    );
    fails(&folder, &["two-view", path(&a)], 2, "required arguments");
    let both = [
        "two-view",
        path(&a),
        path(&b),
        "--k",
        K,
        "--focal-px",
        "600",
    ];
    fails(&folder, &both, 2, "cannot be used with");
    let out = folder.file("rectified");
    fails(
        &folder,
        &["rectify", path(&a), path(&blank), "-o", path(&out)],
        1,
        "needs at least",
    );
}

#[test]
fn rectified_photographs_share_their_rows() {
    let folder = Folder::new("rectify");
    let cameras = pair(&folder, &step());
    let [a, b] = ["a.png", "b.png"].map(|name| folder.file(name));
    let camera = k(&cameras[0]);
    let baseline_m = step().translation.vector.norm().to_string();
    let known = ["--k", &camera, "--baseline-m", &baseline_m];
    for (name, options) in [("free", &[][..]), ("known", &known)] {
        let out = folder.file(name);
        let base = ["rectify", path(&a), path(&b), "-o", path(&out)];
        let result = json(&[&base[..], options].concat());
        let (h1, h2) = (
            matrix(&result["homography1"]),
            matrix(&result["homography2"]),
        );
        let rows: Vec<f64> = true_matches(&cameras)
            .iter()
            .map(|(p, q)| (transfer(&h1, p).y - transfer(&h2, q).y).abs())
            .collect();
        let typical = median(rows);
        assert!(typical < 1.0, "{name}: {typical}");
        let written: Vec<&str> = result["files"]
            .as_array()
            .unwrap()
            .iter()
            .map(|f| f.as_str().unwrap())
            .collect();
        assert_eq!(written.len(), 2);
        for file in written {
            assert_eq!(image::open(file).unwrap().width(), SIZE.0);
        }
        assert_eq!(
            std::fs::read_dir(&out).unwrap().count(),
            2,
            "no part is left behind"
        );
        if name == "free" {
            assert_eq!(result["q"], Value::Null);
            continue;
        }
        // Q makes a point of a pixel and its disparity: check it on what is really there.
        let q = nalgebra::Matrix4::from_row_slice(&numbers(&result["q"]));
        let scene = Scene::still_life();
        let errors = true_matches(&cameras).into_iter().map(|(p, other)| {
            let (left, right) = (transfer(&h1, &p), transfer(&h2, &other));
            let x = q * nalgebra::Vector4::new(left.x, left.y, left.x - right.x, 1.0);
            let distance = (x.xyz() / x.w).norm();
            let center = cameras[0].center_in_world();
            let hit = scene.cast(&center, &cameras[0].ray_in_world(&p)).unwrap();
            let truth = (hit.point - center).norm();
            (distance / truth - 1.0).abs()
        });
        let typical = median(errors.collect());
        assert!(typical < 0.03, "{typical}");
    }
    let small = folder.blank("small.png", (100, 80));
    let out = folder.file("sizes");
    let arguments = ["rectify", path(&a), path(&small), "-o", path(&out)];
    fails(
        &folder,
        &arguments,
        1,
        "must have the same size, but one is 640 × 480 and the other 100 × 80",
    );
}
