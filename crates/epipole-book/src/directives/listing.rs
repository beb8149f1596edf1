//! `{{#listing name | Title}}` … `{{/listing}}`: a listing with a tab for each of its fences, its
//! output, and cells of the chapter's notebook.
//!
//! The fences are any of `python numpy`, `python opencv`, `python epipole`, `rust` and `js`, in
//! this order. The tests run each tab and record its output in
//! `listings/<chapter>.<name>.<tab>.txt`. A listing with `picture="description"` writes
//! `result.png`, which is recorded as `<chapter>.<name>.png`.

use crate::html::{escape, path_to_root};
use crate::parse::source::Source;
use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::code::{COPY, Heading, LONGEST_LINE, run_button, shown, take_name};
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::{Block, Fence, Insert, Words};
use crate::render::listing::pre;
use crate::render::notebook::Cell;
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// Tabs: info string of the fence, language, and label on the page.
const TABS: [(&str, &str, &str); 5] = [
    ("numpy", "python", "NumPy"),
    ("opencv", "python", "OpenCV"),
    ("epipole", "python", "Epipole (Python)"),
    ("rust", "rust", "Rust"),
    ("js", "js", "JavaScript"),
];

/// The start of a listing. `T` is the stage of its title.
pub(super) struct Listing<T> {
    name: String,
    /// The title as Markdown.
    written: String,
    title: T,
    /// Alternative text of its picture, if it makes one.
    picture: Option<String>,
    recorded: Recorded,
}

/// Output of a listing, recorded by the tests.
struct Recorded {
    /// `<chapter>.<name>`, the stem of its file names.
    stem: String,
    /// Output of each tab.
    prints: [Option<Source>; TABS.len()],
    picture: Option<Vec<u8>>,
}

impl Directive for Listing<ParsedText> {
    const NAME: &'static str = "listing";
    type Resolved = Listing<Text>;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let name = request.one_word("name | Title")?;
        let Some(title) = &request.body else {
            return Err("write {{#listing name | Title}}".to_owned());
        };
        let chapter = parser.page.trim_end_matches(".html").replace('/', "-");
        let stem = format!("{chapter}.{name}");
        let prints = |(tab, _, _)| parser.content.read(&format!("listings/{stem}.{tab}.txt"));
        let picture = parser.content.path(&format!("listings/{stem}.png"));
        Ok(Listing {
            name: name.to_owned(),
            written: title.text().to_owned(),
            title: parser.text(title),
            picture: request.setting("picture").map(str::to_owned),
            recorded: Recorded {
                prints: TABS.map(prints),
                picture: std::fs::read(picture).ok(),
                stem,
            },
        })
    }

    fn resolve(self, book: &Book) -> Result<Listing<Text>, String> {
        Ok(Listing {
            name: self.name,
            written: self.written,
            title: self.title.resolve(book),
            picture: self.picture,
            recorded: self.recorded,
        })
    }

    fn render(listing: Listing<Text>, page: &mut Writer) -> Insert {
        let heading = Heading {
            name: listing.name,
            title: listing.written,
            html: listing.title.inline(page),
        };
        Insert::Opening(Box::new(Opened {
            heading,
            picture: listing.picture,
            recorded: listing.recorded,
        }))
    }
}

/// A listing before its text and fences.
struct Opened {
    heading: Heading,
    picture: Option<String>,
    recorded: Recorded,
}

/// A tab of a listing.
struct Tab<'a> {
    key: &'static str,
    label: &'static str,
    fence: &'a Fence,
    prints: String,
}

impl Block for Opened {
    fn end(&self) -> &'static str {
        "{{/listing}}"
    }

    fn render(&self, page: &mut Writer, words: Words, fences: &[Fence], place: &Place) -> String {
        if !take_name(page, &self.heading.name, place) {
            return String::new();
        }
        self.html(page, words, fences).unwrap_or_else(|message| {
            page.report(place.clone(), message);
            String::new()
        })
    }
}

