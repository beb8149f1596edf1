//! Arrays from NumPy, SciPy, scikit-image and OpenCV, for tests.

use super::GrayImage32;
use image::GrayImage;
use std::path::PathBuf;

/// An array of a `.npy` file, rows first.
pub(crate) struct Array<T> {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<T>,
}

/// Returns the path of a real photo, or `None` with a printed message if it is missing.
pub(crate) fn data(relative: &str) -> Option<PathBuf> {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = root.join(relative);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: no data at {}", path.display());
    None
}

fn read(name: &str, kind: &str) -> (Vec<usize>, Vec<u8>) {
    let path = PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/peers/fixtures"
    ))
    .join(name);
    let file = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
    let header = std::str::from_utf8(&file[10..10 + length]).unwrap();
    assert!(header.contains(kind), "{name} is {header}, not {kind}");
    assert!(header.contains("'fortran_order': False"));
    let from = header.find("'shape': (").unwrap() + 10;
    let to = from + header[from..].find(')').unwrap();
    let shape = header[from..to]
        .split(',')
        .filter_map(|n| n.trim().parse().ok())
        .collect();
    (shape, file[10 + length..].to_vec())
}

pub(crate) fn bytes(name: &str) -> Array<u8> {
    let (shape, values) = read(name, "|u1");
    Array { shape, values }
}

pub(crate) fn floats(name: &str) -> Array<f32> {
    let (shape, raw) = read(name, "<f4");
    let values = raw
        .as_chunks::<4>()
        .0
        .iter()
        .map(|&b| f32::from_le_bytes(b));
    Array {
        shape,
        values: values.collect(),
    }
}

pub(crate) fn gray32(name: &str) -> GrayImage32 {
    let array = floats(name);
    GrayImage32::from_raw(array.shape[1] as u32, array.shape[0] as u32, array.values).unwrap()
}

pub(crate) fn gray8(name: &str) -> GrayImage {
    let array = bytes(name);
    GrayImage::from_raw(array.shape[1] as u32, array.shape[0] as u32, array.values).unwrap()
}

/// Asserts that two images agree to within `relative` times the reference's largest value.
pub(crate) fn assert_close(ours: &GrayImage32, reference: &GrayImage32, relative: f32, what: &str) {
    assert_eq!(ours.dimensions(), reference.dimensions(), "{what}");
    let largest = reference
        .as_raw()
        .iter()
        .fold(0.0f32, |m, v| m.max(v.abs()));
    let worst = ours
        .as_raw()
        .iter()
        .zip(reference.as_raw())
        .fold(0.0f32, |m, (a, b)| m.max((a - b).abs()));
    assert!(
        worst <= relative * largest,
        "{what}: off by {worst}, largest {largest}, relative {}",
        worst / largest
    );
}
