//! Disparities of stereo pairs.

use crate::{Error, Result};
use epipole::stereo::DisparityImage;

/// Writes a PFM file: gray, little-endian, bottom row first; NaN for no value.
///
/// Source: the format of the Middlebury stereo evaluation.
pub fn write_pfm(disparity: &DisparityImage) -> Vec<u8> {
    let (width, height) = (disparity.width() as usize, disparity.height() as usize);
    // A negative scale means little-endian.
    let mut bytes = format!("Pf\n{width} {height}\n-1.0\n").into_bytes();
    if width > 0 {
        for row in disparity.as_raw().chunks_exact(width).rev() {
            for value in row {
                bytes.extend_from_slice(&value.to_le_bytes());
            }
        }
    }
    bytes
}

/// Reads a gray PFM file of either byte order; infinities and NaN mean no value.
///
/// # Errors
/// [`Error::Malformed`] for bytes that are not a complete gray PFM file.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole::stereo::DisparityImage;
/// use epipole_io::disparity::{read_pfm, write_pfm};
/// let disparity = DisparityImage::from_raw(2, 1, vec![1.5, f32::NAN])?;
/// assert_eq!(read_pfm(&write_pfm(&disparity))?, disparity);
/// # Ok(()) }
/// ```
pub fn read_pfm(bytes: &[u8]) -> Result<DisparityImage> {
    let bad = Error::malformed;
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
    Ok(DisparityImage::from_raw(width, height, values)?)
}

/// Writes a 16-bit gray PNG file: disparity × 256, rounded; 0 for no value.
///
/// Disparities outside 1/256 … 255.996 px cannot be stored and become no value.
///
/// # Errors
/// [`Error::Unsupported`] for an empty image, which PNG cannot hold.
///
/// Source: the format of the KITTI stereo benchmark.
#[cfg(feature = "photos")]
pub fn write_png16(disparity: &DisparityImage) -> Result<Vec<u8>> {
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
    let raw: Vec<u8> = disparity
        .as_raw()
        .iter()
        .flat_map(|d| value(d).to_ne_bytes())
        .collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(
            &raw,
            disparity.width(),
            disparity.height(),
            image::ExtendedColorType::L16,
        )
        .map_err(|error| Error::unsupported(error.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pfm_has_the_bottom_row_first() {
        let disparity = DisparityImage::from_raw(1, 2, vec![1.0, f32::NAN]).unwrap();
        let bytes = write_pfm(&disparity);
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
        let disparity = read_pfm(&bytes).unwrap();
        assert_eq!(disparity.get(0, 0), Some(2.5));
        assert_eq!(disparity.get(1, 0), None);
    }

    #[test]
    fn broken_pfm_is_refused() {
        let good = write_pfm(&DisparityImage::from_raw(2, 2, vec![1.0; 4]).unwrap());
        for len in 0..good.len() {
            assert!(read_pfm(&good[..len]).is_err(), "{len} bytes");
        }
        let with = |from: &str, to: &str| {
            let text = String::from_utf8_lossy(&good).replace(from, to);
            read_pfm(text.as_bytes()).is_err()
        };
        assert!(with("Pf", "PF"));
        assert!(with("2 2", "2 -2"));
        assert!(with("2 2", "4294967295 4294967295"));
        assert!(with("-1.0", "x"));
        assert!(read_pfm(&[0xff; 40]).is_err());
    }

    #[test]
    fn png_holds_256ths_of_a_pixel() {
        let values = vec![1.5, f32::NAN, 300.0, 0.0, -2.0, 255.99];
        let disparity = DisparityImage::from_raw(3, 2, values).unwrap();
        let png = write_png16(&disparity).unwrap();
        let back = image::load_from_memory(&png).unwrap().into_luma16();
        assert_eq!(back.dimensions(), (3, 2));
        assert_eq!(back.as_raw(), &[384, 0, 0, 0, 0, 65533]);
        let empty = DisparityImage::from_raw(0, 0, vec![]).unwrap();
        assert!(write_png16(&empty).is_err());
    }
}
