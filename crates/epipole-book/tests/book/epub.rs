//! The EPUB file: that of a small book, and, when asked, that of the whole.

use crate::tiny::Book;
use scraper::{ElementRef, Html, Selector};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use zip::ZipArchive;

const CHAPTER: &str = "# One\n\n## Rays of *light*\n\nSee {{#ref fig-dot}}, [two](part/two.md#end) and [all](all.md).\n\
    $a < b$<br>\n\n{{#figure dot | First.}}\n\n| |a|\n|-|-|\n|b|1 & 2|\n\n\
    1. Why?\n\n   <details><summary>Hint</summary>\n\n   Look at [the end](part/two.md#end).\n\n   </details>\n\n\
    {{#quiz rays}}\n";

fn small() -> Book {
    Book::new(&[
        (
            "book.toml",
            "[book]\ntitle = \"Tiny & small\"\nauthors = [\"A\"]\nsrc = \".\"\n\
             [output.epipole]\nnot-printed = [\"all.md\"]\n",
        ),
        (
            "SUMMARY.md",
            "# Contents\n\n# Part & one\n\n- [One](one.md)\n- [Two](part/two.md)\n\n---\n\n[All](all.md)\n",
        ),
        ("one.md", CHAPTER),
        (
            "part/two.md",
            "# Two\n\n## The end {#end}\n\n[Back](../one.md)\n",
        ),
        ("all.md", "# All\n\n{{#gallery}}\n"),
        (
            "quizzes/rays.toml",
            "[[question]]\nid = 'a'\nprompt = 'P?'\nexplanation = 'E.'\n\
             choices = [{ text = 'yes', right = true }, { text = 'no' }]\n",
        ),
    ])
}

#[test]
fn a_book_becomes_pages_of_xhtml() {
    let book = small();
    let file = book.epub(Some("https://a.example/book"));
    let bytes = fs::read(&file).unwrap();
    let files = files(&file);
    check(&files);
    let one = &files["book/one.xhtml"];
    for part in [
        "<h2 id=\"rays-of-light\">Rays of <em>light</em> </h2>",
        "<a class=\"ref\" href=\"#fig-dot\">Figure 1.1</a>",
        "<a href=\"part/two.xhtml#end\">two</a>",
        "<a href=\"https://a.example/book/all.html\">all</a>",
        "alttext=\"a &lt; b\"",
        "<br/>",
        "alt=\"A &quot;dot&quot; of size 3.\" width=\"1440\" height=\"20\"/>",
        "href=\"https://a.example/book/one.html#fig-dot\">Live on the web</a></figcaption>",
        "<td>1 &amp; 2</td>",
        "<a href=\"answers.xhtml#answer-1\">Hint</a>",
        "<ul class=\"choices\">",
    ] {
        assert!(one.contains(part), "{part}: {one}");
    }
    let answers = &files["book/answers.xhtml"];
    for part in [
        "<h2 id=\"of-one\">1 One</h2>",
        "<a href=\"one.xhtml#to-answer-1\">Exercise 1</a>",
        "<em>Hint. </em>Look at <a href=\"part/two.xhtml#end\">the end</a>.",
        "<strong>yes</strong>",
    ] {
        assert!(answers.contains(part), "{part}: {answers}");
    }
    let contents = &files["book/contents.xhtml"];
    for part in [
        "<span>Part &amp; one</span>",
        "<a href=\"one.xhtml#rays-of-light\">Rays of light</a>",
        "<a href=\"part/two.xhtml\">2 Two</a>",
    ] {
        assert!(contents.contains(part), "{part}: {contents}");
    }
    let package = &files["book/package.opf"];
    for part in [
        "<dc:title>Tiny &amp; small</dc:title>",
        "<meta property=\"dcterms:modified\">2026-01-31T12:00:00Z</meta>",
        "href=\"one.xhtml\" media-type=\"application/xhtml+xml\" properties=\"mathml\"/>",
        "media-type=\"image/jpeg\" properties=\"cover-image\"/>",
    ] {
        assert!(package.contains(part), "{part}: {package}");
    }
    assert!(!files.contains_key("book/all.xhtml"));
    assert_eq!(
        fs::read(book.epub(Some("https://a.example/book"))).unwrap(),
        bytes
    );
}

#[test]
fn without_an_address_nothing_leads_to_the_web() {
    let files = files(&small().epub(None));
    check(&files);
    for (path, text) in &files {
        assert!(!text.contains("href=\"http"), "{path}: {text}");
    }
    assert!(files["book/one.xhtml"].contains(" and all."));
}

