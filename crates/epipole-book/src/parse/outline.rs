//! Figures of a page and the phrases that set them, found before the directives are parsed, as a
//! sentence can refer to a figure below it.

use super::source::Source;
use super::syntax::{Call, Piece, split};
use crate::problems::{Place, name_list};

/// A figure of a page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Instance {
    pub(crate) name: String,
    /// Its permanent anchor on the page.
    pub(crate) id: String,
    /// State in the chapter.
    pub(crate) settings: Vec<(String, String)>,
    first: Place,
    last_line: usize,
}

/// Figures, phrases and symbols of a chapter.
#[derive(Debug, Default)]
pub(crate) struct Outline {
    figures: Vec<Instance>,
    acts: Vec<Act>,
    /// Symbols of the chapter that its figures also draw.
    pub(crate) symbols: Vec<String>,
}

impl Outline {
    pub(crate) fn of(source: &Source) -> Outline {
        let figures = instances(source);
        Outline {
            acts: acts(source, &figures),
            figures,
            symbols: symbols(source),
        }
    }

    /// Returns the figure of the directive at `place`.
    pub(crate) fn at(&self, place: &Place) -> Option<&Instance> {
        at(place, &self.figures)
    }

    /// Returns the figure that `name` or `name#id` in a sentence at `place` refers to.
    ///
    /// # Errors
    /// A message with the figures of the page.
    pub(crate) fn nearest(&self, wanted: &str, place: &Place) -> Result<&Instance, String> {
        nearest(wanted, place, &self.figures)
    }

    /// Returns the states of `figure` after a click on the phrase at `place`, for a reader who
    /// clicked other phrases before: all above, or all below.
    pub(crate) fn after_others(
        &self,
        figure: &Instance,
        place: &Place,
        changes: &[(String, String)],
    ) -> [Vec<(String, String)>; 2] {
        clicked_before(figure, (place, changes), &self.acts).map(|clicked| {
            let start = figure.settings.clone();
            let settings = clicked
                .iter()
                .fold(start, |settings, act| with_settings(settings, &act.changes));
            with_settings(settings, changes)
        })
    }
}

/// Returns the symbols that a chapter lists.
fn symbols(source: &Source) -> Vec<String> {
    let mut names = Vec::new();
    for piece in split(source) {
        if let Piece::Directive(directive) = piece
            && directive.name == "symbols"
        {
            names.extend(directive.words);
        }
    }
    names
}

/// Attributes of a figure's tag that concern the builder and the page; all others are the figure's
/// state.
const WORDS_OF_THE_PAGE: [&str; 8] = [
    "id", "controls", "readouts", "goals", "claim", "page", "play", "moves",
];

/// Returns the settings of a directive that belong to the figure's state.
pub(crate) fn own_settings(directive: &Call) -> Vec<(String, String)> {
    let mut settings = directive.settings.clone();
    settings.retain(|(key, _)| !WORDS_OF_THE_PAGE.contains(&key.as_str()));
    settings
}

/// Returns all figures of a chapter in order. Figures without an explicit id are `fig-name`, then
/// `fig-name-2` and so on.
fn instances(source: &Source) -> Vec<Instance> {
    let mut found: Vec<Instance> = Vec::new();
    for piece in split(source) {
        let Piece::Directive(directive) = piece else {
            continue;
        };
        let [name] = &directive.words[..] else {
            continue;
        };
        if directive.name != "figure" {
            continue;
        }
        let id = match directive.setting("id") {
            Some(id) => id.to_owned(),
            None => free_id(name, &found),
        };
        found.push(Instance {
            name: name.clone(),
            id,
            settings: own_settings(&directive),
            first: source.place(directive.span.start),
            last_line: source.place(directive.span.end).line,
        });
    }
    found
}

/// A phrase of a page that sets one of its figures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Act {
    place: Place,
    /// The anchor of the figure.
    figure: String,
    pub(crate) changes: Vec<(String, String)>,
}

/// Returns all phrases of a chapter that set figures, in order; `all` are its figures.
fn acts(source: &Source, all: &[Instance]) -> Vec<Act> {
    let act = |piece| {
        let Piece::Directive(directive) = piece else {
            return None;
        };
        let ("do", [wanted]) = (&directive.name[..], &directive.words[..]) else {
            return None;
        };
        let place = source.place(directive.span.start);
        let figure = nearest(wanted, &place, all).ok()?.id.clone();
        let changes = own_settings(&directive);
        Some(Act {
            place,
            figure,
            changes,
        })
    };
    split(source).into_iter().filter_map(act).collect()
}

