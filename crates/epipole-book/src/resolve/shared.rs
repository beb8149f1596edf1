//! What the pages of a build share: content files, figures, references, and the files that come
//! out. What one page says of another is a token until all pages are rendered.

use crate::parse::source::Source;
use crate::problems::{Place, Problems};
use crate::resolve::facts::Facts;
use crate::resolve::figures::Gallery;
use crate::resolve::posters::kept_as;
use crate::resolve::references::References;
use crate::write::assets::fnv;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Kind of the token for the page with the list of references.
pub(crate) const PAGE_OF_REFERENCES: &str = "references-page";

const OPEN: char = '\u{E010}';
const MIDDLE: char = '\u{E011}';
const CLOSE: char = '\u{E012}';

/// A stand-in for what is known only when all pages are rendered.
pub(crate) fn token(kind: &str, name: &str) -> String {
    format!("{OPEN}{kind}{MIDDLE}{name}{CLOSE}")
}

/// Replaces all tokens.
pub(crate) fn resolve(html: &str, mut answer: impl FnMut(&str, &str) -> String) -> String {
    let mut resolved = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(open) = rest.find(OPEN) {
        resolved.push_str(&rest[..open]);
        let after = &rest[open + OPEN.len_utf8()..];
        let (inside, next) = after.split_once(CLOSE).unwrap_or((after, ""));
        let (kind, name) = inside.split_once(MIDDLE).unwrap_or((inside, ""));
        resolved.push_str(&answer(kind, name));
        rest = next;
    }
    resolved.push_str(rest);
    resolved
}

/// A quiz and where it is.
#[derive(Debug, Clone)]
pub(crate) struct QuizEntry {
    pub(crate) name: String,
    pub(crate) page: String,
    pub(crate) title: String,
    pub(crate) questions: usize,
}

/// What a figure's panel is made of: see `web/prerender.mjs`.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct PanelRequest {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) help: String,
    pub(crate) snapshot: serde_json::Value,
    pub(crate) attributes: BTreeMap<String, String>,
    pub(crate) sizes: Vec<(u32, f64)>,
}

#[derive(Default)]
struct Collected {
    facts: BTreeMap<(String, Settings), Arc<Facts>>,
    panels: Vec<PanelRequest>,
    files: BTreeMap<String, Vec<u8>>,
    quizzes: Vec<QuizEntry>,
    /// For each page, the goals of its figures that it shows, each `figure/goal`.
    goals: BTreeMap<String, BTreeSet<String>>,
    wanted_figures: Vec<(String, Place)>,
    wanted_references: Option<Place>,
}

type Settings = Vec<(String, String)>;

/// The state of one build.
pub(crate) struct Shared<'a> {
    pub(crate) problems: &'a Problems,
    pub(crate) gallery: &'a dyn Gallery,
    pub(crate) references: References,
    content: &'a Path,
    /// How the content folder is called in messages.
    shown_as: PathBuf,
    /// Where posters are kept between builds; none are drawn without.
    posters: Option<PathBuf>,
    collected: Mutex<Collected>,
}

impl<'a> Shared<'a> {
    pub(crate) fn new(
        content: &'a Path,
        gallery: &'a dyn Gallery,
        posters: Option<PathBuf>,
        problems: &'a Problems,
    ) -> Self {
        let shown_as = content
            .file_name()
            .map_or_else(|| content.to_path_buf(), PathBuf::from);
        let mut shared = Shared {
            problems,
            gallery,
            references: References::default(),
            content,
            shown_as,
            posters,
            collected: Mutex::default(),
        };
        if let Some(source) = shared.read("references.toml") {
            shared.references = References::parse(&source, problems);
        }
        shared
    }

    /// Where posters are kept; none in a build that only looks for problems.
    pub(crate) fn posters_in(&self) -> Option<&Path> {
        self.posters.as_deref()
    }

    /// What a figure shows in a state, its computations done.
    ///
    /// # Errors
    /// A sentence that names the figure.
    pub(crate) fn facts(&self, name: &str, settings: &Settings) -> Result<Arc<Facts>, String> {
        let key = (name.to_owned(), settings.clone());
        if let Some(known) = self.with(|all| all.facts.get(&key).cloned()) {
            return Ok(known);
        }
        let of_figure = |error| format!("figure {name}: {error}");
        let figure = self.gallery.open(name, settings).map_err(of_figure)?;
        let file = self
            .posters_in()
            .map(|folder| kept_as(folder, name, settings, "facts"));
        let kept = file
            .as_ref()
            .and_then(|file| std::fs::read_to_string(file).ok());
        let kept = kept.and_then(|snapshot| Facts::parse(&snapshot).ok());
        let facts = match kept {
            Some(facts) => facts,
            None => {
                let snapshot = figure.snapshot().map_err(of_figure)?;
                if let Some(file) = &file {
                    // What cannot be kept costs time, nothing else.
                    let _ = std::fs::write(file, &snapshot);
                }
                Facts::parse(&snapshot).map_err(of_figure)?
            }
        };
        let facts = Arc::new(facts);
        self.with(|all| all.facts.insert(key, facts.clone()));
        Ok(facts)
    }

