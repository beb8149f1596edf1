//! Renders Markdown to HTML: placeholders replace directives while Markdown is parsed, and are
//! replaced by the directives' HTML afterwards.

use super::blocks::{code_of, collect, single_block, single_opening};
use super::insert::{Block, Insert, Words, substitute};
use super::links;
use super::listing::listing;
use super::math::{self, Layout, mathml};
use super::page::Heading;
use super::symbols;
use super::tables;
use super::words::{callout, neighbors, plain};
use super::writer::Writer;
use crate::html::{escape, forbidden_inline, slug};
use crate::parse::events::{Located, end_of, section_starts, take_footnotes};
use crate::parse::placeholders::{self, Part, parts};
use crate::parse::source::Source;
use crate::parse::syntax::markdown_options;
use crate::problems::Place;
use pulldown_cmark::{CowStr, Event, Parser, Tag, TagEnd};
use std::collections::HashMap;

/// Markdown with placeholders, and their inserts.
pub(crate) struct Markdown {
    pub(crate) source: Source,
    pub(crate) inserts: Vec<Insert>,
    /// Text of each insert for the search index: captions, notes, quizzes.
    pub(crate) found: Vec<String>,
}

/// Context of the events of a text.
struct Text<'a> {
    source: &'a Source,
    inserts: &'a [Insert],
    found: &'a [String],
    footnotes: HashMap<CowStr<'a>, Vec<Located<'a>>>,
}

/// Renders a text with paragraphs, headings and other blocks.
pub(crate) fn block(markdown: &Markdown, page: &mut Writer) -> String {
    let (events, text) = parsed(markdown);
    let starts = section_starts(&events);
    let mut html = page.events(&events[..starts[0]], &text, false);
    for bounds in starts.windows(2) {
        let section = page.events(&events[bounds[0]..bounds[1]], &text, false);
        html.push_str(&format!("<section>\n{section}</section>\n"));
    }
    html
}

/// Renders a text inside a paragraph, such as a caption.
pub(crate) fn inline(markdown: &Markdown, page: &mut Writer) -> String {
    let (events, text) = parsed(markdown);
    let html = page.events(&events, &text, true);
    page.page.words.push(' ');
    html
}

fn parsed(markdown: &Markdown) -> (Vec<Located<'_>>, Text<'_>) {
    let Markdown {
        source,
        inserts,
        found,
    } = markdown;
    let parser = Parser::new_ext(source.text(), markdown_options());
    let mut events: Vec<Located> = parser.into_offset_iter().collect();
    let footnotes = take_footnotes(&mut events);
    let text = Text {
        source,
        inserts,
        found,
        footnotes,
    };
    (events, text)
}

impl Writer<'_> {
    /// Renders a range of events. `tight` omits the tags of paragraphs.
    fn events(&mut self, events: &[Located], text: &Text, tight: bool) -> String {
        let mut out: Vec<Event> = Vec::new();
        // Length of the punctuation after a formula that is already written, bytes of the next
        // text.
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
                    if let Some(opening) = single_opening(inner, text.inserts) {
                        let (html, end) = self.code_block(opening, events, next, text, place());
                        next = end;
                        out.push(Event::Html(html.into()));
                    } else if let Some((block, words)) =
                        single_block(inner, text.inserts, text.found)
                    {
                        self.page.words.push_str(&format!(" {words} "));
                        out.push(Event::Html(block.to_owned().into()));
                    } else {
                        self.page.describe(|| plain(inner, text.inserts));
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
                    let html = {
                        let inner = &events[at + 1..next - 1];
                        tables::table(inner, alignments, &mut |cell| {
                            let html = self.events(cell, text, true);
                            self.page.words.push(' ');
                            (html, plain(cell, text.inserts))
                        })
                    };
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
                    let alternative = plain(&events[at + 1..next - 1], text.inserts);
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
                    let code = substitute(code, text.inserts, Insert::text);
                    self.page.words.push_str(&code);
                    out.push(Event::Code(code.into()));
                }
                Event::Html(html) | Event::InlineHtml(html) => {
                    if let Some(offence) = forbidden_inline(html) {
                        let message = format!("{offence}: pages hold no inline scripts and styles");
                        self.report(place(), message);
                    }
                    let html = substitute(html, text.inserts, Insert::html);
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
                    // For example the end of a list item. Only emphasis and links end within a
                    // word.
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

    /// Renders a block between two directives that begins before `from`. Returns the HTML and the
    /// index after its end.
    fn code_block(
        &mut self,
        opening: &dyn Block,
        events: &[Located],
        from: usize,
        text: &Text,
        place: Place,
    ) -> (String, usize) {
        let end = opening.end();
        let is_end = |paragraph: &[Located]| plain(paragraph, text.inserts) == end;
        let collected = collect(events, from, text.source, is_end);
        let mut words = Words::default();
        for inner in collected.words {
            let source = &text.source.text()[events[inner.start].1.clone()];
            words
                .html
                .push_str(&self.events(&events[inner], text, false));
            let source = substitute(source, text.inserts, Insert::text);
            words.markdown.push_str(&source);
            words.markdown.push_str("\n\n");
        }
        for stray in collected.strays {
            let message = "in a listing or a task words come first and fences after them";
            self.report(stray, message);
        }
        let html = match collected.is_closed {
            true => opening.render(self, words, &collected.fences, &place),
            false => {
                self.report(place, format!("this has no {end}"));
                String::new()
            }
        };
        (html, collected.next)
    }

    fn heading(&mut self, level: u8, id: Option<&str>, inner: &[Located], text: &Text) -> String {
        let title = plain(inner, text.inserts);
        let wanted = id.map_or_else(|| slug(&title), str::to_owned);
        let mut id = wanted.clone();
        let mut count = 1;
        while self.page.headings.iter().any(|heading| heading.id == id) {
            id = format!("{wanted}-{count}");
            count += 1;
        }
        self.page.start_section(&id, &title);
        let html = self.events(inner, text, true);
        // The search displays the title separately from the text of its section.
        self.page.words.clear();
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

    fn formula(&mut self, latex: &str, layout: Layout, text: &Text, place: Place) -> String {
        let latex = substitute(latex, text.inserts, Insert::text);
        match mathml(&latex, layout) {
            Ok(html) => {
                let words = math::words(&html);
                self.page.words.push_str(&match layout {
                    Layout::Inline => words,
                    Layout::Display => format!(" {words} "),
                });
                symbols::mark(&html, self.symbols)
            }
            Err(message) => {
                self.report(place, format!("formula `{}`: {message}", latex.trim()));
                String::new()
            }
        }
    }

    /// Emits text with the placeholders of directives replaced.
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
                        let at = text.source.text().find(&placeholders::of(index));
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
}
