//! Known positions of photos.

use crate::failure::Failure;
use crate::files;
use crate::matrices::positive;
use clap::Args;
use epipole::math::{Geodetic, local_from_geodetic};
use epipole::sfm::{Photo, PositionPrior, Reconstruction};
use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// Known positions of photos.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Positions")]
pub(super) struct PositionArguments {
    /// Positions of the images. A file of lines NAME X Y Z in meters, optionally followed by a
    /// standard deviation that overrides --position-sigma-m; or "exif" for positions from EXIF
    /// data. Three positions that are not on one line give the result their frame and meters; some
    /// may be wrong.
    #[arg(long, value_name = "FILE|exif")]
    positions: Option<String>,
    /// The file has NAME LATITUDE LONGITUDE HEIGHT, in degrees and meters (WGS 84). Results are in
    /// meters east, north and up of the first image with a known position.
    #[arg(long, requires = "positions")]
    geodetic: bool,
    /// Standard deviation of positions that have none, meters.
    #[arg(long, default_value_t = 5.0, value_name = "M", value_parser = positive)]
    position_sigma_m: f64,
}

/// A line of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) numbers: [f64; 3],
    pub(crate) sigma_m: f64,
}

/// Positions of all photos.
#[derive(Debug, Default)]
pub(super) struct Positions {
    /// Origin of the frame in meters, if the positions were in degrees.
    pub(super) origin: Option<Geodetic>,
    /// Number of photos with a position.
    pub(super) num_known: usize,
}

impl PositionArguments {
    /// Returns whether positions come from EXIF data.
    fn is_exif(&self) -> bool {
        self.positions.as_deref() == Some("exif")
    }

    /// Sets the positions of the photos.
    ///
    /// * `places`: positions from the files of the photos, in order
    ///
    /// # Errors
    /// For a file that cannot be read or has invalid positions, and if no photo has a position.
    pub(super) fn give(
        &self,
        photos: &mut [Photo],
        places: &[Option<Geodetic>],
    ) -> Result<Positions, Failure> {
        let Some(file) = &self.positions else {
            return Ok(Positions::default());
        };
        let path = Path::new(file);
        let positions: Vec<Option<Line>> = if self.is_exif() {
            let line = |place: &Geodetic| Line {
                numbers: [place.latitude_deg, place.longitude_deg, place.height_m],
                sigma_m: self.position_sigma_m,
            };
            places
                .iter()
                .map(|place| place.as_ref().map(line))
                .collect()
        } else {
            let lines = lines(&files::read_text(path)?, path, self.position_sigma_m)?;
            of_photos(&lines, photos)
        };
        let num_known = positions.iter().flatten().count();
        if num_known == 0 {
            return Err(match self.is_exif() {
                true => Failure::new("malformed", "no image has a GPS position"),
                false => Failure::new("malformed", "none of its lines is for one of the images")
                    .about(path),
            });
        }
        let mut origin = None;
        for (photo, line) in photos.iter_mut().zip(&positions) {
            let Some(line) = line else { continue };
            let [x, y, z] = line.numbers;
            let center_in_world = if self.geodetic || self.is_exif() {
                let place = Geodetic {
                    latitude_deg: x,
                    longitude_deg: y,
                    height_m: z,
                };
                let named = |error: epipole::Error| {
                    Failure::new("malformed", format!("{}: {error}", photo.name)).about(path)
                };
                local_from_geodetic(&place, origin.get_or_insert(place)).map_err(named)?
            } else {
                Point3::new(x, y, z)
            };
            photo.position = Some(PositionPrior {
                center_in_world,
                sigma: Vector3::repeat(line.sigma_m),
            });
        }
        self.check(photos)?;
        Ok(Positions { origin, num_known })
    }

    /// Refuses positions closer to each other than their uncertainty, such as degrees taken for
    /// meters.
    fn check(&self, photos: &[Photo]) -> Result<(), Failure> {
        let known: Vec<&PositionPrior> =
            photos.iter().filter_map(|p| p.position.as_ref()).collect();
        let sigma_m = known
            .iter()
            .map(|p| p.sigma.x)
            .fold(f64::INFINITY, f64::min);
        let mut apart_m: f64 = 0.0;
        for other in &known {
            apart_m = apart_m.max((other.center_in_world - known[0].center_in_world).norm());
        }
        if known.len() < 3 || apart_m > sigma_m {
            return Ok(());
        }
        let degrees = match self.geodetic || self.is_exif() {
            true => "",
            false => "; if they are degrees, say so by --geodetic",
        };
        Err(Failure::new(
            "degenerate",
            format!(
                "all positions lie within {apart_m:.3} m, and their standard deviation is {sigma_m} m, so they \
                 determine nothing: --position-sigma-m may be smaller{degrees}"
            ),
        ))
    }
}

