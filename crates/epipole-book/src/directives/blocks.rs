//! Blocks of code: `{{#listing name | Title}}` and `{{#task name | Title}}`, each with the words and fences
//! that follow, up to `{{/listing}}` or `{{/task}}`.
//!
//! A listing has a tab for each fence: `python numpy`, `python opencv` and `rust`, in this order, those that
//! there are. What a tab prints is recorded in `listings/<chapter>.<name>.<tab>.txt` by the tests that run it.
//! A listing with `picture="what it shows"` makes `result.png`, which is recorded as `<chapter>.<name>.png`.
//! A task has the fences `python start`, `python check` and `python solution`.

use crate::html::{escape, path_to_root};
use crate::problems::{Place, name_list};
use crate::render::listing::{pre, shown_lines};
use crate::render::markdown::Renderer;
use crate::render::notebook::Cell;

/// What a reader sees of a line of code, in characters; more makes even a wide page scroll.
const LONGEST_LINE: usize = 66;

/// The tabs: as a fence names them, their languages, and as the page calls them.
const TABS: [(&str, &str, &str); 3] = [
    ("numpy", "python", "NumPy"),
    ("opencv", "python", "OpenCV"),
    ("rust", "rust", "Rust"),
];

/// The fences of a task.
const TASK: [&str; 3] = ["start", "check", "solution"];

/// Which of the two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Listing,
    Task,
}

impl Kind {
    /// What ends it.
    pub(crate) fn end(self) -> &'static str {
        match self {
            Kind::Listing => "{{/listing}}",
            Kind::Task => "{{/task}}",
        }
    }
}

/// How a block begins.
#[derive(Debug, Clone)]
pub(crate) struct Opening {
    pub(crate) kind: Kind,
    pub(crate) name: String,
    pub(crate) title: String,
    /// The title as HTML.
    pub(crate) html: String,
    /// What the picture of the result shows, if the listing makes one.
    pub(crate) picture: Option<String>,
}

/// A fence inside a block.
pub(crate) struct Fence {
    pub(crate) language: String,
    pub(crate) word: String,
    pub(crate) code: String,
    /// The line of the fence itself.
    pub(crate) place: Place,
}

impl Fence {
    /// What a page shows; lines that are too long are reported.
    fn shown(&self, renderer: &Renderer) -> String {
        let mut shown = String::new();
        for (number, line) in shown_lines(&self.code, &self.language) {
            let length = line.chars().count();
            if length > LONGEST_LINE {
                let mut place = self.place.clone();
                place.line += number + 1;
                renderer.report(
                    place,
                    format!("{length} characters: a line of a listing has at most {LONGEST_LINE}"),
                );
            }
            shown.push_str(line);
            shown.push('\n');
        }
        shown
    }
}

/// What a block becomes: HTML, and cells of the chapter's notebook. `words` is what stands before the
/// fences, as HTML and as Markdown.
pub(crate) fn block(
    renderer: &mut Renderer,
    opening: &Opening,
    words: (String, String),
    fences: &[Fence],
    place: &Place,
) -> String {
    let known = &mut renderer.page.listings;
    let name = &opening.name;
    let is_name =
        |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
    if known.contains(name) || !name.chars().all(is_name) {
        let message =
            format!("\"{name}\": a listing needs a name of its own, of small letters and hyphens");
        renderer.report(place.clone(), message);
        return String::new();
    }
    known.push(name.clone());
    let done = match opening.kind {
        Kind::Listing => listing(renderer, opening, words, fences),
        Kind::Task => task(renderer, opening, words, fences),
    };
    done.unwrap_or_else(|message| {
        renderer.report(place.clone(), message);
        String::new()
    })
}

/// A tab of a listing.
struct Tab<'a> {
    key: &'static str,
    label: &'static str,
    fence: &'a Fence,
    prints: String,
}

