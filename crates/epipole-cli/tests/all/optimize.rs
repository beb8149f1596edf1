//! `epipole ba` and `posegraph` on problems with a known optimum.

use crate::common::{Folder, fails, json, numbers, path};
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::sfm::{BalCamera, BalProblem, BundleObservation};
use epipole::synthetic::{MultiViewProblem, MultiViewProblemOptions};
use epipole_io::bundle::{read_bal, write_bal};
use nalgebra::{Point2, Vector3};
use serde_json::Value;

/// A made world in the conventions of the format: cameras look along −z, v points up.
fn problem(options: &MultiViewProblemOptions) -> BalProblem {
    let world = MultiViewProblem::new(options).unwrap();
    let flip = Vector3::new(1.0, -1.0, -1.0);
    let cameras = world.cameras.iter().map(|camera| {
        // diag(1, −1, −1) is half a turn about x.
        let half_turn =
            nalgebra::UnitQuaternion::from_scaled_axis(Vector3::x() * std::f64::consts::PI);
        BalCamera {
            rotation: (half_turn * camera.cam_from_world.rotation).scaled_axis(),
            translation: camera
                .cam_from_world
                .translation
                .vector
                .component_mul(&flip),
            focal_px: camera.camera.intrinsics.fu_px(),
            k1: 0.0,
            k2: 0.0,
        }
    });
    let observations = world.observations.iter().map(|o| {
        let center = world.cameras[o.camera].camera.intrinsics.principal_point();
        BundleObservation {
            camera: o.camera,
            point: o.point,
            pixel: Point2::new(o.pixel.x - center.x, center.y - o.pixel.y),
        }
    });
    BalProblem {
        cameras: cameras.collect(),
        observations: observations.collect(),
        points: world.points,
    }
}

/// Moves everything a little.
fn disturb(problem: &mut BalProblem) {
    let mut random = Random::new(4);
    let mut shift = |size: f64| Vector3::from_fn(|_, _| size * random.normal());
    for camera in &mut problem.cameras {
        camera.rotation += shift(0.01);
        camera.translation += shift(0.03);
        camera.focal_px += shift(5.0).x;
    }
    for point in &mut problem.points {
        *point += shift(0.03);
    }
}

#[test]
fn exact_observations_are_explained_exactly() {
    let folder = Folder::new("ba-exact");
    let mut problem = problem(&MultiViewProblemOptions::default());
    assert!(
        problem.cost(RobustLoss::Trivial) < 1e-12,
        "the conventions agree"
    );
    disturb(&mut problem);
    let file = folder.write("problem.txt", &write_bal(&problem));
    let out = folder.file("refined.txt");
    let result = json(&["ba", path(&file), "-o", path(&out)]);
    let initial = problem.cost(RobustLoss::Trivial);
    assert!((result["initial_cost"].as_f64().unwrap() / initial - 1.0).abs() < 1e-12);
    let last = result["final_cost"].as_f64().unwrap();
    assert!(last < 1e-9, "{last}");
    let refined = read_bal(&std::fs::read_to_string(&out).unwrap()).unwrap();
    assert!((refined.cost(RobustLoss::Trivial) - last).abs() < 1e-12);
    assert_eq!(refined.observations, problem.observations);
    // Costs of accepted steps only fall; the first is the start, the last the result.
    let history: Vec<Vec<f64>> = result["history"]
        .as_array()
        .unwrap()
        .iter()
        .map(numbers)
        .collect();
    assert_eq!(history[0], [0.0, result["initial_cost"].as_f64().unwrap()]);
    assert!(history.windows(2).all(|pair| pair[1][1] <= pair[0][1]));
    assert_eq!(history[history.len() - 1][1], last);
    assert!(result["iterations"].as_u64().unwrap() > 2);
    assert_ne!(result["termination"], "max-iterations");
    assert_eq!(folder.listing().len(), 2, "no part is left behind");
}

#[test]
fn noise_leaves_the_cost_that_statistics_predict_and_losses_bear_outliers() {
    let folder = Folder::new("ba-noise");
    let options = MultiViewProblemOptions::default()
        .with_noise_px(0.5)
        .with_seed(3);
    let file = folder.write("noise.txt", &write_bal(&problem(&options)));
    let result = json(&["ba", path(&file)]);
    // ½ σ² per degree of freedom: two an observation, less nine a camera, three a point, plus the
    // seven of the free frame.
    let freedom = f64::from(2 * 8 * 200 - 9 * 8 - 3 * 200 + 7);
    let ratio = result["final_cost"].as_f64().unwrap() / (0.5 * 0.25 * freedom);
    assert!((ratio - 1.0).abs() < 0.1, "{ratio}");

    let wild = options.with_outlier_fraction(0.05);
    let clean = problem(&options);
    let file = folder.write("wild.txt", &write_bal(&problem(&wild)));
    // Distance of the points from their positions without outliers.
    let distance = |loss: &str| {
        let out = folder.file("out.txt");
        let options = ["--loss", loss, "--loss-width", "2"];
        json(&[&["ba", path(&file), "-o", path(&out)], &options[..]].concat());
        let refined = read_bal(&std::fs::read_to_string(&out).unwrap()).unwrap();
        let align = epipole::sfm::align_points(
            &refined.points,
            &clean.points,
            epipole::sfm::AlignmentKind::Similarity,
        );
        let align = align.unwrap();
        let errors = refined
            .points
            .iter()
            .zip(&clean.points)
            .map(|(a, b)| (align * a - b).norm());
        let mut errors: Vec<f64> = errors.collect();
        errors.sort_by(f64::total_cmp);
        errors[errors.len() / 2]
    };
    let [none, robust @ ..] = ["none", "huber", "cauchy", "truncated"].map(distance);
    for error in robust {
        assert!(error < 0.5 * none, "{none} {robust:?}");
    }
}

