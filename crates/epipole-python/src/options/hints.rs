//! Python type hints of option structs.

use epipole_schema::Type;

/// Fields of a struct with their type hints.
pub(super) type Fields = Vec<(&'static str, String)>;

/// Returns the type hint of a type, and adds its structs, by name, to `structs`.
pub(super) fn hint(found: &Type, structs: &mut Vec<(&'static str, Fields)>) -> String {
    match found {
        Type::Bool => "bool".to_owned(),
        Type::Integer => "int".to_owned(),
        Type::Float => "float".to_owned(),
        Type::Text => "str".to_owned(),
        Type::Bytes => "bytes".to_owned(),
        Type::Null => "None".to_owned(),
        Type::Map => "Mapping[str, Any]".to_owned(),
        Type::Unknown => "Any".to_owned(),
        Type::Option(inner) => format!("{} | None", hint(inner, structs)),
        Type::Sequence(inner) => format!("Sequence[{}]", hint(inner, structs)),
        Type::Struct(name, fields) => {
            let fields = fields.iter();
            let hints = fields.map(|(field, inner)| (*field, hint(inner, structs)));
            let hints = hints.collect();
            structs.push((name, hints));
            (*name).to_owned()
        }
        Type::Enum(variants) => {
            let without_data = variants.iter().filter(|(_, data)| *data == Type::Null);
            let names: Vec<_> = without_data.map(|(name, _)| format!("{name:?}")).collect();
            let literal = format!("Literal[{}]", names.join(", "));
            match (names.len(), variants.len()) {
                (0, _) => "Mapping[str, Any]".to_owned(),
                (plain, all) if plain < all => format!("{literal} | Mapping[str, Any]"),
                _ => literal,
            }
        }
    }
}
