//! COLMAP's camera models: names, numbers, parameters.
//!
//! A model has one or two focal lengths, the principal point, and coefficients of a lens. The
//! center of the first pixel is at (0.5, 0.5).
//!
//! Source: COLMAP 4, `src/colmap/sensor/models.h`.

use crate::{Error, Result};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind};

/// Coefficients of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Coefficients {
    /// The first coefficients of a lens, in its order.
    First(LensKind),
    /// Coefficients of the rational lens, or of Brown's if the denominator is 1.
    FullOpenCv,
    /// k1, k2, p1, p2, k3, k4, sx1, sy1: a fisheye unless it has tangential or prism terms.
    ThinPrism,
    /// k0 to k5, p0, p1, s0 to s3: like `ThinPrism`, with two more radial terms.
    RadTanThinPrism,
    /// Coefficients of an unsupported lens.
    Other,
}

/// A camera model of COLMAP.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Model {
    name: &'static str,
    num_focals: usize,
    num_coefficients: usize,
    coefficients: Coefficients,
}

const fn model(
    name: &'static str,
    num_focals: usize,
    num_coefficients: usize,
    coefficients: Coefficients,
) -> Model {
    Model {
        name,
        num_focals,
        num_coefficients,
        coefficients,
    }
}

const BROWN: Coefficients = Coefficients::First(LensKind::Brown);
const FISHEYE: Coefficients = Coefficients::First(LensKind::Fisheye);
const DIVISION: Coefficients = Coefficients::First(LensKind::Division);

/// The models; the index is the number of a model in binary files.
const MODELS: [Model; 18] = [
    model("SIMPLE_PINHOLE", 1, 0, BROWN),
    model("PINHOLE", 2, 0, BROWN),
    model("SIMPLE_RADIAL", 1, 1, BROWN),
    model("RADIAL", 1, 2, BROWN),
    model("OPENCV", 2, 4, BROWN),
    model("OPENCV_FISHEYE", 2, 4, FISHEYE),
    model("FULL_OPENCV", 2, 8, Coefficients::FullOpenCv),
    model("FOV", 2, 1, Coefficients::Other),
    model("SIMPLE_RADIAL_FISHEYE", 1, 1, FISHEYE),
    model("RADIAL_FISHEYE", 1, 2, FISHEYE),
    model("THIN_PRISM_FISHEYE", 2, 8, Coefficients::ThinPrism),
    model(
        "RAD_TAN_THIN_PRISM_FISHEYE",
        2,
        12,
        Coefficients::RadTanThinPrism,
    ),
    model("SIMPLE_DIVISION", 1, 1, DIVISION),
    model("DIVISION", 2, 1, DIVISION),
    model("SIMPLE_FISHEYE", 1, 0, FISHEYE),
    model("FISHEYE", 2, 0, FISHEYE),
    model("EUCM", 2, 2, Coefficients::Other),
    // Its parameters are width and height.
    model("EQUIRECTANGULAR", 0, 0, Coefficients::Other),
];

impl Model {
    fn num_params(&self) -> usize {
        self.num_focals + 2 + self.num_coefficients
    }

    /// Returns the lens of the model's coefficients.
    fn lens(&self, k: &[f64]) -> Result<Lens> {
        let (kind, mut numbers) = match self.coefficients {
            Coefficients::First(kind) => (kind, k.to_vec()),
            Coefficients::FullOpenCv => match k[5..] == [0.0; 3] {
                true => (LensKind::Brown, k[..5].to_vec()),
                false => (LensKind::Rational, k.to_vec()),
            },
            Coefficients::ThinPrism => {
                if [k[2], k[3], k[6], k[7]] != [0.0; 4] {
                    return Err(self.beyond("tangential and thin prism terms"));
                }
                (LensKind::Fisheye, vec![k[0], k[1], k[4], k[5]])
            }
            Coefficients::RadTanThinPrism => {
                if k[4..] != [0.0; 8] {
                    return Err(self.beyond("k4, k5, tangential and thin prism terms"));
                }
                (LensKind::Fisheye, k[..4].to_vec())
            }
            Coefficients::Other => return Err(unsupported(self.name)),
        };
        numbers.resize(kind.num_coefficients(), 0.0);
        Ok(Lens::from_coefficients(kind, &numbers)?)
    }

    fn beyond(&self, terms: &str) -> Error {
        Error::unsupported(format!(
            "camera model {} is supported only if its {terms} are 0",
            self.name
        ))
    }
}

