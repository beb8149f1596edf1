//! Prints the features of an image, one a line: `u v scale_px angle_rad response`, then the
//! descriptor's numbers. For scripts that compare detectors.
//!
//! Usage: `features_dump IMAGE [sift|rootsift|orb] [MAX_FEATURES]`

use epipole::feature::{OrbOptions, SiftNormalization, SiftOptions, detect_orb, detect_sift};
use epipole_io::photo::{DecodeOptions, decode_gray};
use std::io::Write;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = arguments.first().ok_or("which image?")?;
    let kind = arguments.get(1).map_or("sift", String::as_str);
    let max_features = arguments.get(2).map_or(Ok(0), |n| n.parse())?;
    let image = decode_gray(&std::fs::read(path)?, &DecodeOptions::default())?.image;
    let features = if kind == "orb" {
        let count = if max_features == 0 {
            1000
        } else {
            max_features
        };
        detect_orb(
            &image,
            &OrbOptions::default().with_max_features(count),
            &mut (),
        )?
    } else {
        let options = SiftOptions::default()
            .with_max_features(max_features)
            .with_normalization(match kind {
                "rootsift" => SiftNormalization::Root,
                _ => SiftNormalization::L2,
            });
        detect_sift(&image, &options, &mut ())?
    };
    let bytes: Vec<u8> = match features.descriptors.as_bits() {
        Some(words) => words
            .iter()
            .flatten()
            .flat_map(|word| word.to_le_bytes())
            .collect(),
        None => features.descriptors.as_bytes().unwrap_or_default().to_vec(),
    };
    let length = bytes.len() / features.keypoints.len().max(1);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for (k, descriptor) in features
        .keypoints
        .iter()
        .zip(bytes.chunks_exact(length.max(1)))
    {
        write!(
            out,
            "{} {} {} {} {}",
            k.u, k.v, k.scale_px, k.angle_rad, k.response
        )?;
        for value in descriptor {
            write!(out, " {value}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
