//! `epipole stereo` against the exact depth of a rendered pair.

use crate::common::{Folder, fails, json, moved, path};
use epipole::camera::RigidTransform;
use serde_json::Value;
use std::path::Path;

const SIZE: (u32, u32) = (320, 240);
const BASELINE_M: f64 = 0.06;

/// A rectified pair and the true disparity of each pixel of the left picture.
fn pair(folder: &Folder) -> (f64, Vec<f32>) {
    let left = moved(SIZE, &RigidTransform::identity());
    let write_photo = folder.write_photo("left.png", &left, SIZE);
    let right = moved(SIZE, &RigidTransform::translation(-BASELINE_M, 0.0, 0.0));
    folder.write_photo("right.png", &right, SIZE);
    let focal_px = left.camera.intrinsics.fu_px();
    let of_depth = |depth: &f32| (focal_px * BASELINE_M / f64::from(*depth)) as f32;
    (focal_px, write_photo.depth_m.iter().map(of_depth).collect())
}

/// The values of a PFM file, top row first.
fn read_pfm(file: &Path) -> Vec<f32> {
    let bytes = std::fs::read(file).unwrap();
    let header = format!("Pf\n{} {}\n", SIZE.0, SIZE.1);
    assert!(bytes.starts_with(header.as_bytes()));
    let values = &bytes[bytes.len() - 4 * (SIZE.0 * SIZE.1) as usize..];
    let scale = std::str::from_utf8(&bytes[header.len()..bytes.len() - values.len()]).unwrap();
    assert!(scale.trim().parse::<f32>().unwrap() < 0.0, "little-endian");
    let values: Vec<f32> = values
        .chunks(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let rows = values.chunks(SIZE.0 as usize).rev();
    rows.flatten().copied().collect()
}

/// Shares of all pixels that have a value, and that are more than 2 px off.
fn judge(found: &[f32], truth: &[f32]) -> (f64, f64) {
    let count = |is: &dyn Fn(f32, f32) -> bool| {
        let those = found.iter().zip(truth).filter(|(f, t)| is(**f, **t));
        those.count() as f64 / truth.len() as f64
    };
    (
        count(&|f, _| f.is_finite()),
        count(&|f, t| (f - t).abs() > 2.0),
    )
}

#[test]
fn disparities_are_those_of_the_scene() {
    let folder = Folder::new("stereo");
    let (_, truth) = pair(&folder);
    let [left, right, out] = ["left.png", "right.png", "d.pfm"].map(|name| folder.file(name));
    let base = [
        "stereo",
        path(&left),
        path(&right),
        "-o",
        path(&out),
        "--max-disparity",
        "40",
    ];
    for (options, least_density, most_bad) in [
        (&["--method", "sgm"][..], 0.75, 0.04),
        (&["--method", "bm"], 0.4, 0.04),
        (&["--method", "sgm", "--fill"], 1.0, 0.1),
    ] {
        let result = json(&[&base[..], options].concat());
        let found = read_pfm(&out);
        let (density, bad) = judge(&found, &truth);
        assert!(
            density >= least_density && bad <= most_bad,
            "{options:?}: {density} {bad}"
        );
        assert_eq!(
            (result["width"].as_u64(), result["height"].as_u64()),
            (Some(320), Some(240))
        );
        assert!((result["density"].as_f64().unwrap() - density).abs() < 1e-6);
        let valid = || found.iter().filter(|d| d.is_finite()).copied();
        let least = valid().fold(f32::INFINITY, f32::min);
        let most = valid().fold(0.0, f32::max);
        assert!((result["min_disparity_px"].as_f64().unwrap() - f64::from(least)).abs() < 1e-4);
        assert!((result["max_disparity_px"].as_f64().unwrap() - f64::from(most)).abs() < 1e-4);
        assert!(least >= 0.0 && most <= 41.0);
        // Only what lies within the range is looked for.
        let result = json(&[&base[..], options, &["--min-disparity", "12"]].concat());
        assert!(result["min_disparity_px"].as_f64().unwrap() >= 11.0);
    }
    // Tests that are left out leave more answers, and strict ones fewer.
    let density = |options: &[&str]| {
        let result = json(&[&base[..], options].concat());
        result["density"].as_f64().unwrap()
    };
    for method in ["sgm", "bm"] {
        let usual = density(&["--method", method]);
        let lax = "--uniqueness-percent 0 --left-right-max-px any --speckle-size 0";
        let lax: Vec<&str> = lax.split(' ').collect();
        let lax = density(&[&["--method", method], &lax[..]].concat());
        let strict = density(&["--method", method, "--uniqueness-percent", "60"]);
        assert!(
            strict < usual && usual < lax,
            "{method}: {strict} {usual} {lax}"
        );
    }
    for (options, expected) in [
        (
            &["--method", "bm", "--paths", "4"][..],
            "--paths belongs to --method sgm",
        ),
        (
            &["--window-px", "9"],
            "--window-px belongs to --method bm, which is not selected",
        ),
        (&["--paths", "6"], "none of 4, 5 and 8"),
        (&["--left-right-max-px", "some"], "\"any\""),
    ] {
        fails(&folder, &[&base[..], options].concat(), 2, expected);
    }
}

#[test]
fn pictures_and_clouds_hold_the_same() {
    let folder = Folder::new("stereo-files");
    let (focal_px, truth) = pair(&folder);
    let [left, right, pfm, png, ply] =
        ["left.png", "right.png", "d.pfm", "d.png", "cloud.ply"].map(|name| folder.file(name));
    json(&["stereo", path(&left), path(&right), "-o", path(&pfm)]);
    let focal = focal_px.to_string();
    let cloud = [
        "--ply",
        path(&ply),
        "--focal-px",
        &focal,
        "--baseline-m",
        "0.06",
    ];
    let result = json(
        &[
            &["stereo", path(&left), path(&right), "-o", path(&png)],
            &cloud[..],
        ]
        .concat(),
    );
    let values = read_pfm(&pfm);
    let picture = image::open(&png).unwrap().into_luma16();
    for (value, pixel) in values.iter().zip(picture.pixels()) {
        let from_png = f32::from(pixel.0[0]) / 256.0;
        if value.is_finite() {
            assert!(
                (from_png - value).abs() <= 0.5 / 256.0 + 1e-6,
                "{from_png} {value}"
            );
        } else {
            assert_eq!(from_png, 0.0);
        }
    }
    let bytes = std::fs::read(&ply).unwrap();
    let end = bytes
        .windows(11)
        .position(|w| w == b"end_header\n")
        .unwrap()
        + 11;
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let count: usize = header
        .lines()
        .find_map(|line| line.strip_prefix("element vertex "))
        .unwrap()
        .parse()
        .unwrap();
    assert!(header.contains("format binary_little_endian 1.0"));
    let with_depth = values.iter().filter(|d| **d > 0.0).count();
    assert_eq!(count, with_depth, "{}", result["density"]);
    let size = (bytes.len() - end) / count;
    let depths = bytes[end..]
        .chunks(size)
        .map(|vertex| f32::from_le_bytes([vertex[8], vertex[9], vertex[10], vertex[11]]));
    let mut found: Vec<f32> = depths.collect();
    let mut truth: Vec<f32> = truth
        .iter()
        .map(|d| (focal_px * BASELINE_M) as f32 / d)
        .collect();
    for list in [&mut found, &mut truth] {
        list.sort_by(f32::total_cmp);
    }
    let ratio = found[found.len() / 2] / truth[truth.len() / 2];
    assert!((ratio - 1.0).abs() < 0.15, "meters along the axis: {ratio}");
}

#[test]
fn a_wall_without_texture_gives_valid_files() {
    let folder = Folder::new("stereo-flat");
    let blank = folder.blank("blank.png", SIZE);
    let tiny = folder.blank("tiny.png", (1, 1));
    for (picture, method) in [(&blank, "sgm"), (&blank, "bm"), (&tiny, "sgm")] {
        for name in ["d.pfm", "d.png"] {
            let out = folder.file(name);
            let base = ["stereo", path(picture), path(picture), "--method", method];
            let result = json(&[&base[..], &["-o", path(&out), "--fill"]].concat());
            let density = result["density"].as_f64().unwrap();
            assert!((0.0..=1.0).contains(&density));
            assert_eq!(result["min_disparity_px"] == Value::Null, density == 0.0);
            assert!(std::fs::metadata(&out).unwrap().len() > 0);
        }
    }
    // Block matching knows nothing of a wall without texture.
    let out = folder.file("bm.pfm");
    let base = ["stereo", path(&blank), path(&blank), "-o", path(&out)];
    assert_eq!(
        json(&[&base[..], &["--method", "bm"]].concat())["density"],
        0.0
    );
    // Paths answer from smoothness, and it is said.
    let stderr = String::from_utf8(crate::common::epipole(&base).stderr).unwrap();
    assert_eq!(stderr.matches("shows no texture").count(), 2, "{stderr}");
    assert_eq!(stderr.matches("are the same image").count(), 1, "{stderr}");
}

#[test]
fn what_cannot_be_matched_is_refused() {
    let folder = Folder::new("stereo-bad");
    let [a, b] = [
        folder.blank("a.png", (64, 48)),
        folder.blank("b.png", (64, 50)),
    ];
    let out = folder.file("d.pfm");
    let base = ["stereo", path(&a), path(&a), "-o", path(&out)];
    let with = |more: &[&'static str]| [&base[..], more].concat();
    let sizes = ["stereo", path(&a), path(&b), "-o", path(&out)];
    fails(&folder, &sizes, 1, "must have the same size");
    for wrong in ["0", "-5", "ten", "5000"] {
        fails(&folder, &with(&["--max-disparity", wrong]), 2, wrong);
    }
    let crossed = ["--min-disparity", "20", "--max-disparity", "20"];
    fails(&folder, &with(&crossed), 2, "they are 20 and 20");
    fails(&folder, &with(&["--method", "magic"]), 2, "magic");
    let small = folder.blank("small.png", (9, 9));
    let arguments = [
        "stereo",
        path(&small),
        path(&small),
        "-o",
        path(&out),
        "--method",
        "bm",
    ];
    fails(
        &folder,
        &arguments,
        1,
        "the window must be no larger than the shorter side",
    );
    fails(
        &folder,
        &with(&["--ply", "cloud.ply"]),
        2,
        "give --q, or --focal-px",
    );
    let no_q = folder.write("no-q.json", "{\"q\": null}");
    let arguments = [&base[..], &["--ply", "cloud.ply", "--q", path(&no_q)]].concat();
    fails(&folder, &arguments, 1, "no-q.json: Q is missing");
    fails(&folder, &with(&["--doffs", "3"]), 2, "--ply");
    for wrong in ["0", "-1", "nan", "inf"] {
        let arguments = [
            "--ply",
            "cloud.ply",
            "--baseline-m",
            "1",
            "--focal-px",
            wrong,
        ];
        fails(&folder, &with(&arguments), 2, wrong);
    }
    let jpg = folder.file("d.jpg");
    fails(
        &folder,
        &["stereo", path(&a), path(&a), "-o", path(&jpg)],
        2,
        "must be a .pfm or .png file",
    );
    let nowhere = folder.file("no/such/folder/d.pfm");
    fails(
        &folder,
        &["stereo", path(&a), path(&a), "-o", path(&nowhere)],
        1,
        "cannot be written",
    );
    // A file that is no picture, and one cut off in the middle.
    let text = folder.write("text.png", "not a picture");
    fails(
        &folder,
        &["stereo", path(&text), path(&a), "-o", path(&out)],
        1,
        "text.png: the image cannot be read",
    );
    let bytes = std::fs::read(&a).unwrap();
    let cut = folder.file("cut.png");
    std::fs::write(&cut, &bytes[..bytes.len() / 2]).unwrap();
    fails(
        &folder,
        &["stereo", path(&a), path(&cut), "-o", path(&out)],
        1,
        "cut.png: the image cannot be read",
    );
}

/// Points of a cloud, x, y, z each.
fn read_cloud(file: &Path) -> Vec<[f32; 3]> {
    let (cloud, _) = epipole_io::cloud::read_ply(&std::fs::read(file).unwrap()).unwrap();
    let points = cloud.points.iter();
    points
        .map(|p| [p.x as f32, p.y as f32, p.z as f32])
        .collect()
}

#[test]
fn a_cloud_follows_from_q_or_from_its_numbers() {
    let folder = Folder::new("stereo-q");
    pair(&folder);
    let [left, right, pfm, ply] =
        ["left.png", "right.png", "d.pfm", "c.ply"].map(|name| folder.file(name));
    let base = [
        "stereo",
        path(&left),
        path(&right),
        "-o",
        path(&pfm),
        "--ply",
        path(&ply),
    ];
    let cloud = |more: &[&str]| {
        json(&[&base[..], more].concat());
        read_cloud(&ply)
    };
    // Z = f B/(d + doffs), X = (u − cx) Z/f.
    let numbers = "--focal-px 300 --baseline-m 0.5 --cx 100 --cy 90 --doffs 2.5";
    let found = cloud(&numbers.split(' ').collect::<Vec<_>>());
    let values = read_pfm(&pfm);
    let pixels = values.iter().enumerate().filter(|(_, d)| d.is_finite());
    let expected = pixels.map(|(n, d)| {
        let depth = 150.0 / (f64::from(*d) + 2.5);
        let (u, v) = ((n as u32 % SIZE.0) as f32, (n as u32 / SIZE.0) as f32);
        let depth = depth as f32;
        [
            (u - 100.0) * depth / 300.0,
            (v - 90.0) * depth / 300.0,
            depth,
        ]
    });
    let expected: Vec<[f32; 3]> = expected.collect();
    assert_eq!(found.len(), expected.len());
    for (p, q) in found.iter().zip(&expected) {
        assert!(
            (0..3).all(|i| (p[i] - q[i]).abs() <= 1e-5 * q[2]),
            "{p:?} {q:?}"
        );
    }
    let q = folder.write(
        "q.yml",
        "%YAML:1.0\n---\nQ: [1,0,0,-100, 0,1,0,-90, 0,0,0,300, 0,0,2,5]\n",
    );
    assert_eq!(cloud(&["--q", path(&q)]), found);
}

#[test]
fn a_pair_whose_rows_do_not_agree_is_reported() {
    let folder = Folder::new("stereo-rows");
    pair(&folder);
    let upper = moved(SIZE, &RigidTransform::translation(0.0, -0.06, 0.0));
    folder.write_photo("upper.png", &upper, SIZE);
    let out = folder.file("d.pfm");
    let stderr_of = |first: &str, second: &str, more: &[&str]| {
        let [first, second] = [first, second].map(|name| folder.file(name));
        let base = ["stereo", path(&first), path(&second), "-o", path(&out)];
        let output = crate::common::epipole(&[&base[..], more].concat());
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    let vertical = stderr_of("left.png", "upper.png", &[]);
    assert!(vertical.contains("columns agree, not rows"), "{vertical}");
    let swapped = stderr_of("right.png", "left.png", &[]);
    assert!(swapped.contains("may be swapped"), "{swapped}");
    let narrow = stderr_of("left.png", "right.png", &["--max-disparity", "3"]);
    assert!(narrow.contains("set --min-disparity"), "{narrow}");
    assert_eq!(stderr_of("left.png", "right.png", &[]), "");
}
