//! HTML of a page of the book.

use crate::tiny::Book;

#[test]
fn a_tiny_chapter_as_html() {
    let book = Book::of_chapter(
        "# A *title*\n\nIs it {{#value camera.project-u f=500 cu=320 x=-1 z=2 digits=0}}? \"Yes\".\n\n\
         ## Next part {#next}\n\n[Up](#next) and `a < b`.\n",
    );
    book.must_build();
    assert_eq!(
        book.article("one.html"),
        "<div class=\"reading-time\">About 1 min</div>\n\
         <h1 id=\"a-title\"><span class=\"chapter-number\"><span class=\"visually-hidden\">Chapter \
         </span>0</span> A <em>title</em></h1>\n\
         <p>Is it <span class=\"value\">70</span>? “Yes”.</p>\n\
         <section>\n<h2 id=\"next\">Next part <a class=\"anchor\" href=\"#next\" \
         aria-label=\"Link to the section Next part\">#</a></h2>\n\
         <p><a href=\"#next\">Up</a> and <code>a &lt; b</code>.</p>\n</section>\n\
         <p class=\"deck-link\"><a href=\"slides/one.html\">Slides of this chapter</a> \
         <span>figures to operate, questions, and notes for the speaker</span></p>"
    );
    let deck = book.page("slides/one.html");
    for part in [
        "<title>Slides: One · Tiny</title>",
        "<section data-kind=\"words\">\n<h2>Next part</h2>",
        "<aside class=\"notes\"><p><a href=\"../one.html#next\">Up</a>",
    ] {
        assert!(deck.contains(part), "{part}: {deck}");
    }
    let page = book.page("one.html");
    assert!(page.contains("<title>One · Tiny</title>"), "{page}");
    assert!(
        page.contains("name=\"description\" content=\"Is it 70? “Yes”.\""),
        "{page}"
    );
    assert_eq!(book.page("index.html"), page);
}

#[test]
fn a_number_has_a_minus_sign_in_text_and_in_formulas() {
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
    assert!(bound[3].starts_with("<math"), "{one}");
    assert!(bound[3].contains("</math>’</span>s.</p>\n"), "{one}");
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
    for number in ["1", "2"] {
        let mark = format!("aria-label=\"Note {number}\">{number}</label></sup><small");
        assert!(article.contains(&mark), "{article}");
    }
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
fn terms_lead_to_the_glossary_and_that_to_their_chapters() {
    let book = Book::new(&[
        (
            "SUMMARY.md",
            "# Contents\n\n- [One](one.md)\n\n[Words](words.md)\n",
        ),
        (
            "one.md",
            "# One\n\nA **{{#define ray}}** and more {{#term ray | rays}}.\n\n{{#figure dot | C.}}\n",
        ),
        ("words.md", "# Words\n\n{{#glossary}}\n"),
        (
            "glossary.toml",
            "[ray]\ntext = \"A *half*-line.\"\nfigure = \"fig-dot\"\n",
        ),
    ]);
    book.must_build();
    let article = book.article("one.html");
    let expected = "<strong><dfn id=\"term-ray\">ray</dfn></strong> and more <a class=\"term\" \
                    href=\"words.html#ray\">rays</a>";
    assert!(article.contains(expected), "{article}");
    let words = book.article("words.html");
    let expected = "<div id=\"ray\"><dt>ray</dt><dd>A <em>half</em>-line. <span class=\"where\">\
                    <a class=\"ref\" href=\"one.html#term-ray\">Chapter 0</a>, \
                    <a class=\"ref\" href=\"one.html#fig-dot\">Figure 0.1</a></span></dd></div>";
    assert!(words.contains(expected), "{words}");
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
    // The page of progress knows the wording that counts.
    let (_, form) = article
        .split_once("id=\"quiz-one-a\" data-hash=\"")
        .unwrap();
    let hash = form.split('"').next().unwrap();
    let progress = book.article("progress.html");
    assert!(
        progress.contains(&format!(
            "<tr data-quiz=\"one\"><td><a href=\"one.html\">One</a></td>\
             <td class=\"solved\" data-wordings=\"quiz-one-a:{hash}\">– of 1</td>"
        )),
        "{progress}"
    );
    // The goals of its figures are counted, too.
    let goals = "<td class=\"reached\" data-goals=\"dot/large\">– of 1</td>";
    assert!(progress.contains(goals), "{progress}");
    // The page around a chapter's frame hears of them.
    let page = book.page("one.html");
    assert!(
        page.contains("<article data-goals=\"dot/large\">"),
        "{page}"
    );
    // A picture that links to a chapter has room for the chapter's solved questions.
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
