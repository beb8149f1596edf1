//! A chapter's Markdown to HTML. Directives become stand-ins before Markdown is parsed, and their
//! HTML takes the stand-ins' place afterwards.

use crate::directives::blocks::{self, Fence, Opening};
use crate::directives::expand::Insert;
use crate::html::{escape, forbidden_inline, slug};
use crate::parse::events::{Located, end_of, section_starts, take_footnotes};
use crate::parse::outline::{Act, Instance, acts, instances};
use crate::parse::source::Source;
use crate::parse::stand_ins::{self, Part, parts, substitute};
use crate::parse::syntax::{Directive, Piece, markdown_options, split};
use crate::problems::Place;
use crate::render::links;
use crate::render::listing::{info, listing};
use crate::render::math::{Layout, mathml};
use crate::render::page::{Heading, Page};
use crate::render::symbols;
use crate::resolve::shared::Shared;
use pulldown_cmark::{Alignment, BlockQuoteKind, CowStr, Event, Parser, Tag, TagEnd};
use std::collections::HashMap;
/// Renders one chapter; its page grows as it goes.
pub(crate) struct Renderer<'a> {
    pub(crate) shared: &'a Shared<'a>,
    pub(crate) page: Page,
    /// The figures of the page, also those still to come.
    pub(crate) instances: Vec<Instance>,
    /// The words that set them.
    pub(crate) acts: Vec<Act>,
    notes: usize,
}

/// What the events of one text refer to.
struct Text<'a> {
    source: &'a Source,
    inserts: &'a [Insert],
    /// What the search finds in each of the inserts: captions, notes, quizzes.
    found: &'a [String],
    footnotes: HashMap<CowStr<'a>, Vec<Located<'a>>>,
}

impl<'a> Renderer<'a> {
    /// For a page of a source with figures, or of none.
    pub(crate) fn new(shared: &'a Shared<'a>, page: Page, source: Option<&Source>) -> Self {
        let instances = source.map(instances).unwrap_or_default();
        let acts = source.map(|source| acts(source, &instances));
        Renderer {
            shared,
            page,
            acts: acts.unwrap_or_default(),
            instances,
            notes: 0,
        }
    }

    /// A whole text with paragraphs, headings and so on.
    pub(crate) fn block(&mut self, source: &Source) -> String {
        self.render(source, false)
    }

    /// A text that stands inside a paragraph, such as a caption.
    pub(crate) fn inline(&mut self, source: &Source) -> String {
        self.render(source, true)
    }

    /// Notes a problem.
    pub(crate) fn report(&self, place: Place, message: impl Into<String>) {
        self.shared.problems.report(place, message);
    }

    fn render(&mut self, source: &Source, inline: bool) -> String {
        let mut expanded = Source::default();
        let (mut inserts, mut found) = (Vec::new(), Vec::new());
        for piece in split(source) {
            match piece {
                Piece::Text(range) => expanded.push_slice(source, range),
                Piece::Broken(range, message) => self.report(source.place(range.start), message),
                Piece::Directive(directive) => {
                    let place = source.place(directive.span.start);
                    // Directives come before the text that they stand in; their words belong into it.
                    let before = std::mem::take(&mut self.page.words);
                    let insert = self.directive(source, &directive);
                    found.push(std::mem::replace(&mut self.page.words, before));
                    expanded.push(&stand_ins::of(inserts.len()), place);
                    inserts.push(insert);
                }
            }
        }
        let mut events: Vec<Located> = Parser::new_ext(expanded.text(), markdown_options())
            .into_offset_iter()
            .collect();
        let footnotes = take_footnotes(&mut events);
        let text = Text {
            source: &expanded,
            inserts: &inserts,
            found: &found,
            footnotes,
        };
        if inline {
            let html = self.events(&events, &text, true);
            self.page.words.push(' ');
            return html;
        }
        let starts = section_starts(&events);
        let mut html = self.events(&events[..starts[0]], &text, false);
        for bounds in starts.windows(2) {
            let section = self.events(&events[bounds[0]..bounds[1]], &text, false);
            html.push_str(&format!("<section>\n{section}</section>\n"));
        }
        html
    }