impl Opened {
    fn html(&self, page: &mut Writer, words: Words, fences: &[Fence]) -> Result<String, String> {
        let name = &self.heading.name;
        let tabs = self.tabs(page, fences)?;
        if let Some(contradiction) = contradictions(&tabs).first() {
            return Err(format!("listing {name}: {contradiction}"));
        }
        let parts: String = tabs
            .iter()
            .map(|tab| part(page, name, tab, tabs.len()))
            .collect();
        let result = match &self.picture {
            Some(alternative) => self.picture(page, alternative)?,
            None => String::new(),
        };
        self.add_cells(page, &words.markdown, &tabs);
        let runs = tabs.iter().any(|tab| tab.fence.language == "js");
        page.page.has_programs |= runs;
        let run = match runs {
            true => run_button("Run", "<span class=\"run-hint\"> in JavaScript</span>"),
            false => String::new(),
        };
        Ok(format!(
            "<div class=\"listing\" id=\"listing-{name}\" role=\"group\" aria-labelledby=\"listing-{name}-title\">\n\
             <div class=\"listing-bar\"><p class=\"listing-title\" id=\"listing-{name}-title\">{title}</p>{run}{COPY}{chooser}</div>\n\
             <div class=\"listing-words\">{words}</div>{parts}{result}</div>\n",
            words = words.html,
            title = self.heading.html,
            chooser = chooser(name, &tabs),
        ))
    }

    fn tabs<'a>(&self, page: &Writer, fences: &'a [Fence]) -> Result<Vec<Tab<'a>>, String> {
        let name = &self.heading.name;
        let mut tabs: Vec<Tab> = Vec::new();
        let mut last = None;
        for fence in fences {
            let word = match fence.word.as_str() {
                "" if fence.language == "python" => "numpy",
                "" => fence.language.as_str(),
                word => word,
            };
            let known = TABS
                .iter()
                .position(|(key, language, _)| *key == word && *language == fence.language);
            let Some(index) = known else {
                let written = format!("{} {}", fence.language, fence.word);
                return Err(format!(
                    "listing {name}: `{}` is no tab; its fences are `python numpy`, `python opencv`, `python epipole`, `rust`, `js`",
                    written.trim()
                ));
            };
            if last >= Some(index) {
                return Err(format!(
                    "listing {name}: each tab comes once, in the order NumPy, OpenCV, Epipole (Python), Rust, JavaScript"
                ));
            }
            last = Some(index);
            let (key, _, label) = TABS[index];
            let prints = self.recorded.prints(page, index)?;
            tabs.push(Tab {
                key,
                label,
                fence,
                prints,
            });
        }
        match tabs.is_empty() {
            true => Err(format!("listing {name} has no code")),
            false => Ok(tabs),
        }
    }

    /// Renders the picture of the listing, recorded by the tests.
    fn picture(&self, page: &mut Writer, alternative: &str) -> Result<String, String> {
        let file = format!("listings/{}.png", self.recorded.stem);
        let bytes = self.recorded.picture.clone().ok_or_else(|| {
            format!("there is no {file}, the picture it makes: run `make bless-listings`")
        })?;
        let (width, height) = png_size(&bytes).ok_or_else(|| format!("{file} is no PNG"))?;
        let path = page.add_asset(&format!("listing-{}", self.heading.name), "png", bytes);
        Ok(format!(
            "<div class=\"listing-picture\"><img src=\"{root}{path}\" alt=\"{alternative}\" \
             width=\"{width}\" height=\"{height}\" loading=\"lazy\" decoding=\"async\"></div>\n",
            root = path_to_root(&page.page.path),
            alternative = escape(alternative),
        ))
    }

    /// Adds the Python of the listing to the chapter's notebook.
    fn add_cells(&self, page: &mut Writer, markdown: &str, tabs: &[Tab]) {
        let (name, title) = (&self.heading.name, &self.heading.title);
        let head = Cell::text(format!("## {title}\n\n{}", markdown.trim()));
        let mut cells = vec![head];
        let python = tabs.iter().filter(|tab| tab.fence.language == "python");
        for (index, tab) in python.enumerate() {
            if index > 0 {
                cells.push(Cell::text(format!("### With {}", tab.label)));
            }
            cells.push(Cell::Code {
                id: format!("{name}-{}", tab.key),
                source: tab.fence.code.clone(),
                prints: tab.prints.clone(),
                solution: None,
            });
        }
        if cells.len() > 1 {
            page.page.cells.extend(cells);
        }
    }
}

impl Recorded {
    /// Returns the recorded output of a tab; reports lines that are too long.
    fn prints(&self, page: &Writer, tab: usize) -> Result<String, String> {
        let Some(text) = &self.prints[tab] else {
            return Err(format!(
                "there is no listings/{}.{}.txt, which says what it prints: run `make bless-listings`",
                self.stem, TABS[tab].0
            ));
        };
        for (number, line) in text.text().lines().enumerate() {
            if line.chars().count() > LONGEST_LINE {
                let mut place = text.place(0);
                place.line += number;
                let message =
                    format!("a listing prints lines of at most {LONGEST_LINE} characters");
                page.report(place, message);
            }
        }
        Ok(text.text().trim_end().to_owned())
    }
}

