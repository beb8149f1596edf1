//! HTML utilities.

/// Escapes the five special characters of HTML.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            letter => escaped.push(letter),
        }
    }
    escaped
}

/// Converts a heading to an anchor: lower-case words, joined by hyphens.
pub fn slug(text: &str) -> String {
    let mut slug = String::new();
    for letter in text.chars() {
        if letter.is_alphanumeric() {
            slug.extend(letter.to_lowercase());
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
    }
    let trimmed = slug.trim_end_matches('-');
    if trimmed.is_empty() {
        "section".to_owned()
    } else {
        trimmed.to_owned()
    }
}

/// Returns the relative path from the page at `page` (such as `part/page.html`) to the root of the
/// book: empty or `../`s.
pub fn path_to_root(page: &str) -> String {
    "../".repeat(page.matches('/').count())
}

/// Returns the first violation of a page's Content-Security-Policy: an inline script, handler or
/// style.
pub fn forbidden_inline(html: &str) -> Option<String> {
    let mut rest = html;
    while let Some(open) = rest.find('<') {
        rest = &rest[open + 1..];
        let name_len = rest
            .find(|c: char| !c.is_ascii_alphanumeric())
            .unwrap_or(rest.len());
        let name = rest[..name_len].to_ascii_lowercase();
        if name.is_empty() {
            continue;
        }
        let (attributes, after) = attributes(&rest[name_len..]);
        if name == "style" {
            return Some("a <style> element".to_owned());
        }
        if name == "script" && !attributes.iter().any(|(key, _)| key == "src") {
            return Some("an inline <script>".to_owned());
        }
        for (key, value) in &attributes {
            if key == "style" || (key.starts_with("on") && key.len() > 2) {
                return Some(format!("the attribute {key}=\"{value}\" of <{name}>"));
            }
            if matches!(key.as_str(), "href" | "src" | "action")
                && value
                    .trim_start()
                    .to_ascii_lowercase()
                    .starts_with("javascript:")
            {
                return Some(format!("a script in {key} of <{name}>"));
            }
        }
        rest = &rest[rest.len() - after.len()..];
    }
    None
}

/// Parses the attributes of a tag, with names in lower case and values as written. Returns them
/// with the rest after the tag.
pub fn attributes(tag: &str) -> (Vec<(String, String)>, &str) {
    let mut found = Vec::new();
    let mut rest = tag;
    loop {
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || c == '/');
        if rest.is_empty() || rest.starts_with('>') {
            return (found, rest.strip_prefix('>').unwrap_or(rest));
        }
        let end = rest
            .find(|c: char| c.is_whitespace() || matches!(c, '=' | '>' | '/'))
            .unwrap_or(rest.len())
            .max(1);
        let end = (end..=rest.len())
            .find(|&at| rest.is_char_boundary(at))
            .unwrap_or(rest.len());
        let key = rest[..end].to_ascii_lowercase();
        rest = rest[end..].trim_start();
        let mut value = "";
        if let Some(after) = rest.strip_prefix('=') {
            let after = after.trim_start();
            let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''));
            let (from, to) = match quote {
                Some(quote) => (1, after[1..].find(quote).map_or(after.len(), |at| at + 1)),
                None => {
                    let end = after.find(|c: char| c.is_whitespace() || c == '>');
                    (0, end.unwrap_or(after.len()))
                }
            };
            value = &after[from..to];
            rest = &after[to..];
            if quote.is_some() {
                rest = rest.get(1..).unwrap_or("");
            }
        }
        found.push((key, value.to_owned()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slugs() {
        assert_eq!(slug("One point, one line!"), "one-point-one-line");
        assert_eq!(slug("Überblick — 3-D"), "überblick-3-d");
        assert_eq!(slug("…"), "section");
    }

    #[test]
    fn inline_code_is_found() {
        for (html, part) in [
            ("<p style=\"x\">", "style"),
            ("<SCRIPT>alert(1)</SCRIPT>", "inline <script>"),
            ("<img src=a onerror='b'>", "onerror"),
            ("<a href=\"javascript:x\">", "script in href"),
            ("<style>", "<style>"),
            ("<a title=\">\" style=b>", "style"),
        ] {
            let found = forbidden_inline(html).unwrap_or_else(|| panic!("{html}"));
            assert!(found.contains(part), "{html}: {found}");
        }
        for html in [
            "<script src=\"a.js\" defer></script>",
            "<p title=\"style=\">a < b onx=</p>",
            "< <",
        ] {
            assert_eq!(forbidden_inline(html), None, "{html}");
        }
    }

    #[test]
    fn roots() {
        assert_eq!(path_to_root("a.html"), "");
        assert_eq!(path_to_root("a/b.html"), "../");
    }
}
