//! Splitting of paragraphs into sentences.

/// Returns the HTML up to the end of the first sentence that ends outside of all elements or at the
/// end of one; everything if there is none.
pub(crate) fn first(html: &str) -> &str {
    let mut depth = 0_usize;
    let mut rest = html.char_indices().peekable();
    while let Some((at, c)) = rest.next() {
        match c {
            '<' => {
                let tag = &html[at..html[at..].find('>').map_or(html.len(), |end| at + end + 1)];
                match tag {
                    _ if tag.starts_with("</") => depth = depth.saturating_sub(1),
                    _ if is_void(tag) => {}
                    _ => depth += 1,
                }
                while rest.next_if(|(next, _)| *next < at + tag.len()).is_some() {}
            }
            '.' | '?' | '!' => {
                let end = at + 1;
                // A formula and the period after it share an element that keeps them on one line.
                let bound = html[end..].strip_prefix("</span>").filter(|_| depth == 1);
                let after = bound.unwrap_or(&html[end..]);
                if (depth == 0 || bound.is_some()) && ends(&html[..at], after) {
                    return &html[..html.len() - after.len()];
                }
            }
            _ => {}
        }
    }
    html
}

/// Whether punctuation between these texts ends a sentence: a new one follows, and it belongs to no
/// abbreviation or initial.
fn ends(before: &str, after: &str) -> bool {
    let word = before.rsplit([' ', '\n', '(', '>', '\u{a0}']).next();
    let is_initial = |word: &str| word.chars().count() == 1 && word.chars().all(char::is_uppercase);
    let is_short = word.is_some_and(|word| word.contains('.') || is_initial(word));
    let next = after.trim_start_matches([' ', '\n']);
    let is_apart = after.is_empty() || after.starts_with('<') || next.len() < after.len();
    is_apart && !is_short && next.chars().next().is_none_or(|c| !c.is_lowercase())
}

fn is_void(tag: &str) -> bool {
    let name = tag[1..].split(|c: char| !c.is_ascii_alphanumeric()).next();
    tag.ends_with("/>") || matches!(name, Some("br" | "img" | "wbr" | "input" | "source"))
}

#[cfg(test)]
mod tests {
    use super::first;

    #[test]
    fn a_sentence_ends_where_the_next_begins() {
        for (html, sentence) in [
            ("One. Two.", "One."),
            ("Is it? Yes.", "Is it?"),
            (
                "All 3.5 m of it, e.g. the wall. Next",
                "All 3.5 m of it, e.g. the wall.",
            ),
            ("As R. Hartley says. Next", "As R. Hartley says."),
            ("No end", "No end"),
            ("", ""),
        ] {
            assert_eq!(first(html), sentence);
        }
    }

    #[test]
    fn elements_stay_whole() {
        assert_eq!(first("A <b>b. C</b> day.<br> E."), "A <b>b. C</b> day.");
        assert_eq!(
            first("<math><mi>x.</mi></math> is so. Y"),
            "<math><mi>x.</mi></math> is so."
        );
        assert_eq!(first("<b>All. Here.</b>"), "<b>All. Here.</b>");
        let bound = "At <span class=\"bound\"><math>x</math>.</span>";
        assert_eq!(first(&format!("{bound} The")), bound);
        assert_eq!(first("a < b"), "a < b");
    }
}
