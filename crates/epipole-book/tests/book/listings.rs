//! Listings: tabs, hidden lines, and output.

use crate::tiny::Book;

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
fn a_listing_has_tabs_and_shows_its_output() {
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
    // Checking code is for the tests and the notebook.
    for hidden in ["assert", "Not yet", "{{"] {
        assert!(!article.contains(hidden), "{hidden}: {article}");
    }
    let solved = book.page("notebooks/one-solutions.ipynb");
    assert!(solved.contains("x / 2"), "{solved}");
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
fn mistakes_in_a_listing_are_reported() {
    let long = format!("{}\n", "x".repeat(67));
    for (from, to, expected) in [
        (
            "f = 700\n",
            long.as_str(),
            "content/one.md:10: 67 characters: a line of a listing has at most 66",
        ),
        ("```rust", "```rust opencv", "`rust opencv` is no tab"),
        ("```rust", "```rust epipole", "`rust epipole` is no tab"),
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
        let is_reported = problems.iter().any(|problem| problem.contains(expected));
        assert!(is_reported, "{expected}: {problems:?}");
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
