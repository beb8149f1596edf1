//! Helpers for the events of a parsed text.

use pulldown_cmark::{CowStr, Event, HeadingLevel, Tag};
use std::collections::HashMap;
use std::ops::Range;

/// An event and its byte range.
pub(crate) type Located<'a> = (Event<'a>, Range<usize>);

/// Returns the index after the end of the element that starts at `start`.
pub(crate) fn end_of(events: &[Located], start: usize) -> usize {
    let mut depth = 0_usize;
    for (at, (event, _)) in events.iter().enumerate().skip(start) {
        match event {
            Event::Start(_) => depth += 1,
            Event::End(_) => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return at + 1;
                }
            }
            _ => {}
        }
    }
    events.len()
}

/// Returns the byte offsets of the sections, which start with second-level headings, and of the
/// text's end.
pub(crate) fn section_starts(events: &[Located]) -> Vec<usize> {
    let mut starts = Vec::new();
    let mut at = 0;
    while at < events.len() {
        match &events[at].0 {
            Event::Start(tag) => {
                if matches!(tag, Tag::Heading { level, .. } if *level == HeadingLevel::H2) {
                    starts.push(at);
                }
                at = end_of(events, at);
            }
            _ => at += 1,
        }
    }
    starts.push(events.len());
    starts
}

/// Removes the definitions of footnotes from the events: they become margin notes.
pub(crate) fn take_footnotes<'a>(
    events: &mut Vec<Located<'a>>,
) -> HashMap<CowStr<'a>, Vec<Located<'a>>> {
    let mut footnotes = HashMap::new();
    let mut at = 0;
    while at < events.len() {
        if let Event::Start(Tag::FootnoteDefinition(label)) = &events[at].0 {
            let label = label.clone();
            let end = end_of(events, at);
            let mut definition: Vec<Located> = events.drain(at..end).collect();
            definition.remove(0);
            definition.pop();
            footnotes.insert(label, definition);
        } else {
            at += 1;
        }
    }
    footnotes
}
