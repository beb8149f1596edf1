//! Small books in temporary folders: what comes out, and what each mistake says.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use epipole_book::figures::{Figure, Gallery, Poster, Room};
use epipole_book::html::forbidden_inline;
use epipole_book::problems::Place;
use epipole_book::rhythm::stretches;
use epipole_book::site::{Options, Outcome, build};
use epipole_book::source::Source;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// One figure, `dot`, with the parameter `size`.
struct OneDot;

struct Dot(f64);

impl Gallery for OneDot {
    fn names(&self) -> Vec<String> {
        vec!["dot".to_owned()]
    }

    fn about(&self, _: &str) -> (String, String) {
        ("A dot".to_owned(), "Look at it.".to_owned())
    }

    fn open(&self, _: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String> {
        let mut size = 3.0;
        for (key, value) in settings {
            match key.as_str() {
                "size" => {
                    size = value
                        .parse()
                        .map_err(|_| format!("{key}={value} is no number"))?
                }
                _ => return Err(format!("no parameter \"{key}\"; its parameters are size")),
            }
        }
        Ok(Box::new(Dot(size)))
    }
}

impl Figure for Dot {
    fn snapshot(&self) -> Result<String, String> {
        let size = self.0;
        Ok(format!(
            r#"{{"aspect":"broad","description":"A \"dot\" of size {size}.",
            "readouts":[{{"id":"area","text":"{area} px²","value":{area}}}],
            "controls":[{{"id":"size","kind":"slider","value":{size},"value_text":"{size} px"}}],
            "challenges":[{{"id":"large","solved":{large}}}]}}"#,
            area = size * size,
            large = size > 8.0
        ))
    }

    fn posters(&self, room: Room, scale: u32) -> Result<[Poster; 2], String> {
        let (width, height) = (room.width() * scale, 10 * scale);
        Ok([255, 0].map(|level| {
            let rgba = [level, level, level, 255].repeat((width * height) as usize);
            Poster {
                width,
                height,
                rgba,
            }
        }))
    }
}

/// A project with the real template and these content files.
struct Book {
    folder: TempDir,
}

impl Book {
    fn new(files: &[(&str, &str)]) -> Book {
        let folder = tempfile::tempdir().unwrap();
        let book = Book { folder };
        for template in ["web/theme/index.hbs", "web/theme/frame.hbs"] {
            let own = Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("../..")
                .join(template);
            book.write(template, &fs::read_to_string(own).unwrap());
        }
        book.write(
            "content/book.toml",
            "[book]\ntitle = \"Tiny\"\nlanguage = \"en\"\nsrc = \".\"\n[output.epipole]\nfirst-chapter = 0\n",
        );
        for (path, text) in files {
            book.write(&format!("content/{path}"), text);
        }
        book
    }

    /// A book of one chapter.
    fn of_chapter(text: &str) -> Book {
        Book::new(&[("SUMMARY.md", "- [One](one.md)\n"), ("one.md", text)])
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn build(&self) -> Outcome {
        let options = Options {
            project: self.folder.path().to_path_buf(),
            out: self.out(),
            assets: false,
            live: false,
            check: false,
            notebooks: None,
        };
        build(&options, &OneDot).unwrap()
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("target/book")
    }

    fn page(&self, path: &str) -> String {
        fs::read_to_string(self.out().join(path)).unwrap()
    }

    fn article(&self, path: &str) -> String {
        let page = self.page(path);
        let start = page.find("<article>").unwrap() + "<article>".len();
        page[start..page.find("</article>").unwrap()]
            .trim()
            .to_owned()
    }

    #[track_caller]
    fn must_build(&self) {
        if let Outcome::Problems(problems) = self.build() {
            panic!("{problems:#?}");
        }
    }

    #[track_caller]
    fn problems(&self) -> Vec<String> {
        match self.build() {
            Outcome::Problems(problems) => problems.iter().map(ToString::to_string).collect(),
            Outcome::Built { .. } => panic!("it was built"),
        }
    }
}

#[test]
fn a_tiny_chapter_as_html() {
    let book = Book::of_chapter(
        "# A *title*\n\nIs it {{#value camera.project-u f=500 cu=320 x=-1 z=2 digits=0}}? \"Yes\".\n\n\
         ## Next part {#next}\n\n[Up](#next) and `a < b`.\n",
    );
    book.must_build();
    assert_eq!(
        book.article("one.html"),
        "<h1 id=\"a-title\"><span class=\"chapter-number\"><span class=\"visually-hidden\">Chapter \
         </span>0</span> A <em>title</em></h1>\n\
         <p>Is it <span class=\"value\">70</span>? “Yes”.</p>\n\
         <section>\n<h2 id=\"next\">Next part <a class=\"anchor\" href=\"#next\" \
         aria-label=\"Link to the section Next part\">#</a></h2>\n\
         <p><a href=\"#next\">Up</a> and <code>a &lt; b</code>.</p>\n</section>"
    );
    let page = book.page("one.html");
    assert!(page.contains("<title>One · Tiny</title>"), "{page}");
    assert!(
        page.contains("name=\"description\" content=\"Is it 70? “Yes”.\""),
        "{page}"
    );
    assert_eq!(book.page("index.html"), page);
}

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
        let stand_in = book.page("lab/index.html");
        assert!(stand_in.contains("make lab"), "{stand_in}");
        assert!(
            stand_in.contains("<a href=\"../part/one.html\">"),
            "{stand_in}"
        );
    }
    let book = Book::of_chapter("# One\n\n[Try it](lab/nothing.html).\n");
    assert_eq!(book.problems().len(), 1);
}

