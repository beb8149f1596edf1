//! The matrix Q of a rectified pair, from pixels with disparities to points.
//!
//! Source: OpenCV's documentation of `calib3d`, `stereoRectify` and `reprojectImageTo3D`.

use super::read::read_cameras;
use crate::text::decode;
use crate::tree::{Field, Syntax};
use crate::{Error, Result};
use epipole::camera::Lens;
use epipole::stereo::q_from_rig;
use nalgebra::Matrix4;

/// Maximum rotation, radians, and offset relative to the baseline that count as rounding.
const ROUNDED: f64 = 1e-4;

/// Reads Q: the key `Q` of JSON, YAML or XML, as OpenCV writes it; sixteen numbers row by row; or
/// the cameras of a rectified rig, such as `calib.txt` of Middlebury or KITTI.
///
/// # Errors
/// [`Error::Malformed`] without sixteen finite numbers, if the last row does not depend on the
/// disparity, and for cameras that are not rectified.
///
/// ```
/// use epipole_io::camera::read_q;
/// let q = read_q(b"1 0 0 -320\n0 1 0 -240\n0 0 0 700\n0 0 8 0\n")?;
/// assert_eq!((q[(2, 3)], q[(3, 2)]), (700.0, 8.0));
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn read_q(bytes: &[u8]) -> Result<Matrix4<f64>> {
    let text = decode(bytes)?;
    let q = match (plain(text), numbers_of_q(text)) {
        (Some(numbers), _) | (None, Ok(numbers)) => of_numbers(numbers)?,
        (None, Err(error)) => of_rig(bytes).ok_or(error)??,
    };
    if !q.iter().all(|entry| entry.is_finite()) {
        return Err(Error::malformed("Q has entries that are not finite"));
    }
    match q[(3, 2)] == 0.0 || q[(2, 3)] == 0.0 {
        true => Err(Error::malformed(
            "this is no Q: row 4, column 3 is ±1 over the baseline and row 3, column 4 the focal \
             length, neither can be 0",
        )),
        false => Ok(q),
    }
}

/// Returns Q of sixteen numbers, row by row.
fn of_numbers(numbers: Vec<f64>) -> Result<Matrix4<f64>> {
    let entries: [f64; 16] = (numbers.try_into()).map_err(|numbers: Vec<f64>| {
        Error::malformed(format!("Q has {} numbers, not 16", numbers.len()))
    })?;
    Ok(Matrix4::from_row_slice(&entries))
}

/// Returns the numbers of a text that has nothing else.
fn plain(text: &str) -> Option<Vec<f64>> {
    let between = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '[' | ']');
    let words = text.split(between).filter(|word| !word.is_empty());
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    numbers.filter(|numbers| !numbers.is_empty())
}

/// Returns the numbers of the key `Q`.
fn numbers_of_q(text: &str) -> Result<Vec<f64>> {
    let tree = Syntax::of(text).parse(text)?;
    let whole = Field::root(&tree);
    let root = whole.get("opencv_storage").unwrap_or(whole);
    let field = root.any(&["q", "disparitytodepthmatrix"]);
    match field {
        Some(field) => field.numbers(),
        None => Err(root.missing(
            "Q",
            "16 numbers; `epipole rectify --json` with known cameras prints one",
        )),
    }
}

