//! `repr`, equality, pickling and display of classes, from the names of their attributes.

use numpy::PyUntypedArray;
use numpy::prelude::*;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString, PyTuple};

/// Number of characters above which a `repr` shortens an array.
const MAX_REPR: usize = 120;
/// Number of elements above which a `repr` shows only the length of a list.
const MAX_LIST: usize = 3;

/// `Class(a=1, b=<float64 array of shape (100, 2)>, c=<list of 20>)`.
pub(crate) fn repr(object: &Bound<'_, PyAny>, fields: &[&str]) -> PyResult<String> {
    let mut parts = Vec::new();
    for field in fields {
        parts.push(format!("{field}={}", brief(&object.getattr(*field)?)?));
    }
    let class = object.get_type().name()?;
    Ok(format!("{class}({})", parts.join(", ")))
}

/// Returns a table of the attributes for notebooks, below a plot if `epipole.plot` has one.
pub(crate) fn html(object: &Bound<'_, PyAny>, fields: &[&str]) -> PyResult<String> {
    let escape = object.py().import("html")?.getattr("escape")?;
    let mut rows = String::new();
    for field in fields {
        let text = escape.call1((brief(&object.getattr(*field)?)?,))?;
        rows += &format!("<tr><th>{field}</th><td><code>{text}</code></td></tr>");
    }
    let class = object.get_type().name()?;
    let plot = object.py().import("epipole.plot")?;
    let picture: String = plot.call_method1("_html_picture", (object,))?.extract()?;
    Ok(format!(
        "{picture}<table><caption>{class}</caption>{rows}</table>"
    ))
}

/// Returns one attribute of a `repr`.
fn brief(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(list) = value.cast::<PyList>()
        && list.len() > MAX_LIST
    {
        return Ok(format!("<list of {}>", list.len()));
    }
    let Ok(array) = value.cast::<PyUntypedArray>() else {
        return Ok(value.repr()?.to_string());
    };
    if array.len() <= MAX_REPR {
        let text = value.call_method0("tolist")?.repr()?.to_string();
        if text.chars().count() <= MAX_REPR {
            return Ok(text);
        }
    }
    let kind: String = array.dtype().getattr("name")?.extract()?;
    let shape = PyTuple::new(value.py(), array.shape())?.repr()?;
    if kind == "bool" {
        let count = value.call_method0("sum")?;
        return Ok(format!("<bool array of shape {shape}, {count} true>"));
    }
    Ok(format!("<{kind} array of shape {shape}>"))
}

/// Returns whether two objects have the same class and equal attributes, comparing arrays by
/// element. NaN equals NaN: it marks missing values.
pub(crate) fn equal(
    object: &Bound<'_, PyAny>,
    other: &Bound<'_, PyAny>,
    fields: &[&str],
) -> PyResult<bool> {
    if !object.get_type().is(other.get_type()) {
        return Ok(false);
    }
    for field in fields {
        let (a, b) = (object.getattr(*field)?, other.getattr(*field)?);
        let is_equal = if a.is_instance_of::<PyUntypedArray>() {
            let numpy = object.py().import("numpy")?;
            numpy.call_method1("array_equal", (a, b, true))?.extract()?
        } else {
            a.eq(b)?
        };
        if !is_equal {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Class and arguments that recreate an object.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// Returns the class and arguments that recreate the object, for pickling and copying.
pub(crate) fn reduce<'py>(object: &Bound<'py, PyAny>, fields: &[&str]) -> PyResult<Reduced<'py>> {
    let names = fields.iter().map(|field| PyString::new(object.py(), field));
    let values: PyResult<Vec<_>> = names.map(|name| object.getattr(name)).collect();
    let arguments = PyTuple::new(object.py(), values?)?;
    Ok((object.get_type().into_any(), arguments))
}

/// Implements `__repr__`, `_repr_html_` and `__reduce__` for a class. Its constructor takes these
/// attributes.
macro_rules! shown_class {
    ($class:ident: $($field:ident),+) => {
        #[pymethods]
        impl $class {
            fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
                $crate::record::repr(slf, &[$(stringify!($field)),+])
            }

            fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
                $crate::record::html(slf, &[$(stringify!($field)),+])
            }

            fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<$crate::record::Reduced<'py>> {
                $crate::record::reduce(slf, &[$(stringify!($field)),+])
            }
        }
    };
}

/// Implements everything of `shown_class`, and `__eq__` by the attributes.
macro_rules! plain_class {
    ($class:ident: $($field:ident),+) => {
        $crate::record::shown_class!($class: $($field),+);

        #[pymethods]
        impl $class {
            fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
                $crate::record::equal(slf, other, &[$(stringify!($field)),+])
            }
        }
    };
}

/// Implements `__len__`: the number of rows of an attribute.
macro_rules! rows {
    ($class:ident: $field:ident) => {
        #[pymethods]
        impl $class {
            fn __len__(&self, py: Python<'_>) -> usize {
                self.$field.bind(py).shape()[0]
            }
        }
    };
}

/// Defines a class of named attributes: constructor, getters, and everything of `plain_class`. Its
/// docstring lists them as parameters of the constructor.
macro_rules! record {
    (
        $(#[doc = $doc:literal])*
        $module:literal $class:ident {
            $($(#[doc = $field_doc:literal])* $field:ident: $type:ty,)+
        }
    ) => {
        $(#[doc = $doc])*
        ///
        /// Parameters
        /// ----------
        $(
            #[doc = stringify!($field)]
            $(#[doc = concat!("   ", $field_doc)])*
        )+
        #[pyclass(frozen, get_all, module = $module)]
        pub(crate) struct $class {
            $($(#[doc = $field_doc])* pub(crate) $field: $type,)+
        }

        #[pymethods]
        impl $class {
            #[new]
            #[allow(clippy::too_many_arguments)]
            fn new($($field: $type),+) -> Self {
                Self { $($field),+ }
            }
        }

        $crate::record::plain_class!($class: $($field),+);
    };
}

pub(crate) use plain_class;
pub(crate) use record;
pub(crate) use rows;
pub(crate) use shown_class;
