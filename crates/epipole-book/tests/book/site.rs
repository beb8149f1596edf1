//! The site as a whole: its links, its search, its files.

use crate::tiny::Book;
use epipole_book::html::forbidden_inline;
use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn the_lab_stays_where_it_is_when_the_book_is_built_again() {
    let book = Book::of_chapter("# A title\n\nWords.\n");
    book.must_build();
    book.write("target/book/old.html", "an old page");
    // In place of the page that stands there until the Lab is built, with its mark.
    fs::remove_dir_all(book.out().join("lab")).unwrap();
    book.write("target/book/lab/index.html", "the Lab");
    book.must_build();
    assert_eq!(book.page("lab/index.html"), "the Lab");
    assert!(!book.out().join("old.html").exists());
}

#[test]
fn the_manual_becomes_a_part_of_the_site_and_of_its_search() {
    let mut book = Book::of_chapter("# A title\n\nWords.\n");
    book.must_build();
    assert!(!book.page("one.html").contains("python/index.html"));
    for (path, text) in [
        ("index.html", "<p>Quick start"),
        ("reference/camera.html", "<p>Cameras"),
        (
            "search/sections.json",
            r##"[{"u":"reference/camera.html#lens","c":"Python: camera","t":"Lens","w":"A lens"}]"##,
        ),
    ] {
        book.write(&format!("manual/{path}"), text);
    }
    book.manual = Some(book.path("manual"));
    book.must_build();
    assert_eq!(book.page("python/reference/camera.html"), "<p>Cameras");
    assert!(book.page("one.html").contains("\"python/index.html\""));
    let assets = fs::read_dir(book.out().join("assets")).unwrap();
    let mut names = assets.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let index = names.find(|name| name.starts_with("search-") && name.ends_with(".json"));
    let index = book.page(&format!("assets/{}", index.unwrap()));
    assert!(
        index.contains("one.html") && index.contains("python/reference/camera.html#lens"),
        "{index}"
    );

    book.manual = Some(book.path("nothing"));
    let error = format!("{:#}", book.try_build().unwrap_err());
    assert!(error.contains("make python-docs"), "{error}");
}

#[test]
fn the_reference_of_the_npm_package_becomes_a_part_of_the_site() {
    let mut book = Book::of_chapter("# A title\n\nWords.\n");
    book.must_build();
    assert!(!book.page("one.html").contains("js/index.html"));
    book.write("reference/index.html", "<p>Epipole for JavaScript");
    book.write("reference/classes/Vision.html", "<p>Functions");
    book.js_reference = Some(book.path("reference"));
    book.must_build();
    assert_eq!(book.page("js/classes/Vision.html"), "<p>Functions");
    assert!(book.page("one.html").contains("\"js/index.html\""));
    assert!(!book.page("one.html").contains("python/index.html"));

    book.js_reference = Some(book.path("nothing"));
    let error = format!("{:#}", book.try_build().unwrap_err());
    assert!(error.contains("make vision-docs"), "{error}");
}

#[test]
fn links_to_the_lab_are_not_dead_while_there_is_no_lab() {
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](part/one.md)\n"),
        (
            "part/one.md",
            "# One\n\n[Try it](../lab/?step=matches&ratio=0.8).\n",
        ),
    ]);
    for _ in 0..2 {
        book.must_build();
        let article = book.article("part/one.html");
        assert!(
            article.contains("href=\"../lab/index.html?step=matches&amp;ratio=0.8\""),
            "{article}"
        );
        let contents = book.page("part/one.html");
        assert!(
            contents.contains("<a href=\"../lab/index.html\">"),
            "{contents}"
        );
        let placeholder = book.page("lab/index.html");
        assert!(placeholder.contains("make lab"), "{placeholder}");
        assert!(
            placeholder.contains("<a href=\"../part/one.html\">"),
            "{placeholder}"
        );
    }
    let book = Book::of_chapter("# One\n\n[Try it](lab/nothing.html).\n");
    assert_eq!(book.problems().len(), 1);
}

