//! Features of photos and matches between them.

use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::feature::Matches;
use crate::functions::functions;
use crate::images::{Rgb, colors};
use crate::options::{Options, Setting};
use crate::output::{Bytes, Indices, Numbers, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::feature::Match;
use epipole::sfm::{self, PairMatches, Photo, PhotoOptions, PositionPrior, SfmImage};

structs! {
    /// Keypoints of photos and matches between pairs of them.
    struct MatchedPhotos as MatchedPhotos {
        /// Keypoints of each photo.
        images: Vec<SfmImage>,
        /// Matches between photos.
        pairs: Vec<PairMatches>,
    }

    /// Keypoints of one photo.
    struct ImageKeypoints as SfmImage {
        /// Pixels of the keypoints, interleaved.
        keypoints: Numbers,
        /// Color of each keypoint, 3 bytes each.
        colors: Bytes,
        /// Number of the lens: photos of one lens share its refined parameters.
        lens: usize,
    }

    /// Matches between two photos.
    struct Pair as PairMatches {
        /// Index of the first photo.
        image1: usize,
        /// Index of the second photo.
        image2: usize,
        /// Matches between their keypoints.
        matches: Matches,
    }
}

impl Output for SfmImage {
    fn typescript(types: &mut Types) -> String {
        ImageKeypoints::typescript(types)
    }

    fn into_value(self) -> Value {
        let image = ImageKeypoints {
            keypoints: Numbers::of_points(&self.keypoints),
            colors: Bytes(self.colors.into_flattened()),
            lens: self.lens,
        };
        image.into_value()
    }
}

impl Argument for SfmImage {
    fn typescript(types: &mut Types) -> String {
        let pixels = Vectors::<2>::typescript(types);
        let position = Setting::<PositionPrior>::typescript(types);
        types.interface(
            "SfmImageLike",
            "Keypoints of one photo.",
            &[
                ("keypoints", &pixels, "Pixels of the keypoints."),
                (
                    "colors?",
                    "Uint8Array | Uint8ClampedArray",
                    "Color of each keypoint, 3 bytes each.",
                ),
                (
                    "lens?",
                    "number",
                    "Number of the lens: photos of one lens share its refined parameters. 0 if \
                     not given.",
                ),
                ("position?", &position, "Position of the camera, if known."),
            ],
        );
        "SfmImageLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["keypoints", "colors", "lens", "position"])?;
        let colors = colors(name, value, "keypoint")?.unwrap_or_default();
        let position = entry::<Option<Setting<PositionPrior>>>(name, value, "position")?;
        Ok(Self {
            name: String::new(),
            keypoints: entry::<Vectors<2>>(name, value, "keypoints")?.points(),
            colors,
            lens: entry::<Option<u32>>(name, value, "lens")?.unwrap_or(0) as usize,
            position: position.map(|position| position.0),
        })
    }
}

impl Output for PairMatches {
    fn typescript(types: &mut Types) -> String {
        Pair::typescript(types)
    }

    fn into_value(self) -> Value {
        let pair = Pair {
            image1: self.image1,
            image2: self.image2,
            matches: Matches::from(&*self.matches),
        };
        pair.into_value()
    }
}

/// Matches between two lists of keypoints, given by the caller.
pub(crate) struct GivenMatches(pub(crate) Vec<Match>);

impl Argument for GivenMatches {
    fn typescript(types: &mut Types) -> String {
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "MatchesLike",
            "Matches between two lists of keypoints.",
            &[
                ("indices1", &indices, "Indices in the first list."),
                ("indices2", &indices, "Indices in the second list."),
                (
                    "distances?",
                    "ArrayLike<number>",
                    "Distance of the descriptors. 0 if not given.",
                ),
                (
                    "ratios?",
                    "ArrayLike<number>",
                    "Distance over that of the second nearest. 0 if not given.",
                ),
            ],
        );
        "MatchesLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        matches(name, value).map(Self)
    }
}

impl Argument for PairMatches {
    fn typescript(types: &mut Types) -> String {
        let matches = GivenMatches::typescript(types);
        types.interface(
            "PairMatchesLike",
            "Matches between two photos.",
            &[
                ("image1", "number", "Index of the first photo."),
                ("image2", "number", "Index of the second photo."),
                ("matches", &matches, "Matches between their keypoints."),
            ],
        );
        "PairMatchesLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["image1", "image2", "matches"])?;
        Ok(Self {
            image1: entry::<u32>(name, value, "image1")? as usize,
            image2: entry::<u32>(name, value, "image2")? as usize,
            matches: entry::<GivenMatches>(name, value, "matches")?.0,
        })
    }
}

fn matches(name: &str, value: &Value) -> Result<Vec<Match>> {
    check_keys(
        name,
        value,
        &["indices1", "indices2", "distances", "ratios"],
    )?;
    let indices1 = entry::<Indices>(name, value, "indices1")?.0;
    let count = indices1.len();
    let checked = |key: &str, got: usize| match got == count {
        true => Ok(()),
        false => Err(Fault::of_range(format!(
            "{name}.{key} must have {count} numbers, as many as indices1, but has {got}"
        ))),
    };
    let indices2 = entry::<Indices>(name, value, "indices2")?.0;
    checked("indices2", indices2.len())?;
    let column = |key| -> Result<Vec<f32>> {
        let Some(numbers) = entry::<Option<Vectors<1>>>(name, value, key)? else {
            return Ok(vec![0.0; count]);
        };
        checked(key, numbers.0.len())?;
        Ok(numbers.0.iter().map(|number| number[0] as f32).collect())
    };
    let (distances, ratios) = (column("distances")?, column("ratios")?);
    let all = indices1
        .into_iter()
        .zip(indices2)
        .zip(distances)
        .zip(ratios);
    Ok(all
        .map(|(((index1, index2), distance), ratio)| Match {
            index1,
            index2,
            distance,
            ratio,
        })
        .collect())
}

/// Converts photos for the core.
pub(crate) fn photos(images: Vec<Rgb>) -> Vec<Photo> {
    let photo = |Rgb(image)| Photo {
        image,
        ..Photo::default()
    };
    images.into_iter().map(photo).collect()
}

functions! {
    /// Keypoints of all photos, and matches between all pairs, or between photos that are near in
    /// order.
    fn match_photos(photos: Vec<Rgb>, options: Options<PhotoOptions>; monitor) -> MatchedPhotos {
        let (images, pairs) = sfm::match_photos(&self::photos(photos), &options.0, monitor)?;
        MatchedPhotos { images, pairs }
    }
}