    fn directive(&mut self, source: &Source, directive: &Directive) -> Insert {
        let place = source.place(directive.span.start);
        let body = directive.body.clone().map(|range| source.slice(range));
        match crate::directives::expand::expand(self, directive, body, &place) {
            Ok(insert) => insert,
            Err(message) => {
                self.report(place, message);
                Insert::Inline {
                    html: String::new(),
                    text: String::new(),
                }
            }
        }
    }

    /// HTML of a run of events. `tight` leaves out the tags of paragraphs.
    fn events(&mut self, events: &[Located], text: &Text, tight: bool) -> String {
        let mut out: Vec<Event> = Vec::new();
        // Bytes of the next text that stand behind the formula before it already.
        let mut skipped = 0;
        let mut at = 0;
        while at < events.len() {
            let (event, range) = &events[at];
            let place = || text.source.place(range.start);
            let mut next = at + 1;
            match event {
                Event::Start(Tag::Paragraph) => {
                    next = end_of(events, at);
                    let inner = &events[at + 1..next - 1];
                    if let Some(opening) = lone_opening(inner, text) {
                        let (html, end) = self.code_block(opening, events, next, text, place());
                        next = end;
                        out.push(Event::Html(html.into()));
                    } else if let Some((block, words)) = lone_block(inner, text) {
                        self.page.words.push_str(&format!(" {words} "));
                        out.push(Event::Html(block.to_owned().into()));
                    } else {
                        self.page.describe(|| plain(inner, text));
                        let html = self.events(inner, text, tight);
                        let html = match (tight, out.is_empty()) {
                            (false, _) => format!("<p>{html}</p>\n"),
                            (true, true) => html,
                            (true, false) => format!("<br>{html}"),
                        };
                        out.push(Event::Html(html.into()));
                        self.page.words.push(' ');
                    }
                }
                Event::Start(Tag::Heading { level, id, .. }) => {
                    next = end_of(events, at);
                    let inner = &events[at + 1..next - 1];
                    let html = self.heading(*level as u8, id.as_deref(), inner, text);
                    out.push(Event::Html(html.into()));
                }
                Event::Start(Tag::CodeBlock(kind)) => {
                    next = end_of(events, at);
                    out.push(Event::Html(
                        listing(&code_of(&events[at..next]), kind).into(),
                    ));
                }
                Event::Start(Tag::BlockQuote(Some(kind))) => {
                    next = end_of(events, at);
                    let html = self.events(&events[at + 1..next - 1], text, false);
                    out.push(Event::Html(callout(*kind, &html).into()));
                }
                Event::Start(Tag::Table(alignments)) => {
                    next = end_of(events, at);
                    let html = self.table(&events[at + 1..next - 1], alignments, text);
                    out.push(Event::Html(html.into()));
                }
                Event::Start(Tag::Link {
                    link_type,
                    dest_url,
                    title,
                    id,
                }) => {
                    let dest_url = links::rewrite(self, dest_url, place()).into();
                    out.push(Event::Start(Tag::Link {
                        link_type: *link_type,
                        dest_url,
                        title: title.clone(),
                        id: id.clone(),
                    }));
                }
                Event::Start(Tag::Image {
                    dest_url, title, ..
                }) => {
                    next = end_of(events, at);
                    let alternative = plain(&events[at + 1..next - 1], text);
                    let html = links::image(self, dest_url, title, &alternative, place());
                    out.push(Event::InlineHtml(html.into()));
                }
                Event::InlineMath(latex) => {
                    let html = self.formula(latex, Layout::Inline, text, place());
                    let (before, after) = neighbors(events, at);
                    if let Some(Event::Text(words)) = out.last_mut() {
                        *words = words[..words.len() - before.len()].to_owned().into();
                    }
                    let html = match before.is_empty() && after.is_empty() {
                        true => html,
                        false => format!("<span class=\"bound\">{before}{html}{after}</span>"),
                    };
                    self.page.words.push_str(after);
                    skipped = after.len();
                    out.push(Event::InlineHtml(html.into()));
                }
                Event::DisplayMath(latex) => {
                    out.push(Event::InlineHtml(
                        self.formula(latex, Layout::Display, text, place()).into(),
                    ));
                }
                Event::Text(words) => {
                    self.text(&words[std::mem::take(&mut skipped)..], text, &mut out)
                }
                Event::Code(code) => {
                    let code = self.substitute(code, text, Insert::text);
                    self.page.words.push_str(&code);
                    out.push(Event::Code(code.into()));
                }
                Event::Html(html) | Event::InlineHtml(html) => {
                    if let Some(offence) = forbidden_inline(html) {
                        let message = format!("{offence}: pages hold no inline scripts and styles");
                        self.report(place(), message);
                    }
                    let html = self.substitute(html, text, Insert::html);
                    out.push(Event::Html(html.into()));
                }
                Event::FootnoteReference(label) => match text.footnotes.get(label) {
                    Some(definition) => {
                        let note = self.events(definition, text, true);
                        out.push(Event::InlineHtml(self.note(&note).into()));
                    }
                    None => self.report(place(), format!("no footnote is called \"{label}\"")),
                },
                Event::SoftBreak | Event::HardBreak | Event::Rule | Event::End(_) => {
                    // The end of a list's item, say. Within a word nothing ends but emphasis and links.
                    if !matches!(
                        event,
                        Event::End(TagEnd::Emphasis | TagEnd::Strong | TagEnd::Link)
                    ) {
                        self.page.words.push(' ');
                    }
                    out.push(event.clone());
                }
                event => out.push(event.clone()),
            }
            at = next;
        }
        let mut html = String::new();
        pulldown_cmark::html::push_html(&mut html, out.into_iter());
        html
    }

