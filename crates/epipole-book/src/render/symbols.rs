//! Colored symbols, shared by figures and formulas: the symbols that a chapter lists are colored in
//! all of its formulas.

use crate::html::escape;

/// A symbol that figures draw.
pub(crate) struct Symbol {
    /// Name in chapters.
    pub(crate) name: &'static str,
    /// Name in figures. A pixel and its homogeneous vector share one, as they are the same point of
    /// a picture.
    pub(crate) drawn: &'static str,
    pub(crate) latex: &'static str,
    /// Color role.
    pub(crate) role: &'static str,
    pub(crate) meaning: &'static str,
    /// Marker in the list, in a square of 16.
    pub(crate) mark: &'static str,
}

const DIAMOND: &str = "<path d=\"M8 2l6 6-6 6-6-6z\"/>";
const DISK: &str = "<circle cx=\"8\" cy=\"8\" r=\"5\"/>";
const SQUARE: &str = "<path d=\"M3 3h10v10H3z\"/>";
const LINE: &str = "<path d=\"M1 13L15 3\"/>";
const RING: &str =
    "<circle cx=\"8\" cy=\"8\" r=\"5.5\" fill=\"none\"/><circle cx=\"8\" cy=\"8\" r=\"1\"/>";

pub(crate) const SYMBOLS: [Symbol; 10] = [
    symbol("P", "P", "point", "a point in the world", DIAMOND),
    symbol("X", "X", "point", "a point in the world", DIAMOND),
    symbol("p", "p", "pixel", "its pixel in image 1", DISK),
    symbol(
        "p'",
        "p'",
        "match",
        "its pixel in image 2, the match",
        SQUARE,
    ),
    Symbol {
        drawn: "p",
        ..symbol(
            "x",
            "x",
            "pixel",
            "a pixel of image 1, as (u,\u{a0}v,\u{a0}1)",
            DISK,
        )
    },
    Symbol {
        drawn: "p'",
        ..symbol(
            "x'",
            "x'",
            "match",
            "its match in image 2, as (u′,\u{a0}v′,\u{a0}1)",
            SQUARE,
        )
    },
    symbol("ℓ", "\\ell", "line", "an epipolar line in image 1", LINE),
    symbol("ℓ'", "\\ell'", "line", "the epipolar line in image 2", LINE),
    symbol("e", "e", "epipole", "the epipole in image 1", RING),
    symbol("e'", "e'", "epipole", "the epipole in image 2", RING),
];

const fn symbol(
    name: &'static str,
    latex: &'static str,
    role: &'static str,
    meaning: &'static str,
    mark: &'static str,
) -> Symbol {
    Symbol {
        name,
        drawn: name,
        latex,
        role,
        meaning,
        mark,
    }
}

/// Returns the symbol that a chapter calls `name`.
pub(crate) fn find(name: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.name == name)
}

/// Colors and names the symbols `names` in a formula. A letter with an index, or with a prime that
/// is not in the list, is another symbol.
pub(crate) fn mark(html: &str, names: &[String]) -> String {
    const LEAF: &str = "<mi>";
    const PRIME: &str = "<mi>′</mi>";
    /// MathML of a transposed prime, after the letter itself.
    const PRIME_TRANSPOSED: &str = "<msup><mi>′</mi><mi>⊤</mi></msup>";
    let mut marked = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(at) = rest.find(LEAF) {
        let Some(length) = rest[at + LEAF.len()..].find("</mi>") else {
            break;
        };
        let letter = &rest[at + LEAF.len()..at + LEAF.len() + length];
        let mut end = at + LEAF.len() + length + "</mi>".len();
        let prime = [PRIME, PRIME_TRANSPOSED]
            .into_iter()
            .find(|prime| rest[end..].starts_with(prime));
        let name = match prime {
            Some(_) => format!("{letter}'"),
            None => letter.to_owned(),
        };
        end += prime.map_or(0, str::len);
        let (before, after) = (&rest[..at], &rest[end..]);
        // With an index, an accent, or a prime that has an exponent, it is another symbol.
        let is_other = ["<msub>", "<msubsup>", "<mover>", "<mover accent=\"true\">"]
            .iter()
            .any(|tag| before.ends_with(tag))
            || ["<msup>", "<msub>"].iter().any(|tag| {
                after
                    .strip_prefix(tag)
                    .is_some_and(|rest| rest.starts_with(PRIME))
            });
        let symbol = find(&name).filter(|_| !is_other && names.contains(&name));
        marked.push_str(before);
        let whole = &rest[at..end];
        match symbol {
            Some(Symbol { drawn, role, .. }) => {
                let attributes = format!("data-symbol=\"{}\" data-role=\"{role}\"", escape(drawn));
                marked.push_str(&match prime {
                    Some(PRIME_TRANSPOSED) => format!(
                        "<msup><mrow {attributes}><mi>{letter}</mi>{PRIME}</mrow><mi>⊤</mi></msup>"
                    ),
                    Some(_) => format!("<mrow {attributes}>{whole}</mrow>"),
                    None => whole.replacen(LEAF, &format!("<mi {attributes}>"), 1),
                });
            }
            None => marked.push_str(whole),
        }
        rest = after;
    }
    marked + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::math::{Layout, mathml};

    fn marked(latex: &str, names: &[&str]) -> Vec<String> {
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        let html = mark(&mathml(latex, Layout::Inline).unwrap(), &names);
        let found = html.split("data-symbol=\"").skip(1);
        found
            .map(|rest| rest[..rest.find('"').unwrap()].to_owned())
            .collect()
    }

    #[test]
    fn letters_of_the_list_are_marked_and_no_others() {
        assert_eq!(marked("p' = \\pi(P)", &["P", "p'"]), ["p'", "P"]);
        assert_eq!(marked("\\ell' = F p", &["p", "ℓ'"]), ["ℓ'", "p"]);
        assert_eq!(marked("P' = R P + t", &["P", "p"]), ["P"]);
        assert_eq!(marked("P_1 + p_2'^2 + e^x", &["P", "p"]), [""; 0]);
        assert_eq!(marked("F e = 0, F^\\top e' = 0", &["e", "e'"]), ["e", "e'"]);
        assert_eq!(marked("\\hat x = T x", &["x"]), ["p"]);
        assert_eq!(marked("x'^\\top F x = 0", &["x", "x'"]), ["p'", "p"]);
    }
}
