//! The directives of the authors' notation: a file each, with its three stages, and a line of
//! [`VOCABULARY`].
//!
//! The README of this crate shows the syntax of each.

mod cite;
mod claim;
mod define;
mod figure;
mod formulas;
mod gallery;
mod glossary;
mod include;
mod listing;
mod live;
mod note;
mod operate;
mod progress;
mod quiz;
mod reference;
mod references;
mod small;
mod symbols;
mod task;
mod term;
mod value;

use crate::parse::text::Entry;
use crate::render::directive::{Parsed, entry};

/// All directives, sorted by name.
pub(crate) const VOCABULARY: &[Entry<Parsed>] = &[
    entry::<cite::Cite>(),
    entry::<claim::Claim>(),
    entry::<define::Define>(),
    entry::<operate::Do<_>>(),
    entry::<figure::Figure<_>>(),
    entry::<formulas::Formulas<_>>(),
    entry::<gallery::Gallery>(),
    entry::<glossary::Glossary<_>>(),
    entry::<include::Include>(),
    entry::<listing::Listing<_>>(),
    entry::<live::Live>(),
    entry::<note::Note>(),
    entry::<progress::Progress>(),
    entry::<quiz::Quiz<_>>(),
    entry::<reference::Reference>(),
    entry::<references::List>(),
    entry::<small::Small<_>>(),
    entry::<symbols::Symbols>(),
    entry::<task::Task<_>>(),
    entry::<term::Term>(),
    entry::<value::Value>(),
];
