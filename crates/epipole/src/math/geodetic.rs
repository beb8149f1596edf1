//! Conversion of GPS coordinates to local meters.

use crate::{Error, Result};
use nalgebra::{Point3, Vector3};

/// A position on the earth, as from GPS (WGS 84).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geodetic {
    /// Latitude north of the equator, degrees: −90 to 90.
    pub latitude_deg: f64,
    /// Longitude east of Greenwich, degrees: −180 to 180.
    pub longitude_deg: f64,
    /// Height above the ellipsoid, meters.
    pub height_m: f64,
}

/// Semi-major axis of the earth's ellipsoid, meters.
const SEMI_MAJOR_M: f64 = 6_378_137.0;
/// Flattening of the earth's ellipsoid.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Converts a position to east, north and up, in meters from an origin, such as the position of the
/// first image. Suits [`PositionPrior`](crate::sfm::PositionPrior) in meters.
///
/// # Errors
/// [`Error::OutOfRange`] for a latitude or longitude outside its range, [`Error::NotFinite`] for
/// NaN and infinities, in the position or the origin.
///
/// Source: Defense Mapping Agency 1991, "Department of Defense World Geodetic System 1984", TR
/// 8350.2 (the ellipsoid, and coordinates from degrees).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::math::{Geodetic, local_from_geodetic};
/// let tower = Geodetic { latitude_deg: 48.8583, longitude_deg: 2.2945, height_m: 80.0 };
/// let north = Geodetic { latitude_deg: 48.8593, ..tower };
/// let there = local_from_geodetic(&north, &tower)?;
/// // A thousandth of a degree of latitude is about 111 meters.
/// assert!(there.x.abs() < 1e-6 && (there.y - 111.2).abs() < 0.1);
/// # Ok(()) }
/// ```
pub fn local_from_geodetic(place: &Geodetic, origin: &Geodetic) -> Result<Point3<f64>> {
    place.check()?;
    origin.check()?;
    let offset = place.in_earth_frame() - origin.in_earth_frame();
    let (sin_lat, cos_lat) = libm::sincos(origin.latitude_deg.to_radians());
    let (sin_lon, cos_lon) = libm::sincos(origin.longitude_deg.to_radians());
    let east = Vector3::new(-sin_lon, cos_lon, 0.0);
    let up = Vector3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
    let north = up.cross(&east);
    Ok(Point3::new(
        east.dot(&offset),
        north.dot(&offset),
        up.dot(&offset),
    ))
}

impl Geodetic {
    pub(crate) fn check(&self) -> Result<()> {
        for (what, value, most, requirement) in [
            (
                "a latitude",
                self.latitude_deg,
                90.0,
                "from -90 to 90 degrees",
            ),
            (
                "a longitude",
                self.longitude_deg,
                180.0,
                "from -180 to 180 degrees",
            ),
            ("a height", self.height_m, f64::MAX, "a number of meters"),
        ] {
            if !value.is_finite() {
                return Err(Error::NotFinite { what });
            }
            if value.abs() > most {
                return Err(Error::OutOfRange {
                    what,
                    requirement,
                    value,
                });
            }
        }
        Ok(())
    }

    /// Converts to the earth-centered frame, meters: x through Greenwich's meridian on the equator,
    /// z through the pole.
    fn in_earth_frame(&self) -> Vector3<f64> {
        let (sin_lat, cos_lat) = libm::sincos(self.latitude_deg.to_radians());
        let (sin_lon, cos_lon) = libm::sincos(self.longitude_deg.to_radians());
        let eccentricity_sq = FLATTENING * (2.0 - FLATTENING);
        // Distance from the surface along the normal to the earth's axis.
        let to_axis = SEMI_MAJOR_M / (1.0 - eccentricity_sq * sin_lat * sin_lat).sqrt();
        let from_axis = (to_axis + self.height_m) * cos_lat;
        Vector3::new(
            from_axis * cos_lon,
            from_axis * sin_lon,
            (to_axis * (1.0 - eccentricity_sq) + self.height_m) * sin_lat,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Geodetic {
        Geodetic {
            latitude_deg,
            longitude_deg,
            height_m,
        }
    }

    /// From PROJ 9.5 (EPSG:4979 to EPSG:4978), to a tenth of a micrometer.
    #[test]
    fn the_center_of_the_earth_is_where_others_have_it() {
        for (place, want) in [
            (
                place(48.8583, 2.2945, 80.0),
                [4200996.778203971, 168325.5446921596, 4780265.972522975],
            ),
            (
                place(-33.86, 151.21, 20.0),
                [-4646573.69693585, 2553419.5251990594, -3533573.021890466],
            ),
            (
                place(89.9, -179.5, -12.5),
                [-11168.945058603298, -97.46990688867993, 6356730.067128353],
            ),
        ] {
            let got = place.in_earth_frame();
            assert!((got - Vector3::from(want)).norm() < 1e-7, "{got}");
        }
    }

    #[test]
    fn up_is_up_and_lengths_stay() {
        let origin = place(-33.86, 151.21, 20.0);
        let above = local_from_geodetic(&place(-33.86, 151.21, 120.0), &origin).unwrap();
        assert!((above - Point3::new(0.0, 0.0, 100.0)).norm() < 1e-8);
        let beside = place(-33.859, 151.212, 30.0);
        let there = local_from_geodetic(&beside, &origin).unwrap();
        let apart = beside.in_earth_frame() - origin.in_earth_frame();
        assert!((there.coords.norm() - apart.norm()).abs() < 1e-8);
        assert!(there.x > 100.0 && there.y > 100.0);
    }

    #[test]
    fn places_that_are_none_are_refused() {
        let origin = place(0.0, 0.0, 0.0);
        for bad in [
            place(91.0, 0.0, 0.0),
            place(0.0, -181.0, 0.0),
            place(f64::NAN, 0.0, 0.0),
            place(0.0, 0.0, f64::INFINITY),
        ] {
            assert!(local_from_geodetic(&bad, &origin).is_err());
            assert!(local_from_geodetic(&origin, &bad).is_err());
        }
    }
}