    /// A listing or a task: the HTML, and the index after its end. It begins before `from`.
    fn code_block(
        &mut self,
        opening: &Opening,
        events: &[Located],
        from: usize,
        text: &Text,
        place: Place,
    ) -> (String, usize) {
        let (mut words, mut markdown) = (String::new(), String::new());
        let mut fences: Vec<Fence> = Vec::new();
        let mut at = from;
        while at < events.len() {
            let (event, range) = &events[at];
            let next = match event {
                Event::Start(_) => end_of(events, at),
                _ => at + 1,
            };
            let inner = &events[at..next];
            match event {
                Event::Start(Tag::Paragraph) if plain(inner, text) == opening.kind.end() => {
                    let words = (words, markdown);
                    let html = blocks::block(self, opening, words, &fences, &place);
                    return (html, next);
                }
                Event::Start(Tag::CodeBlock(kind)) => {
                    let (language, word) = info(kind);
                    fences.push(Fence {
                        language: language.to_owned(),
                        word: word.to_owned(),
                        code: code_of(inner),
                        place: text.source.place(range.start),
                    });
                }
                Event::Start(Tag::Paragraph | Tag::List(_) | Tag::HtmlBlock)
                    if fences.is_empty() =>
                {
                    let source = &text.source.text()[range.clone()];
                    words.push_str(&self.events(inner, text, false));
                    markdown.push_str(&substitute(source, text.inserts, Insert::text));
                    markdown.push_str("\n\n");
                }
                Event::Start(_) => {
                    let message = "in a listing or a task words come first and fences after them";
                    self.report(text.source.place(range.start), message);
                }
                // The element around the block ends before the block does.
                Event::End(_) => break,
                _ => {}
            }
            at = next;
        }
        self.report(place, format!("this has no {}", opening.kind.end()));
        (String::new(), at)
    }

