//! `epipole fit`: models from files of matches.

use super::*;

#[test]
fn fit_finds_the_motion_between_two_cameras() {
    let folder = Folder::new("fit-essential");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let result = json(&["fit", "--model", "essential", path(&file), "--k", K]);
    let truth = cam2_from_cam1(&problem.camera1, &problem.camera2);
    let (angle, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &truth);
    assert!(angle < 1e-4 && direction < 1e-3, "{angle} {direction}");
    // No true match is missed; a wrong one may lie on its epipolar line by chance.
    let found = mask(&result);
    assert!(
        found
            .iter()
            .zip(&problem.is_inlier)
            .all(|(found, is)| *found || !is)
    );
    let is_random = found
        .iter()
        .zip(&problem.is_inlier)
        .filter(|(f, is)| **f && !**is);
    assert!(is_random.count() < 10);
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
    let down = |camera: &PosedCamera| {
        let down = camera.cam_from_world.rotation * Vector3::new(0.1, 1.0, -0.2);
        format!("{},{},{}", down.x, down.y, down.z)
    };
    let (down1, down2) = (down(&problem.camera1), down(&problem.camera2));
    let known = ["--gravity", &down1, "--gravity2", &down2];
    let fit = ["fit", "--model", "essential", path(&file), "--k", K];
    let result = json(&[&fit[..], &known].concat());
    let truth = cam2_from_cam1(&problem.camera1, &problem.camera2);
    let (angle, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &truth);
    assert!(angle < 1e-4 && direction < 1e-3, "{angle} {direction}");
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
        (
            vec!["--gravity", "0,1,nan", "--gravity2", "0,1,0"],
            "finite",
        ),
    ] {
        fails(&folder, &[&fit[..], &more].concat(), 2, words);
    }
    let other = ["fit", "--model", "fundamental", path(&file)];
    fails(&folder, &[&other[..], &known].concat(), 2, "essential only");
    // Without a motion no three matches make a model.
    let still: String = (0..40)
        .map(|n| format!("{0} {1} {0} {1}\n", n * 37 % 640, n * 71 % 480))
        .collect();
    let still = folder.write("still.txt", &still);
    let fit = ["fit", "--model", "essential", path(&still), "--k", K];
    let level = ["--gravity", "0,1,0", "--gravity2", "0,1,0"];
    fails(
        &folder,
        &[&fit[..], &level].concat(),
        1,
        "the camera hardly moved",
    );
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
fn insignificant_match_files_are_rejected() {
    let folder = Folder::new("fit-bad");
    let good = "10 20 30 40\n50 60 70 80\n15 70 33 21\n90 11 40 44\n";
    let same = "10 20 30 40\n".repeat(30);
    let along: String = (0..30).map(|n| format!("{n} {n} {n} {n}\n")).collect();
    for (model, text, expected) in [
        (
            "homography",
            "1 2 3 4\n\n5 6 7\n".to_owned(),
            "line 3: here should be 4 numbers, not \"5 6 7\"",
        ),
        (
            "homography",
            format!("{good}1 nan 2 3"),
            "line 5: here should be 4 numbers",
        ),
        (
            "fundamental",
            format!("{good}1 2 inf 3\n1 2 1e12 3"),
            "but there are only 4; rows left out for being beyond 10⁹ pixels: 2",
        ),
        ("line", "1\n".to_owned(), "here should be 2 numbers"),
        ("homography", String::new(), "needs at least 4"),
        ("fundamental", good.to_owned(), "but there are only 4"),
        (
            "homography",
            "# only a comment\n1 2 3 4".to_owned(),
            "needs at least 4, but there is only 1",
        ),
        (
            "homography",
            same.clone(),
            "at least 4 that differ, but the 30 given are equal",
        ),
        (
            "fundamental",
            format!("{same}{good}"),
            "at least 7 that differ, but of the 34 given only 4 are distinct",
        ),
        (
            "homography",
            along.clone(),
            "pixels of an image lie on one line",
        ),
        ("fundamental", along, "pixels of an image lie on one line"),
    ] {
        let file = folder.write("bad.txt", &text);
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

#[test]
fn matches_that_are_no_pixels_are_reported() {
    let folder = Folder::new("fit-units");
    let rows =
        "0.1 0.2 0.3 0.4\n0.2 0.1 0.3 0.2\n0.5 0.3 0.4 0.2\n0.2 0.9 0.1 0.8\n0.7 0.3 0.3 0.1\n";
    let file = folder.write("shares.txt", rows);
    let fit = [
        "fit",
        "--model",
        "essential",
        "--k",
        "600,600,320,240",
        path(&file),
    ];
    let sentence = String::from_utf8(crate::common::epipole(&fit).stderr).unwrap();
    let why = "all coordinates are within ± 0.90";
    assert!(sentence.contains(why), "{sentence}");
}
