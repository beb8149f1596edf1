//! Python type hints of option structs, from their serde implementations.
//!
//! A [`Probe`] deserializes no value: its error is the type that serde asks for.

use serde::Deserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, Error as _, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess, Visitor,
};
use std::fmt::{self, Display, Formatter};

/// Fields of a struct with their type hints.
pub(super) type Fields = Vec<(&'static str, String)>;

/// Returns the type hint of `T`, and adds its structs, by name, to `structs`.
pub(super) fn hint<T: DeserializeOwned>(structs: &mut Vec<(&'static str, Fields)>) -> String {
    explore::<T>(&mut Vec::new(), structs)
}

/// Type hint at a path: indices of fields and variants below `T`.
fn explore<T: DeserializeOwned>(
    path: &mut Vec<usize>,
    structs: &mut Vec<(&'static str, Fields)>,
) -> String {
    let Err(found) = T::deserialize(Probe(path)) else {
        return "Any".to_owned();
    };
    let inner = match found.kind {
        Kind::Hint(hint) => hint.to_owned(),
        Kind::Unit => "None".to_owned(),
        Kind::Struct(name, fields) => {
            let mut hints = Fields::new();
            for (index, field) in fields.iter().enumerate() {
                path.push(index);
                hints.push((field, explore::<T>(path, structs)));
                path.pop();
            }
            structs.push((name, hints));
            name.to_owned()
        }
        Kind::Enum(variants) => {
            let mut names = Vec::new();
            for (index, variant) in variants.iter().enumerate() {
                path.push(index);
                if let Err(Found {
                    kind: Kind::Unit, ..
                }) = T::deserialize(Probe(path))
                {
                    names.push(format!("{variant:?}"));
                }
                path.pop();
            }
            let literal = format!("Literal[{}]", names.join(", "));
            match (names.len(), variants.len()) {
                (0, _) => "Mapping[str, Any]".to_owned(),
                (plain, all) if plain < all => format!("{literal} | Mapping[str, Any]"),
                _ => literal,
            }
        }
    };
    found.wraps.iter().fold(inner, |inner, wrap| match wrap {
        Wrap::Option => format!("{inner} | None"),
        Wrap::Sequence => format!("Sequence[{inner}]"),
    })
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
        Self::new(Kind::Hint("Any"))
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
        "bool": deserialize_bool;
        "int": deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
            deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64;
        "float": deserialize_f32 deserialize_f64;
        "str": deserialize_char deserialize_str deserialize_string deserialize_identifier;
        "bytes": deserialize_bytes deserialize_byte_buf;
        "None": deserialize_unit;
        "Mapping[str, Any]": deserialize_map;
        "Any": deserialize_any deserialize_ignored_any;
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

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, _: S) -> Result<S::Value, Found> {
        Err(Found::custom("data"))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value, Found> {
        Err(Found::custom("data"))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Found> {
        Err(Found::custom("data"))
    }
}
