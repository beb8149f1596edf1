//! Files that cannot be read: the Lab says so in words, and goes on with the others.

use crate::common::{finish, jpeg, png, sentences};
use epipole_lab::project::{Blob, Project};
use epipole_lab::session::Event;
use image::RgbImage;

/// The beginning of a PNG file of so many pixels.
fn promise(width: u32, height: u32) -> Vec<u8> {
    let mut head = b"IHDR".to_vec();
    head.extend(width.to_be_bytes());
    head.extend(height.to_be_bytes());
    head.extend([8, 0, 0, 0, 0]);
    let mut check = !0_u32;
    for byte in &head {
        check ^= u32::from(*byte);
        for _ in 0..8 {
            check = (check >> 1) ^ if check & 1 == 1 { 0xEDB8_8320 } else { 0 };
        }
    }
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0D".to_vec();
    bytes.extend(head);
    bytes.extend((!check).to_be_bytes());
    // Data of no length: what was promised does not come.
    bytes.extend(b"\0\0\0\0IDAT\x35\xAF\x06\x1E");
    bytes
}

#[test]
fn a_file_that_is_none_leaves_the_others_alone() {
    let mut project = Project::default();
    project.update(Event::Add(vec![
        (
            "broken.jpg".to_owned(),
            vec![0xFF, 0xD8, 0xFF, 0, 1, 2].into(),
        ),
        ("flat.png".to_owned(), png(64, 48)),
        ("flat.png".to_owned(), png(65, 48)),
    ]));
    finish(&mut project);
    // A file that promises more pixels than anybody has memory for.
    let huge = promise(100_000, 90_000);
    project.update(Event::Add(vec![("huge.png".to_owned(), huge.into())]));
    finish(&mut project);
    let words = project.outcome_words(&project.document().photos[3]);
    assert!(
        words.starts_with("cannot be read") && words.contains("9000000000"),
        "{words}"
    );
    let (each, all) = sentences(&mut project);
    assert!(each[0].starts_with("cannot be read"), "{each:?}");
    assert!(each[1].contains("features, which is too few"), "{each:?}");
    assert!(all.contains("broken.jpg: cannot be read"), "{all}");
    assert_eq!(project.document().photos[2].name, "flat-2.png");
}

#[test]
fn a_file_that_is_damaged_is_told_with_the_row() {
    let image = RgbImage::from_fn(160, 120, |u, v| {
        image::Rgb([(u * v % 251) as u8, (v * 2) as u8, (u * 7 % 256) as u8])
    });
    let whole = jpeg(&image, 1);
    let middle = whole.len() / 2;
    // The data end in the middle, and the file does not: decoders that show what they can take it
    // for whole.
    let cut: Blob = [&whole[..middle], &[0xFF, 0xD9]].concat().into();
    let mut project = Project::default();
    project.update(Event::Add(vec![
        ("cut.jpg".to_owned(), cut),
        ("whole.jpg".to_owned(), whole),
    ]));
    finish(&mut project);
    let (each, all) = sentences(&mut project);
    assert!(
        each[0].contains("is damaged: its data end after"),
        "{each:?}"
    );
    assert!(each[0].contains("of 120 rows"), "{each:?}");
    assert!(!each[1].contains("cannot be read"), "{each:?}");
    assert!(all.contains("cut.jpg: cannot be read"), "{all}");
    assert!(project.photograph(&project.document().photos[1]).is_some());
}
