//! Intrinsics of photos: given on the command line, or guessed.

use crate::failure::Failure;
use crate::matrices::{intrinsics, positive};
use crate::photo::Photo;
use clap::Args;
use epipole::camera::Intrinsics;

/// Options of the intrinsics of photos.
#[derive(Debug, Clone, Copy, Default, Args)]
pub(crate) struct CameraArguments {
    /// Focal lengths and principal point in pixels.
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    pub(crate) k: Option<Intrinsics>,
    /// Focal length in pixels. The principal point is the center of each image.
    #[arg(long, value_name = "F", value_parser = positive, conflicts_with = "k")]
    pub(crate) focal_px: Option<f64>,
}

impl CameraArguments {
    /// Returns whether any is given.
    pub(crate) fn is_set(&self) -> bool {
        self.k.is_some() || self.focal_px.is_some()
    }

    /// Returns the given intrinsics, if any.
    ///
    /// # Errors
    /// As [`Intrinsics::centered`].
    fn explicit(&self, photo: &Photo) -> Result<Option<Intrinsics>, Failure> {
        match (self.k, self.focal_px) {
            (Some(k), _) => Ok(Some(photo.reduced_k(&k)?)),
            (None, Some(focal_px)) => of_focal(focal_px, photo).map(Some),
            (None, None) => Ok(None),
        }
    }

    /// Returns the given intrinsics, or those of the calibrated camera, or else a guess from EXIF
    /// data or from the field of view of a usual lens.
    ///
    /// # Errors
    /// As [`Intrinsics::centered`].
    pub(crate) fn or_guess(&self, photo: &Photo) -> Result<(Intrinsics, Option<Guess>), Failure> {
        if let Some(k) = self.explicit(photo)?.or(photo.k) {
            return Ok((k, None));
        }
        let longer = f64::from(photo.color.width().max(photo.color.height()));
        let guess = Guess {
            focal_px: photo.focal_px.unwrap_or(1.2 * longer),
            from_exif: photo.focal_px.is_some(),
            focal_mm: photo.focal_mm,
        };
        Ok((centered(guess.focal_px, photo)?, Some(guess)))
    }
}

/// Options of the intrinsics of two photos.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct PairArguments {
    #[command(flatten)]
    camera: CameraArguments,
    /// Intrinsics of the second camera [default: those of --k].
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    k2: Option<Intrinsics>,
}

impl PairArguments {
    /// Returns whether any is given.
    pub(crate) fn is_set(&self) -> bool {
        self.camera.is_set()
    }

    /// Returns whether a focal length is given, without K. Returns whether any is given.
    pub(crate) fn has_focal_only(&self) -> bool {
        self.camera.focal_px.is_some()
    }

    /// Refuses intrinsics of the second camera alone.
    ///
    /// # Errors
    /// A failure that names the missing option.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        if self.k2.is_some() && !self.is_set() {
            return Err(Failure::usage(
                "--k2 is for the second camera: the first needs --k or --focal-px, too",
            ));
        }
        Ok(())
    }

    /// Returns the given intrinsics, if any. With only a focal length, the principal point is the
    /// center of each photo.
    ///
    /// # Errors
    /// If one principal point is given for photographs of different sizes; as
    /// [`Intrinsics::centered`].
    pub(crate) fn explicit(&self, photos: &[Photo; 2]) -> Result<Option<[Intrinsics; 2]>, Failure> {
        let sizes = photos.each_ref().map(|photo| photo.full_size);
        if self.camera.k.is_some() && self.k2.is_none() && sizes[0] != sizes[1] {
            let message = format!(
                "--k cannot be right for both images, as one is {} × {} and the other {} × {}: \
                 give --k2 for the second",
                sizes[0].0, sizes[0].1, sizes[1].0, sizes[1].1
            );
            return Err(Failure::new("size-mismatch", message));
        }
        let first = self.camera.explicit(&photos[0])?;
        let second = match self.k2 {
            Some(k2) => Some(photos[1].reduced_k(&k2)?),
            None => self.camera.explicit(&photos[1])?,
        };
        Ok(first.zip(second).map(|(k1, k2)| [k1, k2]))
    }

    /// Returns the given intrinsics, or else a guess for each photo with a warning.
    ///
    /// # Errors
    /// As [`PairArguments::explicit`].
    pub(crate) fn or_guess(
        &self,
        photos: &[Photo; 2],
    ) -> Result<([Intrinsics; 2], Option<String>), Failure> {
        if let Some(explicit) = self.explicit(photos)? {
            return Ok((explicit, None));
        }
        let (k1, guess1) = self.camera.or_guess(&photos[0])?;
        let (k2, guess2) = self.camera.or_guess(&photos[1])?;
        let guesses: Vec<Guess> = guess1.into_iter().chain(guess2).collect();
        Ok(([k1, k2], sentence(&guesses)))
    }
}

