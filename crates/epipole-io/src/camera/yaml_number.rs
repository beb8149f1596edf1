//! Numbers that every YAML reader recognizes.

/// Writes all digits, a point, and a signed exponent, because `1e5` is a string in YAML 1.1.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        None => text,
        Some((digits, exponent)) => {
            let point = if digits.contains('.') { "" } else { ".0" };
            let sign = if exponent.starts_with('-') { "" } else { "+" };
            format!("{digits}{point}e{sign}{exponent}")
        }
    }
}

/// Writes a list, without brackets.
pub(super) fn numbers(values: &[f64]) -> String {
    let all: Vec<String> = values.iter().map(|&value| number(value)).collect();
    all.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_points_and_signs() {
        let text = numbers(&[5.0, 0.1, 1e-7, -2.5e30, 1e16]);
        assert_eq!(text, "5.0, 0.1, 1.0e-7, -2.5e+30, 1.0e+16");
    }
}
