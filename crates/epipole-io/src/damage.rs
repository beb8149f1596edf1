//! Kinds of damage to files, and the number of test cases.

use proptest::prelude::*;

/// Returns a configuration of a thousand cases, or of `EPIPOLE_FUZZ_CASES`.
pub(crate) fn config() -> ProptestConfig {
    let num_cases = std::env::var("EPIPOLE_FUZZ_CASES").ok();
    ProptestConfig {
        cases: num_cases.map_or(1000, |num_cases| {
            num_cases.parse().expect("a number of cases")
        }),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Damage at a fraction of the length.
#[derive(Debug, Clone)]
pub(crate) enum Damage {
    /// A bit flips.
    Flip(f64, u8),
    /// The end is missing.
    Cut(f64),
    /// A part is missing.
    Drop(f64, usize),
    /// A part is repeated.
    Repeat(f64, usize),
    /// Other bytes are inserted.
    Insert(f64, Vec<u8>),
    /// A word is replaced.
    Word(f64, usize),
}

/// Replacements that resemble numbers or keywords.
const WORDS: [&str; 18] = [
    "nan",
    "inf",
    "-inf",
    "1e999",
    "-1e308",
    "1e-320",
    "0",
    "-0",
    "-1",
    "18446744073709551615",
    "4294967296",
    "99999999999999999999999",
    "0x10",
    "1,5",
    "",
    "FIX",
    "\u{feff}",
    "𝟙",
];

pub(crate) fn some_damage() -> impl Strategy<Value = Vec<Damage>> {
    let place = || 0.0..1.0_f64;
    let one = prop_oneof![
        (place(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        place().prop_map(Damage::Cut),
        (place(), 1..20_usize).prop_map(|(at, length)| Damage::Drop(at, length)),
        (place(), 1..20_usize).prop_map(|(at, length)| Damage::Repeat(at, length)),
        (place(), prop::collection::vec(any::<u8>(), 1..8))
            .prop_map(|(at, bytes)| Damage::Insert(at, bytes)),
        (place(), 0..WORDS.len()).prop_map(|(at, word)| Damage::Word(at, word)),
    ];
    prop::collection::vec(one, 0..5)
}

/// Returns the offset at a fraction of the length.
fn place(fraction: f64, length: usize) -> usize {
    ((fraction * (length + 1) as f64) as usize).min(length)
}

pub(crate) fn damage_bytes(bytes: &[u8], changes: &[Damage]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for change in changes {
        let length = bytes.len();
        match change {
            Damage::Flip(at, bit) if length > 0 => {
                bytes[place(*at, length).min(length - 1)] ^= 1 << bit;
            }
            Damage::Flip(..) => {}
            Damage::Cut(at) => bytes.truncate(place(*at, length)),
            Damage::Drop(at, count) => {
                let start = place(*at, length);
                bytes.drain(start..(start + count).min(length));
            }
            Damage::Repeat(at, count) => {
                let start = place(*at, length);
                let part = bytes[start..(start + count).min(length)].to_vec();
                bytes.splice(start..start, part);
            }
            Damage::Insert(at, more) => {
                let start = place(*at, length);
                bytes.splice(start..start, more.iter().copied());
            }
            Damage::Word(at, word) => {
                let is_blank = |b: &u8| b.is_ascii_whitespace();
                let around = place(*at, length);
                let start = bytes[..around]
                    .iter()
                    .rposition(is_blank)
                    .map_or(0, |i| i + 1);
                let end =
                    (bytes[around..].iter().position(is_blank)).map_or(length, |i| around + i);
                bytes.splice(start..end, WORDS[*word].bytes());
            }
        }
    }
    bytes
}

/// Damages a text; invalid UTF-8 is replaced.
pub(crate) fn damage_text(text: &str, changes: &[Damage]) -> String {
    String::from_utf8_lossy(&damage_bytes(text.as_bytes(), changes)).into_owned()
}
