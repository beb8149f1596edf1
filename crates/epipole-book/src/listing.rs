//! Listings of code.

use crate::highlight::highlight;
use crate::html::escape;
use pulldown_cmark::CodeBlockKind;

/// A listing as HTML, highlighted, with a label that says what it is.
pub(crate) fn listing(code: &str, kind: &CodeBlockKind) -> String {
    let language = match kind {
        CodeBlockKind::Fenced(info) => info.split([' ', ',']).next().unwrap_or("").to_owned(),
        CodeBlockKind::Indented => String::new(),
    };
    let shown = if language == "rust" {
        without_hidden_lines(code)
    } else {
        code.to_owned()
    };
    let class = if language.is_empty() {
        String::new()
    } else {
        format!(" class=\"language-{}\"", escape(&language))
    };
    let label = match language.as_str() {
        "python" => "Python",
        "rust" => "Rust",
        "html" => "HTML",
        "sh" | "console" | "bash" => "Command line",
        _ => "Listing",
    };
    format!(
        "<pre data-language=\"{label}\"><code{class}>{}</code></pre>\n",
        highlight(&shown, &language)
    )
}

/// As in Rust's own documentation, a line that starts with `# ` is run but not shown.
fn without_hidden_lines(code: &str) -> String {
    let hidden = |line: &&str| {
        let line = line.trim_start();
        line.trim_end() == "#" || line.starts_with("# ")
    };
    code.split_inclusive('\n')
        .filter(|line| !hidden(line))
        .collect()
}