fn unsupported(name: &str) -> Error {
    Error::unsupported(format!(
        "camera model {name} is not supported: undistort its images, or use a pinhole, radial, \
         OpenCV, fisheye or division model"
    ))
}

/// Returns name and number of parameters of a model by its ID in binary files.
pub(crate) fn model_of_id(id: i32) -> Result<(&'static str, usize)> {
    let model = usize::try_from(id).ok().and_then(|id| MODELS.get(id));
    let model = model.ok_or_else(|| {
        Error::unsupported(format!(
            "camera model {id} is not known: COLMAP 4 numbers its models 0 to {}",
            MODELS.len() - 1
        ))
    })?;
    Ok((model.name, model.num_params()))
}

/// Converts a camera of COLMAP.
///
/// * `name`: of the model, such as `OPENCV`
/// * `width`, `height`: of its images, pixels
/// * `params`: in COLMAP's order, pixel centers at halves
///
/// # Errors
/// [`Error::Malformed`] for another number of parameters or an impossible size,
/// [`Error::Unsupported`] for an unsupported model, [`Error::Invalid`] for a focal length ≤ 0 and
/// for values that are not finite.
pub(crate) fn camera_from_colmap(
    name: &str,
    width: u64,
    height: u64,
    params: &[f64],
) -> Result<Camera> {
    let model =
        (MODELS.iter().find(|model| model.name == name)).ok_or_else(|| unsupported(name))?;
    if params.len() != model.num_params() {
        return Err(Error::malformed(format!(
            "camera model {name} has {} parameters, not {}",
            model.num_params(),
            params.len()
        )));
    }
    let side = |value: u64| u32::try_from(value).ok().filter(|side| *side > 0);
    let (Some(width), Some(height)) = (side(width), side(height)) else {
        return Err(Error::malformed(format!(
            "an image of {width} × {height} pixels is impossible"
        )));
    };
    let (focals, rest) = params.split_at(model.num_focals);
    let (center, coefficients) = rest.split_at(2);
    let lens = model.lens(coefficients)?;
    let (fx, fy) = match *focals {
        [f] => (f, f),
        [fx, fy] => (fx, fy),
        _ => return Err(unsupported(name)),
    };
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::from_colmap([fx, fy, center[0], center[1]])?,
        lens,
    })
}

/// A camera as COLMAP stores it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ColmapCamera {
    /// Number of its model.
    pub(crate) id: i32,
    /// Name of its model.
    pub(crate) name: &'static str,
    /// Parameters, pixel centers at halves.
    pub(crate) params: Vec<f64>,
}

