//! Data shared by the chapters of a build: figures, their posters and facts, and references.

use super::cache::Cache;
use super::facts::Facts;
use super::figures::{Gallery, Room};
use super::posters::{self, Posters};
use super::references::References;
use crate::parse::content::Content;
use crate::problems::Problems;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

type Settings = [(String, String)];

/// A figure in a state.
type State = (String, Vec<(String, String)>);

/// The data for all directives, shared by several threads.
pub(crate) struct Book<'a> {
    pub(crate) problems: &'a Problems,
    pub(crate) gallery: &'a dyn Gallery,
    pub(crate) references: References,
    cache: Cache,
    /// Whether posters are drawn: not by a check of the content.
    draws_posters: bool,
    facts: Mutex<BTreeMap<State, Arc<Facts>>>,
}

impl<'a> Book<'a> {
    pub(crate) fn new(
        content: &Content,
        gallery: &'a dyn Gallery,
        cache: Cache,
        draws_posters: bool,
        problems: &'a Problems,
    ) -> Self {
        let references = content.read("references.toml");
        let references = references.map(|source| References::parse(&source, problems));
        Book {
            problems,
            gallery,
            references: references.unwrap_or_default(),
            cache,
            draws_posters,
            facts: Mutex::default(),
        }
    }

    /// Facts of a figure in a state, after its computations.
    ///
    /// # Errors
    /// A sentence that names the figure.
    pub(crate) fn facts(&self, name: &str, settings: &Settings) -> Result<Arc<Facts>, String> {
        let key = (name.to_owned(), settings.to_vec());
        let lock = || self.facts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&key) {
            return Ok(known.clone());
        }
        let of_figure = |error| format!("figure {name}: {error}");
        let figure = self.gallery.open(name, settings).map_err(of_figure)?;
        let make = || {
            let snapshot = figure.snapshot()?;
            Ok((Facts::parse(&snapshot)?, snapshot.into_bytes()))
        };
        let read = |kept: &[u8]| Facts::parse(std::str::from_utf8(kept).ok()?).ok();
        let facts = self.cache.get_or((name, settings, "facts"), read, make);
        let facts = Arc::new(facts.map_err(of_figure)?);
        lock().insert(key, facts.clone());
        Ok(facts)
    }

    /// Posters of a figure in a state, narrow ones first; none in a check.
    ///
    /// # Errors
    /// A sentence.
    pub(crate) fn posters(
        &self,
        name: &str,
        settings: &Settings,
        rooms: &[Room],
    ) -> Result<Posters, String> {
        let figure = self.gallery.open(name, settings)?;
        match self.draws_posters {
            true => posters::draw(figure.as_ref(), name, settings, rooms, &self.cache),
            false => Ok(Posters::default()),
        }
    }
}