#[test]
fn tolerances_end_the_steps() {
    let folder = Folder::new("ba-tolerances");
    let mut problem = problem(&MultiViewProblemOptions::default());
    disturb(&mut problem);
    let file = folder.write("problem.txt", &write_bal(&problem));
    for (flag, value, termination) in [
        // Any step lowers the cost by less than the whole.
        ("--cost-tolerance", "1", "small-cost-change"),
        ("--step-tolerance", "1", "small-step"),
        ("--gradient-tolerance", "1e30", "small-gradient"),
    ] {
        let result = json(&["ba", path(&file), flag, value]);
        assert_eq!(result["termination"], termination, "{flag}");
        assert!(result["iterations"].as_u64().unwrap() <= 1, "{result}");
    }
    for flag in ["--initial-damping", "--loss-width"] {
        fails(&folder, &["ba", path(&file), flag, "0"], 2, flag);
    }
}

#[test]
fn broken_problems_are_refused_with_their_line() {
    let folder = Folder::new("ba-bad");
    let camera = "0 0 0 0 0 0 100 0 0";
    for (text, expected) in [
        (String::new(), "the number of cameras"),
        ("1 1".to_owned(), "the number of observations"),
        (format!("1 1 1\n0 0 11 nan\n{camera}\n1 2 -10\n"), "line 2"),
        (
            "1 1 1\n0 0 11 20\n0 0 0 0 0 0 inf 0 0\n1 2 -10\n".to_owned(),
            "line 3",
        ),
        (
            format!("1 1 1\n0 0 11 20\n{camera}\n1 2\n"),
            "a point's coordinate",
        ),
        ("1 1 2\n0 0 11 20\n".to_owned(), "an observation's camera"),
        (format!("1 1 1\n0 1 11 20\n{camera}\n1 2 -10\n"), "line 2"),
        (format!("1 1 1\n3 0 11 20\n{camera}\n1 2 -10\n"), "line 2"),
        (
            format!("1 1 1\n0 0 11 20\n{camera}\n1 2 -10\n7\n"),
            "line 5",
        ),
        ("-1 1 1\n".to_owned(), "line 1"),
        (
            "4000000000 4000000000 4000000000\n".to_owned(),
            "the text ends where an observation's camera should follow",
        ),
        ("some words\n".to_owned(), "line 1"),
        // Cameras, but nothing that they see.
        (format!("2 0 0\n{camera}\n{camera}\n"), "needs at least"),
        // The point lies in the camera's own plane.
        (
            format!("1 1 1\n0 0 11 20\n{camera}\n1 2 0\n"),
            "bad.txt: the errors at the start are no finite numbers: a point is level",
        ),
    ] {
        let file = folder.write("bad.txt", &text);
        let out = folder.file("out.txt");
        fails(&folder, &["ba", path(&file), "-o", path(&out)], 1, expected);
    }
    // A camera and a point without observations do no harm.
    let text = format!("2 2 2\n0 0 11 20\n0 0 10 20\n{camera}\n{camera}\n1 2 -10\n0 0 -5\n");
    let file = folder.write("unseen.txt", &text);
    let result = json(&["ba", path(&file)]);
    assert!(
        (result["final_cost"].as_f64().unwrap() - 0.25).abs() < 1e-9,
        "{result}"
    );
    fails(&folder, &["ba", path(&file), "--loss", "l2"], 2, "l2");
    fails(
        &folder,
        &["ba", path(&file), "--max-iterations", "-1"],
        2,
        "-1",
    );
    let binary = folder.file("binary.txt");
    std::fs::write(&binary, [0xff, 0xfe, 0, 1]).unwrap();
    fails(
        &folder,
        &["ba", path(&binary)],
        1,
        "this is not a text file",
    );
    let nowhere = folder.file("no/folder/out.txt");
    fails(
        &folder,
        &["ba", path(&file), "-o", path(&nowhere)],
        1,
        "cannot be written",
    );
}

const UNIT: &str = "1 0 0 1 0 1";

