//! Types of option structs in TypeScript.

use crate::types::Types;
use crate::value::camel;
use epipole_schema::{Type, describe};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Declares the interface of an option struct, with defaults, and returns its name.
pub(super) fn declare<T: DeserializeOwned + Serialize + Default>(types: &mut Types) -> String {
    let name = written(&describe::<T>(), types);
    #[cfg(not(target_arch = "wasm32"))]
    if let Ok(serde_json::Value::Object(defaults)) = serde_json::to_value(T::default()) {
        for (field, value) in defaults {
            types.set_default(&name, &camel(&field), &literal(&value));
        }
    }
    name
}

/// Returns the TypeScript type of any value.
pub(super) fn declare_plain<T: DeserializeOwned>(types: &mut Types) -> String {
    written(&describe::<T>(), types)
}

/// Formats a default as a JavaScript literal.
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

/// Formats a type in TypeScript; declares the interfaces of its structs.
fn written(found: &Type, types: &mut Types) -> String {
    match found {
        Type::Bool => "boolean".to_owned(),
        Type::Integer | Type::Float => "number".to_owned(),
        Type::Text => "string".to_owned(),
        Type::Null => "null".to_owned(),
        Type::Bytes | Type::Map | Type::Unknown => "unknown".to_owned(),
        Type::Option(inner) => format!("{} | null", written(inner, types)),
        Type::Sequence(inner) => match written(inner, types).as_str() {
            "number" => "ArrayLike<number>".to_owned(),
            inner => format!("readonly ({inner})[]"),
        },
        Type::Struct(name, fields) => {
            let fields: Vec<(String, String)> = fields
                .iter()
                .map(|(field, of)| (camel(field), written(of, types)))
                .collect();
            if name.is_empty() {
                let fields = fields.iter().map(|(name, of)| format!("{name}: {of}"));
                return format!("{{ {} }}", fields.collect::<Vec<_>>().join("; "));
            }
            types.options(name, &fields);
            (*name).to_owned()
        }
        Type::Enum(variants) => {
            let variants = variants.iter().map(|(variant, data)| match data {
                Type::Null => format!("{:?}", camel(variant)),
                data => format!("{{ {}: {} }}", camel(variant), written(data, types)),
            });
            variants.collect::<Vec<_>>().join(" | ")
        }
    }
}
