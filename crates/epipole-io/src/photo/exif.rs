//! EXIF data: a guess of the focal length, and the position.

use epipole::math::{Geodetic, local_from_geodetic};
use exif::{Exif, In, Reader, Tag, Value};

/// Diagonal of a 36 mm × 24 mm frame, squared, mm².
const FULL_FRAME_DIAGONAL_SQ: f64 = 36.0 * 36.0 + 24.0 * 24.0;

/// Contents of an EXIF block.
pub(crate) struct Facts(Exif);

impl Facts {
    /// Reads a block; `None` if it is malformed.
    pub(crate) fn read(data: &[u8]) -> Option<Self> {
        let data = data.strip_prefix(b"Exif\0\0").unwrap_or(data);
        Reader::new().read_raw(data.to_vec()).ok().map(Self)
    }

    /// Returns up to three numbers of a field.
    fn numbers(&self, tag: Tag) -> Option<[f64; 3]> {
        let value = &self.0.get_field(tag, In::PRIMARY)?.value;
        let number = |index: usize| match value {
            Value::Rational(list) => list.get(index).map(|r| r.to_f64()),
            value => value.get_uint(index).map(f64::from),
        };
        Some([
            number(0)?,
            number(1).unwrap_or(0.0),
            number(2).unwrap_or(0.0),
        ])
    }

    fn number(&self, tag: Tag) -> Option<f64> {
        self.numbers(tag).map(|[first, ..]| first)
    }

    /// Returns the focal length in millimeters.
    pub(crate) fn focal_length_mm(&self) -> Option<f64> {
        self.number(Tag::FocalLength)
            .filter(|mm| mm.is_finite() && *mm > 0.0)
    }

    /// Returns the focal length in pixels of a `width × height` image.
    ///
    /// * `sensor_width_mm`: longer side of the sensor, if known; with the focal length in
    ///   millimeters it takes precedence
    ///
    /// The 35 mm equivalent `f₃₅` compares diagonals, `f = f₃₅ √(w² + h²) / √(36² + 24²)`; without
    /// it, the focal length in millimeters times the resolution of the focal plane. `None` if
    /// neither is present and plausible.
    ///
    /// Source: CIPA DC-008 (EXIF 2.32), §4.6.5; CIPA DCG-001 for the equivalence of diagonals.
    pub(crate) fn focal_length_px(
        &self,
        width: u32,
        height: u32,
        sensor_width_mm: Option<f64>,
    ) -> Option<f64> {
        let (w, h) = (f64::from(width), f64::from(height));
        let by_width = || Some(self.focal_length_mm()? * w.max(h) / sensor_width_mm?);
        let equivalent = || {
            let f_35mm = self.number(Tag::FocalLengthIn35mmFilm)?;
            Some(f_35mm * ((w * w + h * h) / FULL_FRAME_DIAGONAL_SQ).sqrt())
        };
        let measured = || {
            let mm_per_unit = match self.number(Tag::FocalPlaneResolutionUnit).unwrap_or(2.0) as u32
            {
                2 => 25.4,
                3 => 10.0,
                4 => 1.0,
                5 => 0.001,
                _ => return None,
            };
            // The resolution is that of the sensor; an image downscaled later has another width.
            let scale = self
                .number(Tag::PixelXDimension)
                .filter(|&x| x > 0.0)
                .map_or(1.0, |x| w / x);
            let resolution = self.number(Tag::FocalPlaneXResolution)?;
            Some(self.number(Tag::FocalLength)? * resolution / mm_per_unit * scale)
        };
        let plausible = |focal_px: &f64| {
            let ratio = focal_px / w.max(h);
            ratio > 0.1 && ratio < 100.0
        };
        by_width()
            .filter(plausible)
            .or_else(|| equivalent().filter(plausible))
            .or_else(|| measured().filter(plausible))
    }

