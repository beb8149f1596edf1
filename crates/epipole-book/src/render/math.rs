//! Conversion of LaTeX to MathML at build time, which needs no script, can be selected, and is
//! accessible to screen readers.

use crate::html::escape;
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

/// Whether a formula is inline or displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// `$…$`
    Inline,
    /// `$$…$$`
    Display,
}

/// Converts a formula to MathML, with its LaTeX as an annotation.
///
/// # Errors
/// The error in the LaTeX, in one line.
pub fn mathml(latex: &str, layout: Layout) -> Result<String, String> {
    let latex = latex.trim();
    if latex.is_empty() {
        return Err("an empty formula".to_owned());
    }
    let storage = Storage::new();
    let events: Vec<_> = Parser::new(latex, &storage)
        .collect::<Result<_, _>>()
        .map_err(|error| one_line(&error.to_string()))?;
    let annotation = escape(latex);
    let config = RenderConfig {
        display_mode: match layout {
            Layout::Inline => DisplayMode::Inline,
            Layout::Display => DisplayMode::Block,
        },
        annotation: Some(&annotation),
        ..RenderConfig::default()
    };
    let mut html = String::new();
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut html, events, config).map_err(|error| error.to_string())?;
    // The renderer writes `\ ` as an entity and escapes it, which would display its name.
    let html = html.replace("&amp;nbsp;", "\u{a0}");
    let html = with_accents(&escape_leaves(&html));
    if html.contains("<merror") || html.contains(" style=") {
        return Err("this LaTeX is not supported (colors and sizes are not)".to_owned());
    }
    let sized = r#"<mo symmetric="true" stretchy="true"minsize"#;
    if ["msup", "msub", "msubsup"]
        .iter()
        .any(|script| html.contains(&format!("<{script}>{sized}")))
    {
        return Err(
            "browsers misplace \\bigr) with an exponent or index: write \\left( and \\right)"
                .to_owned(),
        );
    }
    Ok(match layout {
        Layout::Inline => html,
        Layout::Display => format!("<span class=\"formula\">{html}</span>"),
    })
}

/// Escapes the text inside leaf elements, which the renderer leaves unescaped: `<mo><</mo>`.
fn escape_leaves(html: &str) -> String {
    let mut escaped = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(open) = rest.find("<m") {
        let name: String = rest[open + 1..]
            .chars()
            .take_while(char::is_ascii_alphabetic)
            .collect();
        let Some(end) = rest[open..].find('>') else {
            break;
        };
        let inside = open + end + 1;
        let close = format!("</{name}>");
        let is_leaf = matches!(name.as_str(), "mi" | "mn" | "mo" | "mtext" | "ms");
        match rest[inside..].find(&close).filter(|_| is_leaf) {
            Some(length) => {
                escaped.push_str(&rest[..inside]);
                escaped.push_str(&escape_once(&rest[inside..inside + length]));
                escaped.push_str(&close);
                rest = &rest[inside + length + close.len()..];
            }
            None => {
                escaped.push_str(&rest[..inside]);
                rest = &rest[inside..];
            }
        }
    }
    escaped.push_str(rest);
    escaped
}

/// Marks accents as such. The renderer emits them as letters, which browsers place small and high
/// above their base. Also replaces them by the characters that fonts provide for accents.
fn with_accents(html: &str) -> String {
    const START: &str = "<mover>";
    const END: &str = "</mover>";
    let mut done = String::with_capacity(html.len());
    let mut open = Vec::new();
    let mut rest = html;
    while let Some(place) = [START, END].iter().filter_map(|tag| rest.find(tag)).min() {
        done.push_str(&rest[..place]);
        rest = &rest[place..];
        let tag = if rest.starts_with(START) { START } else { END };
        if tag == START {
            open.push(done.len() + "<mover".len());
        } else if let Some(start) = open.pop() {
            let accent = [('^', 'ˆ'), ('~', '˜'), ('→', '→'), ('˙', '˙'), ('¨', '¨')]
                .into_iter()
                .map(|(letter, mark)| (format!("<mi>{letter}</mi>"), mark))
                .find(|(letter, _)| done.ends_with(letter));
            if let Some((letter, mark)) = accent {
                done.truncate(done.len() - letter.len());
                done.push_str(&format!("<mo stretchy=\"false\">{mark}</mo>"));
                done.insert_str(start, " accent=\"true\"");
            }
        }
        done.push_str(tag);
        rest = &rest[tag.len()..];
    }
    done + rest
}

