//! Written files can be read: PLY, by an independent reader.

use super::config;
use epipole::stereo::PointCloud;
use nalgebra::Point3;
use proptest::prelude::*;

/// The values behind the header of a binary PLY file with colors, and how many it promises.
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
    fn ply_of_a_cloud(
        points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..20),
        num_colors in 0..21_usize,
    ) {
        let cloud = PointCloud {
            points: points.iter().map(|p| Point3::from(*p)).collect(),
            colors: (0..num_colors).map(|i| [i as u8, 7, 255]).collect(),
        };
        let has_colors = num_colors == points.len() && num_colors > 0;
        let binary = cloud.to_ply();
        let (count, values) = ply(&binary);
        prop_assert_eq!(count, points.len());
        prop_assert_eq!(values.len(), points.len() * if has_colors { 15 } else { 12 });
        let text = cloud.to_ply_ascii();
        let body: Vec<&str> = text.split("end_header\n").nth(1).unwrap().lines().collect();
        prop_assert_eq!(body.len(), points.len());
        for line in body {
            prop_assert_eq!(line.split(' ').count(), if has_colors { 6 } else { 3 });
        }
    }
}
