//! Tests that independent readers can read written reconstructions.

use crate::damage::config;
use crate::model::Model;
use epipole::camera::{Camera, Distortion, Intrinsics, PosedCamera, RigidTransform};
use epipole::sfm::{Reconstruction, ScenePoint, SfmImage, TrackElement};
use nalgebra::{Point2, Point3};
use proptest::prelude::*;

fn any_reconstruction() -> impl Strategy<Value = (Reconstruction, Vec<SfmImage>)> {
    let number = || -1e6..1e6_f64;
    let image = (
        // File names may contain anything but a slash.
        "[^/\0]{1,12}",
        1..5000_u32,
        prop::collection::vec((number(), number()), 1..6),
        prop::option::of((1.0..1e5_f64, number(), number(), number())),
    );
    let point = (
        [number(), number(), number()],
        any::<[u8; 3]>(),
        prop::collection::vec(
            (any::<prop::sample::Index>(), any::<prop::sample::Index>()),
            2..5,
        ),
    );
    let lens = (-0.5..0.5_f64, any::<bool>());
    (
        prop::collection::vec(image, 1..5),
        prop::collection::vec(point, 0..8),
        lens,
    )
        .prop_map(|(list, points, (k1, is_bent))| {
            let images: Vec<SfmImage> = list
                .iter()
                .map(|(name, _, keypoints, _)| SfmImage {
                    name: name.clone(),
                    keypoints: keypoints.iter().map(|&(u, v)| Point2::new(u, v)).collect(),
                    ..SfmImage::default()
                })
                .collect();
            let distortion = Distortion {
                k1: if is_bent { k1 } else { 0.0 },
                ..Distortion::NONE
            };
            let camera = |side: u32, pose: &Option<(f64, f64, f64, f64)>| {
                let (f, x, y, z) = (*pose)?;
                Some(PosedCamera {
                    camera: Camera {
                        width: side,
                        height: side / 2 + 1,
                        intrinsics: Intrinsics::new(f, f, 10.0, 5.0).unwrap(),
                        lens: distortion.into(),
                    },
                    cam_from_world: RigidTransform::translation(x, y, z),
                })
            };
            let cameras = list
                .iter()
                .map(|(_, side, _, pose)| camera(*side, pose))
                .collect();
            let track = |list: &[(prop::sample::Index, prop::sample::Index)]| {
                let element = |(image, keypoint): &(prop::sample::Index, prop::sample::Index)| {
                    let image = image.index(images.len());
                    TrackElement {
                        image: image as u32,
                        keypoint: keypoint.index(images[image].keypoints.len()) as u32,
                    }
                };
                list.iter().map(element).collect()
            };
            let points = points
                .iter()
                .map(|(position, color, track_elements)| ScenePoint {
                    position: Point3::from(*position),
                    color: *color,
                    track: track(track_elements),
                    error_px: 0.5,
                })
                .collect();
            let reconstruction = Reconstruction {
                cameras,
                points,
                ..Reconstruction::default()
            };
            (reconstruction, images)
        })
}

/// Returns the words of the lines without comments; an empty line has no keypoints.
fn lines(text: &str) -> Vec<Vec<&str>> {
    let is_data = |line: &&str| !line.starts_with('#');
    // As in COLMAP, a line ends at the line feed.
    let whole = text.strip_suffix('\n').unwrap_or(text);
    whole
        .split('\n')
        .filter(is_data)
        .map(|line| line.split(' ').collect())
        .collect()
}

fn number(word: &str) -> f64 {
    let value: f64 = word.parse().unwrap();
    assert!(value.is_finite(), "{word}");
    value
}

/// Returns the values after the header of a binary PLY file with colors, and their count in the
/// header.
fn ply(bytes: &[u8]) -> (usize, &[u8]) {
    let end = bytes
        .windows(11)
        .position(|w| w == b"end_header\n")
        .unwrap()
        + 11;
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let count = header
        .lines()
        .find_map(|line| line.strip_prefix("element vertex "));
    (count.unwrap().parse().unwrap(), &bytes[end..])
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn colmap((reconstruction, images) in any_reconstruction()) {
        let model = Model::from_reconstruction(&reconstruction, &images);
        let files = model.to_colmap_text().unwrap();
        let [cameras, image_list, points] = [0, 1, 2].map(|i| str::from_utf8(&files[i].bytes).unwrap());
        let cameras = lines(cameras);
        for (index, words) in cameras.iter().enumerate() {
            prop_assert_eq!(words[0], (index + 1).to_string());
            let is_bent = (reconstruction.cameras.iter().flatten()).any(|c| !c.camera.is_pinhole());
            prop_assert_eq!(words.len(), if is_bent { 12 } else { 8 });
            words[2..].iter().for_each(|word| { number(word); });
        }
        let list = lines(image_list);
        prop_assert_eq!(list.len(), 2 * reconstruction.num_registered());
        let registered = (0..images.len()).filter(|&i| reconstruction.cameras[i].is_some());
        for (index, pair) in registered.zip(list.chunks_exact(2)) {
            let [head, keypoints] = pair else { unreachable!() };
            prop_assert_eq!(number(head[0]) as usize, index + 1);
            head[1..8].iter().for_each(|word| { number(word); });
            let camera = number(head[8]) as usize;
            prop_assert!(camera >= 1 && camera <= cameras.len());
            prop_assert_eq!(keypoints.len(), 3 * images[index].keypoints.len());
            for keypoint in keypoints.chunks_exact(3) {
                let point = number(keypoint[2]);
                prop_assert!(point == -1.0 || point >= 1.0 && point <= reconstruction.points.len() as f64);
            }
        }
        let points = lines(points);
        prop_assert_eq!(points.len(), reconstruction.points.len());
        for (words, point) in points.iter().zip(&reconstruction.points) {
            let is_registered = |element: &&TrackElement| reconstruction.cameras[element.image as usize].is_some();
            let num_observations = point.track.iter().filter(is_registered).count();
            prop_assert_eq!(words.len(), 8 + 2 * num_observations);
            prop_assert_eq!(Point3::new(number(words[1]), number(words[2]), number(words[3])), point.position);
        }
        let cloud = model.to_ply();
        let (count, values) = ply(&cloud);
        prop_assert_eq!((count, values.len()), (reconstruction.points.len(), 15 * reconstruction.points.len()));
    }
}
