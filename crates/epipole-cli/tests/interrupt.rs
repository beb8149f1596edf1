//! Ctrl-C: the work ends with a valid partial result.
//!
//! No test here depends on the speed of the machine. The program reads its last input from a pipe
//! that stays open: bytes taken from the pipe prove that its signal handler is installed, and its
//! message on standard error that the handler ran.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[allow(dead_code, reason = "the other tests use the rest")]
#[path = "all/common/mod.rs"]
mod common;

use common::{Folder, command, k, moved, parse, path};
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole_io::bundle::read_bal;
use nalgebra::Vector3;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

fn interrupt(child: &Child) {
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
}

/// Runs a command that reads `/dev/stdin`, and interrupts it before it has all of `input`.
fn interrupted_while_reading(arguments: &[&str], input: &[u8]) -> Output {
    // More than a pipe holds: writing returns once the program has read.
    assert!(input.len() > 1 << 20);
    let mut child = command(arguments).stdin(Stdio::piped()).spawn().unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let (most, last) = input.split_at(input.len() - 1);
    pipe.write_all(most).unwrap();
    interrupt(&child);
    let mut heard = String::new();
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    stderr.read_line(&mut heard).unwrap();
    assert!(heard.contains("ending with what there is"), "{heard}");
    pipe.write_all(last).unwrap();
    drop(pipe);
    let mut output = child.wait_with_output().unwrap();
    stderr.read_to_end(&mut output.stderr).unwrap();
    output
}

#[test]
fn bundle_adjustment_ends_with_the_best_that_it_has() {
    let folder = Folder::new("interrupt-ba");
    // One camera sees a point badly, 30 000 times.
    let mut text = "1 1 30000\n".to_owned();
    for n in 0..30_000 {
        text += &format!("0 0 {}.25 20.123456789012345678901234\n", n % 7);
    }
    text += "0 0 0 0 0 0 100 0 0\n1 2 -10\n";
    let out = folder.file("out.txt");
    let output = interrupted_while_reading(
        &["ba", "/dev/stdin", "-o", path(&out), "--json"],
        text.as_bytes(),
    );
    assert_eq!(output.status.code(), Some(0));
    let result = parse(&output);
    assert_eq!(result["termination"], "canceled");
    assert_eq!(result["iterations"], 0);
    let problem = read_bal(&text).unwrap();
    let written = read_bal(&std::fs::read_to_string(&out).unwrap()).unwrap();
    assert_eq!(written, problem, "no step was taken");
    let ratio = result["final_cost"].as_f64().unwrap() / problem.cost(RobustLoss::Trivial);
    assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
    assert_eq!(folder.listing().len(), 1, "no part is left behind");
}

/// More data than a pipe holds: unrelated matches, or matches of a similarity.
fn matches_text(wrong: bool) -> String {
    let mut random = Random::new(3);
    let mut text = String::new();
    for _ in 0..30_000 {
        let mut coordinate = || random.uniform(0.0, 1000.0);
        let (u, v) = (coordinate(), coordinate());
        let (p, q) = match wrong {
            true => (coordinate(), coordinate()),
            false => (1.5 * u - 0.5 * v + 7.0, 0.5 * u + 1.5 * v - 20.0),
        };
        text += &format!("{u} {v} {p} {q}\n");
    }
    text
}

const ENDLESS: [&str; 3] = ["--json", "--max-iterations", "4000000000"];

#[test]
fn fits_end_with_the_best_model_so_far() {
    for model in ["similarity", "homography", "line"] {
        let arguments = [&["fit", "--model", model, "/dev/stdin"], &ENDLESS[..]].concat();
        let output = interrupted_while_reading(&arguments, matches_text(false).as_bytes());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{model}: {stderr}");
        assert!(stderr.contains("warning: ended early"), "{model}: {stderr}");
        let result = parse(&output);
        // The signal came before the first sample, which is drawn nevertheless.
        assert_eq!(
            (&result["stop"], &result["iterations"]),
            (&"canceled".into(), &1.into())
        );
        // A line goes through a few points of this cloud.
        if model != "line" {
            assert_eq!(result["num_inliers"], 30_000, "{model}");
        }
    }
}

/// Nothing but the signal can end these runs: all matches are wrong, and four billion samples are
/// allowed.
#[test]
fn fits_end_soon_wherever_they_are() {
    for (model, camera) in [
        ("similarity", &[][..]),
        ("fundamental", &[]),
        ("essential", &["--k", "500,500,500,500"]),
    ] {
        let fit = ["fit", "--model", model, "/dev/stdin"];
        let arguments = [&fit[..], camera, &ENDLESS].concat();
        let mut child = command(&arguments).stdin(Stdio::piped()).spawn().unwrap();
        let mut pipe = child.stdin.take().unwrap();
        pipe.write_all(matches_text(true).as_bytes()).unwrap();
        drop(pipe);
        std::thread::sleep(Duration::from_millis(300));
        interrupt(&child);
        let output = child.wait_with_output().unwrap();
        let result = parse(&output);
        // On a slow machine it may have drawn one sample only, and not every sample gives a model.
        if output.status.code() == Some(1) {
            assert_eq!(result["error"]["kind"], "canceled", "{model}");
            continue;
        }
        assert_eq!(output.status.code(), Some(0), "{model}");
        assert_eq!(result["stop"], "canceled");
        assert!(result["num_inliers"].as_u64().unwrap() >= 2, "{model}");
    }
}