#[test]
fn a_number_has_a_minus_sign_in_text_and_stands_in_formulas() {
    let value = "{{#value camera.project-u f=500 cu=0 x=-1 z=2 digits=0}}";
    let book = Book::of_chapter(&format!("# One\n\n{value} and $u = {value}$.\n"));
    book.must_build();
    let article = book.article("one.html");
    assert!(
        article.contains("<span class=\"value\">−250</span>"),
        "{article}"
    );
    assert!(article.contains("<mn>250</mn>"), "{article}");
    assert!(article.contains("u = -250</annotation>"), "{article}");
}

#[test]
fn figures_have_posters_numbers_and_permanent_names() {
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](one.md)\n- [Two](part/two.md)\n"),
        (
            "one.md",
            "# One\n\n{{#figure dot | First.}}\n\n{{#figure dot size=4 | A *second*\n$x^{2}$ one.}}\n",
        ),
        (
            "part/two.md",
            "# Two\n\n{{#figure dot id=other | Third.}}\n\nSee {{#ref fig-dot-2}}, {{#ref other}}.\n",
        ),
    ]);
    book.must_build();
    let one = book.article("one.html");
    assert!(
        one.contains("<figure class=\"epipole\" id=\"fig-dot\">"),
        "{one}"
    );
    assert!(
        one.contains("<epipole-figure name=\"dot\" size=\"4\">"),
        "{one}"
    );
    assert!(
        one.contains("alt=\"A &quot;dot&quot; of size 4.\" loading=\"lazy\""),
        "{one}"
    );
    for sized in [
        "media=\"all\" width=\"2176\" height=\"20\"><img src=",
        "media=\"(max-width: 927.98px)\" width=\"1440\" height=\"20\">",
        "media=\"(max-width: 551.98px)\" width=\"720\" height=\"20\">",
    ] {
        assert!(one.contains(sized), "{sized}: {one}");
    }
    assert!(one.contains("Figure 0.2</a> A <em>second</em>"), "{one}");
    assert!(!one.contains("<p><figure"), "{one}");
    let two = book.article("part/two.html");
    assert!(
        two.contains("href=\"../one.html#fig-dot-2\">Figure 0.2</a>"),
        "{two}"
    );
    assert!(two.contains("href=\"#other\">Figure 1.1</a>"), "{two}");
    let source = two
        .split("srcset=\"")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap();
    assert!(
        source.starts_with("../assets/figures/dot-360-dark-"),
        "{source}"
    );
    assert!(book.out().join("part").join(source).is_file());
}

