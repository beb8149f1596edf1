//! Texts of cameras.

use super::format::CameraFormat;
use super::named::Cameras;
use super::{colmap, epipole_json, opencv_write, ros_write};
use crate::{Error, Result};

/// Writes cameras: [`CameraFormat::Epipole`], [`OpenCv`](CameraFormat::OpenCv) (YAML),
/// [`Ros`](CameraFormat::Ros) or [`Colmap`](CameraFormat::Colmap) (`cameras.txt`).
///
/// Numbers have all digits, so cameras read back are equal. COLMAP's format has no names and no
/// motion.
///
/// # Errors
/// [`Error::Unsupported`] for other formats, for a lens or a number of cameras that the format
/// cannot hold, and without a camera.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole_io::camera::{CameraFormat, Cameras, write_cameras};
/// let camera = Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480);
/// let text = write_cameras(CameraFormat::Colmap, &Cameras::of(camera))?;
/// // COLMAP has the middle of the image half a pixel ahead.
/// assert!(text.ends_with("\n1 PINHOLE 640 480 500 500 320 240\n"));
/// # Ok(()) }
/// ```
pub fn write_cameras(format: CameraFormat, cameras: &Cameras) -> Result<String> {
    if cameras.cameras.is_empty() {
        return Err(Error::unsupported("there is no camera to write"));
    }
    match format {
        CameraFormat::Epipole => epipole_json::write(cameras),
        CameraFormat::OpenCv => opencv_write::write(cameras),
        CameraFormat::Ros => ros_write::write(cameras),
        CameraFormat::Colmap => Ok(colmap::write(cameras)),
        other => Err(Error::unsupported(format!(
            "cameras of {} are read, but not written: Epipole, OpenCV, ROS and COLMAP are",
            other.name()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::super::read_cameras;
    use super::*;
    use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
    use nalgebra::Vector3;

    const FORMATS: [CameraFormat; 4] = [
        CameraFormat::Epipole,
        CameraFormat::OpenCv,
        CameraFormat::Ros,
        CameraFormat::Colmap,
    ];

    fn camera(kind: LensKind) -> Camera {
        let numbers = [-0.1, 1.0 / 3.0, 1e-17, -2e-3, 1e-5, 0.4, 0.5, 0.6];
        Camera {
            width: 641,
            height: 480,
            // Half a pixel is added and subtracted exactly.
            intrinsics: Intrinsics::new(1000.0 / 3.0, 500.1, 320.125, 239.75).unwrap(),
            lens: Lens::from_coefficients(kind, &numbers[..kind.num_coefficients()]).unwrap(),
        }
    }

    #[test]
    fn every_lens_survives_every_format() {
        for kind in [
            LensKind::Brown,
            LensKind::Rational,
            LensKind::Fisheye,
            LensKind::Division,
        ] {
            for format in FORMATS {
                let cameras = Cameras::of(camera(kind));
                let text = write_cameras(format, &cameras);
                let is_held = kind != LensKind::Division
                    || matches!(format, CameraFormat::Epipole | CameraFormat::Colmap);
                if !is_held {
                    assert!(matches!(text, Err(Error::Unsupported { .. })));
                    continue;
                }
                let (found, read) = read_cameras(text.unwrap().as_bytes(), None).unwrap();
                assert_eq!(found, format);
                assert_eq!(read.cameras[0].camera, cameras.cameras[0].camera);
            }
        }
    }

    #[test]
    fn rigs_are_written_where_they_have_a_place() {
        let motion =
            RigidTransform::new(Vector3::new(-0.1, 0.0, 1e-3), Vector3::new(0.1, 0.2, 0.3));
        let rig = Cameras::of_rig([LensKind::Brown, LensKind::Rational].map(camera), motion);
        let text = write_cameras(CameraFormat::OpenCv, &rig).unwrap();
        let (_, read) = read_cameras(text.as_bytes(), None).unwrap();
        assert_eq!(read.cameras, rig.cameras);
        let off = read.right_from_left.unwrap().to_matrix() - motion.to_matrix();
        assert!(off.amax() < 1e-15);
        let colmap = write_cameras(CameraFormat::Colmap, &rig).unwrap();
        let (_, two) = read_cameras(colmap.as_bytes(), None).unwrap();
        assert_eq!((two.cameras.len(), two.right_from_left), (2, None));
        let mixed = Cameras::of_rig([LensKind::Brown, LensKind::Fisheye].map(camera), motion);
        for (format, cameras) in [
            (CameraFormat::Ros, &rig),
            (CameraFormat::OpenCv, &mixed),
            (CameraFormat::Kalibr, &rig),
            (CameraFormat::Colmap, &Cameras::default()),
        ] {
            let error = write_cameras(format, cameras).unwrap_err();
            assert!(matches!(error, Error::Unsupported { .. }));
        }
    }
}
