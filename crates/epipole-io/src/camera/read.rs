//! Recognition of camera files.

use super::format::CameraFormat;
use super::named::Cameras;
use super::{colmap, epipole_json, flat, kalibr, kitti, matlab, metashape, middlebury, nerfstudio};
use super::{opencv, ros};
use crate::text::decode;
use crate::tree::{Field, Syntax};
use crate::{Error, Result};
use epipole::camera::{Camera, Intrinsics, Lens};

/// Maximum number of keys that a message lists.
const MAX_KEYS: usize = 8;

/// Reads the cameras of a file, whose format is recognized by its content.
///
/// * `bytes`: content of the file
/// * `size`: width and height of the images, pixels, for a file without them
///
/// Pixels are converted to centers at integers; see [`CameraFormat`] for the formats.
///
/// # Errors
/// [`Error::Malformed`] for another file, and for wrong or missing values, with key and line;
/// [`Error::Unsupported`] for lenses that the library does not have; [`Error::Invalid`] for a focal
/// length ≤ 0.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::camera::{CameraFormat, read_cameras};
/// let text = "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   \
///     data: [ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]\n";
/// let (format, cameras) = read_cameras(text.as_bytes(), Some((640, 480)))?;
/// assert_eq!(format, CameraFormat::OpenCv);
/// assert_eq!(cameras.cameras[0].camera.intrinsics.fu_px(), 500.0);
/// # Ok(()) }
/// ```
pub fn read_cameras(bytes: &[u8], size: Option<(u32, u32)>) -> Result<(CameraFormat, Cameras)> {
    let (format, cameras) = if colmap::is_binary(bytes) {
        (CameraFormat::Colmap, colmap::read_binary(bytes)?)
    } else {
        let text = decode(bytes)?;
        if colmap::is_text(text) {
            (CameraFormat::Colmap, colmap::read_text(text)?)
        } else if middlebury::is_it(text) {
            (CameraFormat::Middlebury, middlebury::read(text)?)
        } else {
            of_tree(text, size)?
        }
    };
    match cameras.cameras.is_empty() {
        true => Err(Error::malformed("there is no camera in it")),
        false => Ok((format, cameras)),
    }
}

/// Returns whether keys or first words are those of a camera file, even if it is malformed.
pub fn is_camera_file(bytes: &[u8]) -> bool {
    let is_tree = |text: &str| {
        let syntax = Syntax::of(text);
        let Ok(node) = syntax.parse(text) else {
            return false;
        };
        let whole = Field::root(&node);
        let storage = whole.get("opencv_storage");
        let root = storage.as_ref().unwrap_or(&whole);
        recognize(syntax, root, storage.is_some()).is_ok() || bare_matrix(root).is_some()
    };
    let is_text = |text: &str| colmap::is_text(text) || middlebury::is_it(text) || is_tree(text);
    colmap::is_binary(bytes) || decode(bytes).is_ok_and(is_text)
}

fn of_tree(text: &str, size: Option<(u32, u32)>) -> Result<(CameraFormat, Cameras)> {
    let syntax = Syntax::of(text);
    let node = syntax.parse(text)?;
    let whole = Field::root(&node);
    let storage = whole.get("opencv_storage");
    let root = storage.as_ref().unwrap_or(&whole);
    if let (Some([fx, fy, cx, cy]), Some((width, height))) = (bare_matrix(root), size) {
        let one = Camera {
            width,
            height,
            intrinsics: Intrinsics::new(fx, fy, cx, cy)?,
            lens: Lens::NONE,
        };
        return Ok((CameraFormat::Flat, Cameras::of(one)));
    }
    let format = recognize(syntax, root, storage.is_some())?;
    let cameras = match format {
        CameraFormat::Epipole => epipole_json::read(root),
        CameraFormat::NerfStudio => nerfstudio::read(root, size),
        CameraFormat::Matlab => matlab::read(root, size),
        CameraFormat::Metashape => metashape::read(root),
        CameraFormat::Kalibr => kalibr::read(root),
        CameraFormat::Ros => ros::read(root, size),
        CameraFormat::Kitti => kitti::read(root, size),
        CameraFormat::Flat => flat::read(root, size),
        CameraFormat::OpenCv | CameraFormat::Colmap | CameraFormat::Middlebury => {
            opencv::read(root, size)
        }
    }?;
    Ok((format, cameras))
}