#[test]
fn the_search_finds_captions_notes_and_quizzes_in_their_sections_and_fuses_no_words() {
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](one.md)\n"),
        (
            "one.md",
            "# One\n\n## A\n\n{{#figure dot | A caption.}}\n\nThen $p$, *so*.\n\n- x\n- y\n\n## B\n\nEnd{{#note | Aside.}} here.\n\n{{#quiz q}}\n",
        ),
        (
            "quizzes/q.toml",
            "[[question]]\nid = 'a'\nprompt = 'Why?'\nexplanation = 'E.'\n\
             choices = [{ text = 'yes', right = true }, { text = 'no' }]\n",
        ),
    ]);
    book.must_build();
    let index = files_below(&book.out()).into_iter().find(|path| {
        path.file_name().is_some_and(|name| {
            name.to_string_lossy().starts_with("search-")
                && path.extension().is_some_and(|e| e == "json")
        })
    });
    let index = fs::read_to_string(index.unwrap()).unwrap();
    for part in [
        "A \\\"dot\\\" of size 3. A caption. Then p, so. x y",
        "End Aside. here. ",
        "Why? ",
    ] {
        assert!(index.contains(part), "{part}: {index}");
    }
    let place = |words: &str| index.find(words).unwrap();
    assert!(
        place("A caption.") < place("#b") && place("Why?") > place("Aside."),
        "{index}"
    );
    assert!(
        !index.contains("yesno") && !index.contains("noyes"),
        "{index}"
    );
}

/// All files below a folder.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files_below(&path));
        } else {
            found.push(path);
        }
    }
    found
}

/// Every `href`, `src` and `srcset` of a page.
fn addresses(html: &str) -> Vec<String> {
    let mut found = Vec::new();
    for attribute in [" href=\"", " src=\"", " srcset=\"", " data-index=\""] {
        found.extend(
            html.split(attribute)
                .skip(1)
                .map(|rest| rest.split('"').next().unwrap_or("").to_owned()),
        );
    }
    found
}

#[test]
fn the_site_works_below_any_path_and_holds_no_inline_code() {
    let book = Book::new(&[
        (
            "SUMMARY.md",
            "[Start](index.md)\n\n- [One](part/one.md)\n- [Two](two.md)\n",
        ),
        (
            "index.md",
            "# Start\n\n[One](part/one.md), {{#ref fig-dot}}, ![dot](dot.svg)\n",
        ),
        (
            "part/one.md",
            "# One\n\n{{#figure dot | C.}}\n\n[Two](../two.md#t), [data](../data.csv)\n\n$$x^2$$\n",
        ),
        ("two.md", "# Two\n\n## T\n\n[home](index.md)\n"),
        ("dot.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>"),
        ("data.csv", "1"),
    ]);
    book.must_build();
    let out = book.out();
    let mut checked = 0;
    for file in files_below(&out)
        .iter()
        .filter(|path| path.extension().is_some_and(|e| e == "html"))
    {
        let html = fs::read_to_string(file).unwrap();
        assert_eq!(forbidden_inline(&html), None, "{}", file.display());
        assert!(html.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src"));
        for address in addresses(&html) {
            if address.starts_with('#') || address.is_empty() {
                continue;
            }
            assert!(
                !address.starts_with('/') && !address.contains(':'),
                "{address}"
            );
            let path = file
                .parent()
                .unwrap()
                .join(address.split('#').next().unwrap());
            // Without assets the style sheet, scripts and icon are empty names: the folder itself.
            assert!(path.exists(), "{} → {address}", file.display());
            checked += 1;
        }
    }
    assert!(checked >= 36, "{checked}");
    assert!(out.join("part/one.html.br").is_file() && out.join("part/one.html.gz").is_file());
}

#[test]
fn a_second_build_replaces_the_first() {
    let book = Book::of_chapter("# One\n\nOld.\n");
    book.must_build();
    fs::write(book.out().join("stale.html"), "x").unwrap();
    book.write("content/one.md", "# One\n\nNew.\n");
    book.must_build();
    assert!(!book.out().join("stale.html").exists());
    assert!(book.article("one.html").contains("New."));
    assert!(!book.out().with_extension("next").exists());
}

#[test]
fn a_published_book_can_be_installed() {
    let book = Book::of_chapter("# One\n\nWords.\n");
    book.must_build();
    let link = "<link rel=\"manifest\" href=\"manifest.webmanifest\">";
    assert!(book.page("one.html").contains(link));
    let manifest = book.page("manifest.webmanifest");
    for part in [
        "\"name\":\"Tiny\"",
        "\"start_url\":\"index.html\"",
        "\"lang\":\"en\"",
    ] {
        assert!(manifest.contains(part), "{part}: {manifest}");
    }
}
