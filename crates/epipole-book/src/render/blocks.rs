//! Paragraphs with a single directive, and blocks of fences between two such paragraphs.

use super::insert::{Block, Fence, Insert};
use super::listing::info;
use crate::parse::events::{Located, end_of};
use crate::parse::placeholders;
use crate::parse::source::Source;
use crate::problems::Place;
use pulldown_cmark::{Event, Tag};
use std::ops::Range;

/// Content of a block, up to the paragraph that ends it.
pub(super) struct Collected {
    /// Events of the text before the fences.
    pub(super) words: Vec<Range<usize>>,
    pub(super) fences: Vec<Fence>,
    /// Places of text after a fence, which is not allowed.
    pub(super) strays: Vec<Place>,
    /// Whether the end was found.
    pub(super) is_closed: bool,
    /// Index of the event after the block.
    pub(super) next: usize,
}

/// Collects a block whose start lies before `from`.
pub(super) fn collect(
    events: &[Located],
    from: usize,
    source: &Source,
    is_end: impl Fn(&[Located]) -> bool,
) -> Collected {
    let mut found = Collected {
        words: Vec::new(),
        fences: Vec::new(),
        strays: Vec::new(),
        is_closed: false,
        next: from,
    };
    while let Some((event, range)) = events.get(found.next) {
        let at = found.next;
        let next = match event {
            Event::Start(_) => end_of(events, at),
            _ => at + 1,
        };
        let inner = &events[at..next];
        match event {
            Event::Start(Tag::Paragraph) if is_end(inner) => {
                found.is_closed = true;
                found.next = next;
                break;
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let (language, word) = info(kind);
                found.fences.push(Fence {
                    language: language.to_owned(),
                    word: word.to_owned(),
                    code: code_of(inner),
                    place: source.place(range.start),
                });
            }
            Event::Start(Tag::Paragraph | Tag::List(_) | Tag::HtmlBlock)
                if found.fences.is_empty() =>
            {
                found.words.push(at..next);
            }
            Event::Start(_) => found.strays.push(source.place(range.start)),
            // The element around the block ends first.
            Event::End(_) => break,
            _ => {}
        }
        found.next = next;
    }
    found
}

/// Returns the text of a fence.
pub(super) fn code_of(fence: &[Located]) -> String {
    let texts = fence.iter().map(|(event, _)| match event {
        Event::Text(code) => code.as_ref(),
        _ => "",
    });
    texts.collect()
}

/// Returns the opening of a block, if a paragraph contains nothing else.
pub(super) fn single_opening<'t>(
    inner: &[Located],
    inserts: &'t [Insert],
) -> Option<&'t dyn Block> {
    match inserts.get(single_index(inner)?)? {
        Insert::Opening(opening) => Some(opening.as_ref()),
        _ => None,
    }
}

/// Returns the HTML of a paragraph with a single insert, and its text for the search index.
pub(super) fn single_block<'t>(
    inner: &[Located],
    inserts: &'t [Insert],
    found: &'t [String],
) -> Option<(&'t str, &'t str)> {
    let index = single_index(inner)?;
    match inserts.get(index)? {
        Insert::Block { html } => Some((html, found.get(index)?)),
        _ => None,
    }
}

/// Returns the index of the insert in a paragraph, if it contains nothing else.
fn single_index(inner: &[Located]) -> Option<usize> {
    let mut words = String::new();
    for (event, _) in inner {
        match event {
            Event::Text(part) => words.push_str(part),
            Event::SoftBreak => words.push(' '),
            _ => return None,
        }
    }
    placeholders::index_of(words.trim())
}