/// Returns the line of each photo, by its name or by a file name that is unique.
fn of_photos(lines: &BTreeMap<String, Line>, photos: &[Photo]) -> Vec<Option<Line>> {
    let file = |photo: &Photo| photo.name.rsplit('/').next().map(str::to_owned);
    let mut counts = BTreeMap::new();
    for photo in photos {
        *counts.entry(file(photo)).or_insert(0) += 1;
    }
    let by_file = |photo: &Photo| lines.get(&file(photo).filter(|_| counts[&file(photo)] == 1)?);
    (photos.iter())
        .map(|photo| lines.get(&photo.name).or_else(|| by_file(photo)).copied())
        .collect()
}

/// Maximum distance of a position from zero in any frame on Earth, meters.
const FARTHEST_M: f64 = 1e9;

/// Parses the lines of a file, by the names of their photos.
///
/// * `sigma_m`: standard deviation of lines without one
///
/// # Errors
/// A failure that names the line.
pub(crate) fn lines(
    text: &str,
    path: &Path,
    sigma_m: f64,
) -> Result<BTreeMap<String, Line>, Failure> {
    let mut lines = BTreeMap::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let malformed = |why: &str| {
            let message = format!("line {}: {why}", index + 1);
            Failure::new("malformed", message).about(path)
        };
        // A name may have spaces.
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_number = |word: &&&str| word.parse::<f64>().is_ok_and(f64::is_finite);
        let num_numbers = words.iter().rev().take_while(is_number).count().min(4);
        // The name may be a number too.
        let num_numbers = num_numbers.min(words.len() - 1);
        if num_numbers < 3 {
            return Err(malformed("it is not a name and three numbers"));
        }
        let numbers: Vec<f64> = (words[words.len() - num_numbers..].iter())
            .filter_map(|word| word.parse().ok())
            .collect();
        let sigma_m = numbers.get(3).copied().unwrap_or(sigma_m);
        if sigma_m <= 0.0 {
            return Err(malformed("a standard deviation must be greater than 0"));
        }
        if numbers.iter().any(|number| number.abs() > FARTHEST_M) {
            return Err(malformed("no number may be more than 10⁹ from 0"));
        }
        let name = words[..words.len() - num_numbers].join(" ");
        let line = Line {
            numbers: [numbers[0], numbers[1], numbers[2]],
            sigma_m,
        };
        if lines.insert(name, line).is_some() {
            return Err(malformed("this is the second line for the image"));
        }
    }
    Ok(lines)
}

impl Positions {
    /// Adds `placed`, `position_rms_m` and `origin` to a result.
    pub(super) fn fields(
        &self,
        found: &Reconstruction,
        photos: &[Photo],
    ) -> [(&'static str, Value); 3] {
        let origin = self.origin.filter(|_| found.is_placed).map(|origin| {
            json!({
                "latitude_deg": origin.latitude_deg,
                "longitude_deg": origin.longitude_deg,
                "height_m": origin.height_m,
            })
        });
        [
            ("placed", json!(found.is_placed)),
            ("position_rms_m", json!(rms_m(found, photos))),
            ("origin", json!(origin)),
        ]
    }
}

/// Returns the root mean square distance of the cameras from their known positions, if the model is
/// placed.
pub(super) fn rms_m(found: &Reconstruction, photos: &[Photo]) -> Option<f64> {
    let off_sq: Vec<f64> = (found.cameras.iter().zip(photos))
        .filter_map(|(camera, photo)| {
            let known = photo.position.as_ref()?.center_in_world;
            Some((camera.as_ref()?.center_in_world() - known).norm_squared())
        })
        .collect();
    (found.is_placed && !off_sq.is_empty())
        .then(|| (off_sq.iter().sum::<f64>() / off_sq.len() as f64).sqrt())
}