/// A guessed focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Guess {
    focal_px: f64,
    from_exif: bool,
    /// Focal length from EXIF, millimeters.
    focal_mm: Option<f64>,
}

/// Returns whether a guess is not from EXIF data.
pub(crate) fn some_unknown(guesses: &[Guess]) -> bool {
    guesses.iter().any(|guess| !guess.from_exif)
}

/// Returns a warning about guessed focal lengths; `None` without guesses.
pub(crate) fn sentence(guesses: &[Guess]) -> Option<String> {
    let first = guesses.first()?;
    let num_exif = guesses.iter().filter(|guess| guess.from_exif).count();
    let range = guesses
        .iter()
        .fold((first.focal_px, first.focal_px), |(least, most), guess| {
            (least.min(guess.focal_px), most.max(guess.focal_px))
        });
    let focal = match (format!("{:.0}", range.0), format!("{:.0}", range.1)) {
        (least, most) if least == most => least,
        (least, most) => format!("{least} to {most}"),
    };
    let from = match guesses.len() {
        count if num_exif == count => "from the image's EXIF data".to_owned(),
        _ if num_exif == 0 => "1.2 times the longer side".to_owned(),
        count => format!(
            "from EXIF data for {num_exif} of {count} images, for the others 1.2 times the \
             longer side"
        ),
    };
    let of_mm = guesses.iter().filter(|guess| !guess.from_exif);
    let advice = match of_mm.filter_map(|guess| guess.focal_mm).next() {
        Some(mm) => format!(
            " (EXIF data have {mm:.1} mm, but not the size of the sensor: give --sensor-width-mm)"
        ),
        None => String::new(),
    };
    Some(format!(
        "no --k or --focal-px: taking {focal} px, {from}{advice}"
    ))
}

/// Returns the intrinsics of a photo for a focal length in pixels of its file. The principal point
/// is that of its calibrated camera, or else the center.
///
/// # Errors
/// As [`Intrinsics::centered`].
pub(crate) fn of_focal(focal_px: f64, photo: &Photo) -> Result<Intrinsics, Failure> {
    let focal_px = photo.reduced_focal_px(focal_px);
    let Some(k) = photo.k else {
        return centered(focal_px, photo);
    };
    let center = k.principal_point();
    Ok(Intrinsics::new(focal_px, focal_px, center.x, center.y)?)
}

/// Returns intrinsics with the principal point at the center of the photo.
///
/// # Errors
/// As [`Intrinsics::centered`].
pub(crate) fn centered(focal_px: f64, photo: &Photo) -> Result<Intrinsics, Failure> {
    Ok(Intrinsics::centered(
        focal_px,
        photo.color.width(),
        photo.color.height(),
    )?)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use image::RgbImage;

    fn photo(width: u32, height: u32, focal_px: Option<f64>) -> Photo {
        Photo {
            color: RgbImage::new(width, height),
            focal_px,
            focal_mm: None,
            place: None,
            k: None,
            lens: None,
            full_size: (width, height),
            sensor_size: (width, height),
            is_as_stored: true,
        }
    }

    fn arguments(focal_px: Option<f64>) -> PairArguments {
        PairArguments {
            camera: CameraArguments { k: None, focal_px },
            k2: None,
        }
    }

    #[test]
    fn each_image_has_its_own_center_and_its_own_guess() {
        let photos = [photo(640, 480, Some(500.0)), photo(480, 640, Some(700.0))];
        let explicit = arguments(Some(600.0)).explicit(&photos).unwrap().unwrap();
        let middle = |width, height, f| Intrinsics::centered(f, width, height).unwrap();
        assert_eq!(explicit, [middle(640, 480, 600.0), middle(480, 640, 600.0)]);
        let (guessed, warning) = arguments(None).or_guess(&photos).unwrap();
        assert_eq!(guessed, [middle(640, 480, 500.0), middle(480, 640, 700.0)]);
        let warning = warning.unwrap();
        assert!(
            warning.contains("500 to 700 px, from the image's EXIF data"),
            "{warning}"
        );
        let photos = [photo(640, 480, Some(500.0)), photo(480, 640, None)];
        let (guessed, warning) = arguments(None).or_guess(&photos).unwrap();
        assert_eq!(guessed[1], middle(480, 640, 768.0));
        let warning = warning.unwrap();
        assert!(warning.contains("for 1 of 2 images"), "{warning}");
    }

    #[test]
    fn one_k_is_not_for_two_sizes() {
        let photos = [photo(640, 480, None), photo(480, 640, None)];
        let k = Intrinsics::centered(600.0, 640, 480).unwrap();
        let mut both = arguments(None);
        both.camera.k = Some(k);
        let refused = both.explicit(&photos).unwrap_err();
        assert_eq!(refused.kind, "size-mismatch");
        both.k2 = Some(Intrinsics::centered(600.0, 480, 640).unwrap());
        assert_eq!(both.explicit(&photos).unwrap(), Some([k, both.k2.unwrap()]));
    }
}
