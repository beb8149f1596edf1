//! Point clouds with arbitrary values.

use crate::cloud::{read_ply, write_ply};
use crate::damage::config;
use epipole::stereo::PointCloud;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config())]

    #[test]
    fn ply_of_a_cloud(
        points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..20),
        num_colors in 0..21_usize,
        num_normals in 0..21_usize,
        num_confidences in 0..21_usize,
    ) {
        let cloud = PointCloud {
            points: points.iter().map(|p| Point3::from(*p)).collect(),
            colors: (0..num_colors).map(|i| [i as u8, 7, 255]).collect(),
            normals: (0..num_normals).map(|i| Vector3::new(i as f64, f64::NAN, 1e300)).collect(),
            confidences: (0..num_confidences).map(|i| i as f32).collect(),
        };
        let (read, notes) = read_ply(&write_ply(&cloud)).unwrap();
        let num_left_out = notes.first().and_then(|note| note.split(' ').next()?.parse().ok());
        prop_assert_eq!(read.points.len() + num_left_out.unwrap_or(0), points.len());
        for (expected, got) in [
            (num_colors, read.colors.len()),
            (num_normals, read.normals.len()),
            (num_confidences, read.confidences.len()),
        ] {
            let is_whole = expected == points.len();
            prop_assert_eq!(got, if is_whole { read.points.len() } else { 0 });
        }
    }
}
