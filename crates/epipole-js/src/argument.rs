//! Conversion of arguments to points, matrices and cameras.

use crate::fault::{Fault, Result};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform};
use epipole::nalgebra::{
    Const, Matrix3, OPoint, Quaternion, Rotation3, SMatrix, SVector, Translation3, UnitQuaternion,
};

/// Deviation of `Rᵀ R` from the identity, and of |q|² from 1, that is attributed to rounding.
const ROUNDING: f64 = 1e-6;

/// Deviation of |q|² from 1 below which a quaternion is not normalized, to keep it bit for bit.
const LAST_BITS: f64 = 1e-14;

/// A parameter of a function.
pub trait Argument: Sized {
    /// Type in TypeScript.
    fn typescript(types: &mut Types) -> String;

    /// Reads a value; errors name the argument.
    ///
    /// # Errors
    /// `TypeError` or `RangeError`.
    fn read(name: &str, value: &Value) -> Result<Self>;

    /// Whether the caller may omit it.
    const IS_OPTIONAL: bool = false;
}

/// Returns the error for an argument that is not of the expected type.
pub(crate) fn not(name: &str, expected: &str, value: &Value) -> Fault {
    let got = match value {
        Value::Nothing => "missing".to_owned(),
        other => other.describe(),
    };
    Fault::of_type(format!("{name} must be {expected}, but is {got}"))
}

impl Argument for f64 {
    fn typescript(_: &mut Types) -> String {
        "number".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        match value {
            Value::Number(number) if number.is_nan() => {
                Err(Fault::of_range(format!("{name} is NaN")))
            }
            Value::Number(number) => Ok(*number),
            _ => Err(not(name, "a number", value)),
        }
    }
}

impl Argument for u32 {
    fn typescript(_: &mut Types) -> String {
        "number".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let number = f64::read(name, value)?;
        if number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&number) {
            return Err(Fault::of_range(format!(
                "{name} must be an integer from 0 to {}, but is {number}",
                u32::MAX
            )));
        }
        Ok(number as u32)
    }
}

impl<T: Argument> Argument for Option<T> {
    const IS_OPTIONAL: bool = true;

    fn typescript(types: &mut Types) -> String {
        T::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        match value {
            Value::Nothing => Ok(None),
            _ => T::read(name, value).map(Some),
        }
    }
}

impl<T: Argument> Argument for Vec<T> {
    fn typescript(types: &mut Types) -> String {
        let element = T::typescript(types);
        match T::IS_OPTIONAL {
            true => format!("readonly ({element} | null)[]"),
            false => format!("readonly {element}[]"),
        }
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let Value::List(list) = value else {
            return Err(not(name, "an array", value));
        };
        let element = |(index, value)| T::read(&format!("{name}[{index}]"), value);
        list.iter().enumerate().map(element).collect()
    }
}

/// A list of vectors with D coordinates each.
pub struct Vectors<const D: usize>(pub Vec<SVector<f64, D>>);

impl<const D: usize> Vectors<D> {
    /// Converts the vectors to points.
    pub fn points(self) -> Vec<OPoint<f64, Const<D>>> {
        self.0.into_iter().map(OPoint::from).collect()
    }
}

impl<const D: usize> Argument for Vectors<D> {
    fn typescript(types: &mut Types) -> String {
        let name = format!("Points{D}");
        let docs = format!("Points of {D} coordinates each: interleaved, or an array of {D} each.");
        types.alias(
            &name,
            &docs,
            "ArrayLike<number> | readonly ArrayLike<number>[]",
        );
        name
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let expected = format!("numbers, {D} for each point, or an array of points");
        let numbers = flat(name, value, D, &expected)?;
        Ok(Self(
            numbers
                .chunks_exact(D)
                .map(SVector::from_column_slice)
                .collect(),
        ))
    }
}

/// N vectors with D coordinates each, for minimal solvers.
pub struct Sample<const N: usize, const D: usize>(pub [SVector<f64, D>; N]);

impl<const N: usize, const D: usize> Sample<N, D> {
    /// Converts the vectors to points.
    pub fn points(self) -> [OPoint<f64, Const<D>>; N] {
        self.0.map(OPoint::from)
    }
}

impl<const N: usize, const D: usize> Argument for Sample<N, D> {
    fn typescript(types: &mut Types) -> String {
        Vectors::<D>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let rows = Vectors::<D>::read(name, value)?.0;
        let got = rows.len();
        <[_; N]>::try_from(rows)
            .map(Self)
            .map_err(|_| Fault::of_range(format!("{name} must have {N} points, but has {got}")))
    }
}

