//! Corners, SIFT, ORB; matching and tracking.

pub(crate) mod window;

use crate::argument::{Argument, Vectors, check_keys, entry, not};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::images::{Field, Gray};
use crate::options::Options;
use crate::output::{Floats, Indices, Integers, Mask, Numbers, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::feature::{
    self, Descriptors, FeatureOptions, GoodFeaturesOptions, Keypoint, Match, MatchOptions,
    OrbOptions, RefineOptions, SiftOptions, StructureTensorOptions, TrackOptions,
};
use epipole::imaging::GrayImage32;

/// Number of bytes of a binary descriptor.
const BYTES_OF_BITS: usize = 32;

/// A list of keypoints.
pub(crate) struct Keypoints(pub(crate) Vec<Keypoint>);

impl From<&[Match]> for Matches {
    fn from(matches: &[Match]) -> Self {
        Self {
            indices1: Indices(matches.iter().map(|one| one.index1).collect()),
            indices2: Indices(matches.iter().map(|one| one.index2).collect()),
            distances: Floats(matches.iter().map(|one| one.distance).collect()),
            ratios: Floats(matches.iter().map(|one| one.ratio).collect()),
        }
    }
}

impl From<feature::Features> for Features {
    fn from(features: feature::Features) -> Self {
        Self {
            keypoints: Keypoints(features.keypoints),
            descriptors: features.descriptors,
        }
    }
}

structs! {
    /// Keypoints with their descriptors.
    struct Features as Features {
        /// Keypoints, strongest first.
        keypoints: Keypoints,
        /// Their descriptors.
        descriptors: Descriptors,
    }

    /// Matches between two lists of features.
    pub(crate) struct Matches as Matches {
        /// Indices in the first list.
        indices1: Indices,
        /// Indices in the second list.
        indices2: Indices,
        /// Distance of the descriptors: Euclidean, or the number of bits that differ.
        distances: Floats,
        /// Distance over that of the second nearest, in [0, 1].
        ratios: Floats,
    }

    /// The two nearest descriptors of each descriptor.
    struct Neighbors as Neighbors {
        /// Index of the nearest.
        indices: Indices,
        /// Distance of the nearest.
        distances: Floats,
        /// Distance of the second nearest; Infinity if there is none.
        second_distances: Floats,
    }

    /// Points that were tracked from one image to the next.
    struct Tracks as Tracks {
        /// Positions in the second image, interleaved; NaN for lost points.
        points: Numbers,
        /// 1 for tracked points.
        found: Mask,
        /// Mean absolute difference of gray values between the two windows; NaN for lost points.
        residuals: Floats,
        /// Distance between each point and itself tracked back, pixels; NaN without that check.
        forward_backward_px: Numbers,
    }
}

impl Output for Keypoints {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Keypoints",
            "Keypoints: entry k of each array belongs to keypoint k.",
            &[
                ("points", "Float64Array", "Pixels, interleaved."),
                ("scalesPx", "Float32Array", "Scales, pixels."),
                ("anglesRad", "Float32Array", "Directions, radians."),
                ("responses", "Float32Array", "Strengths."),
                ("octaves", "Int32Array", "Octaves of the pyramid."),
            ],
        );
        "Keypoints".to_owned()
    }

    fn into_value(self) -> Value {
        let points = self.0.iter().flat_map(|keypoint| [keypoint.u, keypoint.v]);
        let floats =
            |of: fn(&Keypoint) -> f32| Floats(self.0.iter().map(of).collect()).into_value();
        Value::Record(vec![
            ("points".into(), Numbers(points.collect()).into_value()),
            ("scalesPx".into(), floats(|keypoint| keypoint.scale_px)),
            ("anglesRad".into(), floats(|keypoint| keypoint.angle_rad)),
            ("responses".into(), floats(|keypoint| keypoint.response)),
            (
                "octaves".into(),
                Integers(self.0.iter().map(|keypoint| keypoint.octave).collect()).into_value(),
            ),
        ])
    }
}

