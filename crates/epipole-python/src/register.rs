//! Registration of classes and functions in a module.

/// Adds classes to a module, listed by file if it has several.
macro_rules! classes {
    ($module:ident: $($file:ident::{$($class:ident),+}),+) => {
        $($($module.add_class::<$file::$class>()?;)+)+
    };
    ($module:ident: $($class:ty),+) => {
        $($module.add_class::<$class>()?;)+
    };
}

/// Adds functions to a module, listed by file if it has several.
macro_rules! functions {
    ($module:ident: $($file:ident::{$($function:ident),+}),+) => {
        $($($module.add_function(wrap_pyfunction!($file::$function, $module)?)?;)+)+
    };
    ($module:ident: $($function:path),+) => {
        $($module.add_function(wrap_pyfunction!($function, $module)?)?;)+
    };
}

pub(crate) use classes;
pub(crate) use functions;
