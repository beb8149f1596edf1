//! Code listings: visible lines and HTML.

use super::highlight::highlight;
use crate::html::escape;
use pulldown_cmark::CodeBlockKind;

/// Comment lines that hide themselves and the rest of the listing.
const HIDES_THE_REST: [&str; 2] = ["# hidden", "// hidden"];

/// Renders a listing outside of `{{#listing}}`, highlighted, with a label of its kind.
pub(crate) fn listing(code: &str, kind: &CodeBlockKind) -> String {
    let language = info(kind).0;
    let code = match language {
        "rust" => code
            .split_inclusive('\n')
            .filter(|line| !is_hidden_rust(line))
            .collect(),
        _ => code.to_owned(),
    };
    pre(&code, language)
}

/// Returns the language of a fence and the word after it, such as `python` and `opencv`.
pub(crate) fn info<'a>(kind: &'a CodeBlockKind) -> (&'a str, &'a str) {
    let info = match kind {
        CodeBlockKind::Fenced(info) => info.as_ref(),
        CodeBlockKind::Indented => "",
    };
    let mut words = info.split([' ', ',']).filter(|word| !word.is_empty());
    let language = words.next().unwrap_or("");
    (language, words.next().unwrap_or(""))
}

/// Renders code in a scrollable box.
pub(crate) fn pre(code: &str, language: &str) -> String {
    let class = match language {
        "" => String::new(),
        language => format!(" class=\"language-{}\"", escape(language)),
    };
    let label = match language {
        "python" => "Python",
        "rust" => "Rust",
        "js" => "JavaScript",
        "html" => "HTML",
        "sh" | "console" | "bash" => "Command line",
        _ => "Listing",
    };
    format!(
        "<pre data-language=\"{label}\"><code{class}>{}</code></pre>\n",
        highlight(code, language)
    )
}

/// Returns the visible lines of `code`, numbered from 0: without assertions, lines hidden by
/// rustdoc's rules, lines below `# hidden`, and repeated empty lines.
pub(crate) fn shown_lines<'a>(code: &'a str, language: &str) -> Vec<(usize, &'a str)> {
    let mut shown: Vec<(usize, &str)> = Vec::new();
    // Number of unclosed brackets of an assertion.
    let mut open = 0;
    for (number, line) in code.lines().enumerate() {
        let words = line.trim();
        if HIDES_THE_REST.contains(&words) {
            break;
        }
        if open > 0 {
            open += brackets(words);
            continue;
        }
        if is_assertion(words, language) {
            open = brackets(words).max(0);
            continue;
        }
        if language == "rust" && is_hidden_rust(line) {
            continue;
        }
        let follows_gap = shown.last().is_none_or(|(_, last)| last.trim().is_empty());
        if !(words.is_empty() && follows_gap) {
            shown.push((number, line));
        }
    }
    while shown.last().is_some_and(|(_, line)| line.trim().is_empty()) {
        shown.pop();
    }
    shown
}

fn is_assertion(words: &str, language: &str) -> bool {
    match language {
        "rust" => ["assert!(", "assert_eq!(", "assert_ne!("]
            .iter()
            .any(|start| words.starts_with(start)),
        "python" => words.starts_with("assert ") || words.starts_with("assert("),
        "js" => words.starts_with("console.assert("),
        _ => false,
    }
}

/// Returns the number of opening minus closing brackets of a line.
fn brackets(line: &str) -> i32 {
    let count = |letter| match letter {
        '(' | '[' | '{' => 1,
        ')' | ']' | '}' => -1,
        _ => 0,
    };
    line.chars().map(count).sum()
}

/// Whether a line is run but not shown: it starts with `# `, as in rustdoc.
fn is_hidden_rust(line: &str) -> bool {
    let line = line.trim_start();
    line.trim_end() == "#" || line.starts_with("# ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(code: &str, language: &str) -> String {
        let lines = shown_lines(code, language);
        lines
            .iter()
            .map(|(_, line)| *line)
            .collect::<Vec<_>>()
            .join("\n")
    }

    #[test]
    fn assertions_stay_out_of_sight() {
        let code = "a = 1\n\nassert f(\n    a,\n) == 2\n\nprint(a)\nassert a\n";
        assert_eq!(shown(code, "python"), "a = 1\n\nprint(a)");
        assert_eq!(shown_lines(code, "python").last(), Some(&(6, "print(a)")));
        let code =
            "# fn main() {\nlet a = 1;\nassert_eq!(\n    a,\n    1\n);\nprintln!(\"{a}\");\n# }\n";
        assert_eq!(shown(code, "rust"), "let a = 1;\nprintln!(\"{a}\");");
        let code = "f();\nconsole.assert(\n  a === 1,\n);\ng();\n";
        assert_eq!(shown(code, "js"), "f();\ng();");
        // These only look like assertions.
        assert_eq!(shown("assertion = 1\n", "python"), "assertion = 1");
    }

    #[test]
    fn a_mark_hides_the_rest() {
        assert_eq!(shown("a = 1\n\n# hidden\nb = 2\n", "python"), "a = 1");
        assert_eq!(shown("f();\n// hidden\ng();\n", "rust"), "f();");
    }
}
