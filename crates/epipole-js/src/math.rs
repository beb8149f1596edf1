//! Positions on the earth.

use crate::argument::{Argument, check_keys, entry};
use crate::fault::Result;
use crate::functions::functions;
use crate::types::Types;
use crate::value::Value;
use epipole::math::{self, Geodetic};
use epipole::nalgebra::Point3;

impl Argument for Geodetic {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Geodetic",
            "Position on the earth, WGS 84, such as from GPS.",
            &[
                (
                    "latitudeDeg",
                    "number",
                    "Latitude, north positive, degrees.",
                ),
                (
                    "longitudeDeg",
                    "number",
                    "Longitude, east positive, degrees.",
                ),
                ("heightM", "number", "Height above the ellipsoid, meters."),
            ],
        );
        "Geodetic".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["latitudeDeg", "longitudeDeg", "heightM"])?;
        Ok(Self {
            latitude_deg: entry(name, value, "latitudeDeg")?,
            longitude_deg: entry(name, value, "longitudeDeg")?,
            height_m: entry(name, value, "heightM")?,
        })
    }
}

functions! {
    /// Position east, north and up of an origin, meters.
    fn local_from_geodetic(place: Geodetic, origin: Geodetic) -> Point3<f64> {
        math::local_from_geodetic(&place, &origin)?
    }
}