/// Renders one of `count` tabs: the code and its output.
fn part(page: &Writer, name: &str, tab: &Tab, count: usize) -> String {
    let code = pre(&shown(tab.fence, page), &tab.fence.language);
    let key = tab.key;
    // The bar already names a single part.
    let own_name = match count {
        1 => String::new(),
        _ => format!("<p class=\"listing-name\">{}</p>\n", tab.label),
    };
    let prints = match tab.prints.as_str() {
        "" => String::new(),
        prints => format!(
            "<div class=\"prints\"><p class=\"prints-name\">It prints</p>\n\
             <pre data-language=\"What it prints\"><samp>{}</samp></pre></div>\n",
            escape(prints)
        ),
    };
    format!(
        "<div class=\"listing-part\" id=\"listing-{name}-{key}\" data-tab=\"{key}\">\n\
         {own_name}{code}{prints}</div>\n"
    )
}

/// Renders the buttons that switch between the tabs.
fn chooser(name: &str, tabs: &[Tab]) -> String {
    if let [only] = tabs {
        return format!("<p class=\"listing-only\">{}</p>", only.label);
    }
    let choices: String = tabs
        .iter()
        .enumerate()
        .map(|(index, tab)| {
            let (key, label, chosen) = (tab.key, tab.label, index == 0);
            let stop = if chosen { "0" } else { "-1" };
            // A narrow screen shows only the text before the parenthesis.
            let words = match label.split_once(" (") {
                Some((word, rest)) => format!("{word}<span class=\"tab-more\"> ({rest}</span>"),
                None => label.to_owned(),
            };
            format!(
                "<button type=\"button\" role=\"tab\" id=\"listing-{name}-{key}-tab\" data-tab=\"{key}\" data-label=\"{label}\" \
                 aria-controls=\"listing-{name}-{key}\" aria-selected=\"{chosen}\" tabindex=\"{stop}\">{words}</button>"
            )
        })
        .collect();
    format!(
        "<div class=\"listing-tabs\" role=\"tablist\" aria-labelledby=\"listing-{name}-title\">{choices}</div>"
    )
}

/// Returns lines such as `depth: 2.00 m` that two tabs print with different values.
fn contradictions(tabs: &[Tab]) -> Vec<String> {
    let mut known: Vec<(&str, &str, &str)> = Vec::new();
    let mut found = Vec::new();
    for tab in tabs {
        let mut own = Vec::new();
        for (what, value) in tab.prints.lines().filter_map(|line| line.split_once(':')) {
            let before = known.iter().find(|(known, ..)| *known == what);
            if let Some((_, other, label)) = before.filter(|(_, other, _)| *other != value) {
                found.push(format!(
                    "{label} prints \"{what}:{other}\" and {} \"{what}:{value}\"",
                    tab.label
                ));
            }
            own.push((what, value, tab.label));
        }
        known.extend(own);
    }
    found
}

/// Reads width and height from the header of a PNG.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let head = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?.get(8..16)?;
    let (width, height) = head.split_at(4);
    let number = |four: &[u8]| four.try_into().ok().map(u32::from_be_bytes);
    Some((number(width)?, number(height)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabs_that_print_the_same_words_print_the_same_values() {
        let fence = Fence {
            language: "python".to_owned(),
            word: String::new(),
            code: String::new(),
            place: Place::new("a.md", 1),
        };
        let tab = |label, prints: &str| Tab {
            key: "numpy",
            label,
            fence: &fence,
            prints: prints.to_owned(),
        };
        let agree = [
            tab("NumPy", "depth: 2 m\nrest: 1"),
            tab("Rust", "depth: 2 m"),
        ];
        assert!(contradictions(&agree).is_empty());
        let differ = [tab("NumPy", "depth: 2 m"), tab("Rust", "depth: 3 m")];
        assert_eq!(
            contradictions(&differ),
            ["NumPy prints \"depth: 2 m\" and Rust \"depth: 3 m\""]
        );
        let third = [
            tab("NumPy", "depth: 2 m"),
            tab("OpenCV", "rest: 1"),
            tab("Epipole (Python)", "rest: 2"),
        ];
        assert_eq!(
            contradictions(&third),
            ["OpenCV prints \"rest: 1\" and Epipole (Python) \"rest: 2\""]
        );
        // A loop may print the same label several times.
        assert!(contradictions(&[tab("NumPy", "Z: 1\nZ: 2")]).is_empty());
    }
}
