//! Path of the cameras for programs that compare trajectories.

use epipole_io::model::Model;
use epipole_io::trajectory::{TrajectoryFormat, write_trajectory};

/// Returns the names and contents of the files: in KITTI's format, and in TUM's if the photographs
/// are named by their times.
///
/// # Errors
/// A message, if a pose cannot be written.
pub(super) fn files(model: &Model) -> Result<Vec<(&'static str, String)>, String> {
    let path = model.trajectory();
    let mut formats = vec![("trajectory.txt", TrajectoryFormat::Kitti)];
    if path.stamps_ns.is_some() {
        formats.push(("trajectory.tum", TrajectoryFormat::Tum));
    }
    let write = |(name, format)| {
        let text = write_trajectory(format, &path).map_err(|error| error.to_string())?;
        Ok((name, text))
    };
    formats.into_iter().map(write).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
    use epipole::sfm::{Reconstruction, SfmImage};

    fn model(names: [&str; 2]) -> Model {
        let intrinsics = Intrinsics::centered(100.0, 64, 48).unwrap();
        let camera = |x_m: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics, 64, 48),
            cam_from_world: RigidTransform::translation(-x_m, 0.0, 0.0),
        };
        let reconstruction = Reconstruction {
            cameras: vec![Some(camera(0.0)), Some(camera(0.5))],
            is_placed: false,
            points: Vec::new(),
        };
        let images = names.map(|name| SfmImage {
            name: name.to_owned(),
            ..SfmImage::default()
        });
        Model::from_reconstruction(&reconstruction, &images)
    }

    #[test]
    fn times_in_names_give_a_file_with_times() {
        let timed = files(&model(["1305031102.175304.png", "1305031102.275304.png"])).unwrap();
        let [(kitti, _), (tum, text)] = timed.as_slice() else {
            panic!("{timed:?}");
        };
        assert_eq!((*kitti, *tum), ("trajectory.txt", "trajectory.tum"));
        let poses: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
        assert!(poses[1].starts_with("1305031102.275304"), "{text}");
        assert_eq!(poses[1].split_whitespace().nth(1), Some("0.5"), "{text}");
        assert_eq!(files(&model(["a.png", "b.png"])).unwrap().len(), 1);
    }
}