#[test]
fn every_mistake_names_its_file_and_line_and_all_are_told() {
    let figure = "content/one.md:3: ";
    for (text, expected) in [
        (
            "{{#figure cube | C.}}",
            "unknown figure \"cube\"; known figures: dot",
        ),
        (
            "{{#figure dot color=1 | C.}}",
            "figure dot: no parameter \"color\"; its parameters are size",
        ),
        (
            "{{#figure dot size=big | C.}}",
            "figure dot: size=big is no number",
        ),
        ("{{#figure dot}}", "figure dot needs a caption"),
        (
            "Words {{#figure dot | C.}} words",
            "must stand in a paragraph of its own",
        ),
        (
            "{{#value nosuch}}",
            "unknown number \"nosuch\"; known numbers: camera.project-u",
        ),
        (
            "{{#value camera.project-u f=1}}",
            "camera.project-u needs cu=…",
        ),
        (
            "{{#cite nobody}}",
            "unknown reference \"nobody\"; known references: none",
        ),
        (
            "{{#ref fig-none}}",
            "no figure is called \"fig-none\"; figures: none",
        ),
        ("{{#quiz none}}", "there is no quizzes/none.toml"),
        (
            "{{#include none.py}}",
            "there is no file none.py to include",
        ),
        (
            "{{#frame x}}",
            "unknown directive \"frame\"; known: cite, claim, do, figure",
        ),
        ("{{#value a", "`{{#` without `}}`"),
        ("$\\frac{1}$", "formula `\\frac{1}`: "),
        (
            "[a](two.md)",
            "the link \"two.md\" leads to no chapter; chapters: one.md",
        ),
        (
            "[a](#three)",
            "the link \"#three\" leads to no section; anchors there: ",
        ),
        (
            "[a](one.md#three)",
            "the link \"one.md#three\" leads to no section",
        ),
        ("[a](/one.md)", "starts with /"),
        ("[a](data.csv)", "leads nowhere: there is no data.csv"),
        ("![a](a.png)", "there is no picture a.png"),
        (
            "![](https://a.b/c.png)",
            "must be a file of the content folder",
        ),
        (
            "<p style=\"color: red\">",
            "the attribute style=\"color: red\" of <p>",
        ),
        ("<script>1</script>", "an inline <script>"),
        ("<a onclick=\"b()\">c</a>", "the attribute onclick"),
        (
            "{{#figure dot controls=\"size hue\" | C.}}",
            "figure dot: none of its controls is called \"hue\"; controls: size",
        ),
        (
            "{{#figure dot readouts=size | C.}}",
            "none of its readouts is called \"size\"; readouts: area",
        ),
        (
            "{{#figure dot size=9 | C.}}",
            "figure dot: its goal \"large\" is reached before the reader has done anything",
        ),
        (
            "{{#figure dot goals=many | C.}}",
            "goals=many: it is none, one or all",
        ),
        (
            "{{#figure dot claim=\"area > 9\" | C.}}",
            "the claim `area > 9` is false: the figure shows \"9 px²\"",
        ),
        (
            "{{#do dot size=2 | w}}",
            "this page has no figure \"dot\"; its figures: none",
        ),
        ("{{#live dot.area}}", "this page has no figure \"dot\""),
        (
            "{{#do dot | w}}",
            "write {{#do figure key=value … | words}}",
        ),
        ("{{#live dot}}", "write {{#live figure.readout}}"),
        ("{{#claim dot size=2}}", "write {{#claim figure key=value"),
    ] {
        let problems = Book::of_chapter(&format!("# One\n\n{text}\n")).problems();
        let found = problems
            .iter()
            .any(|problem| problem.starts_with(figure) && problem.contains(expected));
        assert!(found, "{text}: {problems:#?}");
    }

    let book = Book::of_chapter("# One\n\n{{#figure a | C.}}\n\n> - {{#value b}}\n\n[c](#c)\n");
    let places: Vec<String> = book.problems().iter().map(|p| p[..16].to_owned()).collect();
    assert_eq!(
        places,
        ["content/one.md:3", "content/one.md:5", "content/one.md:7"]
    );
    assert!(!book.out().exists(), "nothing is written");
}

#[test]
fn lines_are_right_inside_captions_notes_tables_and_after_includes() {
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](one.md)\n"),
        ("code.py", "a = 1\nb = 2\n"),
        (
            "one.md",
            "# One\n\n```python\n{{#include code.py}}\n```\n\n{{#figure dot | A\ncaption with\n\
             {{#value nosuch}}.}}\n\nText{{#note | with\n$\\bad$}}.\n\n| a |\n|---|\n| {{#cite x}} |\n",
        ),
    ]);
    let places: Vec<String> = book
        .problems()
        .iter()
        .map(|p| p.split(": ").next().unwrap().to_owned())
        .collect();
    assert_eq!(
        places,
        ["content/one.md:9", "content/one.md:12", "content/one.md:16"]
    );
}

