//! Numbers of single precision on the command line.

/// Reads a number that `fits`; the error names the `range`.
pub(super) fn number(text: &str, fits: impl Fn(f32) -> bool, range: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if fits(value) && value.is_finite() => Ok(value),
        // Too large for 32 bits, such as 1e60.
        Ok(value) if fits(value) && text.parse::<f64>().is_ok_and(f64::is_finite) => {
            Err(format!("\"{text}\" is too large: at most 3e38"))
        }
        _ => Err(format!("\"{text}\" is not a number {range}")),
    }
}

/// Reads a number above 0 and at most 1.
pub(super) fn above_0_up_to_1(text: &str) -> Result<f32, String> {
    number(text, |x| x > 0.0 && x <= 1.0, "above 0 and at most 1")
}

/// Reads a number of 0 or more.
pub(super) fn not_negative(text: &str) -> Result<f32, String> {
    number(text, |x| x >= 0.0, "of 0 or more")
}
