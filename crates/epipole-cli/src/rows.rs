//! Files with a row of numbers in each line.

use crate::failure::Failure;
use std::path::Path;

/// The rows of a text: numbers between spaces or commas; what follows a `#` is a comment.
///
/// * `path`: where it came from, for what is told of it
/// * `columns`: so many numbers of a line are looked at, and needed
///
/// # Errors
/// A sentence that names the line that has fewer, or NaN. Infinities stay: robust searches leave
/// them out and say so.
pub(crate) fn parse(text: &str, path: &Path, columns: usize) -> Result<Vec<Vec<f64>>, Failure> {
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        let numbers: Vec<f64> = line
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|word| !word.is_empty())
            .take(columns)
            .map_while(|word| word.parse().ok())
            .collect();
        if numbers.len() < columns || numbers.iter().any(|number| number.is_nan()) {
            let place = format!("{}:{}", path.display(), index + 1);
            let message = format!("{place}: here should be {columns} numbers, not \"{line}\"");
            return Err(Failure::new("malformed", message));
        }
        rows.push(numbers);
    }
    Ok(rows)
}