fn tabs<'a>(renderer: &Renderer, name: &str, fences: &'a [Fence]) -> Result<Vec<Tab<'a>>, String> {
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
                "listing {name}: `{}` is no tab; its fences are `python numpy`, `python opencv`, `rust`",
                written.trim()
            ));
        };
        if last >= Some(index) {
            return Err(format!(
                "listing {name}: each tab comes once, in the order NumPy, OpenCV, Rust"
            ));
        }
        last = Some(index);
        let (key, _, label) = TABS[index];
        let prints = recorded(renderer, name, key)?;
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

/// What the tests have seen this tab print.
fn recorded(renderer: &Renderer, name: &str, key: &str) -> Result<String, String> {
    let file = format!("listings/{}.{name}.{key}.txt", chapter(renderer));
    let Some(text) = renderer.shared.read(&file) else {
        return Err(format!(
            "there is no {file}, which says what it prints: run `make bless-listings`"
        ));
    };
    for (number, line) in text.text().lines().enumerate() {
        if line.chars().count() > LONGEST_LINE {
            let place = renderer.shared.place(&file, number + 1);
            let message = format!("a listing prints lines of at most {LONGEST_LINE} characters");
            renderer.report(place, message);
        }
    }
    Ok(text.text().trim_end().to_owned())
}

/// Lines such as `depth: 2.00 m` that two tabs print with the same words and different values.
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

fn listing(
    renderer: &mut Renderer,
    opening: &Opening,
    (words, markdown): (String, String),
    fences: &[Fence],
) -> Result<String, String> {
    let name = &opening.name;
    let tabs = tabs(renderer, name, fences)?;
    if let Some(contradiction) = contradictions(&tabs).first() {
        return Err(format!("listing {name}: {contradiction}"));
    }
    let mut parts = String::new();
    for tab in &tabs {
        let code = pre(&tab.fence.shown(renderer), &tab.fence.language);
        let key = tab.key;
        // Where there is one part only, the bar names it.
        let own_name = match tabs.len() {
            1 => String::new(),
            _ => format!("<p class=\"listing-name\">{}</p>\n", tab.label),
        };
        parts.push_str(&format!(
            "<div class=\"listing-part\" id=\"listing-{name}-{key}\" data-tab=\"{key}\">\n\
             {own_name}{code}{}</div>\n",
            printed(&tab.prints)
        ));
    }
    let result = match &opening.picture {
        Some(alternative) => picture(renderer, name, alternative)?,
        None => String::new(),
    };
    let choices: String = tabs
        .iter()
        .enumerate()
        .map(|(index, tab)| {
            let (key, label, chosen) = (tab.key, tab.label, index == 0);
            let stop = if chosen { "0" } else { "-1" };
            format!(
                "<button type=\"button\" role=\"tab\" id=\"listing-{name}-{key}-tab\" data-tab=\"{key}\" data-label=\"{label}\" \
                 aria-controls=\"listing-{name}-{key}\" aria-selected=\"{chosen}\" tabindex=\"{stop}\">{label}</button>"
            )
        })
        .collect();
    let chooser = match tabs.len() {
        1 => format!("<p class=\"listing-only\">{}</p>", tabs[0].label),
        _ => format!(
            "<div class=\"listing-tabs\" role=\"tablist\" aria-labelledby=\"listing-{name}-title\">{choices}</div>"
        ),
    };

    let mut cells = vec![Cell::text(format!(
        "## {}\n\n{}",
        opening.title,
        markdown.trim()
    ))];
    let python: Vec<&Tab> = tabs.iter().filter(|tab| tab.key != "rust").collect();
    for (index, tab) in python.iter().enumerate() {
        if index > 0 {
            cells.push(Cell::text(format!("### With {}", tab.label)));
        }
        cells.push(Cell::Code {
            id: format!("{name}-{}", tab.key),
            source: tab.fence.code.clone(),
            prints: tab.prints.clone(),
        });
    }
    if !python.is_empty() {
        renderer.page.cells.extend(cells);
    }
    Ok(format!(
        "{words}<div class=\"listing\" id=\"listing-{name}\" role=\"group\" aria-labelledby=\"listing-{name}-title\">\n\
         <div class=\"listing-bar\"><p class=\"listing-title\" id=\"listing-{name}-title\">{title}</p>{chooser}{COPY}</div>\n\
         {parts}{result}</div>\n",
        title = opening.html,
    ))
}

