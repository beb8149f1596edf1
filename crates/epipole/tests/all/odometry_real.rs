//! Visual odometry on a real drive with known poses.

use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::progress::Status;
use epipole::sfm::{
    AlignmentKind, OdometryOptions, Photo, PhotoOptions, SfmInput, absolute_trajectory_error,
    match_photos, monocular_odometry,
};
use epipole_io::photo::{DecodeOptions, decode_rgb};
use nalgebra::Point3;
use std::ops::ControlFlow;
use std::path::PathBuf;

fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// OpenCV's frame-to-frame essential matrices, with the length of every step taken from the truth,
/// come to 13.1 mm; so must our directions with the same lengths. Our own lengths come to 6 cm on
/// 18.7 m whatever the settings.
#[test]
fn kitti_curve_is_followed() {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let folder = root.join("vo/kitti_turn");
    let Ok(poses) = std::fs::read_to_string(folder.join("poses.txt")) else {
        println!("skipped: no data at {}", folder.display());
        return;
    };
    let truth: Vec<Point3<f64>> = poses
        .lines()
        .map(numbers)
        .filter(|p| p.len() == 12)
        .map(|p| Point3::new(p[3], p[7], p[11]))
        .collect();
    let calibration = std::fs::read_to_string(folder.join("calib.txt")).expect("calibration");
    let k = numbers(calibration.lines().next().expect("a line"));
    let intrinsics = Intrinsics::new(k[0], k[5], k[2], k[6]).expect("intrinsics");
    let photos: Vec<Photo> = (0..truth.len())
        .map(|frame| {
            let name = format!("{frame:06}.png");
            let bytes = std::fs::read(folder.join(&name)).expect("a frame");
            let image = decode_rgb(&bytes, &DecodeOptions::default())
                .expect("an image")
                .image;
            Photo {
                name,
                image,
                ..Photo::default()
            }
        })
        .collect();
    let (width, height) = photos[0].image.dimensions();
    let begin = std::time::Instant::now();
    let mut photo_options = PhotoOptions::default().with_neighbors(4);
    photo_options.features.max_features = 3000;
    let mut observer = |status: Status| {
        println!("{:?} {status:?}", begin.elapsed());
        ControlFlow::Continue(())
    };
    let (images, pairs) = match_photos(&photos, &photo_options, &mut observer).expect("matches");
    let input = SfmInput {
        images,
        cameras: vec![Camera::pinhole(intrinsics, width, height)],
        pairs,
    };
    for final_adjustment in [false, true] {
        let options = OdometryOptions::default().with_final_adjustment(final_adjustment);
        let result = monocular_odometry(&input, &options, &mut observer).expect("a path");
        assert_eq!(result.lost, [0; 0]);
        let centers: Vec<Point3<f64>> = result
            .world_from_cam
            .iter()
            .flatten()
            .map(|pose: &RigidTransform| Point3::from(pose.translation.vector))
            .collect();
        let error_of = |centers: &[Point3<f64>]| {
            absolute_trajectory_error(centers, &truth, AlignmentKind::Similarity)
                .expect("an error")
                .0
        };
        let own = error_of(&centers);
        // The same directions with the true lengths.
        let mut stepped = vec![centers[0]];
        for (pair, true_pair) in centers.windows(2).zip(truth.windows(2)) {
            let length_m = (true_pair[1] - true_pair[0]).norm();
            let direction = (pair[1] - pair[0]).normalize();
            stepped.push(stepped[stepped.len() - 1] + direction * length_m);
        }
        let with_true_lengths = error_of(&stepped);
        println!(
            "final adjustment {final_adjustment}: {own:?}, true lengths {with_true_lengths:?}"
        );
        assert!(with_true_lengths.rmse <= 0.0131, "{with_true_lengths:?}");
        assert!(own.rmse <= 0.065, "{own:?}");
    }
    // Nobody knows the focal length: from a quarter too long or too short it is found, as far as 20
    // frames tell it.
    for ratio in [0.75, 1.25] {
        let guess = Intrinsics::new(ratio * k[0], ratio * k[5], k[2], k[6]).expect("intrinsics");
        let unknown = SfmInput {
            cameras: vec![Camera::pinhole(guess, width, height)],
            ..input.clone()
        };
        let mut options = OdometryOptions::default();
        options.sfm.refine_focal = true;
        let result = monocular_odometry(&unknown, &options, &mut observer).expect("a path");
        let cameras = result.reconstruction.cameras.iter().flatten();
        let found: Vec<f64> = cameras
            .map(|camera| camera.camera.intrinsics.fu_px() / k[0])
            .collect();
        println!("from {ratio} of the focal length: {}", found[0]);
        assert_eq!(found.len(), truth.len());
        assert!(found.iter().all(|of| (of - 1.0).abs() < 0.03), "{found:?}");
    }
}
