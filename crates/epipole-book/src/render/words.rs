//! Text of Markdown events, and the characters around formulas.

use super::insert::{Insert, substitute};
use crate::parse::events::Located;
use pulldown_cmark::{BlockQuoteKind, Event};

/// Returns the punctuation directly before and after an inline formula. Browsers may break the line
/// on either side of a formula, which would separate a bracket or a comma.
pub(super) fn neighbors<'t>(events: &'t [Located], at: usize) -> (&'t str, &'t str) {
    let before = match at.checked_sub(1).map(|before| &events[before].0) {
        Some(Event::Text(words)) => {
            let trimmed = words.trim_end_matches(['(', '[', '“', '‘']);
            &words[trimmed.len()..]
        }
        _ => "",
    };
    let after = match events.get(at + 1).map(|(event, _)| event) {
        Some(Event::Text(words)) => {
            let rest = words.trim_start_matches([
                ',', '.', ';', ':', '!', '?', ')', ']', '…', '’', '”', '-', '–',
            ]);
            &words[..words.len() - rest.len()]
        }
        _ => "",
    };
    (before, after)
}

/// Returns the plain text of a range of events.
pub(super) fn plain(events: &[Located], inserts: &[Insert]) -> String {
    let mut words = String::new();
    for (event, _) in events {
        match event {
            Event::Text(part) | Event::Code(part) | Event::InlineMath(part) => {
                words.push_str(&substitute(part, inserts, Insert::text));
            }
            Event::SoftBreak | Event::HardBreak => words.push(' '),
            _ => {}
        }
    }
    words.trim().to_owned()
}

pub(super) fn callout(kind: BlockQuoteKind, html: &str) -> String {
    let (class, title) = match kind {
        BlockQuoteKind::Note => ("note", "Note"),
        BlockQuoteKind::Tip => ("tip", "Try it"),
        BlockQuoteKind::Important => ("important", "Remember"),
        BlockQuoteKind::Warning => ("warning", "Beware"),
        BlockQuoteKind::Caution => ("caution", "Common mistake"),
    };
    format!(
        "<div class=\"callout callout-{class}\">\n<p class=\"callout-title\">{title}</p>\n{html}</div>\n"
    )
}