    /// A note in the margin (below its line on a narrow screen).
    pub(crate) fn note(&mut self, html: &str) -> String {
        self.notes += 1;
        let number = self.notes;
        format!(
            "<sup class=\"note-mark\">{number}</sup><small class=\"note\" role=\"note\">\
             <sup class=\"note-number\">{number}</sup> {html}</small>"
        )
    }

    fn heading(&mut self, level: u8, id: Option<&str>, inner: &[Located], text: &Text) -> String {
        let title = plain(inner, text);
        let wanted = id.map_or_else(|| slug(&title), str::to_owned);
        let mut id = wanted.clone();
        let mut count = 1;
        while self.page.headings.iter().any(|heading| heading.id == id) {
            id = format!("{wanted}-{count}");
            count += 1;
        }
        self.page.start_section(&id, &title);
        let html = self.events(inner, text, true);
        let heading = Heading {
            level,
            id: id.clone(),
            title: title.clone(),
            html: html.clone(),
        };
        self.page.headings.push(heading);
        let (id, title) = (escape(&id), escape(&title));
        if level == 1 {
            let number = match &self.page.number {
                Some(number) => format!(
                    "<span class=\"chapter-number\"><span class=\"visually-hidden\">Chapter </span>{number}</span> "
                ),
                None => String::new(),
            };
            return format!("<h1 id=\"{id}\">{number}{html}</h1>\n");
        }
        format!(
            "<h{level} id=\"{id}\">{html} <a class=\"anchor\" href=\"#{id}\" \
             aria-label=\"Link to the section {title}\">#</a></h{level}>\n"
        )
    }

    /// A table in a box that can scroll. If the corner cell is empty, the first column names the rows.
    fn table(&mut self, inner: &[Located], alignments: &[Alignment], text: &Text) -> String {
        let mut html = String::from("<div class=\"table\"><table>\n");
        let (mut in_head, mut names_rows, mut column) = (false, false, 0);
        let mut at = 0;
        while at < inner.len() {
            let mut next = at + 1;
            match &inner[at].0 {
                Event::Start(Tag::TableHead) => {
                    (in_head, column) = (true, 0);
                    html.push_str("<thead><tr>");
                }
                Event::End(TagEnd::TableHead) => {
                    in_head = false;
                    html.push_str("</tr></thead>\n<tbody>\n");
                }
                Event::Start(Tag::TableRow) => {
                    column = 0;
                    html.push_str("<tr>");
                }
                Event::End(TagEnd::TableRow) => html.push_str("</tr>\n"),
                Event::Start(Tag::TableCell) => {
                    next = end_of(inner, at);
                    let events = &inner[at + 1..next - 1];
                    let words = plain(events, text);
                    names_rows |= in_head && column == 0 && words.is_empty();
                    let class = match alignments.get(column) {
                        Some(Alignment::Right) => " class=\"right\"",
                        Some(Alignment::Center) => " class=\"center\"",
                        _ => "",
                    };
                    let content = self.events(events, text, true);
                    self.page.words.push(' ');
                    // Not every tool reads a formula as a name; its LaTeX is words.
                    let name = if content.starts_with("<math") {
                        let words = escape(&words);
                        format!(
                            "<span class=\"visually-hidden\">{words}</span>\
                             <span aria-hidden=\"true\">{content}</span>"
                        )
                    } else {
                        content.clone()
                    };
                    html.push_str(&match (in_head, column == 0 && names_rows) {
                        (true, true) => "<td></td>".to_owned(),
                        (true, false) => format!("<th scope=\"col\"{class}>{name}</th>"),
                        (false, true) => format!("<th scope=\"row\"{class}>{name}</th>"),
                        (false, false) => format!("<td{class}>{content}</td>"),
                    });
                    column += 1;
                }
                _ => {}
            }
            at = next;
        }
        html.push_str("</tbody>\n</table></div>\n");
        html
    }