/// Returns other phrases that a reader may have clicked for `figure` before the one at `place`:
/// those above from the top down, and those below from the bottom up.
fn clicked_before<'a>(
    figure: &Instance,
    (place, changes): (&Place, &[(String, String)]),
    all: &'a [Act],
) -> [Vec<&'a Act>; 2] {
    let of_figure: Vec<&Act> = all.iter().filter(|act| act.figure == figure.id).collect();
    let here = |act: &&Act| act.place == *place && act.changes == changes;
    let Some(at) = of_figure.iter().position(here) else {
        return [Vec::new(), Vec::new()];
    };
    let above = of_figure[..at].to_vec();
    let below = of_figure[at + 1..].iter().rev().copied().collect();
    [above, below]
}

/// Settings overridden by `changes`.
pub(crate) fn with_settings(
    mut settings: Vec<(String, String)>,
    changes: &[(String, String)],
) -> Vec<(String, String)> {
    settings.retain(|(key, _)| changes.iter().all(|(changed, _)| changed != key));
    settings.extend_from_slice(changes);
    settings
}

fn free_id(name: &str, taken: &[Instance]) -> String {
    let first = format!("fig-{name}");
    let is_free = |id: &String| taken.iter().all(|figure| figure.id != *id);
    let numbered = (2..).map(|count| format!("{first}-{count}"));
    let mut ids = std::iter::once(first.clone()).chain(numbered);
    ids.find(is_free).unwrap_or(first)
}

/// Returns the figure of the tag at `place`.
fn at<'a>(place: &Place, all: &'a [Instance]) -> Option<&'a Instance> {
    all.iter().find(|figure| figure.first == *place)
}

/// Returns the figure for `name` or `name#id` in a sentence at `place`: the nearest, and of two
/// equally near ones the earlier.
///
/// # Errors
/// A message with the figures of the page.
fn nearest<'a>(wanted: &str, place: &Place, all: &'a [Instance]) -> Result<&'a Instance, String> {
    let (name, id) = match wanted.split_once('#') {
        Some((name, id)) => (name, Some(id)),
        None => (wanted, None),
    };
    let fits = |figure: &&Instance| figure.name == name && id.is_none_or(|id| figure.id == id);
    let distance = |figure: &&Instance| {
        let (first, last) = (figure.first.line, figure.last_line);
        first.saturating_sub(place.line) + place.line.saturating_sub(last)
    };
    all.iter().filter(fits).min_by_key(distance).ok_or_else(|| {
        let of_page = all.iter();
        let known: Vec<String> = of_page
            .map(|figure| format!("{}#{}", figure.name, figure.id))
            .collect();
        format!(
            "this page has no figure \"{wanted}\"; its figures: {}",
            name_list(&known)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_a_name_is_meant() {
        let text = "{{#figure dot | A}}\n\nb\n\nc\n\n{{#figure dot size=2 | A\nB}}\n\n{{#figure dot id=x | C}}\n";
        let source = Source::new(text, Place::new("a.md", 1));
        let all = instances(&source);
        let ids: Vec<&str> = all.iter().map(|figure| figure.id.as_str()).collect();
        assert_eq!(ids, ["fig-dot", "fig-dot-2", "x"]);
        for (line, id) in [
            (1, "fig-dot"),
            (3, "fig-dot"),
            (5, "fig-dot-2"),
            (8, "fig-dot-2"),
            (9, "fig-dot-2"),
            (11, "x"),
        ] {
            let place = Place::new("a.md", line);
            assert_eq!(nearest("dot", &place, &all).unwrap().id, id, "{line}");
        }
        let place = Place::new("a.md", 1);
        assert_eq!(nearest("dot#x", &place, &all).unwrap().id, "x");
        let sentence = nearest("dots", &place, &all).unwrap_err();
        assert!(
            sentence.contains("its figures: dot#fig-dot, dot#fig-dot-2, dot#x"),
            "{sentence}"
        );
        assert_eq!(all[1].settings, [("size".to_owned(), "2".to_owned())]);
    }

    #[test]
    fn what_may_have_been_clicked_before_is_known() {
        let text = "{{#figure dot | A}}\n\n{{#do dot a=1 | w}} {{#do dot a=2 b=1 | w}}\n\n{{#do dot#fig-dot b=3 | w}}\n\n\
                    {{#figure dot id=x | B}}\n\n{{#do dot#x a=4 | w}}\n";
        let source = Source::new(text, Place::new("a.md", 1));
        let all = instances(&source);
        let acts = acts(&source, &all);
        assert_eq!(acts.len(), 4);
        let setting = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let middle = [setting("a", "2"), setting("b", "1")];
        let place = Place::new("a.md", 3);
        let [above, below] = clicked_before(&all[0], (&place, &middle), &acts);
        assert_eq!(above, [&acts[0]]);
        assert_eq!(below, [&acts[2]]);
        let last = [setting("a", "4")];
        let [above, below] = clicked_before(&all[1], (&Place::new("a.md", 9), &last), &acts);
        assert!(above.is_empty() && below.is_empty());
        let settings = with_settings(vec![setting("a", "0"), setting("c", "5")], &middle);
        assert_eq!(
            settings,
            [setting("c", "5"), setting("a", "2"), setting("b", "1")]
        );
    }
}
