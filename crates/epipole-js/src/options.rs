//! Options: conversion of plain objects to structs of the core, by serde.
//!
//! Missing fields take the core's defaults. Keys and variants are in camel case.

mod typescript;

use crate::argument::{Argument, not};
use crate::fault::{Fault, Result};
use crate::types::Types;
use crate::value::{Key, Value, camel};
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, Expected, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::{Deserializer, Serialize};
use std::fmt::Display;

/// A struct with defaults, as the last parameter of a function.
pub struct Options<T>(pub T);

impl<T: DeserializeOwned + Serialize + Default> Argument for Options<T> {
    const IS_OPTIONAL: bool = true;

    fn typescript(types: &mut Types) -> String {
        typescript::declare::<T>(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        match value {
            Value::Nothing => Ok(Self(T::default())),
            _ => T::deserialize(At { value, name }).map(Self),
        }
    }
}

/// Options of a function that takes only those of control.
pub struct NoOptions;

impl Argument for NoOptions {
    const IS_OPTIONAL: bool = true;

    fn typescript(_: &mut Types) -> String {
        "Control".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        match value {
            Value::Nothing => Ok(Self),
            Value::Record(entries) => match entries.first() {
                None => Ok(Self),
                Some((key, _)) => Err(Fault::of_type(format!(
                    "{name} has no {key}; it has signal, progress"
                ))),
            },
            _ => Err(not(name, "an object", value)),
        }
    }
}

/// One value by serde, such as a robust loss.
pub struct Setting<T>(pub T);

impl<T: DeserializeOwned> Argument for Setting<T> {
    fn typescript(types: &mut Types) -> String {
        typescript::declare_plain::<T>(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        T::deserialize(At { value, name }).map(Self)
    }
}

impl de::Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Self::of_type(message.to_string())
    }

    // Serde's own message would add the code that prints values to every module.
    fn invalid_type(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::of_type(format!("an option must be {expected}"))
    }

    fn invalid_value(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::of_type(format!("an option must be {expected}"))
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::of_range(format!(
            "an option must be {expected}, but has length {length}"
        ))
    }

    fn unknown_variant(variant: &str, _: &'static [&'static str]) -> Self {
        Self::of_type(format!("there is no choice {variant}"))
    }

    fn unknown_field(field: &str, _: &'static [&'static str]) -> Self {
        Self::of_type(format!("there is no option {field}"))
    }
}

/// A value with its name.
#[derive(Clone, Copy)]
struct At<'a> {
    value: &'a Value,
    name: &'a str,
}

impl At<'_> {
    fn integer<T: TryFrom<i64>>(self, range: &str) -> Result<T> {
        let number = f64::read(self.name, self.value)?;
        // Above 2⁵³ integers are not exact.
        let is_exact = number.fract() == 0.0 && number.abs() <= 9_007_199_254_740_992.0;
        is_exact
            .then_some(number as i64)
            .and_then(|number| T::try_from(number).ok())
            .ok_or_else(|| {
                Fault::of_range(format!(
                    "{} must be an integer {range}, but is {number}",
                    self.name
                ))
            })
    }

    fn not(self, expected: &str) -> Fault {
        not(self.name, expected, self.value)
    }
}

macro_rules! integers {
    ($($method:ident $visit:ident $range:literal;)+) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            visitor.$visit(self.integer($range)?)
        }
    )+};
}

