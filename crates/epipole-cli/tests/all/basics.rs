//! The contract of the command line: one JSON object on standard output, sentences on standard
//! error, exit statuses, nothing half-written.

use crate::common::{Folder, epipole, fails, moved, parse, path};
use epipole::camera::RigidTransform;
use serde_json::Value;
use std::path::PathBuf;

/// The still life from a camera that stands further to the right.
fn photo(folder: &Folder, name: &str, shift_m: f64) -> PathBuf {
    let size = (320, 240);
    let camera = moved(size, &RigidTransform::translation(-shift_m, 0.0, 0.0));
    folder.write_photo(name, &camera, size);
    folder.file(name)
}

fn json(arguments: &[&str]) -> Value {
    parse(&epipole(&[arguments, &["--json"]].concat()))
}

#[test]
fn a_file_holds_options() {
    let folder = Folder::new("config");
    let points = folder.write("points.txt", "0 0\n1 1\n2 2\n3 3.5\n4 4\n5 5\n6 6\n9 1\n");
    let config = folder.write(
        "options.toml",
        "json = true\n[fit]\nmodel = \"line\"\nmax-error-px = 0.1\n",
    );
    let read = ["fit", path(&points), "--config", path(&config)];
    let found = parse(&epipole(&read));
    assert_eq!(found["num_inliers"], 6);
    let wide = [&read[..], &["--max-error-px", "1"]].concat();
    assert_eq!(parse(&epipole(&wide))["num_inliers"], 7);

    let dumped = epipole(&["fit", "--dump-config", "--config", path(&config)]);
    let text = String::from_utf8(dumped.stdout).unwrap();
    assert!(
        text.contains("json = true") && text.contains("max-error-px = 0.1"),
        "{text}"
    );

    folder.write("options.toml", "[fit]\nmax-errors = 1\n");
    fails(
        &folder,
        &read,
        2,
        "options.toml: max-errors: epipole fit has no such option",
    );
    fails(
        &folder,
        &["fit", path(&points), "--config", "none"],
        1,
        "there is no such file",
    );
}

#[test]
fn a_figure_is_described_with_what_it_computes() {
    let folder = Folder::new("described");
    let png = folder.file("harris.png");
    let described = json(&["figure", "harris", "--describe"]);
    let drawn = json(&["figure", "harris", "--size", "100", "-o", path(&png)]);
    for field in ["description", "readouts"] {
        assert_eq!(described[field], drawn[field]);
    }
    let words = described["description"].as_str().unwrap();
    assert!(words.contains("strongest response"), "{words}");
}

#[test]
fn a_figure_is_drawn_and_described() {
    let folder = Folder::new("figure");
    let png = folder.file("race.png");
    let arguments = [
        "figure",
        "ransac-race",
        "--set",
        "outliers=0.6",
        "--size",
        "400",
        "-o",
        path(&png),
    ];
    let result = json(&arguments);
    assert_eq!(result["permalink"], "ransac-race?outliers=0.60");
    assert!(
        result["description"]
            .as_str()
            .unwrap()
            .contains("least squares")
    );
    assert!(
        result["readouts"]
            .as_array()
            .unwrap()
            .iter()
            .all(|r| r["label"].is_string())
    );
    assert!(result["time_ms"].as_f64().unwrap() > 0.0);
    let picture = image::open(&png).unwrap();
    assert_eq!(
        picture.width(),
        800,
        "400 CSS pixels at two device pixels each"
    );
    assert_eq!(
        std::fs::read_dir(&folder.0).unwrap().count(),
        1,
        "no part is left behind"
    );
}

#[test]
fn a_page_of_a_given_size_is_filled() {
    let folder = Folder::new("page");
    let png = folder.file("race.png");
    let size = ["--size", "800x300", "--scale", "1"];
    epipole(&[&["figure", "ransac-race", "-o", path(&png)], &size[..]].concat());
    let picture = image::open(&png).unwrap();
    assert_eq!((picture.width(), picture.height()), (800, 300));
}

#[test]
fn features_are_found_and_matched() {
    let folder = Folder::new("match");
    let (left, right) = (
        photo(&folder, "left.png", 0.0),
        photo(&folder, "right.png", 0.05),
    );
    let found = json(&["detect", path(&left), "--max-features", "100"]);
    assert_eq!(found["image"]["width"], 320);
    let keypoints = found["keypoints"].as_array().unwrap();
    assert!((50..=100).contains(&keypoints.len()), "{}", keypoints.len());
    assert!(
        keypoints
            .iter()
            .all(|keypoint| keypoint.as_array().unwrap().len() == 5)
    );

    let marked = folder.file("matches.png");
    let result = json(&[
        "match",
        path(&left),
        path(&right),
        "--mutual",
        "--png",
        path(&marked),
    ]);
    let matches = result["matches"].as_array().unwrap();
    assert!(matches.len() > 50, "{}", matches.len());
    let row = |list: &str, index: &Value| {
        let keypoint = &result[list][usize::try_from(index.as_u64().unwrap()).unwrap()];
        keypoint[1].as_f64().unwrap()
    };
    // The camera moved to the right, so matches stay in their rows.
    let in_row = matches
        .iter()
        .filter(|m| (row("keypoints1", &m[0]) - row("keypoints2", &m[1])).abs() < 1.0);
    assert!(in_row.count() * 10 > matches.len() * 9);
    assert_eq!(image::open(&marked).unwrap().width(), 640);
}