    fn formula(&mut self, latex: &str, layout: Layout, text: &Text, place: Place) -> String {
        let latex = self.substitute(latex, text, Insert::text);
        // A formula that is readable as it is written can be searched for, and belongs into excerpts.
        match latex.contains(['\\', '{', '^', '_', '&']) {
            true => self.page.words.push(' '),
            false => self.page.words.push_str(latex.trim()),
        }
        match mathml(&latex, layout) {
            Ok(html) => symbols::mark(&html, &self.page.symbols),
            Err(message) => {
                self.report(place, format!("formula `{}`: {message}", latex.trim()));
                String::new()
            }
        }
    }

    /// Text with the stand-ins of directives replaced.
    fn text(&mut self, words: &str, text: &Text, out: &mut Vec<Event>) {
        for part in parts(words) {
            match part {
                Part::Words(words) => {
                    self.page.words.push_str(words);
                    out.push(Event::Text(words.to_owned().into()));
                }
                Part::Insert(index) => {
                    let Some(insert) = text.inserts.get(index) else {
                        continue;
                    };
                    if let Insert::Block { .. } | Insert::Opening(_) = insert {
                        let at = text.source.text().find(&stand_ins::of(index));
                        let place = text.source.place(at.unwrap_or(0));
                        self.report(place, "this must stand in a paragraph of its own");
                        continue;
                    }
                    self.page.words.push_str(&insert.text());
                    if let Some(found) = text.found.get(index).filter(|words| !words.is_empty()) {
                        self.page.words.push_str(&format!(" {found} "));
                    }
                    out.push(Event::InlineHtml(insert.html().into()));
                }
            }
        }
    }

    fn substitute(&self, words: &str, text: &Text, form: fn(&Insert) -> String) -> String {
        substitute(words, text.inserts, form)
    }
}

/// The marks right before and behind a formula in a line: browsers may break the line on either side of it,
/// which leaves a bracket or a comma alone.
fn neighbors<'t>(events: &'t [Located], at: usize) -> (&'t str, &'t str) {
    let before = match at.checked_sub(1).map(|before| &events[before].0) {
        Some(Event::Text(words)) => {
            let kept = words.trim_end_matches(['(', '[', '“', '‘']);
            &words[kept.len()..]
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

/// The text of a fence.
fn code_of(fence: &[Located]) -> String {
    let texts = fence.iter().map(|(event, _)| match event {
        Event::Text(code) => code.as_ref(),
        _ => "",
    });
    texts.collect()
}

/// The beginning of a listing or a task, if a paragraph holds nothing else.
fn lone_opening<'t>(inner: &[Located], text: &'t Text) -> Option<&'t Opening> {
    match text.inserts.get(lone_index(inner)?)? {
        Insert::Opening(opening) => Some(opening),
        _ => None,
    }
}

/// The HTML of a paragraph that holds nothing but one block, and what the search finds in it.
fn lone_block<'t>(inner: &[Located], text: &'t Text) -> Option<(&'t str, &'t str)> {
    let index = lone_index(inner)?;
    match text.inserts.get(index)? {
        Insert::Block { html } => Some((html, text.found.get(index)?)),
        _ => None,
    }
}

/// The index of the insert that a paragraph holds, if it holds nothing else.
fn lone_index(inner: &[Located]) -> Option<usize> {
    let mut words = String::new();
    for (event, _) in inner {
        match event {
            Event::Text(part) => words.push_str(part),
            Event::SoftBreak => words.push(' '),
            _ => return None,
        }
    }
    stand_ins::index_of(words.trim())
}

/// The words of a run of events, without marks.
fn plain(events: &[Located], text: &Text) -> String {
    let mut words = String::new();
    for (event, _) in events {
        match event {
            Event::Text(part) | Event::Code(part) | Event::InlineMath(part) => {
                words.push_str(&substitute(part, text.inserts, Insert::text));
            }
            Event::SoftBreak | Event::HardBreak => words.push(' '),
            _ => {}
        }
    }
    words.trim().to_owned()
}

fn callout(kind: BlockQuoteKind, html: &str) -> String {
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
