//! Depth maps and normal maps of COLMAP's dense stereo.
//!
//! Source: `Mat::Write` of COLMAP's `mvs/mat.h`: `width&height&channels&` as text, then floats,
//! little-endian, row by row, channel by channel.

use crate::{Error, Result};
use epipole::nalgebra::Vector3;
use image::{ImageBuffer, Luma};

/// Depth of each pixel.
type Depths = ImageBuffer<Luma<f32>, Vec<f32>>;

/// Writes a depth map, such as `stereo/depth_maps/NAME.geometric.bin`; NaN becomes 0, no value.
pub fn write_colmap_depth(depth: &Depths) -> Vec<u8> {
    let value = |z: &f32| if z.is_finite() { *z } else { 0.0 };
    let values = depth.as_raw().iter().map(value);
    bytes(depth.dimensions(), 1, values)
}

/// Writes a normal map, such as `stereo/normal_maps/NAME.geometric.bin`; zeros mean no value.
///
/// * `normals`: in the camera's frame, row by row
///
/// # Errors
/// [`Error::Malformed`] if the numbers of normals and pixels differ.
pub fn write_colmap_normals(size: (u32, u32), normals: &[Vector3<f32>]) -> Result<Vec<u8>> {
    let num_pixels = size.0 as usize * size.1 as usize;
    if normals.len() != num_pixels {
        return Err(Error::malformed(format!(
            "{} normals for {num_pixels} pixels",
            normals.len()
        )));
    }
    let values = (0..3).flat_map(|axis| normals.iter().map(move |normal| normal[axis]));
    Ok(bytes(size, 3, values))
}

fn bytes((width, height): (u32, u32), channels: u32, values: impl Iterator<Item = f32>) -> Vec<u8> {
    let mut bytes = format!("{width}&{height}&{channels}&").into_bytes();
    bytes.extend(values.flat_map(f32::to_le_bytes));
    bytes
}

/// Reads a depth map; NaN where it has no value.
///
/// # Errors
/// [`Error::Malformed`] for bytes that are not a complete depth map.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::depth_map::{read_colmap_depth, write_colmap_depth};
/// let depth = image::ImageBuffer::from_raw(2, 1, vec![1.5, f32::NAN]).unwrap();
/// let bytes = write_colmap_depth(&depth);
/// assert_eq!(&bytes[..6], b"2&1&1&");
/// let read = read_colmap_depth(&bytes)?;
/// assert_eq!(read.as_raw()[0], 1.5);
/// assert!(read.as_raw()[1].is_nan());
/// # Ok(()) }
/// ```
pub fn read_colmap_depth(bytes: &[u8]) -> Result<Depths> {
    let bad = || Error::malformed("a depth map of COLMAP begins with width&height&1&");
    let mut rest = bytes;
    let mut number = || -> Result<u32> {
        let len = rest
            .iter()
            .take(12)
            .position(|byte| *byte == b'&')
            .ok_or_else(bad)?;
        let text = std::str::from_utf8(&rest[..len]).map_err(|_| bad())?;
        rest = &rest[len + 1..];
        text.trim().parse().map_err(|_| bad())
    };
    let (width, height, channels) = (number()?, number()?, number()?);
    if channels != 1 {
        return Err(Error::malformed(format!(
            "a depth map has 1 channel, but this has {channels}: it may be a normal map"
        )));
    }
    let (fours, _) = rest.as_chunks::<4>();
    let num_pixels = u64::from(width) * u64::from(height);
    if num_pixels.checked_mul(4) != Some(rest.len() as u64) {
        return Err(Error::malformed(format!(
            "a depth map of {width} × {height} with {} bytes of values",
            rest.len()
        )));
    }
    let value = |four: &[u8; 4]| {
        let z = f32::from_le_bytes(*four);
        if z > 0.0 && z.is_finite() {
            z
        } else {
            f32::NAN
        }
    };
    let values = fours.iter().map(value).collect();
    ImageBuffer::from_raw(width, height, values).ok_or_else(bad)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_one_axis_after_the_other() {
        let normals = [Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, 5.0, 6.0)];
        let written = write_colmap_normals((2, 1), &normals).unwrap();
        let values: Vec<f32> = (written[6..].as_chunks::<4>().0.iter())
            .map(|four| f32::from_le_bytes(*four))
            .collect();
        assert_eq!(values, [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
        assert!(write_colmap_normals((3, 1), &normals).is_err());
        assert!(read_colmap_depth(&written).is_err());
    }

    #[test]
    fn broken_depth_maps_are_refused() {
        let depth = ImageBuffer::from_raw(2, 2, vec![1.0f32; 4]).unwrap();
        let good = write_colmap_depth(&depth);
        assert_eq!(read_colmap_depth(&good).unwrap(), depth);
        for len in 0..good.len() {
            assert!(read_colmap_depth(&good[..len]).is_err(), "{len} bytes");
        }
        assert!(read_colmap_depth(b"4294967295&4294967295&1&").is_err());
        assert!(read_colmap_depth(b"-1&2&1&").is_err());
        assert!(read_colmap_depth(&[0xff; 40]).is_err());
    }
}
