//! `epipole fit`: how the loop runs, and how sure its answer is.

use super::*;

/// Noise of 0.4 pixels in both images: 99 of 100 Sampson errors are below 2.58 times that. In an
/// image, H has the noise of both, in two dimensions: 3.03 √2 times that.
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

/// Each option of the core's loop is available, and takes effect.
#[test]
fn fit_options_control_the_loop() {
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

/// Options without effect are refused, and so are incomplete ones.
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
    fails(&folder, &arguments, 1, "line 4: here should be 4 numbers");
}

/// The output gives the reason for the end and the required number of samples, with a warning if
/// that exceeds the limit.
#[test]
fn fits_report_whether_they_are_confident() {
    let folder = Folder::new("fit-stop");
    let problem = problem(cube());
    let file = file_of(&folder, &problem);
    let fit = |more: &[&str]| {
        let arguments = ["fit", "--model", "fundamental", path(&file), "--json"];
        let output = epipole(&[&arguments, more].concat());
        assert_eq!(output.status.code(), Some(0));
        (parse(&output), String::from_utf8(output.stderr).unwrap())
    };
    let (result, stderr) = fit(&[]);
    assert_eq!(result["stop"], "confident");
    let num_inliers = usize::try_from(result["num_inliers"].as_u64().unwrap()).unwrap();
    let required = num_trials_without_replacement(num_inliers, 250, 7, 0.999).unwrap();
    assert_eq!(result["required_iterations"], required);
    assert!(result["iterations"].as_u64().unwrap() >= required);
    assert!(stderr.is_empty(), "{stderr}");

    let (result, stderr) = fit(&["--max-iterations", "30"]);
    assert_eq!(
        (&result["stop"], &result["iterations"]),
        (&"exhausted".into(), &30.into())
    );
    let required = result["required_iterations"].as_u64().unwrap();
    assert!(required > 30);
    let sentence = format!("warning: ended by --max-iterations 30: with so few inliers {required}");
    assert!(stderr.contains(&sentence), "{stderr}");
    let (_, stderr) = fit(&["--max-iterations", "30", "--quiet"]);
    assert!(stderr.is_empty(), "{stderr}");

    // A line through 2 of 2 000 points: more samples than can be counted in seconds, still a
    // number.
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

/// Unrelated rows: some agree nevertheless, and there is a warning.
#[test]
fn random_matches_are_distinguished_from_a_model() {
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
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains("is not significant"), "{model}: {stderr}");
        assert_eq!(parse(&output)["could_be_random"], true, "{model}");
    }
    let file = file_of(&folder, &problem(cube()));
    let result = json(&["fit", "--model", "fundamental", path(&file)]);
    assert_eq!(result["could_be_random"], false);
}

/// Rows sorted by quality let PROSAC finish while uniform samples are still searching.
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
