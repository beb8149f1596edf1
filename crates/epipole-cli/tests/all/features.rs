//! `epipole detect` and `epipole match` on pictures that have nothing to offer, or are none.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use image::{GrayImage, Luma};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder for one test's files, removed with it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("epipole-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn picture(&self, name: &str, width: u32, height: u32, gray: fn(u32, u32) -> u8) -> String {
        let path = self.0.join(name);
        let picture = GrayImage::from_fn(width, height, |u, v| Luma([gray(u, v)]));
        picture.save(&path).unwrap();
        text(&path)
    }

    fn bytes(&self, name: &str, bytes: &[u8]) -> String {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).unwrap();
        text(&path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn text(path: &Path) -> String {
    path.to_str().unwrap().to_owned()
}

fn epipole(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_epipole"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Boxes of several sizes: corners and blobs.
fn boxes(u: u32, v: u32) -> u8 {
    let inside =
        |u0: u32, v0: u32, side: u32| (u0..u0 + side).contains(&u) && (v0..v0 + side).contains(&v);
    match (inside(20, 15, 12), inside(60, 30, 25), inside(25, 60, 18)) {
        (true, ..) => 230,
        (_, true, _) => 20,
        (.., true) => 180,
        _ => 90,
    }
}

const KINDS: [&str; 4] = ["sift", "rootsift", "orb", "harris"];

#[test]
fn a_picture_without_features_gives_an_empty_list() {
    let folder = Folder::new("nothing");
    let noise = |u: u32, v: u32| ((u * 7919 + v * 104_729) % 251) as u8;
    let pictures = [
        folder.picture("constant.png", 90, 70, |_, _| 128),
        folder.picture("dot.png", 1, 1, |_, _| 7),
        folder.picture("tiny.png", 3, 2, noise),
        folder.picture("row.png", 500, 1, noise),
        folder.picture("column.png", 1, 500, noise),
    ];
    for picture in &pictures {
        for kind in KINDS {
            let output = epipole(&["detect", picture, "--features", kind, "--json"]);
            let message = format!("{kind} {picture}: {output:?}");
            assert_eq!(output.status.code(), Some(0), "{message}");
            let result: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(
                result["keypoints"].as_array().unwrap().len(),
                0,
                "{message}"
            );
            assert!(result["image"]["width"].as_u64().unwrap() > 0);
        }
    }
}

#[test]
fn nothing_matches_nothing() {
    let folder = Folder::new("no-match");
    let flat = folder.picture("flat.png", 120, 100, |_, _| 50);
    let boxed = folder.picture("boxes.png", 120, 100, boxes);
    for kind in KINDS {
        for pair in [[&flat, &boxed], [&boxed, &flat], [&flat, &flat]] {
            let arguments = [
                "match",
                pair[0],
                pair[1],
                "--features",
                kind,
                "--mutual",
                "--json",
            ];
            let output = epipole(&arguments);
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
            let result: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(result["matches"].as_array().unwrap().len(), 0, "{kind}");
        }
    }
}

#[test]
fn a_picture_matches_itself() {
    let folder = Folder::new("itself");
    let boxed = folder.picture("boxes.png", 120, 100, boxes);
    for kind in KINDS {
        let output = epipole(&[
            "match",
            &boxed,
            &boxed,
            "--features",
            kind,
            "--ratio",
            "1",
            "--mutual",
            "--json",
        ]);
        let result: Value = serde_json::from_slice(&output.stdout).unwrap();
        let matches = result["matches"].as_array().unwrap();
        assert!(!matches.is_empty(), "{kind}");
        for found in matches {
            assert_eq!(
                found[2], 0.0,
                "{kind}: the same patch has the same descriptor"
            );
        }
    }
}

/// The checksum at the end of each chunk of a PNG file.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    };
    !bytes.iter().fold(!0, step)
}

#[test]
fn files_that_are_no_whole_picture_are_named_in_a_sentence() {
    let folder = Folder::new("broken");
    let whole = std::fs::read(folder.picture("whole.png", 120, 100, boxes)).unwrap();
    let truncated = folder.bytes("truncated.png", &whole[..whole.len() * 2 / 3]);
    let empty = folder.bytes("empty.png", &[]);
    let words = folder.bytes("words.jpg", b"Dear reader, this is a letter.");
    // A header that promises 400 megapixels, with a correct checksum.
    let mut huge = whole;
    for at in [16, 20] {
        huge[at..at + 4].copy_from_slice(&20_000_u32.to_be_bytes());
    }
    let crc = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    let huge = folder.bytes("huge.png", &huge);
    let whole = folder.picture("whole.png", 120, 100, boxes);
    for (file, name, expected) in [
        (&truncated, "truncated.png", "the image cannot be read"),
        (&empty, "empty.png", "the image cannot be read"),
        (&words, "words.jpg", "the image cannot be read"),
        (
            &huge,
            "huge.png",
            "400000000 pixels, more than the limit of",
        ),
    ] {
        for arguments in [vec!["detect", file], vec!["match", &whole, file]] {
            let plain = epipole(&arguments);
            let sentence = String::from_utf8(plain.stderr).unwrap();
            assert_eq!(plain.status.code(), Some(1), "{arguments:?}: {sentence}");
            assert!(plain.stdout.is_empty(), "{arguments:?}");
            for part in ["error: ", name, expected] {
                assert!(sentence.contains(part), "{sentence}");
            }
            let output = epipole(&[&arguments[..], &["--json"]].concat());
            let result: Value = serde_json::from_slice(&output.stdout).unwrap();
            let message = result["error"]["message"].as_str().unwrap();
            assert!(message.contains(expected), "{message}");
        }
    }
}