/// Reads the numbers of an array of rows of length `width`, or of one flat array. Rejects NaN.
fn flat(name: &str, value: &Value, width: usize, expected: &str) -> Result<Vec<f64>> {
    let out = rows(name, value, width, expected)?;
    match out.iter().position(|number| number.is_nan()) {
        Some(place) => Err(Fault::of_range(format!(
            "{name} contains NaN in row {}",
            place / width
        ))),
        None => Ok(out),
    }
}

/// Reads numbers like `flat`, but accepts NaN.
pub(crate) fn rows(name: &str, value: &Value, width: usize, expected: &str) -> Result<Vec<f64>> {
    let mut out = Vec::new();
    if let Some(numbers) = value.numbers() {
        if numbers.len() % width != 0 {
            return Err(Fault::of_range(format!(
                "{name} must have {width} numbers for each row, but has {} numbers",
                numbers.len()
            )));
        }
        out.extend_from_slice(&numbers);
    } else if let Value::List(rows) = value {
        for (index, row) in rows.iter().enumerate() {
            let row_name = || format!("{name}[{index}]");
            let numbers = row
                .numbers()
                .ok_or_else(|| not(&row_name(), "an array of numbers", row))?;
            if numbers.len() != width {
                return Err(Fault::of_range(format!(
                    "{} must have {width} numbers, but has {}",
                    row_name(),
                    numbers.len()
                )));
            }
            out.extend_from_slice(&numbers);
        }
    } else {
        return Err(not(name, &format!("an array of {expected}"), value));
    }
    Ok(out)
}

/// Reads the finite numbers of a matrix, row by row. Not generic, so that matrices of all sizes
/// share one copy.
fn matrix(name: &str, value: &Value, rows: usize, columns: usize) -> Result<Vec<f64>> {
    let width = if columns == 1 { rows } else { columns };
    let numbers = flat(name, value, width, "numbers")?;
    if numbers.len() != rows * columns {
        return Err(Fault::of_range(format!(
            "{name} must have {} numbers, but has {}",
            rows * columns,
            numbers.len()
        )));
    }
    match numbers.iter().any(|number| number.is_infinite()) {
        true => Err(Fault::of_range(format!("{name} contains infinity"))),
        false => Ok(numbers),
    }
}

impl<const R: usize, const C: usize> Argument for SMatrix<f64, R, C> {
    fn typescript(types: &mut Types) -> String {
        if C == 1 {
            return "ArrayLike<number>".to_owned();
        }
        let docs = "A matrix: numbers by row, or an array of rows.";
        types.alias(
            "Matrix",
            docs,
            "ArrayLike<number> | readonly ArrayLike<number>[]",
        );
        "Matrix".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let numbers = matrix(name, value, R, C)?;
        Ok(SMatrix::from_row_slice(&numbers))
    }
}

impl<const D: usize> Argument for OPoint<f64, Const<D>> {
    fn typescript(_: &mut Types) -> String {
        "ArrayLike<number>".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        SVector::read(name, value).map(Self::from)
    }
}

/// Checks that a value is an object with known keys only.
pub(crate) fn check_keys(name: &str, value: &Value, known: &[&str]) -> Result<()> {
    let Value::Record(entries) = value else {
        return Err(not(name, "an object", value));
    };
    match entries.iter().find(|(key, _)| !known.contains(&&**key)) {
        Some((key, _)) => Err(Fault::of_type(format!(
            "{name} has no {key}; it has {}",
            known.join(", ")
        ))),
        None => Ok(()),
    }
}

/// Reads one entry of an object.
pub(crate) fn entry<T: Argument>(name: &str, value: &Value, key: &str) -> Result<T> {
    T::read(&format!("{name}.{key}"), value.get(key))
}

impl Argument for Intrinsics {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Intrinsics",
            "Pinhole intrinsics, pixels; pixel centers are at integers.",
            &[
                ("fuPx", "number", "Focal length along u."),
                ("fvPx", "number", "Focal length along v."),
                ("cuPx", "number", "Principal point, u."),
                ("cvPx", "number", "Principal point, v."),
            ],
        );
        "Intrinsics".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["fuPx", "fvPx", "cuPx", "cvPx"])?;
        let number = |key| entry::<f64>(name, value, key);
        let read = Self::new(
            number("fuPx")?,
            number("fvPx")?,
            number("cuPx")?,
            number("cvPx")?,
        );
        read.map_err(|error| Fault::of_range(format!("{name}: {error}")))
    }
}