/// All of `content/` is in the file that `make epub` wrote.
#[test]
#[ignore = "needs the whole book: make test-epub"]
fn the_whole_book_is_there() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let file = project.join("target/epub/epipole.epub");
    let size = fs::metadata(&file).unwrap().len();
    assert!(size <= 25_000_000, "{size} bytes");
    let files = files(&file);
    check(&files);
    let content = project.join("content");
    let summary = fs::read_to_string(content.join("SUMMARY.md")).unwrap();
    let pages = summary.split("](").skip(1);
    let pages: Vec<&str> = pages
        .map(|rest| rest.split(".md)").next().unwrap())
        .collect();
    let left_out = ["gallery", "progress"];
    let mut counts = (0, 0, 0);
    for page in pages.iter().filter(|page| !left_out.contains(page)) {
        let written = fs::read_to_string(content.join(format!("{page}.md"))).unwrap();
        let xhtml = Html::parse_document(&files[&format!("book/{page}.xhtml")]);
        let headings: Vec<String> = all(&xhtml, "h1, h2, h3, h4").map(text).collect();
        let wanted = headings_of(&written);
        assert_eq!(
            headings.len(),
            wanted.len(),
            "{page}: {headings:#?} {wanted:#?}"
        );
        for (heading, wanted) in headings.iter().zip(&wanted) {
            assert!(
                letters(heading).contains(&letters(wanted)),
                "{page}: \"{heading}\" is not \"{wanted}\""
            );
        }
        let figures = all(&xhtml, "figure.epipole > img").count();
        let wanted = written
            .lines()
            .filter(|line| line.starts_with("{{#figure "))
            .count();
        assert_eq!(figures, wanted, "figures of {page}");
        let formulas = all(&xhtml, "math[alttext]").count();
        counts = (
            counts.0 + headings.len(),
            counts.1 + figures,
            counts.2 + formulas,
        );
    }
    let (headings, figures, formulas) = counts;
    println!("{headings} headings, {figures} figures, {formulas} formulas, {size} bytes");
    assert!(
        headings > 100 && figures > 80 && formulas > 900,
        "{counts:?}"
    );
}

/// Beginnings of the headings of a chapter, up to their first mark.
fn headings_of(markdown: &str) -> Vec<String> {
    let mut is_code = false;
    let lines = markdown.lines().filter(|line| {
        is_code ^= line.starts_with("```");
        !is_code
    });
    let headings = lines.filter_map(|line| {
        line.trim_start_matches('#')
            .strip_prefix(' ')
            .filter(|_| line.starts_with('#'))
    });
    headings
        .map(|words| {
            words
                .split(['$', '*', '{', '`', '['])
                .next()
                .unwrap()
                .trim()
                .to_owned()
        })
        .collect()
}

/// Texts of the file by their paths; others are empty.
fn files(file: &Path) -> BTreeMap<String, String> {
    let mut archive = ZipArchive::new(File::open(file).unwrap()).unwrap();
    let mut files = BTreeMap::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).unwrap();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap_or_default();
        files.insert(file.name().to_owned(), text);
    }
    files
}

/// Checks that nothing runs, every picture has its words, and every link leads somewhere.
fn check(files: &BTreeMap<String, String>) {
    let package = Html::parse_document(&files["book/package.opf"]);
    let listed: Vec<&str> = all(&package, "item[href]")
        .filter_map(|item| item.attr("href"))
        .collect();
    for path in files.keys().filter_map(|path| path.strip_prefix("book/")) {
        assert!(
            path == "package.opf" || listed.contains(&path),
            "{path} is not listed"
        );
    }
    assert!(
        listed
            .iter()
            .all(|path| files.contains_key(&format!("book/{path}")))
    );
    let pages = files.iter().filter(|(path, _)| path.ends_with(".xhtml"));
    let pages: BTreeMap<&str, Html> = pages
        .map(|(path, text)| (path.as_str(), Html::parse_document(text)))
        .collect();
    for (path, page) in &pages {
        assert_eq!(
            all(page, "script, form, input, template, [style], [onclick]").count(),
            0,
            "{path}"
        );
        let resolved = |link: &str| {
            let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
            let mut parts: Vec<&str> = folder.split('/').collect();
            for part in link.split('/') {
                match part {
                    ".." => drop(parts.pop()),
                    part => parts.push(part),
                }
            }
            parts.join("/")
        };
        for image in all(page, "img") {
            assert!(image.attr("alt").is_some(), "{path}: {}", image.html());
            assert!(files.contains_key(&resolved(image.attr("src").unwrap())));
        }
        for link in all(page, "a") {
            let href = link
                .attr("href")
                .unwrap_or_else(|| panic!("{path}: {}", link.html()));
            if href.starts_with("https://") {
                continue;
            }
            let (file, anchor) = href.split_once('#').unwrap_or((href, ""));
            let target = match file {
                "" => (*path).to_owned(),
                file => resolved(file),
            };
            let target = pages
                .get(target.as_str())
                .unwrap_or_else(|| panic!("{path}: {href}"));
            let is_there = all(target, "[id]").any(|element| element.attr("id") == Some(anchor));
            assert!(
                anchor.is_empty() || is_there,
                "{path}: {href} leads nowhere"
            );
        }
    }
}

fn all<'a>(page: &'a Html, selector: &str) -> impl Iterator<Item = ElementRef<'a>> {
    let found: Vec<ElementRef> = page.select(&Selector::parse(selector).unwrap()).collect();
    found.into_iter()
}

fn letters(text: &str) -> String {
    text.chars()
        .filter(|letter| letter.is_alphanumeric())
        .collect()
}

fn text(element: ElementRef) -> String {
    element.text().collect()
}
