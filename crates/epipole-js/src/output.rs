//! Conversion of results of the core to JavaScript values.

use crate::argument::{Argument, not};
use crate::fault::{Fault, Result};
use crate::types::Types;
use crate::value::{Key, Value};
use epipole::ArrayVec;
use epipole::camera::{Camera, Intrinsics, Lens, PosedCamera, RigidTransform};
use epipole::math::Line2;
use epipole::nalgebra::{Const, OPoint, SMatrix, SVector};
use epipole::robust::{RansacReport, StopReason};

/// A result of a function.
pub trait Output {
    /// Type in TypeScript.
    fn typescript(types: &mut Types) -> String;

    /// Converts it to plain data.
    fn into_value(self) -> Value;
}

/// Converts structs to plain objects, field by field.
macro_rules! records {
    ($($(#[doc = $docs:literal])+ $type:ty as $name:ident {
        $($(#[doc = $field_docs:literal])+ $field:ident: $field_type:ty,)+
    })+) => {$(
        impl $crate::output::Output for $type {
            fn typescript(types: &mut $crate::types::Types) -> String {
                let fields = [$((
                    $crate::value::camel(stringify!($field)),
                    <$field_type as $crate::output::Output>::typescript(types),
                    concat!($($field_docs),+).trim(),
                )),+];
                let fields = fields.each_ref().map(|(field, of, docs)| (&**field, &**of, *docs));
                types.interface(stringify!($name), concat!($($docs),+).trim(), &fields);
                stringify!($name).to_owned()
            }

            fn into_value(self) -> $crate::value::Value {
                $crate::value::Value::Record(vec![$((
                    $crate::value::camel(stringify!($field)).into(),
                    $crate::output::Output::into_value(self.$field),
                )),+])
            }
        }
    )+};
}
pub(crate) use records;

/// Declares structs, and converts them to plain objects.
#[cfg(any(feature = "geometry", feature = "images"))]
macro_rules! structs {
    ($($(#[doc = $docs:literal])+ $visible:vis struct $type:ident as $name:ident {
        $($(#[doc = $field_docs:literal])+ $field:ident: $field_type:ty,)+
    })+) => {
        $(
            $(#[doc = $docs])+
            $visible struct $type {
                $($field: $field_type,)+
            }
        )+
        $crate::output::records! {
            $($(#[doc = $docs])+ $type as $name {
                $($(#[doc = $field_docs])+ $field: $field_type,)+
            })+
        }
    };
}
#[cfg(any(feature = "geometry", feature = "images"))]
pub(crate) use structs;

/// Converts types that exist in JavaScript.
macro_rules! plain {
    ($($type:ty => $name:literal, $value:ident => $into:expr;)+) => {$(
        impl Output for $type {
            fn typescript(_: &mut Types) -> String {
                $name.to_owned()
            }

            fn into_value(self) -> Value {
                let $value = self;
                $into
            }
        }
    )+};
}

plain! {
    f64 => "number", number => Value::Number(number);
    f32 => "number", number => Value::Number(f64::from(number));
    bool => "boolean", flag => Value::Flag(flag);
    u32 => "number", number => Value::Number(f64::from(number));
    usize => "number", number => Value::Number(number as f64);
    u64 => "number", number => Value::Number(match number {
        u64::MAX => f64::INFINITY,
        number => number as f64,
    });
    StopReason => "\"confident\" | \"exhausted\" | \"interrupted\"", reason => Value::Text(match reason {
        StopReason::Confident => "confident",
        StopReason::Exhausted => "exhausted",
        StopReason::Interrupted => "interrupted",
    }.to_owned());
    Mask => "Uint8Array", mask => Value::Bytes(mask.0.into_iter().map(u8::from).collect());
    Numbers => "Float64Array", numbers => Value::Doubles(numbers.0);
    Indices => "Uint32Array", indices => {
        Value::Indices(indices.0.into_iter().map(|index| index as u32).collect())
    };
    Floats => "Float32Array", floats => Value::Floats(floats.0);
    Integers => "Int32Array", integers => Value::Integers(integers.0);
    Bytes => "Uint8Array", bytes => Value::Bytes(bytes.0);
    Text => "string", text => Value::Text(text.0);
    Line2 => "Float64Array", line => Value::Doubles(vec![line.a, line.b, line.c]);
}

/// Flags, 1 for true.
pub struct Mask(pub Vec<bool>);

/// A list of bytes.
pub struct Bytes(pub Vec<u8>);

/// A string.
pub struct Text(pub String);

/// A list of numbers.
pub struct Numbers(pub Vec<f64>);

/// A list of single-precision numbers.
pub struct Floats(pub Vec<f32>);

/// A list of signed integers.
pub struct Integers(pub Vec<i32>);

/// A list of indices below 2³².
pub struct Indices(pub Vec<usize>);

impl Argument for Indices {
    fn typescript(_: &mut Types) -> String {
        "ArrayLike<number>".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let numbers = value
            .numbers()
            .ok_or_else(|| not(name, "an array of indices", value))?;
        let wrong =
            |number: &&f64| number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(*number);
        match numbers.iter().find(wrong) {
            Some(number) => Err(Fault::of_range(format!(
                "{name} must contain integers from 0 to {}, but contains {number}",
                u32::MAX
            ))),
            None => Ok(Self(
                numbers.iter().map(|&number| number as usize).collect(),
            )),
        }
    }
}

impl Numbers {
    /// Interleaves coordinates.
    pub fn of_points<const D: usize>(points: &[OPoint<f64, Const<D>>]) -> Self {
        Self(
            points
                .iter()
                .flat_map(|point| point.iter().copied())
                .collect(),
        )
    }

    /// Interleaves coordinates, with NaN for failures.
    pub fn or_nan<const D: usize>(
        rows: impl IntoIterator<Item = epipole::Result<SVector<f64, D>>>,
    ) -> Self {
        let row = |row: epipole::Result<SVector<f64, D>>| {
            row.unwrap_or_else(|_| SVector::repeat(f64::NAN))
        };
        let rows = rows.into_iter().map(row);
        Self(rows.flat_map(|row| row.as_slice().to_vec()).collect())
    }
}

impl<const R: usize, const C: usize> Output for SMatrix<f64, R, C> {
    fn typescript(_: &mut Types) -> String {
        "Float64Array".to_owned()
    }

    fn into_value(self) -> Value {
        let by_row = (0..R).flat_map(|row| (0..C).map(move |column| (row, column)));
        Value::Doubles(by_row.map(|place| self[place]).collect())
    }
}

impl<const D: usize> Output for OPoint<f64, Const<D>> {
    fn typescript(_: &mut Types) -> String {
        "Float64Array".to_owned()
    }

    fn into_value(self) -> Value {
        self.coords.into_value()
    }
}

impl<const N: usize> Output for [f64; N] {
    fn typescript(_: &mut Types) -> String {
        "Float64Array".to_owned()
    }

    fn into_value(self) -> Value {
        Value::Doubles(self.to_vec())
    }
}

impl<const N: usize, const D: usize> Output for [OPoint<f64, Const<D>>; N] {
    fn typescript(_: &mut Types) -> String {
        "Float64Array".to_owned()
    }

    fn into_value(self) -> Value {
        Numbers::of_points(&self).into_value()
    }
}

impl<T: Output> Output for Option<T> {
    fn typescript(types: &mut Types) -> String {
        format!("{} | null", T::typescript(types))
    }

    fn into_value(self) -> Value {
        self.map_or(Value::Nothing, T::into_value)
    }
}

impl<T: Output> Output for Vec<T> {
    fn typescript(types: &mut Types) -> String {
        let element = T::typescript(types);
        match element.contains(" | ") {
            true => format!("({element})[]"),
            false => format!("{element}[]"),
        }
    }

    fn into_value(self) -> Value {
        Value::List(self.into_iter().map(T::into_value).collect())
    }
}

impl<T: Output, const N: usize> Output for ArrayVec<T, N> {
    fn typescript(types: &mut Types) -> String {
        Vec::<T>::typescript(types)
    }

    fn into_value(self) -> Value {
        Value::List(self.into_iter().map(T::into_value).collect())
    }
}

fn record<const N: usize>(entries: [(&'static str, Value); N]) -> Value {
    let entries = entries.map(|(key, value)| (Key::from(key), value));
    Value::Record(entries.into())
}

impl Output for RigidTransform {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "RigidTransform",
            "Rotation and translation: `x_in_a = a_from_b * x_in_b`.",
            &[
                (
                    "rotation",
                    "Float64Array",
                    "Rotation matrix, 9 numbers by row.",
                ),
                (
                    "quaternion",
                    "Float64Array",
                    "The same rotation as (w, x, y, z).",
                ),
                ("translation", "Float64Array", "3 numbers."),
            ],
        );
        "RigidTransform".to_owned()
    }

    fn into_value(self) -> Value {
        let q = self.rotation.quaternion();
        record([
            (
                "rotation",
                self.rotation.to_rotation_matrix().into_inner().into_value(),
            ),
            ("quaternion", Value::Doubles(vec![q.w, q.i, q.j, q.k])),
            ("translation", self.translation.vector.into_value()),
        ])
    }
}

impl Output for Intrinsics {
    fn typescript(types: &mut Types) -> String {
        <Self as Argument>::typescript(types)
    }

    fn into_value(self) -> Value {
        let principal = self.principal_point();
        record([
            ("fuPx", self.fu_px().into_value()),
            ("fvPx", self.fv_px().into_value()),
            ("cuPx", principal.x.into_value()),
            ("cvPx", principal.y.into_value()),
        ])
    }
}

impl Output for Lens {
    fn typescript(types: &mut Types) -> String {
        <Self as Argument>::typescript(types)
    }

    fn into_value(self) -> Value {
        record([
            ("kind", Value::Text(self.kind().name().to_owned())),
            ("coefficients", Value::Doubles(self.coefficients())),
        ])
    }
}

impl Output for Camera {
    fn typescript(types: &mut Types) -> String {
        <Self as Argument>::typescript(types)
    }

    fn into_value(self) -> Value {
        record([
            ("width", self.width.into_value()),
            ("height", self.height.into_value()),
            ("intrinsics", self.intrinsics.into_value()),
            ("lens", self.lens.into_value()),
        ])
    }
}

records! {
    /// A camera with its pose.
    PosedCamera as PosedCamera {
        /// Size, intrinsics and lens.
        camera: Camera,
        /// Pose.
        cam_from_world: RigidTransform,
    }
}

impl<M: Output> Output for RansacReport<M> {
    fn typescript(types: &mut Types) -> String {
        let stop = StopReason::typescript(types);
        types.interface(
            "RansacReport<M>",
            "Result of a robust estimation.",
            &[
                ("model", "M", "Best model, refined from its inliers."),
                (
                    "inliers",
                    "Uint8Array",
                    "1 for each datum within the threshold, otherwise 0.",
                ),
                ("numInliers", "number", "Number of inliers."),
                (
                    "numUniqueInliers",
                    "number",
                    "The same, equal data counted once.",
                ),
                (
                    "numLeftOut",
                    "number",
                    "Data with infinite or huge coordinates, no inliers.",
                ),
                ("iterations", "number", "Samples drawn."),
                (
                    "requiredIterations",
                    "number",
                    "Samples required by the inlier ratio; Infinity if no number is enough.",
                ),
                ("maxErrorPx", "number", "Threshold of an inlier, pixels."),
                ("score", "number", "Score of the model."),
                (
                    "log10FalseAlarms",
                    "number | null",
                    "Expected number of such models in random data, as a decimal logarithm.",
                ),
                ("refinements", "number", "Local optimizations."),
                ("stop", &stop, "Reason for the end of the loop."),
                (
                    "couldBeRandom",
                    "boolean",
                    "Whether random data might show as much support.",
                ),
            ],
        );
        format!("RansacReport<{}>", M::typescript(types))
    }

    fn into_value(self) -> Value {
        let could_be_random = self.could_be_random();
        record([
            ("model", self.model.into_value()),
            ("inliers", Mask(self.inliers).into_value()),
            ("numInliers", self.num_inliers.into_value()),
            ("numUniqueInliers", self.num_unique_inliers.into_value()),
            ("numLeftOut", self.num_left_out.into_value()),
            ("iterations", self.iterations.into_value()),
            ("requiredIterations", self.required_iterations.into_value()),
            ("maxErrorPx", self.max_error_px.into_value()),
            ("score", self.score.into_value()),
            ("log10FalseAlarms", self.log10_false_alarms.into_value()),
            ("refinements", self.refinements.into_value()),
            ("stop", self.stop.into_value()),
            ("couldBeRandom", could_be_random.into_value()),
        ])
    }
}
