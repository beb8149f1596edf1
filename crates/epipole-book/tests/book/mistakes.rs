//! Messages for the mistakes of authors.

use crate::tiny::Book;

#[test]
fn every_mistake_is_reported_with_its_file_and_line() {
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
        (
            "{{#term epipole}}",
            "a term is marked, but no chapter holds {{#glossary}}",
        ),
        ("{{#glossary}}", "there is no glossary.toml"),
        ("{{#quiz none}}", "there is no quizzes/none.toml"),
        (
            "{{#include none.py}}",
            "there is no file none.py to include",
        ),
        (
            "{{#frame x}}",
            "unknown directive \"frame\"; known: cite, claim, define, do, figure",
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
