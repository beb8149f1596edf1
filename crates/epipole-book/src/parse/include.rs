//! `{{#include file}}` and `{{#include file:anchor}}`, also inside listings, so that the code on a
//! page is a tested file.

use super::content::Content;
use super::source::Source;
use crate::problems::Problems;

const OPENING: &str = "{{#include ";

/// Expands all includes of a text. Problems are reported.
pub(crate) fn include(
    source: &Source,
    folder: &str,
    content: &Content,
    problems: &Problems,
) -> Source {
    let text = source.text();
    let mut whole = Source::default();
    let mut from = 0;
    while let Some(found) = text[from..].find(OPENING) {
        let start = from + found;
        let place = source.place(start);
        let Some(length) = text[start..].find("}}") else {
            break;
        };
        let end = start + length + 2;
        whole.push_slice(source, from..start);
        from = end;
        if text[..start].ends_with('\\') {
            whole.push_slice(source, start..end);
            continue;
        }
        let argument = text[start + OPENING.len()..end - 2].trim();
        match part(argument, folder, content) {
            Ok(part) => whole.push_slice(&part, 0..part.text().trim_end_matches('\n').len()),
            Err(message) => problems.report(place, message),
        }
    }
    whole.push_slice(source, from..text.len());
    whole
}

/// Returns the text of `file` or `file:anchor`.
fn part(argument: &str, folder: &str, content: &Content) -> Result<Source, String> {
    let (file, anchor) = match argument.split_once(':') {
        Some((file, anchor)) => (file, Some(anchor)),
        None => (argument, None),
    };
    let path = if folder.is_empty() {
        file.to_owned()
    } else {
        format!("{folder}/{file}")
    };
    let source = content
        .read(&path)
        .ok_or_else(|| format!("there is no file {path} to include"))?;
    let mut chosen = Source::default();
    let mut inside = anchor.is_none();
    let mut included = inside;
    let mut offset = 0;
    for line in source.text().split_inclusive('\n') {
        let end = marked(line, "ANCHOR_END:");
        let begin = marked(line, "ANCHOR:");
        if begin.is_some() || end.is_some() {
            if anchor.is_some() && begin == anchor {
                inside = true;
                included = true;
            } else if anchor.is_some() && end == anchor {
                inside = false;
            }
        } else if inside {
            chosen.push_slice(&source, offset..offset + line.len());
        }
        offset += line.len();
    }
    match anchor {
        Some(anchor) if !included => Err(format!("{path} has no line with `ANCHOR: {anchor}`")),
        _ => Ok(chosen),
    }
}

/// Returns the word after a marker, if the line contains it.
fn marked<'a>(line: &'a str, mark: &str) -> Option<&'a str> {
    line.split_once(mark)
        .and_then(|(_, rest)| rest.split_whitespace().next())
}