#[test]
fn sentences_operate_figures_and_quote_them() {
    let dots = "{{#figure dot size=3 goals=one readouts=\"area\" | First.}}\n\n{{#figure dot id=other | Second.}}";
    let book = Book::of_chapter(&format!(
        "# One\n\n{{{{#do dot size=5 claim=\"area = 25\" | Make *it* larger}}}}: {{{{#live dot.area}}}}, \
         {{{{#live dot.size}}}}, {{{{#live dot#other.area}}}}.{{{{#claim dot size=2 | area < 5}}}}\n\n{dots}\n"
    ));
    book.must_build();
    let one = book.article("one.html");
    for part in [
        "<p><span class=\"do\" data-figure=\"fig-dot\" data-parameters=\"{&quot;size&quot;:&quot;5&quot;}\">\
         Make <em>it</em> larger</span>: <span class=\"live\" data-figure=\"fig-dot\" \
         data-shows=\"area\">9 px²</span>, <span",
        "data-figure=\"other\" data-shows=\"area\">9 px²</span>.</p>",
        "<epipole-figure name=\"dot\" size=\"3\" readouts=\"area\" goals=\"one\">",
    ] {
        assert!(one.contains(part), "{part}: {one}");
    }
    for (text, expected) in [
        ("{{#do dot hue=5 | w}}", "figure dot: no parameter \"hue\""),
        (
            "{{#do dot size=big | w}}",
            "figure dot: size=big is no number",
        ),
        (
            "{{#live dot.hue}}",
            "it shows nothing called \"hue\"; it shows area, size",
        ),
        (
            "{{#do dot#no size=1 | w}}",
            "no figure \"dot#no\"; its figures: dot#fig-dot, dot#other",
        ),
        ("{{#do dot size=1 claim=\"area > 1\" | w}}", "is false"),
        (
            "{{#claim dot size=1 | goal.large = true}}",
            "shows \"false\"",
        ),
    ] {
        let problems = Book::of_chapter(&format!("# One\n\n{text}\n\n{dots}\n")).problems();
        let found = problems
            .iter()
            .any(|problem| problem.starts_with("content/one.md:3: ") && problem.contains(expected));
        assert!(found, "{text}: {problems:#?}");
    }
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

#[test]
fn marks_stay_with_their_formulas() {
    let book = Book::of_chapter("# One\n\nOf ($a$), $b$: and $c$ or $d$'s.\n");
    book.must_build();
    let one = book.article("one.html");
    let bound: Vec<&str> = one.split("<span class=\"bound\">").collect();
    assert_eq!(bound.len(), 4, "{one}");
    assert!(
        bound[0].ends_with("<p>Of ") && bound[1].starts_with("(<math"),
        "{one}"
    );
    assert!(bound[1].ends_with("</math>),</span> "), "{one}");
    assert!(bound[2].contains("</math>:</span> and <math"), "{one}");
    assert!(bound[3].ends_with("</math>’</span>s.</p>"), "{one}");
}

#[test]
fn a_missing_chapter_and_a_missing_title() {
    let book = Book::new(&[("SUMMARY.md", "# Contents\n\n- [One](one.md)\n")]);
    assert_eq!(
        book.problems(),
        ["content/SUMMARY.md:3: there is no chapter one.md (a draft has empty parentheses)"]
    );
    let problems = Book::of_chapter("No title.\n").problems();
    assert!(problems[0].starts_with("content/one.md:1: a chapter starts with its title"));
    let problems = Book::new(&[]).problems();
    assert_eq!(
        problems,
        ["content/SUMMARY.md:1: there is no table of contents"]
    );
}

#[test]
fn includes_keep_only_what_the_anchor_marks() {
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](one.md)\n"),
        (
            "code.py",
            "import x\n# ANCHOR: f\nf = 1\n# ANCHOR_END: f\ng = 2\n",
        ),
        (
            "one.md",
            "# One\n\n```python\n{{#include code.py:f}}\n```\n\n\\{{#include code.py}}\n",
        ),
    ]);
    book.must_build();
    let article = book.article("one.html");
    assert!(
        article.contains("<code class=\"language-python\">f = <span"),
        "{article}"
    );
    assert!(
        !article.contains("import") && !article.contains("ANCHOR"),
        "{article}"
    );
    assert!(article.contains("<p>{{#include code.py}}</p>"), "{article}");
}

