//! Properties of the published chapters.

use epipole_book::parse::source::Source;
use epipole_book::parse::stretches::stretches;
use epipole_book::problems::Place;
use std::fs;
use std::path::Path;

/// The chapters of the book itself: file and text.
fn chapters() -> Vec<(String, String)> {
    let content = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../content");
    let mut found: Vec<(String, String)> = fs::read_dir(content)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect();
    found.sort();
    assert!(found.len() > 8);
    found
}

#[test]
fn nobody_reads_more_than_eight_paragraphs_without_something_to_look_at() {
    let mut long = Vec::new();
    for (name, text) in chapters() {
        let source = Source::new(text, Place::new(name, 1));
        long.extend(
            stretches(&source)
                .into_iter()
                .filter(|stretch| stretch.paragraphs > 8),
        );
    }
    assert!(long.is_empty(), "{long:#?}");
}

#[test]
fn captions_are_short() {
    let mut long = Vec::new();
    for (name, text) in chapters() {
        for (at, _) in text.match_indices("{{#figure ") {
            let tag = &text[at..];
            // Captions hold formulas and no directives with a bar of their own.
            let Some((head, rest)) = tag.split_once(" | ") else {
                continue;
            };
            let caption = rest.split("}}\n").next().unwrap_or(rest);
            let words = caption.split_whitespace().count();
            if words > 40 {
                long.push(format!("{name}: {head}: {words} words"));
            }
        }
    }
    assert!(long.is_empty(), "{long:#?}");
}

/// A choice of a question: its words, whether it is right, and whether it has a comment.
type Choice = (String, bool, bool);

/// The questions of all quizzes: id and choices.
fn choices() -> Vec<(String, Vec<Choice>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../content/quizzes");
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let text = fs::read_to_string(entry.unwrap().path()).unwrap();
        let file: toml::Table = toml::from_str(&text).unwrap();
        for question in file["question"].as_array().unwrap() {
            let id = question["id"].as_str().unwrap().to_owned();
            let choices = question.get("choices").and_then(toml::Value::as_array);
            let choice = |choice: &toml::Value| {
                let text = choice["text"].as_str().unwrap().to_owned();
                let is_right = choice.get("right").is_some();
                (text, is_right, choice.get("why").is_some())
            };
            let choices = choices.into_iter().flatten().map(choice).collect();
            found.push((id, choices));
        }
    }
    assert!(found.len() > 50);
    found
}

#[test]
fn every_wrong_choice_is_explained_and_the_longest_is_not_the_right_one() {
    let (mut single, mut longest) = (0, 0);
    for (id, choices) in choices() {
        for (text, is_right, has_why) in &choices {
            assert!(*is_right || *has_why, "{id}: nothing is said of \"{text}\"");
        }
        if choices.iter().filter(|(_, is_right, _)| *is_right).count() == 1 {
            let by_length = |choice: &&Choice| choice.0.chars().count();
            single += 1;
            longest += usize::from(choices.iter().max_by_key(by_length).unwrap().1);
        }
    }
    assert!(
        single > 25 && 2 * longest <= single,
        "{longest} of {single}"
    );
}
