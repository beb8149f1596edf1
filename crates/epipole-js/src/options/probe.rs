//! Types of option structs in TypeScript, from their serde implementations.
//!
//! A [`Probe`] deserializes no value: its error is the type that serde asks for.

use crate::types::Types;
use crate::value::camel;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, Error as _, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess, Visitor,
};
use serde::{Deserializer, Serialize};
use std::fmt::{self, Display, Formatter};

/// Declares the interface of an option struct, with defaults, and returns its name.
pub(super) fn declare<T: DeserializeOwned + Serialize + Default>(types: &mut Types) -> String {
    let name = explore::<T>(&mut Vec::new(), types);
    #[cfg(not(target_arch = "wasm32"))]
    if let Ok(serde_json::Value::Object(defaults)) = serde_json::to_value(T::default()) {
        for (field, value) in defaults {
            types.set_default(&name, &camel(&field), &literal(&value));
        }
    }
    name
}

/// Type of any value.
pub(super) fn declare_plain<T: DeserializeOwned>(types: &mut Types) -> String {
    explore::<T>(&mut Vec::new(), types)
}

/// A default in the notation of JavaScript.
#[cfg(not(target_arch = "wasm32"))]
fn literal(value: &serde_json::Value) -> String {
    use serde_json::Value as Json;
    match value {
        Json::String(text) => format!("{:?}", camel(text)),
        Json::Array(list) => {
            let list: Vec<String> = list.iter().map(literal).collect();
            format!("[{}]", list.join(", "))
        }
        Json::Object(fields) => {
            let fields = fields
                .iter()
                .map(|(key, value)| format!("{}: {}", camel(key), literal(value)));
            format!("{{ {} }}", fields.collect::<Vec<_>>().join(", "))
        }
        Json::Number(number) => number.as_f64().unwrap_or(f64::NAN).to_string(),
        other => other.to_string(),
    }
}

/// Type at a path: indices of fields and variants below `T`.
fn explore<T: DeserializeOwned>(path: &mut Vec<usize>, types: &mut Types) -> String {
    let Err(found) = T::deserialize(Probe(path)) else {
        return "unknown".to_owned();
    };
    let inner = match found.kind {
        Kind::Hint(hint) => hint.to_owned(),
        Kind::Unit => "null".to_owned(),
        Kind::Struct("", fields) => {
            let fields = fields_of::<T>(fields, path, types);
            let fields = fields.iter().map(|(name, of)| format!("{name}: {of}"));
            format!("{{ {} }}", fields.collect::<Vec<_>>().join("; "))
        }
        Kind::Struct(name, fields) => {
            let fields = fields_of::<T>(fields, path, types);
            types.options(name, &fields);
            name.to_owned()
        }
        Kind::Enum(variants) => {
            let mut texts = Vec::new();
            for (index, variant) in variants.iter().enumerate() {
                path.push(index);
                let name = camel(variant);
                texts.push(match explore::<T>(path, types).as_str() {
                    "null" => format!("{name:?}"),
                    data => format!("{{ {name}: {data} }}"),
                });
                path.pop();
            }
            texts.join(" | ")
        }
    };
    found.wraps.iter().fold(inner, |inner, wrap| match wrap {
        Wrap::Option => format!("{inner} | null"),
        Wrap::Sequence if inner == "number" => "ArrayLike<number>".to_owned(),
        Wrap::Sequence => format!("readonly ({inner})[]"),
    })
}

fn fields_of<T: DeserializeOwned>(
    fields: &[&'static str],
    path: &mut Vec<usize>,
    types: &mut Types,
) -> Vec<(String, String)> {
    let mut out = Vec::new();
    for (index, field) in fields.iter().enumerate() {
        path.push(index);
        out.push((camel(field), explore::<T>(path, types)));
        path.pop();
    }
    out
}

/// Type that serde asks for.
#[derive(Debug)]
enum Kind {
    Hint(&'static str),
    /// Variant without data.
    Unit,
    Struct(&'static str, &'static [&'static str]),
    Enum(&'static [&'static str]),
}

#[derive(Debug)]
enum Wrap {
    Option,
    Sequence,
}

/// Type with the options and sequences around it, innermost first.
#[derive(Debug)]
struct Found {
    kind: Kind,
    wraps: Vec<Wrap>,
}

impl Found {
    fn new(kind: Kind) -> Self {
        let wraps = Vec::new();
        Self { kind, wraps }
    }

    fn within(mut self, wrap: Wrap) -> Self {
        self.wraps.push(wrap);
        self
    }
}

impl Display for Found {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

impl std::error::Error for Found {}

impl de::Error for Found {
    fn custom<T: Display>(_: T) -> Self {
        Self::new(Kind::Hint("unknown"))
    }
}

/// Deserializer that follows a path and fails with the type at its end.
struct Probe<'a>(&'a [usize]);

/// Methods that fail with a hint.
macro_rules! hints {
    ($($hint:literal: $($method:ident)+;)+) => {
        $($(
            fn $method<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Found> {
                Err(Found::new(Kind::Hint($hint)))
            }
        )+)+
    };
}

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = Found;

    hints! {
        "boolean": deserialize_bool;
        "number": deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
            deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
            deserialize_f32 deserialize_f64;
        "string": deserialize_char deserialize_str deserialize_string deserialize_identifier;
        "null": deserialize_unit;
        "unknown": deserialize_bytes deserialize_byte_buf deserialize_map deserialize_any
            deserialize_ignored_any;
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Found> {
        let found = visitor.visit_some(self);
        found.map_err(|found| found.within(Wrap::Option))
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Found> {
        let found = visitor.visit_seq(self);
        found.map_err(|found| found.within(Wrap::Sequence))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Found> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Found> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Found> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Found> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Found> {
        match self.0.split_first() {
            Some((&index, path)) => visitor.visit_map(Entry(fields[index], Self(path))),
            None => Err(Found::new(Kind::Struct(name, fields))),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Found> {
        match self.0.split_first() {
            Some((&index, path)) => visitor.visit_enum(Entry(variants[index], Self(path))),
            None => Err(Found::new(Kind::Enum(variants))),
        }
    }
}

/// First element of a sequence.
impl<'de> SeqAccess<'de> for Probe<'_> {
    type Error = Found;

    fn next_element_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Found> {
        seed.deserialize(Probe(self.0)).map(Some)
    }
}

/// Field or variant, with its name.
struct Entry<'a>(&'static str, Probe<'a>);

impl<'de> MapAccess<'de> for Entry<'_> {
    type Error = Found;

    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Found> {
        seed.deserialize(self.0.into_deserializer()).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Found> {
        seed.deserialize(Probe(self.1.0))
    }
}

impl<'de, 'a> EnumAccess<'de> for Entry<'a> {
    type Error = Found;
    type Variant = Probe<'a>;

    fn variant_seed<S: DeserializeSeed<'de>>(
        self,
        seed: S,
    ) -> Result<(S::Value, Probe<'a>), Found> {
        let variant = seed.deserialize(self.0.into_deserializer())?;
        Ok((variant, self.1))
    }
}

impl<'de> VariantAccess<'de> for Probe<'_> {
    type Error = Found;

    fn unit_variant(self) -> Result<(), Found> {
        Err(Found::new(Kind::Unit))
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Found> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value, Found> {
        Err(Found::custom("data"))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Found> {
        self.deserialize_struct("", fields, visitor)
    }
}