#[test]
fn notes_and_footnotes_go_to_the_margin() {
    let book = Book::of_chapter("# One\n\nA{{#note | *one*}} b[^n].\n\n[^n]: two `c`\n");
    book.must_build();
    let article = book.article("one.html");
    let notes = article
        .matches("<small class=\"note\" role=\"note\">")
        .count();
    assert_eq!(notes, 2, "{article}");
    assert!(
        article.contains("<sup class=\"note-number\">1</sup> <em>one</em></small>"),
        "{article}"
    );
    assert!(
        article.contains("<sup class=\"note-number\">2</sup> two <code>c</code></small>"),
        "{article}"
    );
}

#[test]
fn tables_name_their_rows_and_columns_without_inline_styles() {
    let book = Book::of_chapter("# One\n\n| | $x$ | b |\n|---|---:|---|\n| c | 1 | *2* |\n");
    book.must_build();
    let article = book.article("one.html");
    assert!(article.contains(
        "<td></td><th scope=\"col\" class=\"right\"><span class=\"visually-hidden\">x</span>"
    ));
    let row = "<tr><th scope=\"row\">c</th><td class=\"right\">1</td><td><em>2</em></td></tr>";
    assert!(article.contains(row), "{article}");
}

#[test]
fn hidden_lines_of_rust_listings_are_not_shown() {
    let book =
        Book::of_chapter("# One\n\n```rust\n# fn main() {\n#\n#[test]\nlet a = 1;\n# }\n```\n");
    book.must_build();
    let article = book.article("one.html");
    assert!(
        !article.contains("main") && article.contains("#["),
        "{article}"
    );
}

/// A listing with two tabs and a task, as a chapter writes them.
const LISTING: &str = "# One\n\n## In code\n\n{{#listing depth | How *far*}}\n\nIt is $f B / d$.\n\n\
    ```python numpy\nf = 700\nprint(f\"depth: {f}\")\nassert f == 700\n```\n\n\
    ```rust\nprintln!(\"depth: 700\");\n```\n\n{{/listing}}\n\n\
    {{#task half | Half}}\n\nHalve it.\n\n```python start\ndef half(x):\n    return x\n```\n\n\
    ```python check\nprint(\"Right\" if half(4) == 2 else \"Not yet\")\n```\n\n\
    ```python solution\ndef half(x):\n    return x / 2\n```\n\n{{/task}}\n\nAfter.\n";

const PRINTED: [(&str, &str); 2] = [
    ("listings/one.depth.numpy.txt", "depth: 700\n"),
    ("listings/one.depth.rust.txt", "depth: 700\n"),
];

#[test]
fn a_listing_has_tabs_and_says_what_it_prints() {
    let mut files = vec![("SUMMARY.md", "- [One](one.md)\n"), ("one.md", LISTING)];
    files.extend(PRINTED);
    let book = Book::new(&files);
    book.must_build();
    let article = book.article("one.html");
    for part in [
        "<p>It is <span class=\"bound\"><math",
        "<div class=\"listing\" id=\"listing-depth\" role=\"group\" aria-labelledby=\"listing-depth-title\">",
        "id=\"listing-depth-title\">How <em>far</em></p>",
        "aria-controls=\"listing-depth-rust\" aria-selected=\"false\" tabindex=\"-1\">Rust</button>",
        "<div class=\"listing-part\" id=\"listing-depth-numpy\" data-tab=\"numpy\">",
        "<samp>depth: 700</samp>",
        "href=\"notebooks/one.ipynb\" download>the notebook</a>",
        "<p>After.</p>",
    ] {
        assert!(article.contains(part), "{part}: {article}");
    }
    // What checks is for the tests and the notebook.
    for hidden in ["assert", "Not yet", "{{"] {
        assert!(!article.contains(hidden), "{hidden}: {article}");
    }
    let notebook = book.page("notebooks/one.ipynb");
    let notebook: serde_json::Value = serde_json::from_str(&notebook).unwrap();
    let cells = notebook["cells"].as_array().unwrap();
    let code: Vec<&str> = cells
        .iter()
        .filter(|cell| cell["cell_type"] == "code")
        .map(|cell| cell["id"].as_str().unwrap())
        .collect();
    assert_eq!(code, ["depth-numpy", "half-start", "half-check"]);
    let text = notebook.to_string();
    assert!(
        text.contains("## How *far*") && text.contains("It is $f B / d$."),
        "{text}"
    );
    assert!(
        text.contains("assert f == 700") && !text.contains("x / 2"),
        "{text}"
    );
}