/// Escapes characters that are not escaped yet.
fn escape_once(text: &str) -> String {
    let plain = text
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    escape(&plain)
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Operators with spaces around them in [`words`].
const SPACED: &[&str] = &[
    "=", "≈", "∼", "<", ">", "≤", "≥", "+", "−", "·", "×", "→", "∈",
];

/// Returns the text of a MathML formula for the search index: `x′T F x = 0`.
pub(super) fn words(html: &str) -> String {
    let shown = html.split("<annotation").next().unwrap_or(html);
    let mut words = String::new();
    for part in shown.split('<') {
        let (tag, text) = part.split_once('>').unwrap_or(("", ""));
        let text = text.replace("&lt;", "<").replace("&gt;", ">");
        let text = text.replace("&amp;", "&");
        let text = text.trim_matches([' ', '\n', '\u{2061}', '\u{2062}']);
        // Cells of a matrix, or numerator and denominator.
        if tag == "/mtd" || tag.starts_with("mtd") || tag.starts_with("mfrac") {
            words.push(' ');
        }
        match tag.starts_with("mo") && SPACED.contains(&text) {
            true => words.push_str(&format!(" {text} ")),
            false => words.extend(text.chars().map(plain_letter)),
        }
    }
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Converts a letter or digit of a mathematical alphabet (bold, script, …) to a plain one.
fn plain_letter(letter: char) -> char {
    let code = letter as u32;
    let plain = match code {
        0x1D400..0x1D6A4 => match (code - 0x1D400) % 52 {
            n @ 0..26 => u32::from(b'A') + n,
            n => u32::from(b'a') + n - 26,
        },
        0x1D7CE..0x1D800 => u32::from(b'0') + (code - 0x1D7CE) % 10,
        _ => code,
    };
    char::from_u32(plain).unwrap_or(letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_space_is_a_space() {
        let html = mathml("a\\ b", Layout::Inline).unwrap();
        let shown = html.split("<annotation").next().unwrap();
        assert!(
            !shown.contains("nbsp") && !shown.contains("&amp;"),
            "{shown}"
        );
    }

    #[test]
    fn formulas_of_the_book() {
        for latex in [
            r"\mathbf{x}_2^\top F \, \mathbf{x}_1 = 0",
            r"N = \left\lceil \frac{\log(1-p)}{\log(1-w^s)} \right\rceil",
            r"E = [\mathbf{t}]_\times R = K_2^\top F K_1",
            r"\begin{pmatrix} a & b \\ c & d \end{pmatrix}",
            r"\sum_{i,j} \lVert q_{ij} - \pi(C_i, X_j) \rVert^2",
            r"\nabla I = (I_u, I_v), \quad Z = \frac{f B}{d}",
            r"\begin{aligned} a &= b \\ &= c \end{aligned}",
            r"\begin{cases} 1 & x > 0 \\ 0 & \text{otherwise} \end{cases}",
        ] {
            let html =
                mathml(latex, Layout::Display).unwrap_or_else(|error| panic!("{latex}: {error}"));
            assert!(
                html.contains("<math") && html.ends_with("</math></span>"),
                "{html}"
            );
        }
    }

    #[test]
    fn formulas_can_be_searched() {
        for (latex, found) in [
            (r"\mathbf{x}_2^\top F \, \mathbf{x}_1 = 0", "x2⊤Fx1 = 0"),
            (r"Z = \frac{f B}{d}", "Z = fBd"),
            ("a < b", "a < b"),
        ] {
            let html = mathml(latex, Layout::Inline).unwrap();
            assert_eq!(words(&html), found, "{html}");
        }
    }

    #[test]
    fn a_wrong_formula_is_refused() {
        for latex in [
            r"\frac{1}",
            r"\nosuchcommand x",
            r"\left( x",
            "",
            "a_b_c",
            r"\color{red} x",
            r"\bigl( x \bigr)^2",
            r"\Bigl[ x \Bigr]_i",
        ] {
            let message = mathml(latex, Layout::Inline)
                .err()
                .unwrap_or_else(|| panic!("{latex}"));
            assert!(!message.is_empty() && !message.contains('\n'));
        }
    }

    #[test]
    fn accents_are_marks() {
        let html = mathml(r"\hat{\tilde x}", Layout::Inline).unwrap();
        let inner = r#"<mover accent="true"><mi>x</mi><mo stretchy="false">˜</mo></mover>"#;
        assert!(html.contains(inner), "{html}");
        let outer = format!(
            r#"<mover accent="true"><mrow>{inner}</mrow><mo stretchy="false">ˆ</mo></mover>"#
        );
        assert!(html.contains(&outer), "{html}");
        let html = mathml(r"\overset{a}{\bar b}", Layout::Inline).unwrap();
        assert!(!html.contains("accent"), "{html}");
    }

    #[test]
    fn the_annotation_is_escaped() {
        let html = mathml("a < b", Layout::Inline).unwrap();
        assert!(
            html.contains("a &lt; b") && html.contains("<mo>&lt;</mo>"),
            "{html}"
        );
        let html = mathml(r"\text{if } a \& b <c", Layout::Inline).unwrap();
        assert!(html.contains("&amp;</m") && !html.contains("<c"), "{html}");
    }
}