/// Returns the COLMAP model of a camera and its parameters: `PINHOLE`; `OPENCV` for Brown's lens,
/// `FULL_OPENCV` if it has a k3 and for the rational lens; `OPENCV_FISHEYE`; `DIVISION`, which
/// COLMAP supports since version 4.
pub(crate) fn colmap_from_camera(camera: &Camera) -> ColmapCamera {
    let all = camera.lens.coefficients();
    let (id, count) = match camera.lens.kind() {
        LensKind::Brown if camera.lens.is_none() => (1, 0),
        LensKind::Brown if all[4] == 0.0 => (4, 4),
        LensKind::Brown => (6, 5),
        LensKind::Rational => (6, 8),
        LensKind::Fisheye => (5, 4),
        LensKind::Division => (13, 1),
    };
    let model = &MODELS[id];
    let mut params = camera.intrinsics.to_colmap().to_vec();
    params.extend(&all[..count]);
    params.resize(model.num_params(), 0.0);
    ColmapCamera {
        id: id as i32,
        name: model.name,
        params,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, params: &[f64]) -> Result<Camera> {
        camera_from_colmap(name, 640, 480, params)
    }

    fn lens(name: &str, params: &[f64]) -> (LensKind, Vec<f64>) {
        let lens = read(name, params).unwrap().lens;
        (lens.kind(), lens.coefficients())
    }

    #[test]
    fn each_model_is_the_lens_of_its_equation() {
        use LensKind::{Brown, Division, Fisheye, Rational};
        let (f, c) = ([500.0], [320.0, 240.0]);
        let p = |more: &[f64]| [&f, &c[..], more].concat();
        let q = |more: &[f64]| [&f, &f, &c[..], more].concat();
        let none = (Brown, vec![0.0; 5]);
        assert_eq!(lens("SIMPLE_PINHOLE", &p(&[])), none);
        assert_eq!(lens("PINHOLE", &q(&[])), none);
        let k1 = (Brown, vec![0.1, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(lens("SIMPLE_RADIAL", &p(&[0.1])), k1);
        let k2 = (Brown, vec![0.1, 0.2, 0.0, 0.0, 0.0]);
        assert_eq!(lens("RADIAL", &p(&[0.1, 0.2])), k2);
        let p2 = (Brown, vec![0.1, 0.2, 0.3, 0.4, 0.0]);
        assert_eq!(lens("OPENCV", &q(&[0.1, 0.2, 0.3, 0.4])), p2);
        let four = (Fisheye, vec![0.1, 0.2, 0.3, 0.4]);
        assert_eq!(lens("OPENCV_FISHEYE", &q(&[0.1, 0.2, 0.3, 0.4])), four);
        let eight = vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
        assert_eq!(lens("FULL_OPENCV", &q(&eight)), (Rational, eight));
        let five = [0.1, 0.2, 0.3, 0.4, 0.5, 0.0, 0.0, 0.0];
        assert_eq!(lens("FULL_OPENCV", &q(&five)), (Brown, five[..5].to_vec()));
        let one = (Fisheye, vec![0.1, 0.0, 0.0, 0.0]);
        assert_eq!(lens("SIMPLE_RADIAL_FISHEYE", &p(&[0.1])), one);
        let two = (Fisheye, vec![0.1, 0.2, 0.0, 0.0]);
        assert_eq!(lens("RADIAL_FISHEYE", &p(&[0.1, 0.2])), two);
        let prism = [0.1, 0.2, 0.0, 0.0, 0.3, 0.4, 0.0, 0.0];
        assert_eq!(lens("THIN_PRISM_FISHEYE", &q(&prism)), four);
        assert_eq!(lens("SIMPLE_DIVISION", &p(&[-0.1])), (Division, vec![-0.1]));
        assert_eq!(lens("DIVISION", &q(&[-0.1])), (Division, vec![-0.1]));
        assert_eq!(lens("FISHEYE", &q(&[])), (Fisheye, vec![0.0; 4]));
    }

    #[test]
    fn a_camera_survives_its_model() {
        for (name, params) in [
            ("PINHOLE", vec![500.0, 501.0, 320.5, 240.25]),
            (
                "OPENCV",
                vec![500.0, 501.0, 320.0, 240.0, 0.1, 0.0, 0.0, -0.2],
            ),
            (
                "OPENCV_FISHEYE",
                vec![500.0, 501.0, 320.0, 240.0, 0.0, 0.0, 0.0, 0.0],
            ),
            ("DIVISION", vec![500.0, 501.0, 320.0, 240.0, -0.3]),
        ] {
            let camera = read(name, &params).unwrap();
            let written = colmap_from_camera(&camera);
            assert_eq!((written.name, &written.params), (name, &params));
            assert_eq!(model_of_id(written.id).unwrap(), (name, params.len()));
        }
        let brown = read("SIMPLE_RADIAL", &[500.0, 320.0, 240.0, 0.1]).unwrap();
        let written = colmap_from_camera(&brown);
        assert_eq!(read(written.name, &written.params).unwrap(), brown);
    }

    #[test]
    fn other_models_are_named() {
        let of = |name, params: &[f64]| read(name, params).unwrap_err().to_string();
        assert!(of("FOV", &[1.0; 5]).starts_with("camera model FOV is not supported"));
        assert!(of("NEW", &[]).contains("NEW"));
        assert!(of("EQUIRECTANGULAR", &[640.0, 480.0]).contains("EQUIRECTANGULAR"));
        assert!(of("THIN_PRISM_FISHEYE", &[0.1; 12]).contains("only if"));
        assert_eq!(
            of("PINHOLE", &[1.0; 3]),
            "camera model PINHOLE has 4 parameters, not 3"
        );
        assert!(of("PINHOLE", &[-1.0; 4]).contains("focal length"));
        assert!(of("SIMPLE_RADIAL", &[1.0, 1.0, 1.0, f64::NAN]).contains("finite"));
        assert!(camera_from_colmap("PINHOLE", 0, 480, &[1.0; 4]).is_err());
        assert!(model_of_id(-1).is_err() && model_of_id(18).is_err());
    }
}