#[test]
fn what_is_wrong_with_a_listing_is_told() {
    let long = format!("{}\n", "x".repeat(67));
    for (from, to, expected) in [
        (
            "f = 700\n",
            long.as_str(),
            "content/one.md:10: 67 characters: a line of a listing has at most 66",
        ),
        ("```rust", "```rust opencv", "`rust opencv` is no tab"),
        ("```rust", "```python numpy", "each tab comes once"),
        ("{{/listing}}", "{{/listin}}", "content/one.md:5: "),
        (
            "{{#task half",
            "{{#task depth",
            "a listing needs a name of its own",
        ),
        (
            "```python check",
            "```python test",
            "task half has the fences",
        ),
        (
            "How *far*}}\n",
            "How *far*}}\n\n### No\n",
            "words come first and fences after them",
        ),
        (
            "{{#listing depth",
            "{{#listing deep",
            "there is no listings/one.deep.numpy.txt",
        ),
    ] {
        assert!(LISTING.contains(from), "{from}");
        let text = LISTING.replacen(from, to, 1);
        let mut files = vec![
            ("SUMMARY.md", "- [One](one.md)\n"),
            ("one.md", text.as_str()),
        ];
        files.extend(PRINTED);
        let problems = Book::new(&files).problems();
        let is_told = problems.iter().any(|problem| problem.contains(expected));
        assert!(is_told, "{expected}: {problems:?}");
    }
    let files = [
        ("SUMMARY.md", "- [One](one.md)\n"),
        ("one.md", LISTING),
        PRINTED[0],
        ("listings/one.depth.rust.txt", "depth: 701\n"),
    ];
    let problems = Book::new(&files).problems();
    let expected = "listing depth: NumPy prints \"depth: 700\" and Rust \"depth: 701\"";
    assert!(
        problems.iter().any(|problem| problem.contains(expected)),
        "{problems:?}"
    );
}

#[test]
fn letters_of_the_list_have_their_role_everywhere_in_the_chapter() {
    let book =
        Book::of_chapter("# One\n\nFirst $p$.\n\n{{#symbols P p'}}\n\n$$p' = K P$$\n\n> Of $P$.\n");
    book.must_build();
    let article = book.article("one.html");
    assert!(
        article.contains(
            "<p>First <span class=\"bound\"><math display=\"inline\"><semantics><mrow><mi>p</mi>"
        ),
        "{article}"
    );
    assert!(
        article
            .contains("<mrow data-symbol=\"p'\" data-role=\"match\"><mi>p</mi><mi>′</mi></mrow>"),
        "{article}"
    );
    assert_eq!(
        article
            .matches("<mi data-symbol=\"P\" data-role=\"point\">P</mi>")
            .count(),
        2,
        "{article}"
    );
    assert_eq!(
        article.matches("<li><span data-symbol=").count(),
        2,
        "{article}"
    );
    let problems = Book::of_chapter("# One\n\n{{#symbols Q}}\n").problems();
    assert!(problems[0].starts_with("content/one.md:3: unknown symbol \"Q\"; known: P, X"));
}

#[test]
fn citations_lead_to_the_list() {
    let references = "[a1]\nauthors = [\"Author, An\"]\nyear = 2001\ntitle = \"Title\"\n";
    let chapter = ("one.md", "# One\n\nAs {{#cite a1 | §2}} says.\n");
    let summary = "- [One](one.md)\n";
    let book = Book::new(&[
        ("SUMMARY.md", summary),
        chapter,
        ("references.toml", references),
    ]);
    let expected = "content/one.md:3: something is cited, but no chapter holds {{#references}}";
    assert_eq!(book.problems(), [expected]);
    let summary = "- [One](one.md)\n\n[References](refs.md)\n";
    let list = ("refs.md", "# References\n\n{{#references}}\n");
    let book = Book::new(&[
        ("SUMMARY.md", summary),
        chapter,
        list,
        ("references.toml", references),
    ]);
    book.must_build();
    let article = book.article("one.html");
    assert!(
        article.contains("<a class=\"cite\" href=\"refs.html#a1\">Author 2001</a>, §2"),
        "{article}"
    );
    assert!(
        book.article("refs.html")
            .contains("<li id=\"a1\">An Author (2001).")
    );
}