#[test]
fn contradicting_measurements_meet_in_the_middle() {
    let folder = Folder::new("posegraph");
    // One measurement of 1 m, one of 2 m: 1.5 m is best, and leaves 0.25 twice.
    let text = format!(
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 5 1 0.3\n\
         EDGE_SE2 0 1 1 0 0 {UNIT}\nEDGE_SE2 0 1 2 0 0 {UNIT}\n"
    );
    let file = folder.write("two.g2o", &text);
    let out = folder.file("out.g2o");
    let result = json(&["posegraph", path(&file), "-o", path(&out)]);
    assert!(
        (result["final_chi2"].as_f64().unwrap() - 0.5).abs() < 1e-9,
        "{result}"
    );
    assert!(result["initial_chi2"].as_f64().unwrap() > 10.0);
    let written = std::fs::read_to_string(&out).unwrap();
    let pose = written
        .lines()
        .find(|line| line.starts_with("VERTEX_SE2 1 "))
        .unwrap();
    let values: Vec<f64> = pose
        .split(' ')
        .skip(2)
        .map(|word| word.parse().unwrap())
        .collect();
    for (value, truth) in values.iter().zip([1.5, 0.0, 0.0]) {
        assert!((value - truth).abs() < 1e-6, "{pose}");
    }
    // The written graph has the final cost.
    let again = json(&["posegraph", path(&out)]);
    assert!((again["initial_chi2"].as_f64().unwrap() - 0.5).abs() < 1e-9);
    // The measurements alone lead there, too: here least squares are linear.
    let anew = json(&["posegraph", path(&file), "--initialize"]);
    assert!(
        (anew["initial_chi2"].as_f64().unwrap() - 0.5).abs() < 1e-9,
        "{anew}"
    );

    // A square whose last side is 0.4 too long: each of the four sides takes a quarter of it.
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut text = String::new();
    for (n, (x, y)) in [(0.0, 0.0), (1.1, 0.0), (1.0, 0.9), (0.1, 1.0)]
        .into_iter()
        .enumerate()
    {
        text += &format!("VERTEX_SE2 {n} {x} {y} {}\n", quarter * n as f64);
    }
    for (a, b, length) in [(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0), (3, 0, 1.4)] {
        text += &format!("EDGE_SE2 {a} {b} {length} 0 {quarter} 100 0 0 100 0 1e6\n");
    }
    let file = folder.write("square.g2o", &text);
    let result = json(&["posegraph", path(&file)]);
    // Rotations are nearly fixed: 4 · 100 · 0.1².
    let chi2 = result["final_chi2"].as_f64().unwrap();
    assert!((chi2 - 4.0).abs() < 0.01, "{chi2}");
    assert_eq!(
        (&result["num_vertices"], &result["num_edges"]),
        (&Value::from(4), &Value::from(4))
    );
}

#[test]
fn a_wrong_measurement_is_borne_by_a_loss() {
    let folder = Folder::new("posegraph-loss");
    // Two measurements of 1 m, a third of 5 m.
    let text = format!(
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.2 0 0\n\
         EDGE_SE2 0 1 1 0 0 {UNIT}\nEDGE_SE2 0 1 1 0 0 {UNIT}\nEDGE_SE2 0 1 5 0 0 {UNIT}\n"
    );
    let file = folder.write("three.g2o", &text);
    let chi2 = |options: &[&str]| {
        let result = json(&[&["posegraph", path(&file)], options].concat());
        result["final_chi2"].as_f64().unwrap()
    };
    // The mean, 7/3, and the place of the two: the sums of squares are 2 (4/3)² + (8/3)² and 4².
    assert!((chi2(&[]) - 32.0 / 3.0).abs() < 1e-6);
    assert!((chi2(&["--loss", "truncated", "--loss-width", "2"]) - 16.0).abs() < 1e-6);
    assert!((chi2(&["--loss", "truncated", "--loss-width", "9"]) - 32.0 / 3.0).abs() < 1e-6);
}

#[test]
fn broken_graphs_are_refused() {
    let folder = Folder::new("posegraph-bad");
    let two = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n";
    for (text, expected) in [
        (String::new(), ""),
        (format!("{two}EDGE_SE2 0 1 1 0\n"), "line 3"),
        (
            format!("{two}EDGE_SE2 0 1 1 0 nan {UNIT}\n"),
            "\u{201c}nan\u{201d} is not a finite number",
        ),
        (format!("{two}EDGE_SE2 0 7 1 0 0 {UNIT}\n"), "line 3"),
        (format!("{two}EDGE_SE2 1 1 1 0 0 {UNIT}\n"), "with itself"),
        (
            format!("{two}EDGE_SE2 0 1 1 0 0 -1 0 0 1 0 1\n"),
            "not positive semi-definite",
        ),
        (format!("{two}VERTEX_SE2 1 1 0 0\n"), "is there twice"),
        ("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n".to_owned(), "line 1"),
        ("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n".to_owned(), "quaternion"),
        ("these are words\n".to_owned(), ""),
    ] {
        let file = folder.write("bad.g2o", &text);
        let out = folder.file("out.g2o");
        fails(
            &folder,
            &["posegraph", path(&file), "-o", path(&out)],
            1,
            expected,
        );
    }
    let missing = folder.file("missing.g2o");
    fails(
        &folder,
        &["posegraph", path(&missing)],
        1,
        "missing.g2o: there is no such file",
    );
}