/// Returns fx, fy, cx and cy of nine numbers without keys.
fn bare_matrix(root: &Field) -> Option<[f64; 4]> {
    match root.numbers().ok()?[..] {
        [fx, _, cx, _, fy, cy, 0.0, 0.0, 1.0] => Some([fx, fy, cx, cy]),
        _ => None,
    }
}

fn recognize(syntax: Syntax, root: &Field, is_storage: bool) -> Result<CameraFormat> {
    type Candidate = (CameraFormat, fn(&Field) -> bool);
    const OPENCV: Candidate = (CameraFormat::OpenCv, opencv::is_it);
    const OF_JSON: [Candidate; 6] = [
        (CameraFormat::Epipole, epipole_json::is_it),
        (CameraFormat::NerfStudio, nerfstudio::is_it),
        (CameraFormat::Matlab, matlab::is_it),
        (CameraFormat::Ros, ros::is_it),
        OPENCV,
        (CameraFormat::Flat, flat::is_it),
    ];
    const OF_YAML: [Candidate; 5] = [
        (CameraFormat::Kalibr, kalibr::is_it),
        (CameraFormat::Ros, ros::is_it),
        (CameraFormat::Kitti, kitti::is_it),
        OPENCV,
        (CameraFormat::Flat, flat::is_it),
    ];
    const OF_XML: [Candidate; 2] = [(CameraFormat::Metashape, metashape::is_it), OPENCV];
    if root.get("views").is_some() && root.get("poses").is_some() {
        return Err(Error::unsupported(
            "it is a scene of AliceVision (Meshroom), which is not read: export it as COLMAP's",
        ));
    }
    let candidates: &[Candidate] = match syntax {
        Syntax::Json => &OF_JSON,
        Syntax::Yaml => &OF_YAML,
        Syntax::Xml if is_storage => &OF_XML[1..],
        Syntax::Xml => &OF_XML,
    };
    let found = candidates.iter().find(|(_, is_it)| is_it(root));
    found.map(|(format, _)| *format).ok_or_else(|| {
        let keys: Vec<String> = (root.entries().iter().take(MAX_KEYS))
            .map(|(key, _)| format!("{key:.30}"))
            .collect();
        if let Some([fx, fy, cx, cy]) = bare_matrix(root) {
            return Error::malformed(format!(
                "it is a matrix alone, without the size of its images: give it as --k {fx},{fy},{cx},{cy}"
            ));
        }
        let keys = match keys.is_empty() {
            true => "it has no keys".to_owned(),
            false => format!("its keys are {}", keys.join(", ")),
        };
        Error::malformed(format!(
            "no camera that epipole calibrate, OpenCV, ROS, Kalibr, KITTI, Middlebury, ORB-SLAM, COLMAP, nerfstudio, Metashape or MATLAB writes: {keys}"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_without_a_size_is_reported() {
        for text in [
            "500 0 320\n0 501 240\n0 0 1\n",
            "5.0e+02,0,320\n0,501,240\n0,0,1\n",
            "[[500, 0, 320], [0, 501, 240], [0, 0, 1]]",
        ] {
            let error = read_cameras(text.as_bytes(), None).unwrap_err().to_string();
            assert!(error.ends_with("give it as --k 500,501,320,240"), "{error}");
            assert!(is_camera_file(text.as_bytes()));
            let (_, one) = read_cameras(text.as_bytes(), Some((640, 480))).unwrap();
            assert_eq!(one.cameras[0].camera.intrinsics.fv_px(), 501.0);
        }
        let scene = br#"{"version": ["1"], "views": [], "intrinsics": [], "poses": []}"#;
        assert!(
            read_cameras(scene, None)
                .unwrap_err()
                .to_string()
                .contains("AliceVision")
        );
        assert!(!is_camera_file(b"1 2 3\n4 5 6\n7 8 9\n"));
    }
}
