//! Times as whole nanoseconds.

use crate::{Error, Result};

const NS_PER_S: i64 = 1_000_000_000;

/// Converts seconds to nanoseconds, exactly for up to nine decimals; further ones are cut off.
pub(super) fn from_seconds(line: usize, word: &str) -> Result<i64> {
    let malformed = || Error::at(line, format!("\"{word:.40}\" is not a time in seconds"));
    if let Some(stamp) = decimal(word) {
        return Ok(stamp);
    }
    let seconds: f64 = word.parse().map_err(|_| malformed())?;
    if !seconds.is_finite() {
        return Err(malformed());
    }
    let stamp = (seconds * NS_PER_S as f64).round();
    // The first f64 beyond the largest i64.
    if stamp.abs() >= 9_223_372_036_854_775_808.0 {
        let message = format!(
            "time {word:.40} is beyond 292 years of seconds: if it is in nanoseconds, divide by 1e9"
        );
        return Err(Error::at(line, message));
    }
    Ok(stamp as i64)
}

/// Reads whole nanoseconds, which may have a point: `1403636579763555584.000000`.
pub(super) fn from_nanoseconds(line: usize, word: &str) -> Result<i64> {
    let (whole, digits) = word.split_once('.').unwrap_or((word, ""));
    let is_whole = digits.bytes().all(|b| b == b'0');
    if let (true, Ok(stamp)) = (is_whole, whole.parse()) {
        return Ok(stamp);
    }
    // `1.403636579763555584e+18`: with the precision of an f64.
    let stamp = word
        .parse::<f64>()
        .ok()
        .filter(|stamp| word.contains(['e', 'E']) && stamp.abs() < 9e18);
    stamp.map(|stamp| stamp.round() as i64).ok_or_else(|| {
        Error::at(
            line,
            format!("\"{word:.40}\" is not a whole number of nanoseconds"),
        )
    })
}

/// Reads a decimal of seconds without exponent as nanoseconds, if it fits.
pub(super) fn decimal(word: &str) -> Option<i64> {
    let (sign, digits) = match word.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, word),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let are_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if whole.is_empty() || !are_digits(whole) || !are_digits(part) {
        return None;
    }
    let mut nanoseconds = 0;
    for place in 0..9 {
        let digit = part.as_bytes().get(place).map_or(0, |b| b - b'0');
        nanoseconds = nanoseconds * 10 + i64::from(digit);
    }
    let whole: i64 = whole.parse().ok()?;
    Some(sign * whole.checked_mul(NS_PER_S)?.checked_add(nanoseconds)?)
}

/// Writes seconds with as many decimals as needed.
pub(super) fn to_seconds(stamp_ns: i64) -> String {
    let sign = if stamp_ns < 0 { "-" } else { "" };
    let all = stamp_ns.unsigned_abs();
    let scale = NS_PER_S.unsigned_abs();
    let text = format!("{sign}{}.{:09}", all / scale, all % scale);
    let short = text.trim_end_matches('0');
    match short.ends_with('.') {
        true => format!("{short}0"),
        false => short.to_owned(),
    }
}

/// # Errors
/// [`Error::Malformed`] with the line of a time before the previous one.
///
/// * `stamps`: line and nanoseconds
pub(super) fn check_order(stamps: &[(usize, i64)]) -> Result<()> {
    match stamps.windows(2).find(|pair| pair[1].1 < pair[0].1) {
        None => Ok(()),
        Some(pair) => Err(Error::at(
            pair[1].0,
            format!(
                "time goes backwards, from {} s to {} s: sort the poses by time",
                to_seconds(pair[0].1),
                to_seconds(pair[1].1)
            ),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_keep_all_digits() {
        for text in [
            "1403636579.763555584",
            "0.0",
            "-0.5",
            "1305031102.175304",
            "12.0",
        ] {
            let stamp = from_seconds(1, text).unwrap();
            assert_eq!(to_seconds(stamp), text);
        }
        assert_eq!(from_seconds(1, "1.5e0").unwrap(), 1_500_000_000);
        assert_eq!(from_seconds(1, "2").unwrap(), 2_000_000_000);
        assert_eq!(from_seconds(1, ".5").unwrap(), 500_000_000);
        assert_eq!(from_seconds(1, "0.1234567899").unwrap(), 123_456_789);
        for (text, message) in [
            ("x", "line 1: \"x\" is not a time in seconds"),
            ("nan", "line 1: \"nan\" is not a time in seconds"),
            (
                "1403636579763555584",
                "line 1: time 1403636579763555584 is beyond 292 years of seconds: if it is in nanoseconds, divide by 1e9",
            ),
        ] {
            assert_eq!(from_seconds(1, text).unwrap_err().to_string(), message);
        }
        assert!(check_order(&[(1, 5), (2, 5), (3, 6)]).is_ok());
        let message = "line 4: time goes backwards, from 6.0 s to 5.5 s: sort the poses by time";
        let error = check_order(&[(1, 5), (3, 6_000_000_000), (4, 5_500_000_000)]).unwrap_err();
        assert_eq!(error.to_string(), message);
    }
}
