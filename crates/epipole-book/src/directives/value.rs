//! `{{#value ransac.trials s=2 w=0.5 p=0.99}}`: a number computed by the core, also inside
//! formulas.

use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::numbers;

/// A number by its name and parameters.
pub(super) struct Value {
    name: String,
    settings: Vec<(String, String)>,
}

impl Directive for Value {
    const NAME: &'static str = "value";
    type Resolved = String;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        Ok(Value {
            name: request.one_word("name key=value …")?.to_owned(),
            settings: request.call.settings.clone(),
        })
    }

    fn resolve(self, _: &Book) -> Result<String, String> {
        numbers::print(&self.name, &self.settings)
    }

    fn render(printed: String, _: &mut Writer) -> Insert {
        Insert::Value(printed)
    }
}
