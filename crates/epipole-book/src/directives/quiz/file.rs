//! Parsing of `quizzes/<name>.toml` into questions.

use super::numeric::{Answer, Number};
use crate::parse::source::Source;
use crate::problems::{Place, Problems};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    question: Vec<Spanned<Written>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// Permanent: the reader's progress is stored under it.
    id: String,
    prompt: String,
    /// Multiple choice: radio buttons for one correct choice, check boxes for several. A choice can
    /// be a picture: `{{#small figure … | words}}`.
    #[serde(default)]
    choices: Vec<WrittenChoice>,
    /// Steps to put in order, written in the correct order; readers see them shuffled.
    #[serde(default)]
    steps: Vec<String>,
    /// A numeric answer computed by the core, written as in `{{#value …}}`.
    value: Option<String>,
    /// A numeric answer defined by the question itself.
    answer: Option<f64>,
    /// Tolerance of a numeric answer [default: 0].
    #[serde(default)]
    tolerance: f64,
    unit: Option<String>,
    explanation: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenChoice {
    text: String,
    #[serde(default)]
    right: bool,
    /// Feedback for a reader who picks it.
    why: Option<String>,
}

/// A question. `T` is the stage of its texts.
pub(super) struct Question<T> {
    pub(super) id: String,
    /// Number, from 1.
    pub(super) number: usize,
    pub(super) kind: Kind<T>,
    pub(super) prompt: T,
    pub(super) explanation: T,
    place: Place,
}

/// Kinds of questions.
pub(super) enum Kind<T> {
    /// Choices, of which the first is correct, as authors write them.
    Choices(Vec<Choice<T>>),
    /// Steps in the correct order.
    Steps(Vec<T>),
    /// A numeric answer that is not computed yet.
    Number(Number),
    /// A known numeric answer.
    Answer(Answer),
}

/// A choice of a question.
pub(super) struct Choice<T> {
    pub(super) text: T,
    pub(super) right: bool,
    pub(super) why: Option<T>,
}

/// Converts a text written at a place.
pub(super) type MakeText<'a, T> = dyn FnMut(&str, &Place) -> T + 'a;

/// Parses the questions of a file, without those that have problems. Problems are reported.
pub(super) fn parse<T>(
    source: &Source,
    text: &mut MakeText<T>,
    problems: &Problems,
) -> Vec<Question<T>> {
    let file: File = match toml::from_str(source.text()) {
        Ok(file) => file,
        Err(error) => {
            let at = error.span().map_or(0, |span| span.start);
            problems.report(source.place(at), error.message());
            return Vec::new();
        }
    };
    let mut ids: Vec<&str> = Vec::new();
    let mut questions = Vec::new();
    for (index, spanned) in file.question.iter().enumerate() {
        let written = spanned.as_ref();
        let id = &written.id;
        let place = source.place(spanned.span().start);
        if ids.contains(&id.as_str()) {
            problems.report(place.clone(), format!("two questions are called \"{id}\""));
        }
        ids.push(id);
        match kind(written, &place, text) {
            Ok(kind) => questions.push(Question {
                id: id.clone(),
                number: index + 1,
                kind,
                prompt: text(&written.prompt, &place),
                explanation: text(&written.explanation, &place),
                place,
            }),
            Err(message) => problems.report(place, format!("question \"{id}\": {message}")),
        }
    }
    questions
}

fn kind<T>(written: &Written, place: &Place, text: &mut MakeText<T>) -> Result<Kind<T>, String> {
    let kinds = [
        !written.choices.is_empty(),
        !written.steps.is_empty(),
        written.value.is_some(),
        written.answer.is_some(),
    ];
    if kinds.iter().filter(|&&is_set| is_set).count() != 1 {
        return Err("give exactly one of choices, steps, value and answer".to_owned());
    }
    if !written.steps.is_empty() {
        if written.steps.len() < 3 {
            return Err("two steps have only one other order: give three or more".to_owned());
        }
        let steps = written.steps.iter().map(|step| text(step, place));
        return Ok(Kind::Steps(steps.collect()));
    }
    if written.choices.is_empty() {
        return Ok(Kind::Number(Number {
            value: written.value.clone(),
            answer: written.answer,
            tolerance: written.tolerance,
            unit: written.unit.clone(),
        }));
    }
    if written.choices.iter().all(|choice| !choice.right) {
        return Err("no choice is marked right = true".to_owned());
    }
    let choices = written.choices.iter().map(|choice| Choice {
        text: text(&choice.text, place),
        right: choice.right,
        why: choice.why.as_ref().map(|why| text(why, place)),
    });
    Ok(Kind::Choices(choices.collect()))
}

impl<T> Question<T> {
    /// Resolves the texts and the number of the question; `None` if there is a problem, which is
    /// reported.
    pub(super) fn resolve<U>(
        self,
        mut text: impl FnMut(T) -> U,
        problems: &Problems,
    ) -> Option<Question<U>> {
        let kind = match self.kind {
            Kind::Choices(choices) => Kind::Choices(
                choices
                    .into_iter()
                    .map(|choice| Choice {
                        text: text(choice.text),
                        right: choice.right,
                        why: choice.why.map(&mut text),
                    })
                    .collect(),
            ),
            Kind::Steps(steps) => Kind::Steps(steps.into_iter().map(&mut text).collect()),
            Kind::Answer(answer) => Kind::Answer(answer),
            Kind::Number(number) => match number.answer() {
                Ok(answer) => Kind::Answer(answer),
                Err(message) => {
                    let id = &self.id;
                    problems.report(self.place, format!("question \"{id}\": {message}"));
                    return None;
                }
            },
        };
        Some(Question {
            id: self.id,
            number: self.number,
            kind,
            prompt: text(self.prompt),
            explanation: text(self.explanation),
            place: self.place,
        })
    }
}
