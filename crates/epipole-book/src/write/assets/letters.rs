//! Letters that the fonts must contain.

use crate::render::page::Page;
use std::collections::BTreeSet;

/// Letters that the fonts must contain.
#[derive(Debug, Clone, Default)]
pub struct Letters {
    /// Letters in formulas.
    pub math: BTreeSet<char>,
    /// Letters in all other text.
    pub text: BTreeSet<char>,
}

/// Collects the letters of all pages.
pub fn used_letters(pages: &[Page]) -> Letters {
    let mut letters = Letters::default();
    // Characters of the theme, the scripts and the readers' own numbers.
    letters.text.extend(' '..='~');
    letters
        .text
        .extend("–—‘’“”…·×−±°√≤≥≈→←↑↓✓✗“”«»§ \u{a0}\u{202f}".chars());
    letters.math.extend(' '..='~');
    for page in pages {
        let mut rest = page.html.as_str();
        while let Some(start) = rest.find("<math") {
            let end = rest[start..]
                .find("</math>")
                .map_or(rest.len(), |end| start + end);
            letters.text.extend(rest[..start].chars());
            let formula = &rest[start..end];
            letters.math.extend(formula.chars());
            // Browsers draw roots with the font's root sign, which the formula does not contain.
            if formula.contains("<msqrt") || formula.contains("<mroot") {
                letters.math.insert('√');
            }
            rest = &rest[end..];
        }
        letters.text.extend(rest.chars());
    }
    let italics: Vec<char> = letters
        .math
        .iter()
        .copied()
        .filter_map(math_italic)
        .collect();
    letters.math.extend(italics);
    for set in [&mut letters.text, &mut letters.math] {
        set.retain(|letter| !letter.is_control());
    }
    letters
}

/// Returns the letter that a browser draws for a variable: a single letter in `<mi>` is set in
/// italics, which are separate letters in mathematics.
fn math_italic(letter: char) -> Option<char> {
    let shifted = |first: char, to: u32| char::from_u32(to + letter as u32 - first as u32);
    match letter {
        // U+1D455 is unassigned, as its letter is Planck's constant.
        'h' => Some('\u{210E}'),
        'A'..='Z' => shifted('A', 0x1D434),
        'a'..='z' => shifted('a', 0x1D44E),
        'Α'..='Ω' => shifted('Α', 0x1D6E2),
        'α'..='ω' => shifted('α', 0x1D6FC),
        '∂' => Some('\u{1D715}'),
        'ϵ' => Some('\u{1D716}'),
        'ϑ' => Some('\u{1D717}'),
        'ϕ' => Some('\u{1D719}'),
        'ϱ' => Some('\u{1D71A}'),
        'ϖ' => Some('\u{1D71B}'),
        'ı' => Some('\u{1D6A4}'),
        'ȷ' => Some('\u{1D6A5}'),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_formulas_and_text_are_distinguished() {
        let html = "<p>αβ <math><mi>𝐱</mi></math>γ</p>".to_owned();
        let letters = used_letters(&[Page {
            html,
            ..Page::default()
        }]);
        assert!(letters.math.contains(&'𝐱') && !letters.text.contains(&'𝐱'));
        assert!(letters.text.contains(&'α') && letters.text.contains(&'γ'));
        assert!(!letters.math.contains(&'α'));
        assert!(letters.math.contains(&'𝐹') && letters.math.contains(&'ℎ'));
        assert!(!letters.math.contains(&'√'));
        for root in ["msqrt", "mroot"] {
            let html = format!("<math><{root}><mn>2</mn></{root}></math>");
            let letters = used_letters(&[Page {
                html,
                ..Page::default()
            }]);
            assert!(letters.math.contains(&'√'), "{root}");
        }
        assert_eq!(math_italic('z'), Some('𝑧'));
        assert_eq!(math_italic('ω'), Some('𝜔'));
        assert_eq!(math_italic('1'), None);
    }
}
