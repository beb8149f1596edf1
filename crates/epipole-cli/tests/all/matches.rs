//! Files of matches: what `epipole match -o` writes, `fit` and `two-view` read.

use crate::common::{Folder, command, epipole, fails, json, k, moved, numbers, parse, path};
use epipole::camera::RigidTransform;
use nalgebra::Vector3;
use std::io::Write;
use std::process::Stdio;

const SIZE: (u32, u32) = (400, 300);

/// Two photos of the still life, and the intrinsics of both.
fn pair(folder: &Folder) -> String {
    let motion = RigidTransform::new(
        Vector3::new(-0.25, 0.02, 0.03),
        Vector3::new(0.02, 0.17, 0.01),
    );
    let cameras = [
        moved(SIZE, &RigidTransform::identity()),
        moved(SIZE, &motion),
    ];
    for (camera, name) in cameras.iter().zip(["a.png", "b.png"]) {
        folder.write_photo(name, camera, SIZE);
    }
    k(&cameras[0])
}

#[test]
fn matches_that_were_written_give_the_same_geometry() {
    let folder = Folder::new("matches");
    let k = pair(&folder);
    let [a, b, text, csv] =
        ["a.png", "b.png", "matches.txt", "matches.csv"].map(|name| folder.file(name));
    let found = json(&["match", path(&a), path(&b), "-o", path(&text)]);
    json(&["match", path(&a), path(&b), "-o", path(&csv)]);
    let written = std::fs::read_to_string(&text).unwrap();
    assert!(written.starts_with("# u1 v1 u2 v2 distance ratio\n"));
    let count = found["matches"].as_array().unwrap().len();
    assert_eq!(written.lines().count(), count + 1);
    assert!(count > 100, "{count}");

    let mut direct = json(&["two-view", path(&a), path(&b), "--k", &k]);
    for arguments in [
        vec!["two-view", "--matches", path(&text), "--k", &k],
        vec![
            "two-view",
            path(&a),
            path(&b),
            "--matches",
            path(&csv),
            "--k",
            &k,
        ],
    ] {
        let mut of_file = json(&arguments);
        assert!(of_file["num_keypoints"].is_null());
        for result in [&mut of_file, &mut direct] {
            for field in ["time_ms", "num_keypoints"] {
                result.as_object_mut().unwrap().remove(field);
            }
        }
        assert_eq!(of_file, direct);
    }
    let fits: Vec<_> = [&text, &csv]
        .map(|file| json(&["fit", "--model", "fundamental", path(file)]))
        .into();
    assert_eq!(fits[0]["model"], fits[1]["model"]);

    // Standard input is a file, too.
    let mut run = command(&["fit", "--model", "fundamental", "-", "--json"])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    run.stdin
        .take()
        .unwrap()
        .write_all(written.as_bytes())
        .unwrap();
    let piped = parse(&run.wait_with_output().unwrap());
    assert_eq!(numbers(&piped["model"]), numbers(&fits[0]["model"]));

    // Standard output carries the file and no table.
    let output = epipole(&["match", path(&a), path(&b), "-o", "-"]);
    assert!(output.status.success());
    assert_eq!(String::from_utf8(output.stdout).unwrap(), written);
    let output = epipole(&["match", path(&a), path(&b), "-o", "-", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let sentence = String::from_utf8(output.stdout).unwrap();
    assert!(sentence.contains("both for standard output"), "{sentence}");
}

#[test]
fn inliers_that_were_written_all_agree() {
    let folder = Folder::new("inliers");
    let k = pair(&folder);
    let [a, b, text, inliers_file] =
        ["a.png", "b.png", "matches.txt", "kept.csv"].map(|name| folder.file(name));
    json(&[
        "match",
        path(&a),
        path(&b),
        "--ratio",
        "1",
        "-o",
        path(&text),
    ]);
    let fit = ["fit", "--model", "fundamental", path(&text)];
    let pose = ["two-view", "--matches", path(&text), "--k", &k];
    for arguments in [&fit[..], &pose[..]] {
        let found = json(&[arguments, &["-o", path(&inliers_file)]].concat());
        let count = &found["num_inliers"];
        // Above the thresholds of both commands.
        let wide = ["--max-error-px", "4"];
        let again = ["fit", "--model", "fundamental", path(&inliers_file)];
        let again = json(&[&again[..], &wide].concat());
        assert_eq!(again["inliers"].as_array().unwrap().len(), *count);
        assert_eq!(again["num_inliers"], *count);
    }
    let points = folder.write("points.txt", "0 0\n1 1\n2 2\n3 3\n4 4\n5 5\n6 6\n9 1\n");
    let line = epipole(&["fit", "--model", "line", path(&points), "-o", "-"]);
    let written = String::from_utf8(line.stdout).unwrap();
    assert_eq!(written, "# u v\n0 0\n1 1\n2 2\n3 3\n4 4\n5 5\n6 6\n");
}

#[test]
fn without_photos_the_camera_is_required() {
    let folder = Folder::new("matches-alone");
    let rows = (0..20).map(|n| format!("{} {} {} {}\n", n * 7 % 20, n, n * 7 % 20 + 3, n));
    let file = folder.write("matches.txt", &rows.collect::<String>());
    let broken = folder.write("broken.csv", "u1,v1,u2\n1,2,3\n");
    let matches = ["two-view", "--matches", path(&file)];
    for (more, expected) in [
        (
            &["--model", "essential"][..],
            "needs --k fx,fy,cx,cy or --camera",
        ),
        (&["--focal-px", "500"], "give both photos, or --k"),
        (&["a.png"], "SECOND"),
    ] {
        fails(&folder, &[&matches, more].concat(), 2, expected);
    }
    let broken = ["two-view", "--matches", path(&broken)];
    fails(
        &folder,
        &broken,
        1,
        "line 1: the first line names no columns u1 v1 u2 v2",
    );
    fails(&folder, &["two-view"], 2, "FIRST");
}
