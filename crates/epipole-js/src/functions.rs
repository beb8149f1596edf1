//! Table of the functions of a part, with their signatures.

use crate::argument::Argument;
use crate::fault::{Fault, Result};
use crate::value::{Value, camel};
use epipole::progress::Monitor;

/// A function that JavaScript calls by name.
#[derive(Debug)]
pub struct Function {
    /// Name in Rust; JavaScript's is in camel case.
    pub name: &'static str,
    /// Reads the arguments, computes, and returns plain data.
    pub call: fn(&[Value], &mut dyn Monitor) -> Result<Value>,
}

/// Signature of a function in TypeScript.
#[derive(Debug)]
pub struct Signature {
    /// Name in JavaScript.
    pub name: String,
    /// Documentation, line by line.
    pub docs: &'static [&'static str],
    /// Names, types, and whether they are optional.
    pub parameters: Vec<(String, String, bool)>,
    /// Type of the result.
    pub result: String,
}

/// Arguments yet to be read.
pub(crate) struct Arguments<'a> {
    values: std::slice::Iter<'a, Value>,
}

impl<'a> Arguments<'a> {
    pub(crate) fn new(name: &str, most: usize, values: &'a [Value]) -> Result<Self> {
        if values.len() > most {
            return Err(Fault::of_type(format!(
                "{} takes at most {most} arguments, but is given {}",
                camel(name),
                values.len()
            )));
        }
        let values = values.iter();
        Ok(Self { values })
    }

    pub(crate) fn next<T: Argument>(&mut self, name: &str) -> Result<T> {
        T::read(&camel(name), self.values.next().unwrap_or(&Value::Nothing))
    }
}

/// Declares the functions of a file: `FUNCTIONS` and `signatures`.
///
/// The name after the semicolon is that of the monitor.
macro_rules! functions {
    ($($(#[doc = $doc:literal])+
       fn $name:ident($($arg:ident: $type:ty),* $(,)? $(; $monitor:ident)?) -> $out:ty $body:block
    )+) => {
        $(
            fn $name(
                values: &[$crate::value::Value],
                all: &mut dyn epipole::progress::Monitor,
            ) -> $crate::fault::Result<$crate::value::Value> {
                let most = [$(stringify!($arg)),*].len();
                let mut arguments = $crate::functions::Arguments::new(
                    stringify!($name), most, values,
                )?;
                $(let $arg: $type = arguments.next(stringify!($arg))?;)*
                let _ = &all;
                $(let $monitor = all;)?
                let outcome: $out = $body;
                Ok($crate::output::Output::into_value(outcome))
            }
        )+

        /// Functions of this file.
        pub(crate) const FUNCTIONS: &[$crate::functions::Function] = &[$(
            $crate::functions::Function { name: stringify!($name), call: $name },
        )+];

        /// Their signatures.
        pub(crate) fn signatures(
            types: &mut $crate::types::Types,
        ) -> Vec<$crate::functions::Signature> {
            use $crate::{output::Output, argument::Argument, value::camel};
            vec![$($crate::functions::Signature {
                name: camel(stringify!($name)),
                docs: &[$($doc),+],
                parameters: vec![$((
                    camel(stringify!($arg)),
                    <$type as Argument>::typescript(types),
                    <$type as Argument>::IS_OPTIONAL,
                )),*],
                result: <$out as Output>::typescript(types),
            }),+]
        }
    };
}
pub(crate) use functions;
