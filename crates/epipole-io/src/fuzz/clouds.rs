//! Points of any value.

use crate::cloud::{read_ply, write_ply};
use crate::damage::config;
use epipole::stereo::PointCloud;
use nalgebra::Point3;
use proptest::prelude::*;

proptest! {
    #![proptest_config(config())]

    #[test]
    fn ply_of_a_cloud(
        points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..20),
        num_colors in 0..21_usize,
    ) {
        let cloud = PointCloud {
            points: points.iter().map(|p| Point3::from(*p)).collect(),
            colors: (0..num_colors).map(|i| [i as u8, 7, 255]).collect(),
        };
        let (read, notes) = read_ply(&write_ply(&cloud)).unwrap();
        let told = notes.first().and_then(|note| note.split(' ').next()?.parse().ok());
        prop_assert_eq!(read.points.len() + told.unwrap_or(0), points.len());
        let has_colors = num_colors == points.len();
        prop_assert_eq!(read.colors.len(), if has_colors { read.points.len() } else { 0 });
    }
}
