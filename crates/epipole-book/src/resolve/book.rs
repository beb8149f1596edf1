//! Data shared by the chapters of a build: figures, their posters and facts, and references.

use super::cache::Cache;
use super::facts::Facts;
use super::figures::{Gallery, Room};
use super::posters::{self, Medium, Posters};
use super::references::References;
use crate::parse::content::Content;
use crate::problems::Problems;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

type Settings = [(String, String)];

/// A figure in a state.
type State = (String, Vec<(String, String)>);

/// Data for all directives, shared by several threads.
pub(crate) struct Book<'a> {
    pub(crate) problems: &'a Problems,
    pub(crate) gallery: &'a dyn Gallery,
    pub(crate) references: References,
    cache: Cache,
    /// Medium of the posters; `None` for a check of the content, which draws none.
    medium: Option<Medium>,
    facts: Mutex<BTreeMap<State, Arc<Facts>>>,
}

impl<'a> Book<'a> {
    pub(crate) fn new(
        content: &Content,
        gallery: &'a dyn Gallery,
        cache: Cache,
        medium: Option<Medium>,
        problems: &'a Problems,
    ) -> Self {
        let references = content.read("references.toml");
        let references = references.map(|source| References::parse(&source, problems));
        Book {
            problems,
            gallery,
            references: references.unwrap_or_default(),
            cache,
            medium,
            facts: Mutex::default(),
        }
    }

    /// Returns the facts of a figure in a state, after its computations.
    ///
    /// # Errors
    /// A message that names the figure.
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
        let read = |bytes: &[u8]| Facts::parse(std::str::from_utf8(bytes).ok()?).ok();
        let facts = self.cache.get_or((name, settings, "facts"), read, make);
        let facts = Arc::new(facts.map_err(of_figure)?);
        lock().insert(key, facts.clone());
        Ok(facts)
    }

    /// Returns the posters of a figure in a state, narrow ones first; none in a check. Paper has
    /// one width.
    ///
    /// # Errors
    /// A message.
    pub(crate) fn posters(
        &self,
        name: &str,
        settings: &Settings,
        rooms: &[Room],
    ) -> Result<Posters, String> {
        let figure = self.gallery.open(name, settings)?;
        let rooms = match self.medium {
            None => return Ok(Posters::default()),
            Some(Medium::Screen) => (Medium::Screen, rooms),
            Some(Medium::Paper) if rooms.contains(&Room::Column) => {
                (Medium::Paper, &[Room::Column][..])
            }
            Some(Medium::Paper) => (Medium::Paper, rooms),
        };
        posters::draw(figure.as_ref(), name, settings, rooms, &self.cache)
    }
}