#[test]
fn quizzes_work_without_a_script_and_appear_on_the_page_of_progress() {
    let quiz =
        "[[question]]\nid = \"a\"\nprompt = \"What is $x$?\"\nanswer = 7\nexplanation = \"So.\"\n";
    let book = Book::new(&[
        ("SUMMARY.md", "- [One](one.md)\n\n[Progress](progress.md)\n"),
        (
            "one.md",
            "# One\n\n{{#figure dot | First.}}\n\n{{#figure dot goals=none size=4 | Second.}}\n\n{{#quiz one}}\n",
        ),
        (
            "progress.md",
            "# Progress\n\n{{#progress}}\n\n{{#small dot page=one.md#one | One.}}\n{{#small dot | No page.}}\n",
        ),
        ("quizzes/one.toml", quiz),
    ]);
    book.must_build();
    let article = book.article("one.html");
    assert!(
        article.contains("<legend>") && article.contains("<math"),
        "{article}"
    );
    assert!(
        article.contains("<details class=\"solution\">") && article.contains("<strong>7</strong>")
    );
    let progress = book.article("progress.html");
    assert!(
        progress.contains(
            "<tr data-quiz=\"one\"><td><a href=\"one.html\">One</a></td>\
             <td class=\"solved\" data-questions=\"1\">– of 1</td>"
        ),
        "{progress}"
    );
    // The goals of its figures are counted, too.
    let goals = "<td class=\"reached\" data-goals=\"dot/large\">– of 1</td>";
    assert!(progress.contains(goals), "{progress}");
    // A picture that leads to a chapter has room for what is solved there.
    let mark = "<span class=\"solved\" data-quiz=\"one\" data-questions=\"1\" data-goals=\"dot/large\" hidden></span></a>";
    assert_eq!(progress.matches(mark).count(), 1, "{progress}");
    assert_eq!(progress.matches("class=\"solved\" data-quiz").count(), 1);

    book.write(
        "content/quizzes/one.toml",
        &quiz.replace("answer = 7", "value = \"nosuch\""),
    );
    let problems = book.problems();
    assert!(problems[0].starts_with("content/quizzes/one.toml:1: question \"a\": unknown number"));
}