    /// Returns the GPS position, at sea level if there is no height. `None` without valid latitude
    /// and longitude.
    ///
    /// Source: CIPA DC-008 (EXIF 2.32), §4.6.6.
    pub(crate) fn place(&self) -> Option<Geodetic> {
        let degrees = |tag, of_sign, minus: u8| {
            let [degrees, minutes, seconds] = self.numbers(tag)?;
            let sign = match &self.0.get_field(of_sign, In::PRIMARY)?.value {
                Value::Ascii(words) if words.first()?.first()? == &minus => -1.0,
                _ => 1.0,
            };
            Some(sign * (degrees + minutes / 60.0 + seconds / 3600.0))
        };
        let below = self.number(Tag::GPSAltitudeRef) == Some(1.0);
        let height_m = self.number(Tag::GPSAltitude).filter(|h| h.is_finite());
        let place = Geodetic {
            latitude_deg: degrees(Tag::GPSLatitude, Tag::GPSLatitudeRef, b'S')?,
            longitude_deg: degrees(Tag::GPSLongitude, Tag::GPSLongitudeRef, b'W')?,
            height_m: height_m.map_or(0.0, |h| if below { -h } else { h }),
        };
        local_from_geodetic(&place, &place).ok().map(|_| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns one EXIF directory with the focal length 50/10 mm and 1000 pixels per centimeter.
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

    fn focal_length_px(data: &[u8], width: u32, height: u32) -> Option<f64> {
        Facts::read(data)?.focal_length_px(width, height, None)
    }

    /// Returns a directory with a position: 33° 51′ 36″ and 151° 12.6′, each with its letter, and a
    /// height of 20.5 m.
    fn block_of_place(letters: [u8; 2], below: u8, degrees: u32) -> Vec<u8> {
        let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
        data.extend(1u16.to_le_bytes());
        let entry = |data: &mut Vec<u8>, tag: u16, kind: u16, count: u32, value: u32| {
            data.extend(tag.to_le_bytes());
            data.extend(kind.to_le_bytes());
            data.extend(count.to_le_bytes());
            data.extend(value.to_le_bytes());
        };
        entry(&mut data, 0x8825, 4, 1, 26);
        data.extend(0u32.to_le_bytes());
        data.extend(6u16.to_le_bytes());
        let first = 26 + 2 + 6 * 12 + 4;
        entry(&mut data, 1, 2, 2, u32::from(letters[0]));
        entry(&mut data, 2, 5, 3, first);
        entry(&mut data, 3, 2, 2, u32::from(letters[1]));
        entry(&mut data, 4, 5, 3, first + 24);
        entry(&mut data, 5, 1, 1, u32::from(below));
        entry(&mut data, 6, 5, 1, first + 48);
        data.extend(0u32.to_le_bytes());
        assert_eq!(data.len(), first as usize);
        for (n, d) in [
            (degrees, 1u32),
            (51, 1),
            (36, 1),
            (151, 1),
            (126, 10),
            (0, 1),
            (41, 2),
        ] {
            data.extend(n.to_le_bytes());
            data.extend(d.to_le_bytes());
        }
        data
    }

    #[test]
    fn a_place_has_signs_and_a_height() {
        let place = Facts::read(&block_of_place(*b"SE", 0, 33))
            .unwrap()
            .place()
            .unwrap();
        assert!((place.latitude_deg + 33.86).abs() < 1e-12, "{place:?}");
        assert!((place.longitude_deg - 151.21).abs() < 1e-12, "{place:?}");
        assert_eq!(place.height_m, 20.5);
        let place = Facts::read(&block_of_place(*b"NW", 1, 33))
            .unwrap()
            .place()
            .unwrap();
        assert!(place.latitude_deg > 0.0 && place.longitude_deg < 0.0);
        assert_eq!(place.height_m, -20.5);
        // A latitude of 99° is invalid, and many photos have no position.
        assert_eq!(
            Facts::read(&block_of_place(*b"NW", 1, 99)).unwrap().place(),
            None
        );
        assert_eq!(Facts::read(&block(3, 50)).unwrap().place(), None);
    }

    #[test]
    fn millimeters_times_resolution() {
        // 5 mm · 1000 px/cm = 500 px.
        let focal_px = focal_length_px(&block(3, 50), 640, 480).unwrap();
        assert!((focal_px - 500.0).abs() < 1e-9);
    }

    #[test]
    fn a_sensor_width_converts_millimeters_to_pixels() {
        // 5 mm on a sensor of 8 mm, regardless of the resolution of the focal plane.
        let facts = Facts::read(&block(3, 50)).unwrap();
        assert_eq!(facts.focal_length_mm(), Some(5.0));
        for (width, height) in [(640, 480), (480, 640)] {
            let focal_px = facts.focal_length_px(width, height, Some(8.0)).unwrap();
            assert!((focal_px - 400.0).abs() < 1e-9);
        }
    }

    #[test]
    fn nonsense_is_no_guess() {
        assert_eq!(focal_length_px(&block(3, 0), 640, 480), None);
        assert_eq!(focal_length_px(&block(9, 50), 640, 480), None);
        assert_eq!(focal_length_px(b"garbage", 640, 480), None);
        assert_eq!(focal_length_px(&[], 640, 480), None);
    }
}
