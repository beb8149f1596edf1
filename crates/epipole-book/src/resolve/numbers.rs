//! Numbers that chapters print and the core computes.
//!
//! A chapter writes `{{#value ransac.trials s=2 w=0.5 p=0.99}}`. The file for each chapter has the
//! name with its parameters and the core's function. A new number is an entry there and a worked
//! example in the tests. `digits=` sets the decimals. An unknown name or parameter fails the build,
//! so prose cannot diverge from the code.

mod calibration;
mod corners;
mod entry;
mod epipolar;
mod gradients;
mod matching;
mod planes;
mod ransac;
mod rays;
mod sfm;
mod stereo;
mod tracking;
mod triangulation;

use crate::problems::name_list;
pub use entry::{Arguments, Entry, Number};

/// Returns all numbers that chapters may print, in the order of the chapters.
pub fn registry() -> impl Iterator<Item = &'static Entry> {
    let rooms = [
        rays::ENTRIES,
        gradients::ENTRIES,
        corners::ENTRIES,
        matching::ENTRIES,
        epipolar::ENTRIES,
        ransac::ENTRIES,
        triangulation::ENTRIES,
        stereo::ENTRIES,
        sfm::ENTRIES,
        planes::ENTRIES,
        calibration::ENTRIES,
        tracking::ENTRIES,
    ];
    rooms.into_iter().flatten()
}

/// Formats a number, from `name` and `settings` as written by an author.
///
/// # Errors
/// A message with the invalid name, parameter or value, and the valid ones.
pub fn print(name: &str, settings: &[(String, String)]) -> Result<String, String> {
    let mut digits = None;
    let mut rest = Vec::new();
    for (key, value) in settings {
        if key == "digits" {
            let places: usize = value
                .parse()
                .map_err(|_| format!("digits={value} is not a small whole number"))?;
            digits = Some(places.min(12));
        } else {
            rest.push((key.clone(), value.clone()));
        }
    }
    Ok(match compute(name, &rest)? {
        Number::Count(count) => count.to_string(),
        Number::Real(value, places) => fixed(value, digits.unwrap_or(places)),
    })
}

/// Computes a number, for an answer that a reader types.
///
/// # Errors
/// As [`print`].
pub fn compute(name: &str, settings: &[(String, String)]) -> Result<Number, String> {
    let Some(entry) = registry().find(|entry| entry.name == name) else {
        let known: Vec<&str> = registry().map(|entry| entry.name).collect();
        return Err(format!(
            "unknown number \"{name}\"; known numbers: {}",
            name_list(&known)
        ));
    };
    for (key, _) in settings {
        if !entry.parameters.contains(&key.as_str()) {
            let known = name_list(entry.parameters);
            return Err(format!(
                "{name} has no parameter \"{key}\"; its parameters: {known}"
            ));
        }
    }
    let mut values = Vec::new();
    for parameter in entry.parameters {
        let Some((_, text)) = settings.iter().find(|(key, _)| key == parameter) else {
            return Err(format!("{name} needs {parameter}=…"));
        };
        let value: f64 = text
            .parse()
            .map_err(|_| format!("{parameter}={text} is not a number"))?;
        if !value.is_finite() {
            return Err(format!("{parameter}={text} is not a finite number"));
        }
        values.push(value);
    }
    let number = (entry.compute)(&Arguments::new(entry.parameters, &values))
        .map_err(|error| format!("{name}: {error}"))?;
    match number {
        Number::Real(value, _) if !value.is_finite() => Err(format!("{name} is not finite here")),
        number => Ok(number),
    }
}

/// Formats `value` with `places` decimals, never as `-0`.
fn fixed(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|letter| matches!(letter, '0' | '.')) => zero.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests;