/// Returns Q of a file with the cameras of a rig; `None` for another file.
fn of_rig(bytes: &[u8]) -> Option<Result<Matrix4<f64>>> {
    // Q does not depend on the size, which some files lack.
    let (_, cameras) = read_cameras(bytes, Some((1, 1))).ok()?;
    let motion = cameras.right_from_left?;
    let [left, right, ..] = &cameras.cameras[..] else {
        return None;
    };
    let [left, right] = [left.camera, right.camera];
    let [c1, c2] = [left, right].map(|camera| camera.intrinsics.principal_point());
    let focal_px = left.intrinsics.fu_px();
    let baseline = -motion.translation.x;
    let is_rectified = baseline > 0.0
        && motion.translation.vector.yz().norm() <= ROUNDED * baseline
        && motion.rotation.angle() <= ROUNDED
        && [left, right].iter().all(|camera| {
            let k = &camera.intrinsics;
            camera.lens == Lens::NONE && k.fu_px() == focal_px && k.fv_px() == focal_px
        })
        && c1.y == c2.y;
    if !is_rectified {
        return Some(Err(Error::malformed(
            "the cameras are not those of a rectified pair: `epipole rectify --json` prints its Q",
        )));
    }
    let q = q_from_rig(focal_px, baseline, c1.x, c1.y).map(|mut q| {
        // Z = f B/(d + c₂ − c₁).
        q[(3, 3)] = (c2.x - c1.x) / baseline;
        q
    });
    Some(q.map_err(Error::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBERS: &str = "1, 0, 0, -319.5, 0, 1, 0, -239.5, 0, 0, 0, 700, 0, 0, 8.5, 0.25";

    #[test]
    fn a_rig_with_an_infinite_q_is_refused() {
        let text = "cam0=[1000 0 -1e308; 0 1000 0; 0 0 1]\ncam1=[1000 0 1e308; 0 1000 0; 0 0 1]\n\
            baseline=0.5\nwidth=640\nheight=480\n";
        let error = read_q(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("not finite"), "{error}");
    }

    #[test]
    fn q_of_each_syntax() {
        let yaml = format!(
            "%YAML:1.0\n---\nQ: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ {NUMBERS} ]\n"
        );
        let xml = format!(
            "<?xml version=\"1.0\"?>\n<opencv_storage><Q type_id=\"opencv-matrix\"><rows>4</rows><cols>4</cols>\
             <dt>d</dt><data>{}</data></Q></opencv_storage>\n",
            NUMBERS.replace(',', "")
        );
        for text in [
            format!("{{\"q\": [{NUMBERS}], \"num_inliers\": 7}}"),
            yaml,
            xml,
            NUMBERS.replace(", 0, 1,", "\n0, 1,"),
            format!("[[{NUMBERS}]]"),
        ] {
            let q = read_q(text.as_bytes()).unwrap();
            assert_eq!(
                (q[(0, 3)], q[(2, 3)], q[(3, 2)], q[(3, 3)]),
                (-319.5, 700.0, 8.5, 0.25)
            );
        }
    }

    #[test]
    fn q_of_a_rectified_rig() {
        let middlebury = "cam0=[3997.684 0 1176.728; 0 3997.684 1011.728; 0 0 1]\n\
            cam1=[3997.684 0 1307.839; 0 3997.684 1011.728; 0 0 1]\nbaseline=193.001\n\
            width=2964\nheight=1988\n";
        let q = read_q(middlebury.as_bytes()).unwrap();
        let point = q * nalgebra::Vector4::new(1176.728, 1011.728, 100.0, 1.0);
        // Z = f B/(d + doffs), from the web page of the data sets.
        let depth = 3997.684 * 193.001 / (100.0 + 1307.839 - 1176.728);
        assert!((point.z / point.w - depth).abs() < 1e-9 * depth);
        let kitti = "P0: 718.856 0 607.1928 0 0 718.856 185.2157 0 0 0 1 0\n\
            P1: 718.856 0 607.1928 -386.1448 0 718.856 185.2157 0 0 0 1 0\n";
        assert!((1.0 / read_q(kitti.as_bytes()).unwrap()[(3, 2)] - 0.5372).abs() < 1e-4);
        let tilted = kitti.replace("185.2157 0 0 0 1 0\nP1", "185.2157 9 0 0 1 0\nP1");
        let error = read_q(tilted.as_bytes()).unwrap_err().to_string();
        assert!(
            error.starts_with("the cameras are not those of a rectified pair"),
            "{error}"
        );
    }

    #[test]
    fn a_wrong_q_is_named() {
        for (text, message) in [
            ("1 2 3", "Q has 3 numbers, not 16"),
            ("{\"q\": null}", "Q is missing"),
            ("{\"k\": [1]}", "Q is missing"),
            ("1 0 0 0 0 1 0 0 0 0 0 nan 0 0 1 0", "not finite"),
            ("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "this is no Q"),
        ] {
            let error = read_q(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
