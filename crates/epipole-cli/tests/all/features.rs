//! `epipole detect` and `epipole match` on pictures that have nothing to offer, or are none.

use crate::common::{Folder, epipole, path};
use image::{GrayImage, Luma};
use serde_json::Value;

fn picture(
    folder: &Folder,
    name: &str,
    width: u32,
    height: u32,
    gray: fn(u32, u32) -> u8,
) -> String {
    let file = folder.file(name);
    let picture = GrayImage::from_fn(width, height, |u, v| Luma([gray(u, v)]));
    picture.save(&file).unwrap();
    path(&file).to_owned()
}

fn bytes(folder: &Folder, name: &str, bytes: &[u8]) -> String {
    let file = folder.file(name);
    std::fs::write(&file, bytes).unwrap();
    path(&file).to_owned()
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
        picture(&folder, "constant.png", 90, 70, |_, _| 128),
        picture(&folder, "dot.png", 1, 1, |_, _| 7),
        picture(&folder, "tiny.png", 3, 2, noise),
        picture(&folder, "row.png", 500, 1, noise),
        picture(&folder, "column.png", 1, 500, noise),
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
    let flat = picture(&folder, "flat.png", 120, 100, |_, _| 50);
    let boxed = picture(&folder, "boxes.png", 120, 100, boxes);
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
    let boxed = picture(&folder, "boxes.png", 120, 100, boxes);
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
    let whole = std::fs::read(picture(&folder, "whole.png", 120, 100, boxes)).unwrap();
    let truncated = bytes(&folder, "truncated.png", &whole[..whole.len() * 2 / 3]);
    let empty = bytes(&folder, "empty.png", &[]);
    let words = bytes(&folder, "words.jpg", b"Dear reader, this is a letter.");
    // A header that promises 400 megapixels, with a correct checksum.
    let mut huge = whole;
    for at in [16, 20] {
        huge[at..at + 4].copy_from_slice(&20_000_u32.to_be_bytes());
    }
    let crc = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    let huge = bytes(&folder, "huge.png", &huge);
    let whole = picture(&folder, "whole.png", 120, 100, boxes);
    for (file, name, expected) in [
        (&truncated, "truncated.png", "the image cannot be read"),
        (&empty, "empty.png", "the image cannot be read"),
        (&words, "words.jpg", "the image cannot be read"),
        (
            &huge,
            "huge.png",
            "400.0 megapixels, more than --max-memory-gb 2 holds",
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
