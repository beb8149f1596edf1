//! Structure tensor of a window, and its change when shifted.

use crate::argument::{Argument, Vectors, entry, not};
use crate::fault::Result;
use crate::functions::functions;
use crate::images::Gray;
use crate::options::{Options, Setting};
use crate::output::{Numbers, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::feature::{self, StructureTensorOptions, WindowTensor};
use epipole::imaging::Border;

structs! {
    /// Change of a window under every shift by whole pixels up to a reach.
    struct ShiftSurface as ShiftSurface {
        /// Largest shift to each side, pixels.
        reach: usize,
        /// Squared change under the shift (du, dv) at `(reach + dv) (2 reach + 1) + reach + du`.
        values: Numbers,
    }
}

/// Matrix `sum [[Iu Iu, Iu Iv], [Iu Iv, Iv Iv]]` of one window.
struct Window(WindowTensor);

impl Output for Window {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "WindowTensor",
            "Structure tensor of one window, and what follows from it.",
            &[
                ("uu", "number", "Sum of Iu Iu."),
                ("uv", "number", "Sum of Iu Iv."),
                ("vv", "number", "Sum of Iv Iv."),
                ("determinant", "number", "Product of the eigenvalues."),
                ("trace", "number", "Sum of the eigenvalues."),
                ("eigenvalues", "Float64Array", "The larger first."),
                (
                    "directionRad",
                    "number",
                    "Direction of the larger one's eigenvector, atan2(v, u), radians.",
                ),
            ],
        );
        "WindowTensor".to_owned()
    }

    fn into_value(self) -> Value {
        let Self(tensor) = self;
        let (larger, smaller) = tensor.eigenvalues();
        Value::Record(vec![
            ("uu".into(), tensor.uu.into_value()),
            ("uv".into(), tensor.uv.into_value()),
            ("vv".into(), tensor.vv.into_value()),
            ("determinant".into(), tensor.determinant().into_value()),
            ("trace".into(), tensor.trace().into_value()),
            ("eigenvalues".into(), [larger, smaller].into_value()),
            ("directionRad".into(), tensor.direction_rad().into_value()),
        ])
    }
}

impl Argument for Window {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "WindowTensorLike",
            "Structure tensor of one window.",
            &[
                ("uu", "number", "Sum of Iu Iu."),
                ("uv", "number", "Sum of Iu Iv."),
                ("vv", "number", "Sum of Iv Iv."),
            ],
        );
        "WindowTensorLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let Value::Record(_) = value else {
            return Err(not(name, "an object with uu, uv and vv", value));
        };
        Ok(Self(WindowTensor {
            uu: entry(name, value, "uu")?,
            uv: entry(name, value, "uv")?,
            vv: entry(name, value, "vv")?,
        }))
    }
}

functions! {
    /// Structure tensor of the window around a pixel of an image.
    fn window_tensor(
        image: Gray, u: u32, v: u32, options: Options<StructureTensorOptions>
    ) -> Window {
        Window(WindowTensor::at(&image.0, (u, v), &options.0)?)
    }

    /// Structure tensor of a window from the gradients (Iu, Iv) of its pixels.
    fn window_tensor_from_gradients(gradients: Vectors<2>) -> Window {
        Window(WindowTensor::from_gradients(&gradients.0))
    }

    /// Corner response of Harris of a window, `determinant - k trace^2`, with k such as 0.05.
    fn window_harris(tensor: Window, k: f64) -> f64 {
        tensor.0.harris(k)
    }

    /// Squared change of a window of `2 halfWindow + 1` pixels around (u, v), when it is shifted by
    /// up to `reach` pixels to each side. A constant border has the unit of the values.
    fn shift_surface(
        image: Gray, u: u32, v: u32, half_window: u32, reach: u32,
        border: Option<Setting<Border>>
    ) -> ShiftSurface {
        let border = border.map_or(Border::default(), |border| border.0);
        let (half, reach) = (half_window as usize, reach as usize);
        let surface = feature::shift_surface(&image.0, (u, v), half, reach, border)?;
        let shifts = || -(reach as i32)..=reach as i32;
        let rows = shifts().flat_map(|dv| shifts().map(move |du| (du, dv)));
        let values = rows.filter_map(|(du, dv)| surface.at(du, dv)).collect();
        ShiftSurface { reach, values: Numbers(values) }
    }
}
