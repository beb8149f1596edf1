//! Disparities and point clouds as the bytes of common files.

use super::{DisparityImage, PointCloud};
use crate::{Error, Result};
use std::fmt::Write;

impl DisparityImage {
    /// The bytes of a PFM file: gray, little-endian, the bottom row first; NaN for no value.
    ///
    /// Source: the format of the Middlebury stereo evaluation.
    pub fn to_pfm(&self) -> Vec<u8> {
        let (width, height) = (self.width() as usize, self.height() as usize);
        // The negative scale says little-endian.
        let mut bytes = format!("Pf\n{width} {height}\n-1.0\n").into_bytes();
        if width > 0 {
            for row in self.as_raw().chunks_exact(width).rev() {
                for value in row {
                    bytes.extend_from_slice(&value.to_le_bytes());
                }
            }
        }
        bytes
    }

    /// Disparities from the bytes of a gray PFM file of either byte order; infinities and NaN
    /// are no values.
    ///
    /// # Errors
    /// [`Error::BadImage`] for bytes that are no gray PFM, or not a whole one.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::stereo::DisparityImage;
    /// let disparity = DisparityImage::from_raw(2, 1, vec![1.5, f32::NAN])?;
    /// assert_eq!(DisparityImage::from_pfm(&disparity.to_pfm())?, disparity);
    /// # Ok(()) }
    /// ```
    pub fn from_pfm(bytes: &[u8]) -> Result<Self> {
        let bad = |why: &str| Error::BadImage { why: why.into() };
        let mut rest = bytes;
        let mut word = || -> Result<&str> {
            let begin = rest.iter().position(|b| !b.is_ascii_whitespace());
            let text = &rest[begin.ok_or(bad("the PFM header ends early"))?..];
            let len = text.iter().position(u8::is_ascii_whitespace);
            let len = len.ok_or(bad("the PFM header ends early"))?;
            rest = &text[len + 1..];
            std::str::from_utf8(&text[..len]).map_err(|_| bad("the PFM header is not text"))
        };
        if word()? != "Pf" {
            return Err(bad("it is not a gray PFM, which begins with Pf"));
        }
        let width: u32 = word()?
            .parse()
            .map_err(|_| bad("the PFM width is no number"))?;
        let height: u32 = word()?
            .parse()
            .map_err(|_| bad("the PFM height is no number"))?;
        let scale: f32 = word()?
            .parse()
            .map_err(|_| bad("the PFM scale is no number"))?;
        let num_bytes = (width as usize)
            .checked_mul(height as usize)
            .and_then(|n| n.checked_mul(4));
        if num_bytes != Some(rest.len()) {
            return Err(bad("the PFM has not as many values as its header says"));
        }
        let value = |b: &[u8; 4]| {
            if scale < 0.0 {
                f32::from_le_bytes(*b)
            } else {
                f32::from_be_bytes(*b)
            }
        };
        let (fours, _) = rest.as_chunks::<4>();
        let mut values = Vec::with_capacity(fours.len());
        if width > 0 {
            for row in fours.chunks_exact(width as usize).rev() {
                values.extend(row.iter().map(value));
            }
        }
        Self::from_raw(width, height, values)
    }

    /// The bytes of a 16-bit gray PNG file: disparity × 256, rounded; 0 for no value.
    ///
    /// Disparities outside 1/256 … 255.996 px have no such number and count as no value.
    ///
    /// # Errors
    /// [`Error::BadImage`] for an empty picture, which PNG does not know.
    ///
    /// Source: the format of the KITTI stereo benchmark.
    #[cfg(feature = "decode")]
    pub fn to_png16(&self) -> Result<Vec<u8>> {
        use image::ImageEncoder;
        let value = |&d: &f32| {
            let scaled = f64::from(d) * 256.0 + 0.5;
            // NaN compares as false.
            if (1.0..65536.0).contains(&scaled) {
                scaled as u16
            } else {
                0
            }
        };
        let raw: Vec<u8> = self
            .as_raw()
            .iter()
            .flat_map(|d| value(d).to_ne_bytes())
            .collect();
        let mut bytes = Vec::new();
        image::codecs::png::PngEncoder::new(&mut bytes)
            .write_image(
                &raw,
                self.width(),
                self.height(),
                image::ExtendedColorType::L16,
            )
            .map_err(|error| Error::BadImage {
                why: error.to_string(),
            })?;
        Ok(bytes)
    }
}

impl PointCloud {
    /// The bytes of a binary little-endian PLY file: x, y, z as `float`, and red, green, blue if
    /// the points have colors.
    pub fn to_ply(&self) -> Vec<u8> {
        let mut bytes = self.ply_header("binary_little_endian").into_bytes();
        for (i, point) in self.points.iter().enumerate() {
            for x in point.iter() {
                bytes.extend_from_slice(&(*x as f32).to_le_bytes());
            }
            if self.has_colors() {
                bytes.extend_from_slice(&self.colors[i]);
            }
        }
        bytes
    }