impl Argument for Keypoints {
    fn typescript(types: &mut Types) -> String {
        let points = Vectors::<2>::typescript(types);
        let numbers = "ArrayLike<number>";
        types.interface(
            "KeypointsLike",
            "Keypoints: entry k of each array belongs to keypoint k.",
            &[
                ("points", &points, "Pixels."),
                ("scalesPx?", numbers, "Scales, pixels. 1 if not given."),
                (
                    "anglesRad?",
                    numbers,
                    "Directions, radians. 0 if not given.",
                ),
                ("responses?", numbers, "Strengths. 0 if not given."),
                (
                    "octaves?",
                    numbers,
                    "Octaves of the pyramid. 0 if not given.",
                ),
            ],
        );
        "KeypointsLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = ["points", "scalesPx", "anglesRad", "responses", "octaves"];
        check_keys(name, value, &keys)?;
        let points = entry::<Vectors<2>>(name, value, "points")?.points();
        let column = |key| -> Result<Option<Vec<f64>>> {
            let Some(column) = entry::<Option<Vectors<1>>>(name, value, key)? else {
                return Ok(None);
            };
            match column.0.len() == points.len() {
                true => Ok(Some(column.0.iter().map(|number| number[0]).collect())),
                false => Err(Fault::of_range(format!(
                    "{name}.{key} must have {} numbers, as many as points, but has {}",
                    points.len(),
                    column.0.len()
                ))),
            }
        };
        let (scales, angles) = (column("scalesPx")?, column("anglesRad")?);
        let (responses, octaves) = (column("responses")?, column("octaves")?);
        let at = |column: &Option<Vec<f64>>, index: usize| column.as_ref().map(|list| list[index]);
        let keypoints = points.iter().enumerate().map(|(index, point)| Keypoint {
            scale_px: at(&scales, index).unwrap_or(1.0) as f32,
            angle_rad: at(&angles, index).unwrap_or(0.0) as f32,
            octave: at(&octaves, index).unwrap_or(0.0) as i32,
            ..Keypoint::at(
                point.x,
                point.y,
                at(&responses, index).unwrap_or(0.0) as f32,
            )
        });
        Ok(Self(keypoints.collect()))
    }
}

impl Output for Descriptors {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Descriptors",
            "Descriptors, one after the other.",
            &[
                (
                    "kind",
                    "\"bytes\" | \"floats\" | \"bits\"",
                    "Kind of the entries.",
                ),
                (
                    "dimension",
                    "number",
                    "Entries of a descriptor: numbers or bits.",
                ),
                (
                    "data",
                    "Uint8Array | Float32Array",
                    "Entries; eight bits of a descriptor of bits are one byte, lowest first.",
                ),
            ],
        );
        "Descriptors".to_owned()
    }

    fn into_value(self) -> Value {
        let (kind, data) = if let Some(bytes) = self.as_bytes() {
            ("bytes", Value::Bytes(bytes.to_vec()))
        } else if let Some(bits) = self.as_bits() {
            let bytes = bits.iter().flatten().flat_map(|word| word.to_le_bytes());
            ("bits", Value::Bytes(bytes.collect()))
        } else {
            ("floats", Value::Floats(self.to_floats()))
        };
        Value::Record(vec![
            ("kind".into(), Value::Text(kind.to_owned())),
            ("dimension".into(), self.dimension().into_value()),
            ("data".into(), data),
        ])
    }
}

impl Argument for Descriptors {
    fn typescript(types: &mut Types) -> String {
        <Self as Output>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["kind", "dimension", "data"])?;
        let dimension = entry::<u32>(name, value, "dimension")? as usize;
        let named = |error| Fault::of_range(format!("{name}: {error}"));
        match (value.get("kind"), value.get("data")) {
            (Value::Text(kind), Value::Bytes(bytes)) if kind == "bytes" => {
                Self::from_bytes(dimension, bytes.clone()).map_err(named)
            }
            (Value::Text(kind), Value::Floats(floats)) if kind == "floats" => {
                Self::from_floats(dimension, floats.clone()).map_err(named)
            }
            (Value::Text(kind), Value::Bytes(bytes)) if kind == "bits" => {
                if dimension != 8 * BYTES_OF_BITS || bytes.len() % BYTES_OF_BITS != 0 {
                    return Err(Fault::of_range(format!(
                        "{name} must have 256 bits each, but has {} bytes of dimension {dimension}",
                        bytes.len()
                    )));
                }
                let word = |eight: &[u8]| {
                    let bits = eight.iter().rev();
                    bits.fold(0, |sum, &byte| sum << 8 | u64::from(byte))
                };
                let words = bytes.chunks_exact(BYTES_OF_BITS).map(|bytes| {
                    std::array::from_fn(|index| word(&bytes[8 * index..8 * index + 8]))
                });
                Ok(Self::from_bits(words.collect()))
            }
            (kind, data) => Err(not(
                &format!("{name}.data"),
                "a Uint8Array of kind bytes or bits, or a Float32Array of kind floats",
                match kind {
                    Value::Text(_) => data,
                    _ => kind,
                },
            )),
        }
    }
}