/// The picture that the tests have seen the listing make.
fn picture(renderer: &Renderer, name: &str, alternative: &str) -> Result<String, String> {
    let file = format!("listings/{}.{name}.png", chapter(renderer));
    let bytes = std::fs::read(renderer.shared.path(&file)).map_err(|_| {
        format!("there is no {file}, the picture it makes: run `make bless-listings`")
    })?;
    let (width, height) = png_size(&bytes).ok_or_else(|| format!("{file} is no PNG"))?;
    let path = renderer
        .shared
        .add_asset(&format!("listing-{name}"), "png", bytes);
    Ok(format!(
        "<div class=\"listing-picture\"><img src=\"{root}{path}\" alt=\"{alternative}\" \
         width=\"{width}\" height=\"{height}\" loading=\"lazy\" decoding=\"async\"></div>\n",
        root = path_to_root(&renderer.page.path),
        alternative = escape(alternative),
    ))
}

/// Width and height as the head of a PNG has them.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let head = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?.get(8..16)?;
    let (width, height) = head.split_at(4);
    let number = |four: &[u8]| four.try_into().ok().map(u32::from_be_bytes);
    Some((number(width)?, number(height)?))
}

/// The chapter as the names of its recorded files have it.
fn chapter(renderer: &Renderer) -> String {
    let path = renderer.page.path.trim_end_matches(".html");
    path.replace('/', "-")
}

/// The button that copies what is in sight; a script brings it to life.
const COPY: &str = "<button type=\"button\" class=\"copy\" hidden>Copy</button>";

fn printed(prints: &str) -> String {
    match prints {
        "" => String::new(),
        prints => format!(
            "<div class=\"prints\"><p class=\"prints-name\">It prints</p>\n\
             <pre data-language=\"What it prints\"><samp>{}</samp></pre></div>\n",
            escape(prints)
        ),
    }
}

fn task(
    renderer: &mut Renderer,
    opening: &Opening,
    (words, markdown): (String, String),
    fences: &[Fence],
) -> Result<String, String> {
    let name = &opening.name;
    let found: Vec<&str> = fences.iter().map(|fence| fence.word.as_str()).collect();
    if found != TASK || fences.iter().any(|fence| fence.language != "python") {
        let wanted: Vec<String> = TASK.iter().map(|word| format!("python {word}")).collect();
        return Err(format!("task {name} has the fences {}", name_list(&wanted)));
    }
    let [start, check, solution] = fences else {
        return Ok(String::new());
    };
    let shown = pre(&start.shown(renderer), "python");
    let solved = pre(&solution.shown(renderer), "python");
    let cell = |word: &str, fence: &Fence| Cell::Code {
        id: format!("{name}-{word}"),
        source: fence.code.clone(),
        prints: String::new(),
    };
    renderer.page.cells.extend([
        Cell::text(format!(
            "## Your turn: {}\n\n{}",
            opening.title,
            markdown.trim()
        )),
        cell("start", start),
        Cell::text("The next cell looks at your function and says what is missing.".to_owned()),
        cell("check", check),
    ]);
    let (file, root) = (
        crate::render::notebook::path(&renderer.page.path),
        path_to_root(&renderer.page.path),
    );
    Ok(format!(
        "{words}<div class=\"listing task\" id=\"task-{name}\" role=\"group\" aria-labelledby=\"task-{name}-title\">\n\
         <div class=\"listing-bar\"><p class=\"listing-title\" id=\"task-{name}-title\">{title}</p>\
         <p class=\"listing-only\">Python</p>{COPY}</div>\n\
         <div class=\"listing-part\">\n{shown}</div>\n</div>\n\
         <p>Write it in <a href=\"{root}{file}\" download>the notebook</a>. The cell below it says what is wrong.</p>\n\
         <details><summary>Solution</summary>\n{solved}</details>\n",
        title = opening.html,
    ))
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
        // A loop may print the same words several times.
        assert!(contradictions(&[tab("NumPy", "Z: 1\nZ: 2")]).is_empty());
    }
}
