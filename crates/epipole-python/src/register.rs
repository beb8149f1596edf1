//! Lists of the classes and functions of a module.

/// Adds classes to a module.
macro_rules! classes {
    ($module:ident: $($class:ty),+) => {
        $($module.add_class::<$class>()?;)+
    };
}

/// Adds functions to a module.
macro_rules! functions {
    ($module:ident: $($function:path),+) => {
        $($module.add_function(wrap_pyfunction!($function, $module)?)?;)+
    };
}

pub(crate) use classes;
pub(crate) use functions;
