//! Random bytes after the signature of a format.

use crate::bundle::read_bal;
use crate::cloud::read_ply;
use crate::damage::config;
use crate::depth_map::read_colmap_depth;
use crate::disparity::read_pfm;
use crate::photo::{DecodeOptions, decode_gray, sensor_size};
use crate::pose_graph::read_g2o;
use proptest::prelude::*;

const STARTS: [&[u8]; 20] = [
    b"",
    b"\x89PNG\r\n\x1a\n",
    b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
    b"\xff\xd8\xff",
    b"\xff\xd8\xff\xe1\0\x40Exif\0\0II*\0",
    b"RIFF\x40\0\0\0WEBPVP8",
    b"BM",
    b"P1\n",
    b"P5 4 4 255\n",
    b"P6 ",
    b"II*\0\x08\0\0\0",
    b"MM\0*\0\0\0\x08",
    b"\0\0\0\x18ftypheic",
    b"Pf\n2 2\n-1.0\n",
    b"PF\n",
    b"2&1&1&",
    b"ply\nformat ascii 1.0\nelement vertex 2\n",
    b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n",
    b"VERTEX_SE2 ",
    b"1 1 1\n",
];

/// Reads the bytes with every reader of a format with a signature.
fn read_all(bytes: &[u8]) -> Result<(), TestCaseError> {
    let has_message = |error: crate::Error| !error.to_string().is_empty();
    let options = DecodeOptions::default().with_max_pixels(20_000);
    match decode_gray(bytes, &options) {
        Ok(decoded) => prop_assert!(decoded.image.as_raw().iter().all(|gray| gray.is_finite())),
        Err(error) => prop_assert!(has_message(error)),
    }
    prop_assert!(sensor_size(bytes).map_or_else(has_message, |_| true));
    match read_ply(bytes) {
        Ok((cloud, _)) => {
            prop_assert!(cloud.points.iter().all(|x| x.iter().all(|x| x.is_finite())))
        }
        Err(error) => prop_assert!(has_message(error)),
    }
    match read_pfm(bytes) {
        Ok(image) => prop_assert!(image.as_raw().iter().all(|d| d.is_finite() || d.is_nan())),
        Err(error) => prop_assert!(has_message(error)),
    }
    match read_colmap_depth(bytes) {
        Ok(depth) => prop_assert!(depth.as_raw().iter().all(|z| *z > 0.0 || z.is_nan())),
        Err(error) => prop_assert!(has_message(error)),
    }
    let text = String::from_utf8_lossy(bytes);
    prop_assert!(read_g2o(&text).map_or_else(has_message, |read| read.graph.size().0 > 0));
    prop_assert!(
        read_bal(&text).map_or_else(has_message, |problem| !problem.observations.is_empty())
    );
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn random_bytes(
        start in 0..STARTS.len(), bytes in prop::collection::vec(any::<u8>(), 0..1000),
    ) {
        read_all(&[STARTS[start], &bytes].concat())?;
    }

    #[test]
    fn random_signs(start in 0..STARTS.len(), text in "[a-zA-Z_:0-9 .\n+-]{0,200}") {
        read_all(&[STARTS[start], text.as_bytes()].concat())?;
    }
}
