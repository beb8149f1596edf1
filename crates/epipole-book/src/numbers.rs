//! Every number that a chapter prints and the core can compute.
//!
//! A chapter writes `{{#value camera.project-u f=500 cu=320 x=0.1 z=2}}`; the name stands here,
//! with what it needs and the core's function. `digits=` sets the decimals. An unknown name or
//! parameter fails the build, so prose cannot drift away from the code.

use crate::problems::name_list;
use epipole::camera::Intrinsics;
use nalgebra::Point3;

/// A number as the core gives it, and how many decimals to print.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Number {
    /// A whole number.
    Count(u64),
    /// A real number and its decimals.
    Real(f64, usize),
}

/// One line of the registry.
pub struct Entry {
    /// What a chapter calls it.
    pub name: &'static str,
    /// The parameters; all must be given.
    pub parameters: &'static [&'static str],
    /// What it is, for authors.
    pub summary: &'static str,
    compute: fn(&Arguments) -> Result<Number, String>,
}

/// The values of an entry's parameters.
pub struct Arguments<'a> {
    names: &'static [&'static str],
    values: &'a [f64],
}

impl Arguments<'_> {
    fn get(&self, name: &str) -> f64 {
        let index = self.names.iter().position(|known| *known == name);
        index.and_then(|index| self.values.get(index).copied()).unwrap_or(f64::NAN)
    }
}

/// All numbers that chapters may print.
pub const REGISTRY: &[Entry] = &[Entry {
    name: "camera.project-u",
    parameters: &["f", "cu", "x", "z"],
    summary: "column of a point at (x, 0, z), focal length f and principal point cu in pixels",
    compute: |a| {
        let camera = Intrinsics::new(a.get("f"), a.get("f"), a.get("cu"), 0.0).map_err(sentence)?;
        let point = Point3::new(a.get("x"), 0.0, a.get("z"));
        Ok(Number::Real(camera.project(&point).map_err(sentence)?.x, 1))
    },
}];

fn sentence(error: epipole::Error) -> String {
    error.to_string()
}

/// The text of a number: `name` and `settings` as an author writes them.
///
/// # Errors
/// A sentence that says which name, parameter or value is wrong, and what is known.
pub fn print(name: &str, settings: &[(String, String)]) -> Result<String, String> {
    let mut digits = None;
    let mut rest = Vec::new();
    for (key, value) in settings {
        if key == "digits" {
            let places: usize =
                value.parse().map_err(|_| format!("digits={value} is not a small whole number"))?;
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

/// The number itself, for an answer that a reader types.
///
/// # Errors
/// As [`print`].
pub fn compute(name: &str, settings: &[(String, String)]) -> Result<Number, String> {
    let Some(entry) = REGISTRY.iter().find(|entry| entry.name == name) else {
        let known: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
        return Err(format!("unknown number \"{name}\"; known numbers: {}", name_list(&known)));
    };
    for (key, _) in settings {
        if !entry.parameters.contains(&key.as_str()) {
            let known = name_list(entry.parameters);
            return Err(format!("{name} has no parameter \"{key}\"; its parameters: {known}"));
        }
    }
    let mut values = Vec::new();
    for parameter in entry.parameters {
        let Some((_, text)) = settings.iter().find(|(key, _)| key == parameter) else {
            return Err(format!("{name} needs {parameter}=…"));
        };
        let value: f64 =
            text.parse().map_err(|_| format!("{parameter}={text} is not a number"))?;
        if !value.is_finite() {
            return Err(format!("{parameter}={text} is not a finite number"));
        }
        values.push(value);
    }
    let number = (entry.compute)(&Arguments { names: entry.parameters, values: &values })
        .map_err(|error| format!("{name}: {error}"))?;
    match number {
        Number::Real(value, _) if !value.is_finite() => Err(format!("{name} is not finite here")),
        number => Ok(number),
    }
}

/// `value` with `places` decimals; never `-0`.
fn fixed(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|letter| matches!(letter, '0' | '.')) => zero.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(call: &str) -> Result<String, String> {
        let mut words = call.split_whitespace();
        let name = words.next().unwrap();
        let settings: Vec<(String, String)> = words
            .map(|word| word.split_once('=').unwrap())
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect();
        print(name, &settings)
    }

    /// The worked examples of the book. Each can be checked by hand.
    #[test]
    fn worked_numbers() {
        for (call, expected) in [
            // 320 + 500 · 0.1 / 2
            ("camera.project-u f=500 cu=320 x=0.1 z=2", "345.0"),
            ("camera.project-u f=500 cu=320 x=0.1 z=2 digits=0", "345"),
        ] {
            assert_eq!(printed(call).as_deref(), Ok(expected), "{call}");
        }
    }

    #[test]
    fn every_entry_is_pinned_by_name_once() {
        let mut names: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn mistakes_are_sentences() {
        for (call, part) in [
            ("nosuch", "unknown number \"nosuch\"; known numbers: camera.project-u"),
            ("camera.project-u f=1 cu=1 x=1 w=1", "has no parameter \"w\"; its parameters: f, cu"),
            ("camera.project-u f=1 cu=1 x=1", "needs z=…"),
            ("camera.project-u f=1 cu=1 x=1 z=two", "z=two is not a number"),
            ("camera.project-u f=1 cu=1 x=1 z=NaN", "z=NaN is not a finite number"),
            ("camera.project-u f=1 cu=1 x=1 z=-1", "not in front of the camera"),
            ("camera.project-u f=1 cu=1 x=1 z=1 digits=-1", "not a small whole number"),
        ] {
            let message = printed(call).unwrap_err();
            assert!(message.contains(part), "{call}: {message}");
        }
    }

    #[test]
    fn minus_zero_has_no_sign() {
        assert_eq!(fixed(-0.0004, 2), "0.00");
        assert_eq!(fixed(-100.0, 0), "-100");
    }
}
