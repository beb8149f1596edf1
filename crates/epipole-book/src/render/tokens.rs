//! Tokens: placeholders in a page for content that is known only once all pages are rendered.

/// The page with the list of references.
pub(crate) const PAGE_OF_REFERENCES: &str = "references-page";
/// The page with the glossary.
pub(crate) const PAGE_OF_GLOSSARY: &str = "glossary-page";
/// A link to the definition of a term, by its key.
pub(crate) const DEFINITION: &str = "definition";
/// The page of a figure, and its anchor.
pub(crate) const PAGE_OF_FIGURE: &str = "figure-page";
/// Number of a figure, such as `Figure 4.1`.
pub(crate) const NUMBER_OF_FIGURE: &str = "figure-number";
/// Links to all occurrences of this figure in chapters.
pub(crate) const CHAPTERS_OF_FIGURE: &str = "figure-chapters";
/// Number of solved questions of a page's quiz.
pub(crate) const SOLVED: &str = "solved";
/// The table of quizzes and goals.
pub(crate) const PROGRESS: &str = "progress";
/// A panel of the page, by its index.
pub(crate) const PANEL: &str = "panel";

const OPEN: char = '\u{E010}';
const MIDDLE: char = '\u{E011}';
const CLOSE: char = '\u{E012}';

/// Returns a token.
pub(crate) fn token(kind: &str, name: &str) -> String {
    format!("{OPEN}{kind}{MIDDLE}{name}{CLOSE}")
}

/// Replaces all tokens.
pub(crate) fn fill(html: &str, mut answer: impl FnMut(&str, &str) -> String) -> String {
    let mut filled = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(open) = rest.find(OPEN) {
        filled.push_str(&rest[..open]);
        let after = &rest[open + OPEN.len_utf8()..];
        let (inside, next) = after.split_once(CLOSE).unwrap_or((after, ""));
        let (kind, name) = inside.split_once(MIDDLE).unwrap_or((inside, ""));
        filled.push_str(&answer(kind, name));
        rest = next;
    }
    filled.push_str(rest);
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_filled() {
        let html = format!("a{}b{}", token("k", "n"), token("p", ""));
        assert_eq!(
            fill(&html, |kind, name| format!("[{kind}:{name}]")),
            "a[k:n]b[p:]"
        );
        assert_eq!(fill("plain", |_, _| String::new()), "plain");
    }
}