    /// The text of an ASCII PLY file, as [`PointCloud::to_ply`].
    ///
    /// ```
    /// use epipole::stereo::PointCloud;
    /// use nalgebra::Point3;
    /// let cloud = PointCloud {
    ///     points: vec![Point3::new(0.5, -1.0, 2.0)],
    ///     colors: vec![[255, 0, 7]],
    /// };
    /// assert!(cloud.to_ply_ascii().ends_with("end_header\n0.5 -1 2 255 0 7\n"));
    /// ```
    pub fn to_ply_ascii(&self) -> String {
        let mut text = self.ply_header("ascii");
        for (i, point) in self.points.iter().enumerate() {
            let [x, y, z] = [point.x as f32, point.y as f32, point.z as f32];
            // Writing to a string does not fail.
            let _ = write!(text, "{x} {y} {z}");
            if self.has_colors() {
                let [r, g, b] = self.colors[i];
                let _ = write!(text, " {r} {g} {b}");
            }
            text.push('\n');
        }
        text
    }

    fn has_colors(&self) -> bool {
        !self.points.is_empty() && self.colors.len() == self.points.len()
    }

    fn ply_header(&self, format: &str) -> String {
        let colors = if self.has_colors() {
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        } else {
            ""
        };
        format!(
            "ply\nformat {format} 1.0\nelement vertex {}\n\
             property float x\nproperty float y\nproperty float z\n{colors}end_header\n",
            self.points.len()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn pfm_has_the_bottom_row_first() {
        let disparity = DisparityImage::from_raw(1, 2, vec![1.0, f32::NAN]).unwrap();
        let bytes = disparity.to_pfm();
        let header = b"Pf\n1 2\n-1.0\n";
        assert_eq!(&bytes[..header.len()], header);
        let values = &bytes[header.len()..];
        assert!(f32::from_le_bytes(values[..4].try_into().unwrap()).is_nan());
        assert_eq!(values[4..], 1.0f32.to_le_bytes());
    }

    #[test]
    fn pfm_of_either_byte_order_is_read() {
        let mut bytes = b"Pf 2 1\n1.0\n".to_vec();
        bytes.extend_from_slice(&2.5f32.to_be_bytes());
        bytes.extend_from_slice(&f32::INFINITY.to_be_bytes());
        let disparity = DisparityImage::from_pfm(&bytes).unwrap();
        assert_eq!(disparity.get(0, 0), Some(2.5));
        assert_eq!(disparity.get(1, 0), None);
    }

    #[test]
    fn broken_pfm_is_refused() {
        let good = DisparityImage::from_raw(2, 2, vec![1.0; 4])
            .unwrap()
            .to_pfm();
        for len in 0..good.len() {
            assert!(
                DisparityImage::from_pfm(&good[..len]).is_err(),
                "{len} bytes"
            );
        }
        let with = |from: &str, to: &str| {
            let text = String::from_utf8_lossy(&good).replace(from, to);
            DisparityImage::from_pfm(text.as_bytes()).is_err()
        };
        assert!(with("Pf", "PF"));
        assert!(with("2 2", "2 -2"));
        assert!(with("2 2", "4294967295 4294967295"));
        assert!(with("-1.0", "x"));
        assert!(DisparityImage::from_pfm(&[0xff; 40]).is_err());
    }

    #[cfg(feature = "decode")]
    #[test]
    fn png_holds_256ths_of_a_pixel() {
        let values = vec![1.5, f32::NAN, 300.0, 0.0, -2.0, 255.99];
        let disparity = DisparityImage::from_raw(3, 2, values).unwrap();
        let png = disparity.to_png16().unwrap();
        let back = image::load_from_memory(&png).unwrap().into_luma16();
        assert_eq!(back.dimensions(), (3, 2));
        assert_eq!(back.as_raw(), &[384, 0, 0, 0, 0, 65533]);
        assert!(
            DisparityImage::from_raw(0, 0, vec![])
                .unwrap()
                .to_png16()
                .is_err()
        );
    }

    #[test]
    fn ply_counts_its_points() {
        let mut cloud = PointCloud {
            points: vec![Point3::new(1.0, 2.0, 3.0), Point3::new(0.0, 0.25, 1.0)],
            colors: vec![],
        };
        let header_end = |bytes: &[u8]| {
            let text = String::from_utf8_lossy(bytes);
            text.find("end_header\n").unwrap() + "end_header\n".len()
        };
        let plain = cloud.to_ply();
        assert!(plain.starts_with(b"ply\nformat binary_little_endian 1.0\nelement vertex 2\n"));
        assert_eq!(plain.len() - header_end(&plain), 2 * 12);
        cloud.colors = vec![[1, 2, 3], [4, 5, 6]];
        let colored = cloud.to_ply();
        assert_eq!(colored.len() - header_end(&colored), 2 * 15);
        assert_eq!(colored[colored.len() - 3..], [4, 5, 6]);
        assert_eq!(cloud.to_ply_ascii().lines().last(), Some("0 0.25 1 4 5 6"));
        assert!(PointCloud::default().to_ply_ascii().contains("vertex 0\n"));
    }
}
