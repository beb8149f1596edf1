//! The page being rendered.

use super::page::Page;
use crate::hash::fnv;
use crate::problems::{Place, Problems};

/// A page under construction.
pub(crate) struct Writer<'a> {
    pub(crate) page: Page,
    /// Symbols of the chapter that its figures also draw.
    pub(crate) symbols: &'a [String],
    problems: &'a Problems,
    notes: usize,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(page: Page, symbols: &'a [String], problems: &'a Problems) -> Self {
        Writer {
            page,
            symbols,
            problems,
            notes: 0,
        }
    }

    /// Creates a writer for a subpage of this one.
    pub(crate) fn beside(&self, page: Page) -> Writer<'a> {
        Writer::new(page, self.symbols, self.problems)
    }

    /// Reports a problem.
    pub(crate) fn report(&self, place: Place, message: impl Into<String>) {
        self.problems.report(place, message);
    }

    /// Renders a margin note. On a narrow screen, its mark unfolds it below its line.
    pub(crate) fn note(&mut self, html: &str) -> String {
        self.notes += 1;
        let number = self.notes;
        format!(
            "<sup class=\"note-mark\"><label><input type=\"checkbox\" class=\"visually-hidden\" \
             aria-label=\"Note {number}\">{number}</label></sup><small class=\"note\" role=\"note\">\
             <sup class=\"note-number\">{number}</sup> {html}</small>"
        )
    }

    /// Adds a file to the site under `assets/`, with a hash of its content in its name. Returns its
    /// path from the root of the site.
    pub(crate) fn add_asset(&mut self, name: &str, extension: &str, bytes: Vec<u8>) -> String {
        let path = format!("assets/{name}-{:016x}.{extension}", fnv(&bytes));
        self.page.files.insert(path.clone(), bytes);
        path
    }
}
