//! Checking of claims in captions and sentences against the figure.
//!
//! A claim is one or more comparisons, separated by semicolons:
//! `samples > 100; verdict has corner`. The left side is the name of a readout, of a control, or
//! `goal.name`; the right side is a number, another name, or words. `name#2` is the second number
//! of a readout that holds several ("0.2% (start: 9.2)").

use super::facts::{Facts, Shown};

const OPERATORS: [&str; 8] = [">=", "<=", "!=", ">", "<", "=", "has", "lacks"];

/// Checks a claim against the facts of a figure.
///
/// # Errors
/// A message with the false comparison and the actual value, or with the part that is
/// invalid.
pub fn check(claim: &str, facts: &Facts) -> Result<(), String> {
    claim
        .split(';')
        .map(str::trim)
        .filter(|test| !test.is_empty())
        .try_for_each(|test| check_one(test, facts))
}

fn check_one(test: &str, facts: &Facts) -> Result<(), String> {
    let words: Vec<&str> = test.split_whitespace().collect();
    let (left, operator, right) = match &words[..] {
        [left, operator, right @ ..] if OPERATORS.contains(operator) && !right.is_empty() => {
            (*left, *operator, right.join(" "))
        }
        _ => {
            let operators = OPERATORS.join(", ");
            return Err(format!(
                "the claim `{test}` is not written `name operator value` with one of {operators}"
            ));
        }
    };
    let shown = look(left, facts)?;
    let holds = match operator {
        "has" => shown.text.contains(&right),
        "lacks" => !shown.text.contains(&right),
        _ => {
            let (a, b) = match (shown.number, value_of(&right, facts)) {
                (Some(a), Some(b)) => (a, b),
                (_, None) => return words_compare(test, operator, &shown, &right),
                (None, _) => {
                    return Err(format!("{left} is \"{}\", which is no number", shown.text));
                }
            };
            match operator {
                ">=" => a >= b,
                "<=" => a <= b,
                ">" => a > b,
                "<" => a < b,
                "!=" => a != b,
                _ => a == b,
            }
        }
    };
    verdict(holds, test, &shown)
}

fn words_compare(test: &str, operator: &str, shown: &Shown, right: &str) -> Result<(), String> {
    match operator {
        "=" => verdict(shown.text == right, test, shown),
        "!=" => verdict(shown.text != right, test, shown),
        _ => Err(format!("\"{right}\" in the claim `{test}` is no number")),
    }
}

fn verdict(holds: bool, test: &str, shown: &Shown) -> Result<(), String> {
    if holds {
        return Ok(());
    }
    let exact = match shown.number {
        Some(number) if !shown.text.contains(&number.to_string()) => format!(" ({number})"),
        _ => String::new(),
    };
    Err(format!(
        "the claim `{test}` is false: the figure shows \"{}\"{exact}",
        shown.text
    ))
}

/// Returns a number, or the value of a name.
fn value_of(right: &str, facts: &Facts) -> Option<f64> {
    let number = right.parse().ok();
    number.or_else(|| look(right, facts).ok()?.number)
}

/// Returns the value of `name` or `name#2`.
fn look(name: &str, facts: &Facts) -> Result<Shown, String> {
    let (id, place) = match name.split_once('#') {
        Some((id, place)) => (
            id,
            place
                .parse()
                .map_err(|_| format!("`{name}`: # needs a count"))?,
        ),
        None => (name, 1_usize),
    };
    let shown = facts.shown(id)?;
    if shown.number.is_some() && place == 1 {
        return Ok(shown);
    }
    let number = numbers_in(&shown.text).get(place.wrapping_sub(1)).copied();
    if number.is_none() && name.contains('#') {
        return Err(format!(
            "{id} is \"{}\", without a number {place}",
            shown.text
        ));
    }
    Ok(Shown { number, ..shown })
}

/// Returns the numbers of a text as printed by figures, including powers of ten.
fn numbers_in(text: &str) -> Vec<f64> {
    const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let letters: Vec<char> = text.chars().collect();
    let mut numbers = Vec::new();
    let mut at = 0;
    while at < letters.len() {
        if !letters[at].is_ascii_digit() {
            at += 1;
            continue;
        }
        let negative = at > 0 && matches!(letters[at - 1], '−' | '-');
        let start = at;
        while at < letters.len()
            && (letters[at].is_ascii_digit()
                || letters[at] == '.' && letters.get(at + 1).is_some_and(char::is_ascii_digit))
        {
            at += 1;
        }
        let mut written: String = letters[start..at].iter().collect();
        if letters[at..].starts_with(&['·', '1', '0']) {
            at += 3;
            written.push('e');
            if letters.get(at) == Some(&'⁻') {
                at += 1;
                written.push('-');
            }
            while let Some(digit) = letters
                .get(at)
                .and_then(|&l| SUPERSCRIPTS.chars().position(|s| s == l))
            {
                written.push_str(&digit.to_string());
                at += 1;
            }
        }
        if let Ok(number) = written.parse::<f64>() {
            numbers.push(if negative { -number } else { number });
        }
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::facts::tests::some_facts;

    #[test]
    fn true_claims_pass() {
        for claim in [
            "off > 2; off < 3",
            "off = 2.345",
            "best = 36",
            "best#2 = 60",
            "best = 36 of 60",
            "best has of; best lacks off",
            "condition >= 150000",
            "size < off",
            "goal.reach = false",
            "",
        ] {
            assert_eq!(check(claim, &some_facts()), Ok(()), "{claim}");
        }
    }

    #[test]
    fn false_and_broken_ones_are_sentences() {
        for (claim, part) in [
            (
                "off > 3",
                "`off > 3` is false: the figure shows \"2.3 px\" (2.345)",
            ),
            ("best#2 < 60", "is false: the figure shows \"36 of 60\""),
            ("size = wide", "is false: the figure shows \"0.50 m\""),
            (
                "size > wide",
                "\"wide\" in the claim `size > wide` is no number",
            ),
            ("best#3 = 1", "without a number 3"),
            ("goal.reach > 0", "which is no number"),
            ("of > 3", "nothing called \"of\""),
            ("off", "is not written `name operator value`"),
        ] {
            let sentence = check(claim, &some_facts()).unwrap_err();
            assert!(sentence.contains(part), "{claim}: {sentence}");
        }
    }

    #[test]
    fn printed_numbers_are_read() {
        assert_eq!(numbers_in("at (−290.8, 239.5), left"), [-290.8, 239.5]);
        assert_eq!(numbers_in("λ 4.12·10⁻⁵. Then 60."), [4.12e-5, 60.0]);
    }
}