#[test]
fn drafts_are_listed_but_lead_nowhere() {
    let book = Book::new(&[
        (
            "SUMMARY.md",
            "- [One](one.md)\n- [Later]()\n- [Three](three.md)\n",
        ),
        ("one.md", "# One\n\nText.\n"),
        ("three.md", "# Three\n\nText.\n"),
    ]);
    book.must_build();
    let page = book.page("one.html");
    assert!(
        page.contains("<li class=\"draft\"><span class=\"number\">1</span>"),
        "{page}"
    );
    assert!(
        page.contains("<a class=\"next\" rel=\"next\" href=\"three.html\">"),
        "{page}"
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
fn every_figure_has_a_page_for_frames() {
    let book = Book::of_chapter("# One\n\nOld.\n");
    book.must_build();
    let frame = book.page("embed/dot.html");
    for part in [
        "<title>A dot · Tiny</title>",
        "<epipole-figure name=\"dot\"><picture><source srcset=\"../assets/figures/dot-360-dark-",
        "alt=\"A &quot;dot&quot; of size 3.\"",
        "<noscript><p>A &quot;dot&quot; of size 3. It moves",
    ] {
        assert!(frame.contains(part), "{part}: {frame}");
    }
    // Where the book is published nobody has said.
    assert!(!frame.contains("oembed"), "{frame}");
    assert!(!book.out().join("embed/dot.json").exists());
}

#[test]
fn with_an_address_frames_tell_oembed_of_themselves() {
    let book = Book::of_chapter("# One\n\nOld.\n");
    let toml = "[book]\ntitle = \"Tiny\"\nsrc = \".\"\n[output.epipole]\naddress = \"https://a.example/book\"\n";
    book.write("content/book.toml", toml);
    book.must_build();
    let link = "type=\"application/json+oembed\" href=\"https://a.example/book/embed/dot.json\"";
    assert!(book.page("embed/dot.html").contains(link));
    let facts: serde_json::Value = serde_json::from_str(&book.page("embed/dot.json")).unwrap();
    assert_eq!(
        (&facts["version"], &facts["type"]),
        (&"1.0".into(), &"rich".into())
    );
    assert_eq!(facts["width"], 720);
    let html = facts["html"].as_str().unwrap();
    assert!(
        html.starts_with(
            "<iframe src=\"https://a.example/book/embed/dot.html\" title=\"A dot\" width=\"100%\""
        ),
        "{html}"
    );
}

#[test]
fn the_gallery_shows_what_can_be_set_and_read() {
    let book = Book::of_chapter("# All\n\n{{#gallery}}\n");
    book.must_build();
    let page = book.article("one.html");
    for part in [
        "<section class=\"gallery\" data-name=\"dot\">",
        "<h2 id=\"dot\"><a href=\"#dot\">A dot</a></h2>",
        "<figure class=\"epipole\" id=\"figure-dot\">",
        "href=\"embed/dot.html\"",
        "&lt;epipole-figure name=&quot;dot&quot;&gt;&lt;/epipole-figure&gt;",
        "<code>size</code></th>",
        "<code>area</code></th><td>",
        "9 px²",
        "<code>Page Up, Page Down</code>",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    for absent in [
        "What can be pressed",
        "<code>Delete</code>",
        "<code>Enter</code>",
    ] {
        assert!(!page.contains(absent), "{absent}: {page}");
    }
}

/// The chapters of the book itself: file and text.
fn chapters() -> Vec<(String, String)> {
    let content = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../content");
    let mut found: Vec<(String, String)> = fs::read_dir(content)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect();
    found.sort();
    assert!(found.len() > 8);
    found
}

#[test]
fn nobody_reads_more_than_eight_paragraphs_without_something_to_look_at() {
    let mut long = Vec::new();
    for (name, text) in chapters() {
        let source = Source::new(text, Place::new(name, 1));
        long.extend(
            stretches(&source)
                .into_iter()
                .filter(|stretch| stretch.paragraphs > 8),
        );
    }
    assert!(long.is_empty(), "{long:#?}");
}

#[test]
fn captions_are_short() {
    let mut long = Vec::new();
    for (name, text) in chapters() {
        for (at, _) in text.match_indices("{{#figure ") {
            let tag = &text[at..];
            // Captions hold formulas and no directives with a bar of their own.
            let Some((head, rest)) = tag.split_once(" | ") else {
                continue;
            };
            let caption = rest.split("}}\n").next().unwrap_or(rest);
            let words = caption.split_whitespace().count();
            if words > 40 {
                long.push(format!("{name}: {head}: {words} words"));
            }
        }
    }
    assert!(long.is_empty(), "{long:#?}");
}

/// A choice of a question: its words, whether it is right, and whether something is said of it.
type Choice = (String, bool, bool);

/// The questions of all quizzes: id and choices.
fn choices() -> Vec<(String, Vec<Choice>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../content/quizzes");
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let text = fs::read_to_string(entry.unwrap().path()).unwrap();
        let file: toml::Table = toml::from_str(&text).unwrap();
        for question in file["question"].as_array().unwrap() {
            let id = question["id"].as_str().unwrap().to_owned();
            let choices = question.get("choices").and_then(toml::Value::as_array);
            let choice = |choice: &toml::Value| {
                let text = choice["text"].as_str().unwrap().to_owned();
                let is_right = choice.get("right").is_some();
                (text, is_right, choice.get("why").is_some())
            };
            let choices = choices.into_iter().flatten().map(choice).collect();
            found.push((id, choices));
        }
    }
    assert!(found.len() > 50);
    found
}

#[test]
fn every_wrong_choice_is_explained_and_the_longest_is_not_the_right_one() {
    let (mut single, mut longest) = (0, 0);
    for (id, choices) in choices() {
        for (text, is_right, has_why) in &choices {
            assert!(*is_right || *has_why, "{id}: nothing is said of \"{text}\"");
        }
        if choices.iter().filter(|(_, is_right, _)| *is_right).count() == 1 {
            let by_length = |choice: &&Choice| choice.0.chars().count();
            single += 1;
            longest += usize::from(choices.iter().max_by_key(by_length).unwrap().1);
        }
    }
    assert!(
        single > 25 && 2 * longest <= single,
        "{longest} of {single}"
    );
}