impl<'de> Deserializer<'de> for At<'_> {
    type Error = Fault;

    integers! {
        deserialize_i8 visit_i8 "from -128 to 127";
        deserialize_i16 visit_i16 "from -32768 to 32767";
        deserialize_i32 visit_i32 "of 32 bits";
        deserialize_i64 visit_i64 "up to 2^53";
        deserialize_u8 visit_u8 "from 0 to 255";
        deserialize_u16 visit_u16 "from 0 to 65535";
        deserialize_u32 visit_u32 "from 0 to 2^32 - 1";
        deserialize_u64 visit_u64 "from 0 to 2^53";
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value> {
        Err(self.not("of a known type"))
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match self.value {
            Value::Flag(flag) => visitor.visit_bool(*flag),
            _ => Err(self.not("true or false")),
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_f64(f64::read(self.name, self.value)?)
    }

    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_f32(f64::read(self.name, self.value)? as f32)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match self.value {
            Value::Text(text) => visitor.visit_str(text),
            _ => Err(self.not("a string")),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match self.value {
            Value::Nothing => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        let list = match self.value {
            Value::List(list) => list.clone(),
            _ => {
                let numbers = self.value.numbers();
                let numbers = numbers.ok_or_else(|| self.not("an array"))?;
                numbers
                    .iter()
                    .map(|&number| Value::Number(number))
                    .collect()
            }
        };
        visitor.visit_seq(Elements {
            list: list.into_iter(),
            name: self.name,
            index: 0,
        })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value> {
        let got = match self.value {
            Value::List(list) => Some(list.len()),
            _ => self.value.numbers().map(|numbers| numbers.len()),
        };
        match got {
            Some(got) if got != length => Err(Fault::of_range(format!(
                "{} must have {length} elements, but has {got}",
                self.name
            ))),
            _ => self.deserialize_seq(visitor),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        let Value::Record(entries) = self.value else {
            return Err(self.not("an object"));
        };
        for (key, _) in entries {
            if !fields.iter().any(|field| camel(field) == **key) {
                let known: Vec<String> = fields.iter().map(|field| camel(field)).collect();
                return Err(Fault::of_type(format!(
                    "{} has no {key}; it has {}",
                    self.name,
                    known.join(", ")
                )));
            }
        }
        visitor.visit_map(Fields {
            fields,
            entries,
            value: None,
            name: self.name,
        })
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        let (variant, value) = match self.value {
            Value::Text(text) => (text.as_str(), &Value::Nothing),
            Value::Record(entries) if entries.len() == 1 => (&*entries[0].0, &entries[0].1),
            _ => ("", &Value::Nothing),
        };
        let Some(&found) = variants.iter().find(|known| camel(known) == variant) else {
            let known: Vec<String> = variants.iter().map(|variant| camel(variant)).collect();
            return Err(self.not(&format!("one of {}", known.join(", "))));
        };
        let name = match value {
            Value::Nothing => self.name.to_owned(),
            _ => format!("{}.{variant}", self.name),
        };
        visitor.visit_enum(Variant {
            variant: found,
            value,
            name,
        })
    }

    serde::forward_to_deserialize_any! {
        char string bytes byte_buf unit unit_struct tuple_struct map identifier ignored_any
    }
}

/// Elements of an array.
struct Elements<'a> {
    list: std::vec::IntoIter<Value>,
    name: &'a str,
    index: usize,
}

impl<'de> SeqAccess<'de> for Elements<'_> {
    type Error = Fault;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        let Some(value) = self.list.next() else {
            return Ok(None);
        };
        let name = format!("{}[{}]", self.name, self.index);
        self.index += 1;
        let at = At {
            value: &value,
            name: &name,
        };
        seed.deserialize(at).map(Some)
    }
}

/// Remaining entries of an object.
struct Fields<'a> {
    fields: &'static [&'static str],
    entries: &'a [(Key, Value)],
    value: Option<&'a (Key, Value)>,
    name: &'a str,
}

impl<'de> MapAccess<'de> for Fields<'_> {
    type Error = Fault;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        while let Some((first, rest)) = self.entries.split_first() {
            self.entries = rest;
            let mut fields = self.fields.iter();
            if let Some(&field) = fields.find(|field| camel(field) == first.0) {
                self.value = Some(first);
                return seed.deserialize(field.into_deserializer()).map(Some);
            }
        }
        Ok(None)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value> {
        let (key, value) = self
            .value
            .take()
            .ok_or_else(|| Fault::of_type(format!("{} has a value without a key", self.name)))?;
        let name = format!("{}.{key}", self.name);
        let name = &name;
        seed.deserialize(At { value, name })
    }
}

/// A variant, with its data.
struct Variant<'a> {
    variant: &'static str,
    value: &'a Value,
    name: String,
}

impl<'de> EnumAccess<'de> for Variant<'_> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self)> {
        let name: StrDeserializer<'_, Fault> = self.variant.into_deserializer();
        let variant = seed.deserialize(name)?;
        Ok((variant, self))
    }
}

impl<'a> Variant<'a> {
    fn at(&'a self) -> At<'a> {
        At {
            value: self.value,
            name: &self.name,
        }
    }
}

impl<'de> VariantAccess<'de> for Variant<'_> {
    type Error = Fault;

    fn unit_variant(self) -> Result<()> {
        match self.value {
            Value::Nothing => Ok(()),
            _ => Err(self.at().not("without data")),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value> {
        seed.deserialize(self.at())
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value> {
        self.at().deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        self.at().deserialize_struct("", fields, visitor)
    }
}