impl Argument for Lens {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Lens",
            "A lens model with its coefficients.",
            &[
                (
                    "kind",
                    "\"brown\" | \"rational\" | \"fisheye\" | \"division\"",
                    "Model.",
                ),
                (
                    "coefficients",
                    "ArrayLike<number>",
                    "In the order of OpenCV: brown 5, rational 8, fisheye 4, division 1.",
                ),
            ],
        );
        "Lens".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["kind", "coefficients"])?;
        let kinds = [
            LensKind::Brown,
            LensKind::Rational,
            LensKind::Fisheye,
            LensKind::Division,
        ];
        let kind = kinds
            .into_iter()
            .find(|kind| *value.get("kind") == Value::Text(kind.name().to_owned()))
            .ok_or_else(|| {
                let expected = "one of brown, rational, fisheye, division";
                not(&format!("{name}.kind"), expected, value.get("kind"))
            })?;
        let coefficients = flat(
            &format!("{name}.coefficients"),
            value.get("coefficients"),
            1,
            "numbers",
        )?;
        Self::from_coefficients(kind, &coefficients)
            .map_err(|error| Fault::of_range(format!("{name}: {error}")))
    }
}

impl Argument for Camera {
    fn typescript(types: &mut Types) -> String {
        let intrinsics = Intrinsics::typescript(types);
        let lens = Lens::typescript(types);
        types.interface(
            "Camera",
            "A calibrated camera of any lens.",
            &[
                ("width", "number", "Image width, pixels."),
                ("height", "number", "Image height, pixels."),
                ("intrinsics", &intrinsics, "K."),
                ("lens?", &lens, "Without distortion if not given."),
            ],
        );
        "Camera".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["width", "height", "intrinsics", "lens"])?;
        Ok(Self {
            width: entry(name, value, "width")?,
            height: entry(name, value, "height")?,
            intrinsics: entry(name, value, "intrinsics")?,
            lens: entry::<Option<Lens>>(name, value, "lens")?.unwrap_or(Lens::NONE),
        })
    }
}

impl Argument for RigidTransform {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "RigidTransformLike",
            "A rotation, as a matrix by row or a quaternion, and a translation.",
            &[
                (
                    "rotation?",
                    "ArrayLike<number> | readonly ArrayLike<number>[]",
                    "Rotation matrix. Ignored beside a quaternion; identity if neither is given.",
                ),
                (
                    "quaternion?",
                    "ArrayLike<number>",
                    "(w, x, y, z), of length 1.",
                ),
                ("translation?", "ArrayLike<number>", "Zero if not given."),
            ],
        );
        "RigidTransformLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["rotation", "quaternion", "translation"])?;
        let rotation = match entry::<Option<SVector<f64, 4>>>(name, value, "quaternion")? {
            Some(q) => quaternion(name, &q)?,
            None => match entry::<Option<Matrix3<f64>>>(name, value, "rotation")? {
                Some(matrix) => rotation(name, matrix)?,
                None => UnitQuaternion::identity(),
            },
        };
        let translation = entry::<Option<SVector<f64, 3>>>(name, value, "translation")?;
        let translation = Translation3::from(translation.unwrap_or_default());
        Ok(Self::from_parts(translation, rotation))
    }
}

fn quaternion(name: &str, q: &SVector<f64, 4>) -> Result<UnitQuaternion<f64>> {
    let deviation = (q.norm_squared() - 1.0).abs();
    if deviation > ROUNDING {
        return Err(Fault::of_range(format!(
            "{name}.quaternion must have length 1, but has length {}",
            q.norm()
        )));
    }
    let q = Quaternion::new(q[0], q[1], q[2], q[3]);
    Ok(match deviation <= LAST_BITS {
        true => UnitQuaternion::new_unchecked(q),
        false => UnitQuaternion::new_normalize(q),
    })
}

fn rotation(name: &str, matrix: Matrix3<f64>) -> Result<UnitQuaternion<f64>> {
    let deviation = (matrix.transpose() * matrix - Matrix3::identity()).norm();
    if deviation > ROUNDING || matrix.determinant() < 0.0 {
        return Err(Fault::of_range(format!(
            "{name}.rotation must be a rotation matrix, but has determinant {} and differs from an \
             orthogonal matrix by {deviation}",
            matrix.determinant()
        )));
    }
    let matrix = Rotation3::from_matrix_unchecked(matrix);
    Ok(UnitQuaternion::from_rotation_matrix(&matrix))
}

impl Argument for PosedCamera {
    fn typescript(types: &mut Types) -> String {
        let camera = Camera::typescript(types);
        let pose = RigidTransform::typescript(types);
        types.interface(
            "PosedCameraLike",
            "A camera with its pose.",
            &[
                ("camera", &camera, "Size, intrinsics and lens."),
                ("camFromWorld", &pose, "Pose."),
            ],
        );
        "PosedCameraLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["camera", "camFromWorld"])?;
        Ok(Self {
            camera: entry(name, value, "camera")?,
            cam_from_world: entry(name, value, "camFromWorld")?,
        })
    }
}