#[test]
fn the_same_seed_and_any_number_of_threads_give_the_same_result() {
    let folder = Folder::new("threads");
    let left = photo(&folder, "left.png", 0.0);
    let mut one = json(&["detect", path(&left), "--threads", "1"]);
    let mut two = json(&["detect", path(&left), "--threads", "2"]);
    for result in [&mut one, &mut two] {
        result.as_object_mut().unwrap().remove("time_ms");
    }
    assert_eq!(one, two);
}

#[test]
fn what_cannot_be_done_is_a_sentence_with_status_1() {
    let folder = Folder::new("bad");
    let broken = folder.file("broken.png");
    std::fs::write(&broken, b"\x89PNG\r\n\x1a\nnot really").unwrap();
    let missing = folder.file("missing.jpg");
    for (arguments, expected) in [
        (vec!["detect", path(&missing)], "there is no such file"),
        (vec!["detect", path(&broken)], "the image cannot be read"),
        (
            vec!["figure", "no-such-figure", "--describe"],
            "there is no figure",
        ),
        (
            vec!["figure", "ransac-race", "--set", "outliers=many"],
            "\"many\" is not a value",
        ),
        (
            vec!["figure", "ransac-race", "--set", "colour=red"],
            "no parameter \"colour\"",
        ),
    ] {
        let plain = epipole(&arguments);
        let sentence = String::from_utf8(plain.stderr).unwrap();
        assert_eq!(plain.status.code(), Some(1), "{arguments:?}");
        assert!(
            sentence.starts_with("error: ") && sentence.contains(expected),
            "{sentence}"
        );
        assert!(plain.stdout.is_empty(), "{arguments:?} prints no result");

        let result = json(&arguments);
        assert!(
            result["error"]["message"]
                .as_str()
                .unwrap()
                .contains(expected),
            "{result}"
        );
        assert!(result["error"]["kind"].is_string());
    }
}

#[test]
fn wrong_usage_has_status_2() {
    for arguments in [
        &["figure"][..],
        &["detect", "a.png", "--max-features", "-3"],
        &["match", "a.png", "b.png", "--ratio", "1.5"],
        &["figure", "ransac-race", "--size", "0x3"],
        &["no-such-command"],
    ] {
        let output = epipole(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty());
        assert_eq!(json(arguments)["error"]["kind"], "usage", "{arguments:?}");
    }
    // Only the name of the file shows that it cannot be written.
    let folder = Folder::new("usage");
    let jpg = folder.file("race.jpg");
    let arguments = ["figure", "ransac-race", "-o", path(&jpg)];
    fails(&folder, &arguments, 2, "must be a .png file");
}

/// A number below 0 is what an option was given, and no option of its own.
#[test]
fn numbers_that_mean_nothing_are_refused_by_the_option_that_got_them() {
    let folder = Folder::new("numbers");
    let blank = folder.blank("blank.png", (64, 48));
    for (arguments, option) in [
        (
            vec!["detect", path(&blank), "--max-features", "-1"],
            "--max-features",
        ),
        (
            vec!["detect", path(&blank), "--contrast-threshold", "-0.5"],
            "--contrast-threshold",
        ),
        (
            vec!["fit", "--model", "line", "any.txt", "--max-error-px", "-1"],
            "--max-error-px",
        ),
        (vec!["detect", path(&blank), "--seed", "-1"], "--seed"),
        (
            vec!["sfm", path(&blank), "-o", "out", "--focals-px", "-,-3"],
            "--focals-px",
        ),
        (vec!["figure", "ransac-race", "--scale", "-2"], "--scale"),
        (
            vec![
                "stereo",
                "a.png",
                "b.png",
                "-o",
                "d.pfm",
                "--focal-px",
                "1e200",
            ],
            "--focal-px",
        ),
        (
            vec!["two-view", "a.png", "b.png", "--k", "1e200,1e200,0,0"],
            "--k",
        ),
        (vec!["figure", "ransac-race", "--scale", "nan"], "--scale"),
    ] {
        let expected = format!(
            "invalid value '{}' for '{option}",
            arguments[arguments.len() - 1]
        );
        let expected = expected.replace("'-,-3'", "'-3'");
        fails(&folder, &arguments, 2, &expected);
    }
}

#[test]
fn every_command_has_an_example_in_its_help() {
    let help = String::from_utf8(epipole(&["--help"]).stdout).unwrap();
    let commands = help.split("Commands:").nth(1).unwrap();
    let names = commands
        .lines()
        .skip(1)
        .take_while(|line| line.starts_with("  "));
    let names: Vec<&str> = names
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.len() >= 4, "{names:?}");
    for name in names.into_iter().filter(|name| *name != "help") {
        let output = epipole(&[name, "--help"]);
        assert_eq!(output.status.code(), Some(0));
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(&format!("Example: epipole {name}")), "{name}");
    }
}