#[test]
fn two_views_are_canceled() {
    let folder = Folder::new("interrupt-two-view");
    let size = (240, 180);
    let shift = RigidTransform::new(Vector3::new(-0.1, 0.0, 0.0), Vector3::y() * 0.02);
    for (name, motion) in [("1.png", RigidTransform::identity()), ("2.png", shift)] {
        folder.write_photo(name, &moved(size, &motion), size);
    }
    let mut second = std::fs::read(folder.file("2.png")).unwrap();
    // Data behind the end of a PNG are ignored.
    second.resize(second.len().max(1 << 21), 0);
    let camera = k(&moved(size, &RigidTransform::identity()));
    for arguments in [&["--k", &camera][..], &[]] {
        let first = folder.file("1.png");
        let photos = ["two-view", path(&first), "/dev/stdin", "--json"];
        let output = interrupted_while_reading(&[&photos, arguments].concat(), &second);
        let stderr = String::from_utf8_lossy(&output.stderr);
        let result = parse(&output);
        // The choice among models needs all of them.
        assert_eq!(output.status.code(), Some(1), "{stderr}");
        assert_eq!(result["error"]["kind"], "canceled", "{stderr}");
    }
}

#[test]
fn a_second_signal_ends_at_once() {
    let mut child = command(&["ba", "/dev/stdin"])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all("0 ".repeat(1 << 20).as_bytes()).unwrap();
    interrupt(&child);
    let mut heard = String::new();
    BufReader::new(child.stderr.take().unwrap())
        .read_line(&mut heard)
        .unwrap();
    interrupt(&child);
    // The pipe is still open: only the signal can end the program.
    let status = child.wait().unwrap();
    assert_eq!(status.code(), Some(130));
    drop(pipe);
}

#[test]
fn structure_from_motion_is_valid_whenever_it_ends() {
    let folder = Folder::new("interrupt-sfm");
    let size = (240, 180);
    let mut photos = Vec::new();
    for n in 0..6 {
        let shift = Vector3::new(-0.08 * f64::from(n), 0.0, 0.0);
        let camera = moved(
            size,
            &RigidTransform::new(shift, Vector3::y() * 0.03 * f64::from(n)),
        );
        let name = format!("{n}.png");
        folder.write_photo(&name, &camera, size);
        photos.push(folder.file(&name));
    }
    let camera = k(&moved(size, &RigidTransform::identity()));
    let run = |name: &str, after: Option<Duration>| {
        let out = folder.file(name);
        let mut arguments = vec!["sfm"];
        arguments.extend(photos.iter().map(|photo| path(photo)));
        arguments.extend(["--k", &camera, "-o", path(&out), "--json", "--threads", "1"]);
        let child = command(&arguments).spawn().unwrap();
        if let Some(after) = after {
            std::thread::sleep(after);
            // It may have ended already.
            let _ = Command::new("kill")
                .args(["-INT", &child.id().to_string()])
                .status();
        }
        (child.wait_with_output().unwrap(), out)
    };
    let start = std::time::Instant::now();
    let (whole, _) = run("whole", None);
    let total = start.elapsed();
    let whole = parse(&whole);
    assert_eq!(
        (&whole["num_registered"], &whole["complete"]),
        (&6.into(), &true.into())
    );
    // One of four outcomes holds for any time of the signal. Bisection towards an interrupt with
    // part of the photographs registered finds one on most machines; the test does not require it.
    let (mut early, mut late) = (Duration::ZERO, total);
    for attempt in 0..8 {
        let after = (early + late) / 2;
        let (output, out) = run(&attempt.to_string(), Some(after));
        let Some(code) = output.status.code() else {
            // Before the program listened.
            assert!(!out.exists());
            early = after;
            continue;
        };
        let result = parse(&output);
        if code == 1 {
            assert_eq!(result["error"]["kind"], "canceled");
            assert!(!out.exists());
            early = after;
            continue;
        }
        assert_eq!(code, 0);
        let count = |file: &str, each: usize| {
            let text = std::fs::read_to_string(out.join(file)).unwrap();
            text.lines().filter(|line| !line.starts_with('#')).count() / each
        };
        let registered = result["num_registered"].as_u64().unwrap();
        assert_eq!(count("images.txt", 2) as u64, registered);
        assert_eq!(
            count("points3D.txt", 1) as u64,
            result["num_points"].as_u64().unwrap()
        );
        assert_eq!(
            result["images"].as_array().unwrap().len() as u64,
            registered
        );
        assert!(registered >= 2 && out.join("points.ply").exists());
        if result["complete"] == true {
            assert_eq!(result["images"], whole["images"]);
            late = after;
        } else {
            break;
        }
    }
}
