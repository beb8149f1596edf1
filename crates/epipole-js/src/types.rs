//! TypeScript type declarations, collected while signatures are generated.

use std::collections::BTreeMap;

/// Declarations by name.
#[derive(Debug, Default)]
pub struct Types {
    declarations: BTreeMap<String, Declaration>,
}

#[derive(Debug)]
enum Declaration {
    Alias {
        docs: String,
        of: String,
    },
    Interface {
        head: String,
        docs: String,
        fields: Vec<Field>,
    },
}

#[derive(Debug)]
struct Field {
    name: String,
    of: String,
    docs: String,
}

impl Types {
    /// Adds an alias.
    pub fn alias(&mut self, name: &str, docs: &str, of: &str) {
        let (docs, of) = (docs.to_owned(), of.to_owned());
        let alias = Declaration::Alias { docs, of };
        self.declarations.insert(name.to_owned(), alias);
    }

    /// Adds an interface of fields: name, type, documentation.
    pub fn interface(&mut self, head: &str, docs: &str, fields: &[(&str, &str, &str)]) {
        let fields = fields.iter().map(|&(name, of, docs)| Field {
            name: name.to_owned(),
            of: of.to_owned(),
            docs: docs.to_owned(),
        });
        // The head of a generic interface includes its parameter.
        let name = head.split('<').next().unwrap_or(head);
        let interface = Declaration::Interface {
            head: head.to_owned(),
            docs: docs.to_owned(),
            fields: fields.collect(),
        };
        self.declarations.insert(name.to_owned(), interface);
    }

    /// Adds the interface of an option struct, all of whose fields are optional. An existing
    /// interface keeps its defaults.
    pub(crate) fn options(&mut self, name: &str, fields: &[(String, String)]) {
        if self.declarations.contains_key(name) {
            return;
        }
        let fields = fields.iter().map(|(name, of)| Field {
            name: format!("{name}?"),
            of: of.clone(),
            docs: String::new(),
        });
        let interface = Declaration::Interface {
            head: name.to_owned(),
            docs: String::new(),
            fields: fields.collect(),
        };
        self.declarations.insert(name.to_owned(), interface);
    }

    /// Documents the default of an option.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn set_default(&mut self, name: &str, field: &str, value: &str) {
        let field = self.field(name, field);
        if let Some(found) = field.filter(|found| found.docs.is_empty()) {
            found.docs = format!("@default {value}");
        }
    }

    /// Documents option structs and their fields with texts from `docs`, which is called without a
    /// field for the struct itself.
    pub fn document(&mut self, docs: impl Fn(&str, Option<&str>) -> Option<String>) {
        for (name, declaration) in &mut self.declarations {
            let Declaration::Interface {
                fields, docs: all, ..
            } = declaration
            else {
                continue;
            };
            if all.is_empty() {
                *all = docs(name, None).unwrap_or_default();
                for field in fields {
                    let key = field.name.trim_end_matches('?');
                    let text = docs(name, Some(key)).unwrap_or_default();
                    field.docs = format!("{text} {}", field.docs).trim().to_owned();
                }
            }
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn field(&mut self, name: &str, field: &str) -> Option<&mut Field> {
        match self.declarations.get_mut(name) {
            Some(Declaration::Interface { fields, .. }) => fields
                .iter_mut()
                .find(|found| found.name.trim_end_matches('?') == field),
            _ => None,
        }
    }

    /// Returns all declarations, sorted by name.
    pub fn text(&self) -> String {
        let mut texts = Vec::new();
        for (name, declaration) in &self.declarations {
            texts.push(match declaration {
                Declaration::Alias { docs, of } => {
                    format!("/** {docs} */\nexport type {name} = {of};\n")
                }
                Declaration::Interface { head, docs, fields } => {
                    let mut text = comment("", docs);
                    text += &format!("export interface {head} {{\n");
                    for Field { name, of, docs } in fields {
                        text += &format!("{}  {name}: {of};\n", comment("  ", docs));
                    }
                    text + "}\n"
                }
            });
        }
        texts.join("\n")
    }
}

/// Formats a documentation comment with lines of at most 110 characters; empty for an empty text.
pub fn comment(margin: &str, docs: &str) -> String {
    if docs.is_empty() {
        return String::new();
    }
    if docs.len() < 100 {
        return format!("{margin}/** {docs} */\n");
    }
    let mut text = format!("{margin}/**\n");
    let mut line = String::new();
    for word in docs.split(' ') {
        if line.len() + word.len() > 100 {
            text += &format!("{margin} *{line}\n");
            line.clear();
        }
        line += " ";
        line += word;
    }
    text + &format!("{margin} *{line}\n{margin} */\n")
}
