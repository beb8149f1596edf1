//! Syntax highlighting at build time: comments, strings, numbers, keywords and calls.

use crate::html::escape;

const PYTHON: &[&str] = &[
    "and", "as", "assert", "break", "class", "continue", "def", "del", "elif", "else", "except",
    "False", "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "None",
    "not", "or", "pass", "raise", "return", "True", "try", "while", "with", "yield",
];

const RUST: &[&str] = &[
    "as", "async", "await", "break", "const", "continue", "crate", "else", "enum", "extern",
    "false", "fn", "for", "if", "impl", "in", "let", "loop", "match", "mod", "move", "mut", "pub",
    "ref", "return", "self", "Self", "static", "struct", "super", "trait", "true", "type", "use",
    "where", "while",
];

const JAVASCRIPT: &[&str] = &[
    "async",
    "await",
    "break",
    "case",
    "catch",
    "class",
    "const",
    "continue",
    "default",
    "delete",
    "do",
    "else",
    "export",
    "extends",
    "false",
    "finally",
    "for",
    "from",
    "function",
    "if",
    "import",
    "in",
    "instanceof",
    "let",
    "new",
    "null",
    "of",
    "return",
    "static",
    "super",
    "switch",
    "this",
    "throw",
    "true",
    "try",
    "typeof",
    "undefined",
    "while",
    "yield",
];

struct Language {
    keywords: &'static [&'static str],
    comment: &'static str,
    /// Whether `'` starts a string; in Rust it may start a lifetime.
    single_quotes: bool,
}

/// Highlights a listing with `<span class="hl-…">`. An unknown language stays plain.
pub fn highlight(code: &str, language: &str) -> String {
    let language = match language {
        "python" | "py" => Language {
            keywords: PYTHON,
            comment: "#",
            single_quotes: true,
        },
        "rust" | "rs" => Language {
            keywords: RUST,
            comment: "//",
            single_quotes: false,
        },
        "js" => Language {
            keywords: JAVASCRIPT,
            comment: "//",
            single_quotes: true,
        },
        "html" | "text" | "" => return escape(code),
        _ => Language {
            keywords: &[],
            comment: "#",
            single_quotes: true,
        },
    };
    let mut html = String::with_capacity(code.len() * 2);
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let (length, class) = token(rest, first, &language);
        let (token, after) = rest.split_at(length);
        match class {
            Some(class) => {
                html.push_str(&format!(
                    "<span class=\"hl-{class}\">{}</span>",
                    escape(token)
                ));
            }
            None => html.push_str(&escape(token)),
        }
        rest = after;
    }
    html
}

/// Returns length in bytes and kind of the token at the start of `rest`.
fn token(rest: &str, first: char, language: &Language) -> (usize, Option<&'static str>) {
    if rest.starts_with(language.comment) {
        return (rest.find('\n').unwrap_or(rest.len()), Some("comment"));
    }
    if let Some(inside) = rest.strip_prefix('`') {
        let end = inside.find('`').map_or(rest.len(), |end| end + 2);
        return (end, Some("string"));
    }
    if let Some(inside) = rest.strip_prefix("\"\"\"") {
        let end = inside.find("\"\"\"").map_or(rest.len(), |end| end + 6);
        return (end, Some("string"));
    }
    if first == '"' || (first == '\'' && language.single_quotes) {
        return (quoted(rest, first), Some("string"));
    }
    if first.is_ascii_digit() {
        let is_part = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '.' | '_');
        let length = rest.find(|letter| !is_part(letter)).unwrap_or(rest.len());
        // A range such as `0..n` is two numbers.
        return (rest[..length].find("..").unwrap_or(length), Some("number"));
    }
    if first.is_alphabetic() || first == '_' {
        let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
        let length = rest.find(|letter| !is_part(letter)).unwrap_or(rest.len());
        let class = if language.keywords.contains(&&rest[..length]) {
            Some("keyword")
        } else if rest[length..].starts_with('(') {
            Some("call")
        } else {
            None
        };
        return (length, class);
    }
    (first.len_utf8(), None)
}

/// Returns the length of a string that starts and ends with `quote`.
fn quoted(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, letter) in rest.char_indices().skip(1) {
        match letter {
            '\n' => return at,
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            letter if letter == quote => return at + quote.len_utf8(),
            _ => {}
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn python_and_rust() {
        assert_eq!(
            highlight("for i in f(3):  # \"no\"\n", "python"),
            "<span class=\"hl-keyword\">for</span> i <span class=\"hl-keyword\">in</span> \
             <span class=\"hl-call\">f</span>(<span class=\"hl-number\">3</span>):  \
             <span class=\"hl-comment\"># &quot;no&quot;</span>\n"
        );
        let rust = highlight("let x: &'a str = \"a\\\"b\"; 0..10", "rust");
        assert!(rust.contains("&amp;'a str"), "{rust}");
        assert!(
            rust.contains("<span class=\"hl-string\">&quot;a\\&quot;b&quot;</span>"),
            "{rust}"
        );
        assert!(
            rust.contains("<span class=\"hl-number\">0</span>..<span"),
            "{rust}"
        );
    }

    #[test]
    fn javascript() {
        assert_eq!(
            highlight("await f(`a ${b}\n`); // no", "js"),
            "<span class=\"hl-keyword\">await</span> <span class=\"hl-call\">f</span>\
             (<span class=\"hl-string\">`a ${b}\n`</span>); <span class=\"hl-comment\">// no</span>"
        );
    }

    #[test]
    fn nothing_is_lost() {
        let code = "s = 'open\nπ = \"\"\"a\nb\"\"\" + 1.5e3 < \"end";
        let html = highlight(code, "python");
        let mut plain = String::new();
        let mut inside = false;
        for letter in html.chars() {
            match letter {
                '<' => inside = true,
                '>' if inside => inside = false,
                letter if !inside => plain.push(letter),
                _ => {}
            }
        }
        assert_eq!(plain, escape(code));
    }
}
