//! `epipole two-view` and `rectify` on photographs with exact ground truth.

use super::*;

/// Two photographs with enough parallax, and their cameras.
fn pair(folder: &Folder, motion: &RigidTransform) -> [PosedCamera; 2] {
    let cameras = [
        moved(SIZE, &RigidTransform::identity()),
        moved(SIZE, motion),
    ];
    for (camera, name) in cameras.iter().zip(["a.png", "b.png"]) {
        folder.write_photo(name, camera, SIZE);
    }
    cameras
}

/// A translation to the right with a rotation back to the table.
fn step() -> RigidTransform {
    RigidTransform::new(
        Vector3::new(-0.25, 0.02, 0.03),
        Vector3::new(0.02, 0.17, 0.01),
    )
}

/// True matches of every 32nd pixel of the first camera.
fn true_matches(cameras: &[PosedCamera; 2]) -> Vec<(Point2<f64>, Point2<f64>)> {
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
fn two_photos_give_the_motion_of_the_camera() {
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
        let (angle, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &step());
        assert!(
            angle < 0.1 && direction < 0.3,
            "{model}: {angle} {direction}"
        );
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
    let (angle, direction) = errors_deg(&motion(&result["cam2_from_cam1"]), &step());
    assert!(angle < 0.1 && direction < 0.3, "{angle} {direction}");
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

/// Without a given focal length, the matches determine it if the camera rolls and rises; for a step
/// aside they do not, and the guess of 1.2 times the longer side remains.
#[test]
fn matches_determine_an_unknown_focal_length() {
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
        (focals_px[0], cameras[0].camera.intrinsics.fu_px(), words)
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
fn a_rotation_is_distinguished_from_a_motion() {
    let folder = Folder::new("panorama");
    let rotation_only = RigidTransform::new(Vector3::zeros(), Vector3::new(0.03, 0.12, -0.02));
    let cameras = pair(&folder, &rotation_only);
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
        assert!(
            found
                .rotation
                .angle_to(&rotation_only.rotation)
                .to_degrees()
                < 0.2
        );
    }
}

#[test]
fn two_photos_from_one_place_are_reported() {
    let folder = Folder::new("still");
    folder.write_photo("a.png", &moved(SIZE, &RigidTransform::identity()), SIZE);
    let a = folder.file("a.png");
    for model in ["auto", "fundamental", "homography"] {
        let output = epipole(&["two-view", path(&a), path(&a), "--model", model]);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{model}: {stderr}");
        assert!(
            stderr.contains("the camera hardly moved"),
            "{model}: {stderr}"
        );
    }
}

#[test]
fn images_without_a_common_object_are_rejected() {
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
fn rectified_photos_share_their_rows() {
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
        // Q maps a pixel and its disparity to a point: compare with the ground truth.
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
    // All that was photographed, in a picture of another size.
    let out = folder.file("all");
    let base = ["rectify", path(&a), path(&b), "-o", path(&out)];
    let shape = ["--alpha", "1", "--size", "500x400"];
    let all = json(&[&base[..], &known, &shape].concat());
    let h1 = matrix(&all["homography1"]);
    for (u, v) in [(0.0, 0.0), (639.0, 0.0), (0.0, 479.0), (639.0, 479.0)] {
        let corner = transfer(&h1, &Point2::new(u, v));
        let inside = |x: f64, side: f64| (-1.0..=side).contains(&x);
        assert!(
            inside(corner.x, 500.0) && inside(corner.y, 400.0),
            "{corner}"
        );
    }
    let size = image::image_dimensions(out.join("left.png")).unwrap();
    assert_eq!(size, (500, 400));
    // Q has the difference of the principal points, which is none where infinity has disparity 0.
    let [at_zero, free] = [&[][..], &["--free-infinity"]].map(|options| {
        let q = json(&[&base[..], &known, options].concat());
        numbers(&q["q"])[15].abs()
    });
    assert!(at_zero < 1e-9 && free > 1e-6, "{at_zero} {free}");
    fails(&folder, &[&base[..], &shape].concat(), 2, "--focal-px");
    let wrong = [&base[..], &known, &["--alpha", "1.5"]].concat();
    fails(&folder, &wrong, 2, "a number from 0 to 1");
    let small = folder.blank("small.png", (100, 80));
    let out = folder.file("sizes");
    let arguments = ["rectify", path(&a), path(&small), "-o", path(&out)];
    fails(
        &folder,
        &arguments,
        1,
        "must have the same size, but one is 640 × 480 and the other 100 × 80",
    );
    // Without motion there is nothing to rectify, with intrinsics or without.
    for known in [&[][..], &["--focal-px", "500"]] {
        let arguments = ["rectify", path(&a), path(&a), "-o", path(&out)];
        let output = epipole(&[&arguments[..], known].concat());
        let stderr = String::from_utf8(output.stderr).unwrap();
        let sentence = if known.is_empty() {
            "the camera hardly moved"
        } else {
            "a pure rotation"
        };
        assert!(stderr.contains(sentence), "{stderr}");
    }
}
