//! A first guess of the focal length from what the camera wrote into the file.

use exif::{In, Reader, Tag, Value};

/// Diagonal of a 36 mm × 24 mm frame, squared, mm².
const FULL_FRAME_DIAGONAL_SQ: f64 = 36.0 * 36.0 + 24.0 * 24.0;

/// Focal length in pixels of a `width × height` image, from its EXIF block.
///
/// The 35 mm equivalent `f₃₅` compares diagonals, `f = f₃₅ √(w² + h²) / √(36² + 24²)`; without it,
/// the focal length in millimeters times the resolution of the focal plane. `None` if neither is
/// there or they make no sense.
///
/// Source: CIPA DC-008 (EXIF 2.32), §4.6.5; CIPA DCG-001 for the equivalence of diagonals.
pub(crate) fn focal_length_px(data: &[u8], width: u32, height: u32) -> Option<f64> {
    let data = data.strip_prefix(b"Exif\0\0").unwrap_or(data);
    let exif = Reader::new().read_raw(data.to_vec()).ok()?;
    let number = |tag| match &exif.get_field(tag, In::PRIMARY)?.value {
        Value::Rational(list) => list.first().map(|r| r.to_f64()),
        value => value.get_uint(0).map(f64::from),
    };
    let (w, h) = (f64::from(width), f64::from(height));
    let equivalent = || {
        let f_35mm = number(Tag::FocalLengthIn35mmFilm)?;
        Some(f_35mm * ((w * w + h * h) / FULL_FRAME_DIAGONAL_SQ).sqrt())
    };
    let measured = || {
        let mm_per_unit = match number(Tag::FocalPlaneResolutionUnit).unwrap_or(2.0) as u32 {
            2 => 25.4,
            3 => 10.0,
            4 => 1.0,
            5 => 0.001,
            _ => return None,
        };
        // The resolution is that of the sensor; a picture scaled down later says so by its width.
        let scale = number(Tag::PixelXDimension)
            .filter(|&x| x > 0.0)
            .map_or(1.0, |x| w / x);
        let resolution = number(Tag::FocalPlaneXResolution)?;
        Some(number(Tag::FocalLength)? * resolution / mm_per_unit * scale)
    };
    let plausible = |focal_px: &f64| {
        let ratio = focal_px / w.max(h);
        ratio > 0.1 && ratio < 100.0
    };
    equivalent()
        .filter(plausible)
        .or_else(|| measured().filter(plausible))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One directory of EXIF with the focal length 50/10 mm and 1000 pixels a centimeter.
    fn block(unit: u16, numerator: u32) -> Vec<u8> {
        let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
        data.extend(1u16.to_le_bytes());
        let entry = |data: &mut Vec<u8>, tag: u16, kind: u16, value: u32| {
            data.extend(tag.to_le_bytes());
            data.extend(kind.to_le_bytes());
            data.extend(1u32.to_le_bytes());
            data.extend(value.to_le_bytes());
        };
        entry(&mut data, 0x8769, 4, 26);
        data.extend(0u32.to_le_bytes());
        data.extend(3u16.to_le_bytes());
        entry(&mut data, 0x920A, 5, 68);
        entry(&mut data, 0xA20E, 5, 76);
        entry(&mut data, 0xA210, 3, u32::from(unit));
        data.extend(0u32.to_le_bytes());
        for (n, d) in [(numerator, 10u32), (1000, 1)] {
            data.extend(n.to_le_bytes());
            data.extend(d.to_le_bytes());
        }
        data
    }

    #[test]
    fn millimeters_times_resolution() {
        // 5 mm · 1000 px/cm = 500 px.
        let focal_px = focal_length_px(&block(3, 50), 640, 480).unwrap();
        assert!((focal_px - 500.0).abs() < 1e-9);
    }

    #[test]
    fn nonsense_is_no_guess() {
        assert_eq!(focal_length_px(&block(3, 0), 640, 480), None);
        assert_eq!(focal_length_px(&block(9, 50), 640, 480), None);
        assert_eq!(focal_length_px(b"garbage", 640, 480), None);
        assert_eq!(focal_length_px(&[], 640, 480), None);
    }
}
