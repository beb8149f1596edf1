//! Types of structs and enums as data, derived from their serde implementations.
//!
//! ```
//! use epipole_schema::{Type, describe};
//! #[derive(serde::Deserialize)]
//! struct Options {
//!     seed: u64,
//!     limit_px: Option<f64>,
//! }
//! let limit = Type::Option(Box::new(Type::Float));
//! let fields = vec![("seed", Type::Integer), ("limit_px", limit)];
//! let options = Type::Struct("Options", fields);
//! assert_eq!(describe::<Options>(), options);
//! // Fields of a struct in a list are no lists themselves.
//! assert_eq!(describe::<Vec<Options>>(), Type::Sequence(Box::new(options)));
//! ```

use serde::Deserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, Error as _, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess, Visitor,
};
use std::fmt::{self, Display, Formatter};

/// Type of a value as serde deserializes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Type {
    /// `bool`.
    Bool,
    /// Integer of any size.
    Integer,
    /// `f32` or `f64`.
    Float,
    /// String or character.
    Text,
    /// Bytes.
    Bytes,
    /// Unit.
    Null,
    /// Map with keys of any kind.
    Map,
    /// Type that describes itself, or whose deserialization fails.
    Unknown,
    /// Optional value.
    Option(Box<Type>),
    /// Sequence or tuple, by the type of its first element.
    Sequence(Box<Type>),
    /// Struct with its name and fields; the name of a variant with fields is empty.
    Struct(&'static str, Vec<(&'static str, Type)>),
    /// Enum with its variants and their data, [`Type::Null`] for none.
    Enum(Vec<(&'static str, Type)>),
}

/// Describes a type.
///
/// Reads no value: a deserializer follows each path of fields and variants, and fails with the type
/// requested there.
pub fn describe<T: DeserializeOwned>() -> Type {
    explore::<T>(&mut Vec::new())
}

/// Explores the type at a path, given as indices of fields and variants below `T`.
fn explore<T: DeserializeOwned>(path: &mut Vec<usize>) -> Type {
    let Err(found) = T::deserialize(Probe(path)) else {
        return Type::Unknown;
    };
    let mut each = |names: &[&'static str]| {
        let names = names.iter().enumerate();
        names
            .map(|(index, name)| {
                path.push(index);
                let inner = explore::<T>(path);
                path.pop();
                (*name, inner)
            })
            .collect()
    };
    let inner = match found.kind {
        Kind::Plain(plain) => plain,
        Kind::Struct(name, fields) => Type::Struct(name, each(fields)),
        Kind::Enum(variants) => Type::Enum(each(variants)),
    };
    found.wraps.iter().fold(inner, |inner, wrap| match wrap {
        Wrap::Option => Type::Option(Box::new(inner)),
        Wrap::Sequence => Type::Sequence(Box::new(inner)),
    })
}

/// Type requested by serde.
#[derive(Debug)]
enum Kind {
    Plain(Type),
    Struct(&'static str, &'static [&'static str]),
    Enum(&'static [&'static str]),
}

#[derive(Debug)]
enum Wrap {
    Option,
    Sequence,
}

/// Type with the enclosing options and sequences, innermost first.
#[derive(Debug)]
struct Found {
    kind: Kind,
    wraps: Vec<Wrap>,
    /// Whether it is a field or variant, in which case options and sequences around its struct do
    /// not belong to it.
    is_part: bool,
}

impl Found {
    fn new(kind: Kind) -> Self {
        Self {
            kind,
            wraps: Vec::new(),
            is_part: false,
        }
    }

    fn within(mut self, wrap: Wrap) -> Self {
        if !self.is_part {
            self.wraps.push(wrap);
        }
        self
    }

    fn part(mut self) -> Self {
        self.is_part = true;
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
        Self::new(Kind::Plain(Type::Unknown))
    }
}

/// Deserializer that follows a path and fails with the type at its end.
struct Probe<'a>(&'a [usize]);

/// Methods that fail with a type.
macro_rules! plain {
    ($($plain:ident: $($method:ident)+;)+) => {
        $($(
            fn $method<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Found> {
                Err(Found::new(Kind::Plain(Type::$plain)))
            }
        )+)+
    };
}

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = Found;

    plain! {
        Bool: deserialize_bool;
        Integer: deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
            deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64;
        Float: deserialize_f32 deserialize_f64;
        Text: deserialize_char deserialize_str deserialize_string deserialize_identifier;
        Bytes: deserialize_bytes deserialize_byte_buf;
        Null: deserialize_unit;
        Map: deserialize_map;
        Unknown: deserialize_any deserialize_ignored_any;
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
            Some((&index, path)) => {
                let found = visitor.visit_map(Entry(fields[index], Self(path)));
                found.map_err(Found::part)
            }
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
            Some((&index, path)) => {
                let found = visitor.visit_enum(Entry(variants[index], Self(path)));
                found.map_err(Found::part)
            }
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
        Err(Found::new(Kind::Plain(Type::Null)))
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
