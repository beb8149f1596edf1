//! `calib.txt` of the Middlebury and ETH3D stereo benchmarks: a rectified pair.
//!
//! Lines of `key=value`: `cam0`, `cam1`, `width`, `height`, `baseline` in millimeters (meters at
//! ETH3D). Pixel centers are at integers.
//!
//! Source: Scharstein et al. 2014, "High-resolution stereo datasets with subpixel-accurate ground
//! truth", and its page of the 2014 datasets.

use super::named::Cameras;
use crate::{Error, Result};
use epipole::camera::{Camera, Intrinsics, Lens};

pub(super) fn is_it(text: &str) -> bool {
    text.lines()
        .any(|line| line.trim_start().starts_with("cam0=["))
}

pub(super) fn read(text: &str) -> Result<Cameras> {
    let cameras = [camera(text, "cam0")?, camera(text, "cam1")?];
    let (line, baseline) = value(text, "baseline")?;
    let baseline = crate::text::number(line, baseline)?;
    Ok(Cameras::of_rectified(cameras, baseline))
}

/// Returns the line number and the value of a key.
fn value<'a>(text: &'a str, key: &str) -> Result<(usize, &'a str)> {
    let find = |(line, number): (&'a str, usize)| {
        let rest = line.trim().strip_prefix(key)?.strip_prefix('=')?;
        Some((number, rest.trim()))
    };
    (text.lines().zip(1..).find_map(find))
        .ok_or_else(|| Error::malformed(format!("{key} is missing")))
}

fn camera(text: &str, key: &str) -> Result<Camera> {
    let (line, matrix) = value(text, key)?;
    let between = |c: char| c.is_whitespace() || matches!(c, '[' | ']' | ';' | ',');
    let words = matrix.split(between).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words
        .map(|word| crate::text::number(line, word))
        .collect::<Result<_>>()?;
    let [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0] = numbers[..] else {
        return Err(Error::at(
            line,
            format!("{key} is not [fx 0 cx; 0 fy cy; 0 0 1]"),
        ));
    };
    let side = |name: &str| {
        let (line, word) = value(text, name)?;
        let side = word.parse::<u32>().ok().filter(|side| *side > 0);
        side.ok_or_else(|| {
            Error::at(
                line,
                format!("{name} is not a whole number of pixels above 0"),
            )
        })
    };
    Ok(Camera {
        width: side("width")?,
        height: side("height")?,
        intrinsics: Intrinsics::new(fx, fy, cx, cy)
            .map_err(|error| Error::from(error).on_line(line))?,
        lens: Lens::NONE,
    })
}

#[cfg(test)]
mod tests {
    use crate::camera::{CameraFormat, read_cameras};

    const PAIR: &str = "cam0=[3997.684 0 1176.728; 0 3997.684 1011.728; 0 0 1]\n\
        cam1=[3997.684 0 1307.839; 0 3997.684 1011.728; 0 0 1]\ndoffs=131.111\n\
        baseline=193.001\nwidth=2964\nheight=1988\nndisp=280\n";

    #[test]
    fn a_pair_is_a_rig() {
        let (format, rig) = read_cameras(PAIR.as_bytes(), None).unwrap();
        assert_eq!(format, CameraFormat::Middlebury);
        let center = |at: usize| rig.cameras[at].camera.intrinsics.principal_point().x;
        // The difference of the principal points is the doffs of the file.
        assert!((center(1) - center(0) - 131.111).abs() < 1e-9);
        assert_eq!(rig.cameras[0].camera.width, 2964);
        assert_eq!(rig.right_from_left.unwrap().translation.vector.x, -193.001);
    }

    #[test]
    fn wrong_values_are_named() {
        for (from, to, message) in [
            ("cam1=", "cam2=", "cam1 is missing"),
            (
                "baseline=193.001",
                "baseline=x",
                "line 4: \"x\" is not a number",
            ),
            (
                "width=2964",
                "width=0.5",
                "line 5: width is not a whole number",
            ),
            (
                "height=1988",
                "height=0",
                "line 6: height is not a whole number",
            ),
            ("; 0 0 1]\ncam1", "]\ncam1", "line 1: cam0 is not [fx 0 cx"),
            ("cam0=[3997.684", "cam0=[-1", "line 1: "),
        ] {
            let error = read_cameras(PAIR.replace(from, to).as_bytes(), None).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}");
        }
    }
}
