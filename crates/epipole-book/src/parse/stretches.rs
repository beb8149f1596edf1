//! Stretches of a chapter without visuals.

use super::source::Source;
use super::syntax::{Call, Piece, markdown_options, split};
use crate::problems::Place;
use pulldown_cmark::{Event, Parser, Tag, TagEnd};

/// Directives with visuals: a figure, a table of formulas.
const SHOWN: [&str; 2] = ["figure", "formulas"];

/// Consecutive paragraphs without a figure, a picture, a drawing, a table or a listing.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// Number of paragraphs; a list or an aside counts as one. A displayed formula belongs to the
    /// paragraph before it.
    pub paragraphs: usize,
    /// Start of the stretch.
    pub place: Place,
}

/// Returns the stretches of a chapter up to its quiz, since the rest is not read in one go.
pub fn stretches(source: &Source) -> Vec<Stretch> {
    let figures: Vec<Call> = split(source)
        .into_iter()
        .filter_map(|piece| match piece {
            Piece::Directive(directive) if SHOWN.contains(&&*directive.name) => Some(directive),
            _ => None,
        })
        .collect();
    let text = source.text();
    let end = text.find("\n## Quiz").unwrap_or(text.len());
    let mut found = Vec::new();
    let mut open: Option<Stretch> = None;
    let mut depth = 0_usize;
    let events = Parser::new_ext(text, markdown_options()).into_offset_iter();
    let events: Vec<_> = events.take_while(|(_, range)| range.start < end).collect();
    for (index, (event, range)) in events.iter().enumerate() {
        let follows = |count: usize| events.get(index + count).map(|(event, _)| event);
        let is_formula = matches!(follows(1), Some(Event::DisplayMath(_)))
            && matches!(follows(2), Some(Event::End(TagEnd::Paragraph)));
        let is_figure = figures
            .iter()
            .any(|figure| figure.span.start == range.start);
        let is_in_figure = figures
            .iter()
            .any(|figure| figure.span.contains(&range.start));
        match event {
            Event::Start(_) if is_in_figure && !is_figure => {}
            Event::Start(Tag::Paragraph) if is_formula => {}
            Event::Start(Tag::Table(_) | Tag::CodeBlock(_) | Tag::Image { .. }) => {
                found.extend(open.take());
            }
            Event::Start(Tag::Paragraph) if is_figure => found.extend(open.take()),
            Event::Html(html) if html.contains("<svg") => found.extend(open.take()),
            Event::Start(Tag::Paragraph | Tag::List(_) | Tag::BlockQuote(_)) if depth == 0 => {
                let place = source.place(range.start);
                let paragraphs = 0;
                open.get_or_insert(Stretch { paragraphs, place }).paragraphs += 1;
            }
            _ => {}
        }
        match event {
            Event::Start(Tag::List(_) | Tag::BlockQuote(_)) => depth += 1,
            Event::End(TagEnd::List(_) | TagEnd::BlockQuote(_)) => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    found.extend(open);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_tables_and_listings_end_a_stretch() {
        let text = "# A\n\na\n\n- b\n- c\n\n{{#figure dot | C.\n\nD}}\n\n$$ x $$\n\n> e\n>\n> f\n\n| a |\n|---|\n| 1 |\n\ng\n\n<svg>\n</svg>\n\nh\n\n## Quiz\n\nh\n";
        let source = Source::new(text, Place::new("a.md", 1));
        let counted: Vec<_> = stretches(&source)
            .iter()
            .map(|s| (s.paragraphs, s.place.line))
            .collect();
        assert_eq!(counted, [(2, 3), (1, 14), (1, 22), (1, 27)]);
    }
}