functions! {
    /// Gray values in [0, 1] in which features of a photo are detected.
    fn photo_to_gray(photo: Gray) -> GrayImage32 {
        photo.0
    }

    /// Features of the kind that the options name, strongest first.
    fn detect_features(image: Gray, options: Options<FeatureOptions>; monitor) -> Features {
        feature::detect_features(&image.0, &options.0, monitor)?.into()
    }

    /// SIFT features, strongest first.
    fn detect_sift(image: Gray, options: Options<SiftOptions>; monitor) -> Features {
        feature::detect_sift(&image.0, &options.0, monitor)?.into()
    }

    /// ORB features, strongest first.
    fn detect_orb(image: Gray, options: Options<OrbOptions>; monitor) -> Features {
        feature::detect_orb(&image.0, &options.0, monitor)?.into()
    }

    /// SIFT descriptors of given keypoints.
    fn describe_sift(
        image: Gray, keypoints: Keypoints, options: Options<SiftOptions>; monitor
    ) -> Descriptors {
        feature::describe_sift(&image.0, &keypoints.0, &options.0, monitor)?
    }

    /// Gray values in a square around each keypoint, `size` x `size` at distances of `spacingPx`,
    /// with mean 0 and length 1.
    fn describe_patches(
        image: Gray, keypoints: Keypoints, size: u32, spacing_px: f64; monitor
    ) -> Descriptors {
        feature::describe_patches(&image.0, &keypoints.0, size as usize, spacing_px, monitor)?
    }

    /// Corner response of Harris with its factor k, such as 0.05.
    fn harris_response(
        image: Gray, k: f64, options: Options<StructureTensorOptions>; monitor
    ) -> GrayImage32 {
        feature::harris_response(&image.0, k as f32, &options.0, monitor)?
    }

    /// Smaller eigenvalue of the structure tensor.
    fn min_eigenvalue_response(
        image: Gray, options: Options<StructureTensorOptions>; monitor
    ) -> GrayImage32 {
        feature::min_eigenvalue_response(&image.0, &options.0, monitor)?
    }

    /// Corners to track, strongest first.
    fn good_features_to_track(
        image: Gray, options: Options<GoodFeaturesOptions>; monitor
    ) -> Keypoints {
        Keypoints(feature::good_features_to_track(&image.0, &options.0, monitor)?)
    }

    /// Local maxima of a response, strongest first: pixels above `threshold` that are largest in a
    /// window `2 radius + 1` pixels wide.
    fn non_maximum_suppression(response: Field, radius: u32, threshold: f64; monitor) -> Keypoints {
        let (radius, threshold) = (radius as usize, threshold as f32);
        Keypoints(feature::non_maximum_suppression(&response.0, radius, threshold, monitor)?)
    }

    /// Corners located between pixels; NaN for those that cannot be.
    fn refine_corners(
        image: Gray, corners: Vectors<2>, options: Options<RefineOptions>; monitor
    ) -> Numbers {
        let refined = feature::refine_corners(&image.0, &corners.points(), &options.0, monitor)?;
        let place = |corner: Option<epipole::nalgebra::Point2<f64>>| {
            corner.map_or([f64::NAN; 2], |corner| [corner.x, corner.y])
        };
        Numbers(refined.into_iter().flat_map(place).collect())
    }

    /// Matches between two lists of descriptors, in the order of the first.
    fn match_descriptors(
        descriptors1: Descriptors, descriptors2: Descriptors, options: Options<MatchOptions>;
        monitor
    ) -> Matches {
        let matches = feature::match_descriptors(
            &descriptors1, &descriptors2, &options.0, monitor,
        )?;
        Matches::from(&*matches)
    }

    /// The two nearest of the second list for each descriptor of the first.
    fn nearest_two(descriptors1: Descriptors, descriptors2: Descriptors; monitor) -> Neighbors {
        let nearest = feature::nearest_two(&descriptors1, &descriptors2, monitor)?;
        let second = nearest.iter().map(|one| one.second_distance.unwrap_or(f32::INFINITY));
        Neighbors {
            indices: Indices(nearest.iter().map(|one| one.index).collect()),
            distances: Floats(nearest.iter().map(|one| one.distance).collect()),
            second_distances: Floats(second.collect()),
        }
    }

    /// Points tracked from one image to the next (Lucas and Kanade, on a pyramid).
    fn track_lucas_kanade(
        first: Gray, second: Gray, points: Vectors<2>, options: Options<TrackOptions>; monitor
    ) -> Tracks {
        let tracks = feature::track_lucas_kanade(
            &first.0, &second.0, &points.points(), &options.0, monitor,
        )?;
        let place = |track: &Option<feature::Track>| {
            track.map_or([f64::NAN; 2], |track| [track.point.x, track.point.y])
        };
        let residual = |track: &Option<feature::Track>| {
            track.map_or(f32::NAN, |track| track.residual)
        };
        let back = |track: &Option<feature::Track>| {
            track.and_then(|track| track.forward_backward_px).unwrap_or(f64::NAN)
        };
        Tracks {
            points: Numbers(tracks.iter().flat_map(place).collect()),
            found: Mask(tracks.iter().map(Option::is_some).collect()),
            residuals: Floats(tracks.iter().map(residual).collect()),
            forward_backward_px: Numbers(tracks.iter().map(back).collect()),
        }
    }
}