    /// Asks for a panel; its number stands in a token until all are made.
    pub(crate) fn wants_panel(&self, panel: PanelRequest) -> usize {
        self.with(|all| {
            all.panels.push(panel);
            all.panels.len() - 1
        })
    }

    pub(crate) fn wanted_panels(&self) -> Vec<PanelRequest> {
        self.with(|all| all.panels.clone())
    }

    /// A place in a file of the content folder.
    pub(crate) fn place(&self, file: &str, line: usize) -> Place {
        Place::new(self.shown_as.join(file), line)
    }

    /// The full path of a file of the content folder.
    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.content.join(file)
    }

    /// A text file of the content folder.
    pub(crate) fn read(&self, file: &str) -> Option<Source> {
        let text = std::fs::read_to_string(self.content.join(file)).ok()?;
        Some(Source::new(text, self.place(file, 1)))
    }

    /// Adds a file to the site under `assets/`, its name made unique by its content.
    /// Returns its path from the root of the site.
    pub(crate) fn add_asset(&self, name: &str, extension: &str, bytes: Vec<u8>) -> String {
        let path = format!("assets/{name}-{:016x}.{extension}", fnv(&bytes));
        self.with(|all| all.files.insert(path.clone(), bytes));
        path
    }

    /// Names of the files in a folder of the content folder; none if there is no such folder.
    pub(crate) fn files_in(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.content.join(folder)).into_iter();
        let entries = entries.flatten().flatten();
        entries
            .filter(|entry| entry.path().is_file())
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect()
    }

    /// Adds a file to the site at this path, which is its address for good.
    pub(crate) fn add_file(&self, path: &str, bytes: Vec<u8>) {
        self.with(|all| all.files.insert(path.to_owned(), bytes));
    }

    /// Copies a file of the content folder to the same place of the site, if there is one.
    pub(crate) fn copy_file(&self, file: &str) -> bool {
        let path = self.content.join(file);
        match std::fs::read(path) {
            Ok(bytes) => {
                self.with(|all| all.files.insert(file.to_owned(), bytes));
                true
            }
            Err(_) => false,
        }
    }

    /// Takes all files that pages have added.
    pub(crate) fn take_files(&self) -> BTreeMap<String, Vec<u8>> {
        self.with(|all| std::mem::take(&mut all.files))
    }

    pub(crate) fn add_quiz(&self, quiz: QuizEntry) {
        self.with(|all| all.quizzes.push(quiz));
    }

    pub(crate) fn quizzes(&self) -> Vec<QuizEntry> {
        self.with(|all| all.quizzes.clone())
    }

    /// Remembers that a page shows these goals of a figure.
    pub(crate) fn add_goals(&self, page: &str, figure: &str, goals: &[&str]) {
        self.with(|all| {
            let known = all.goals.entry(page.to_owned()).or_default();
            known.extend(goals.iter().map(|goal| format!("{figure}/{goal}")));
        });
    }

    /// The goals that the figures of a page show, each `figure/goal`.
    pub(crate) fn goals_of(&self, page: &str) -> Vec<String> {
        self.with(|all| {
            let goals = all.goals.get(page).into_iter().flatten();
            goals.cloned().collect()
        })
    }

    /// Remembers that a page refers to a figure.
    pub(crate) fn wants_figure(&self, id: &str, place: &Place) {
        self.with(|all| all.wanted_figures.push((id.to_owned(), place.clone())));
    }

    pub(crate) fn wanted_figures(&self) -> Vec<(String, Place)> {
        self.with(|all| all.wanted_figures.clone())
    }

    /// Remembers that a page cites something.
    pub(crate) fn wants_references(&self, place: &Place) {
        self.with(|all| {
            all.wanted_references.get_or_insert_with(|| place.clone());
        });
    }

    pub(crate) fn wanted_references(&self) -> Option<Place> {
        self.with(|all| all.wanted_references.clone())
    }

    fn with<T>(&self, act: impl FnOnce(&mut Collected) -> T) -> T {
        act(&mut self
            .collected
            .lock()
            .unwrap_or_else(PoisonError::into_inner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_resolved() {
        let html = format!("a{}b{}", token("k", "n"), token("p", ""));
        assert_eq!(
            resolve(&html, |kind, name| format!("[{kind}:{name}]")),
            "a[k:n]b[p:]"
        );
        assert_eq!(resolve("plain", |_, _| String::new()), "plain");
    }
}
