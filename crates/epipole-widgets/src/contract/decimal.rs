//! Parsing of decimal numbers without tables.

/// Powers of ten that `f64` represents exactly.
const EXACT: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];
/// Maximum number of significant digits read; `f64` holds no more.
const MOST_DIGITS: u32 = 18;

/// Parses a finite number: digits with an optional sign, point and exponent.
///
/// `f64::from_str` is exact for seventeen digits, but needs a table of ten kilobytes that every
/// page would download. This is equally exact up to fifteen digits and twenty-two zeros, more than
/// any slider has; beyond that the last digits may be wrong.
///
/// Source: Clinger 1990, "How to read floating point numbers accurately", the fast path.
pub(crate) fn parse_decimal(text: &str) -> Option<f64> {
    let text = text.trim();
    let (is_negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let (mut digits, mut num_digits, mut power) = (0_u64, 0, i64::from(exponent));
    for (part, is_fraction) in [(whole, false), (fraction, true)] {
        for character in part.chars() {
            let digit = character.to_digit(10)?;
            if num_digits < MOST_DIGITS {
                digits = 10 * digits + u64::from(digit);
                num_digits += u32::from(digits > 0);
                power -= i64::from(is_fraction);
            } else {
                power += i64::from(!is_fraction);
            }
        }
    }
    let mut value = digits as f64;
    let mut left = power.unsigned_abs().min(400) as usize;
    while left > 0 {
        let step = left.min(EXACT.len() - 1);
        match power > 0 {
            true => value *= EXACT[step],
            false => value /= EXACT[step],
        }
        left -= step;
    }
    let value = if is_negative { -value } else { value };
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::math::random::Random;

    #[test]
    fn what_people_write_is_read() {
        for text in [
            "0",
            "-0",
            "7",
            "+7",
            " 2.5 ",
            ".5",
            "5.",
            "-12.75",
            "1e3",
            "1.5E-3",
            "0.1",
            "0.3",
            "123456789.012345",
            "1e22",
            "1e-22",
            "00012.50",
            "0.000001",
        ] {
            let expected: f64 = text.trim().parse().unwrap();
            assert_eq!(
                parse_decimal(text).map(f64::to_bits),
                Some(expected.to_bits()),
                "{text}"
            );
        }
        for text in [
            "",
            " ",
            "-",
            ".",
            "e5",
            "1e",
            "1e5.5",
            "0x10",
            "1,5",
            "NaN",
            "inf",
            "1 2",
            "--1",
            "1e999",
            "1e99999999999",
            "٣",
        ] {
            assert_eq!(parse_decimal(text), None, "{text}");
        }
        // More digits and zeros than are read exactly.
        for text in [
            "0.30000000000000004",
            "123456789012345678901234",
            "1e-300",
            "4.9e-324",
            "1e-999",
        ] {
            let expected: f64 = text.parse().unwrap();
            let error = (parse_decimal(text).unwrap() - expected).abs();
            assert!(error <= 1e-14 * expected.abs() + 1e-320, "{text}: {error}");
        }
    }

    #[test]
    fn sliders_come_back_to_the_last_bit() {
        let mut random = Random::new(5);
        for trial in 0..50_000 {
            let reach = EXACT[trial % 8];
            let value = random.uniform(-reach, reach);
            let digits = trial % 9;
            let text = format!("{value:.digits$}");
            let expected: f64 = text.parse().unwrap();
            let read = parse_decimal(&text).map(f64::to_bits);
            assert_eq!(read, Some(expected.to_bits()), "{text}");
        }
    }

    #[test]
    fn any_text_is_survived() {
        let mut random = Random::new(6);
        let letters: Vec<char> = "0123456789.,-+eE x∞".chars().collect();
        for _ in 0..50_000 {
            let length = random.uniform(0.0, 12.0) as usize;
            let letter = |_| letters[random.uniform(0.0, letters.len() as f64) as usize];
            let text: String = (0..length).map(letter).collect();
            // Accepts exactly the texts that std parses as a finite number.
            let expected = text
                .trim()
                .parse::<f64>()
                .ok()
                .filter(|value| value.is_finite());
            assert_eq!(
                parse_decimal(&text).is_some(),
                expected.is_some(),
                "{text:?}"
            );
        }
    }
}
