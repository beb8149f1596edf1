//! Figures in a chapter, in frames and in the gallery.

use crate::tiny::Book;

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
         data-shows=\"area\">9 px²</span>\u{2060}, <span",
        "data-figure=\"other\" data-shows=\"area\">9 px²</span>\u{2060}.</p>",
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
    // No address of the published book is configured.
    assert!(!frame.contains("oembed"), "{frame}");
    assert!(!book.out().join("embed/dot.json").exists());
}

#[test]
fn with_an_address_pages_are_found_under_it() {
    let book = Book::of_chapter("# One\n\n{{#figure dot | First.}}\n");
    book.must_build();
    assert!(!book.page("one.html").contains("canonical"));
    assert!(book.page("404.html").contains("href=\"index.html\""));
    assert!(!book.out().join("sitemap.xml").exists());
    book.write("content/book.toml", PUBLISHED);
    book.must_build();
    let page = book.page("one.html");
    for part in [
        "<link rel=\"canonical\" href=\"https://a.example/book/one.html\">",
        "<meta property=\"og:url\" content=\"https://a.example/book/one.html\">",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    let missing = book.page("404.html");
    assert!(!missing.contains("a.example"));
    assert!(missing.contains("href=\"/book/index.html\""), "{missing}");
    let card = "<meta property=\"og:image\" content=\"https://a.example/book/";
    let card = page.split(card).nth(1).unwrap().split('"').next().unwrap();
    assert!(card.starts_with("assets/cards/one-"), "{card}");
    assert!(book.out().join(card).is_file());
    let alt = "<meta property=\"og:image:alt\" content=\"One. A &quot;dot&quot; of size 3.\">";
    assert!(page.contains(alt), "{page}");
    let sitemap = book.page("sitemap.xml");
    assert!(sitemap.contains("<loc>https://a.example/book/one.html</loc>"));
    let robots = book.page("robots.txt");
    assert!(robots.ends_with("Sitemap: https://a.example/book/sitemap.xml\n"));
}

/// A configuration with the address of the published book.
const PUBLISHED: &str = "[book]\ntitle = \"Tiny\"\nsrc = \".\"\n[output.epipole]\naddress = \"https://a.example/book\"\n";

#[test]
fn with_an_address_chapters_have_metadata_for_search_engines() {
    const START: &str = "<script type=\"application/ld+json\">";
    let book = Book::new(&[
        (
            "SUMMARY.md",
            "[Start](index.md)\n- [One](one.md)\n- [Terms](terms.md)\n",
        ),
        ("index.md", "# Start\n"),
        (
            "one.md",
            "# One\n\nOf {{#define epipolar-line}} and `</script>`.\n",
        ),
        ("terms.md", "# Terms\n\n{{#glossary}}\n"),
        ("glossary.toml", "[epipolar-line]\ntext = \"A line.\"\n"),
    ]);
    book.must_build();
    assert!(!book.page("one.html").contains(START));
    book.write("content/book.toml", PUBLISHED);
    book.must_build();
    assert!(!book.page("index.html").contains(START));
    let page = book.page("one.html");
    let facts = page.split(START).nth(1).unwrap();
    let facts = facts.split("</script>").next().unwrap();
    let facts: serde_json::Value = serde_json::from_str(facts).unwrap();
    assert_eq!(facts["@type"], "LearningResource");
    assert_eq!(facts["url"], "https://a.example/book/one.html");
    assert_eq!(facts["description"], "Of epipolar line and </script>.");
    assert_eq!(facts["isPartOf"]["name"], "Tiny");
    assert_eq!(facts["timeRequired"], "PT1M");
    assert_eq!(facts["teaches"][0], "epipolar line");
}

#[test]
fn with_an_address_frames_have_oembed_metadata() {
    let book = Book::of_chapter("# One\n\nOld.\n");
    book.write("content/book.toml", PUBLISHED);
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
fn the_gallery_leads_to_a_page_of_each_figure() {
    let book = Book::of_chapter("# All\n\n{{#gallery}}\n");
    book.must_build();
    let list = book.article("one.html");
    for part in [
        "<ul class=\"gallery\">",
        "<li id=\"dot\"><a href=\"figures/dot.html\"><picture>",
        "<span>A dot</span></a> <code>dot</code></li>",
    ] {
        assert!(list.contains(part), "{part}: {list}");
    }
    assert!(!list.contains("epipole-figure"), "{list}");
    let page = book.article("figures/dot.html");
    for part in [
        "<p class=\"up\"><a href=\"../one.html\">",
        "<h1 id=\"dot\">A dot</h1>",
        "<figure class=\"epipole\" id=\"figure-dot\">",
        "href=\"../embed/dot.html\"",
        "<section class=\"embedding\" data-name=\"dot\">",
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
    let whole = book.page("figures/dot.html");
    assert!(
        whole.contains("<li class=\"current\"><a href=\"../one.html\" aria-current=\"true\">"),
        "{whole}"
    );
    assert!(!whole.contains("rel=\"prev\""), "{whole}");
}
