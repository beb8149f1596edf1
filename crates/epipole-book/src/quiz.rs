//! Quizzes: `content/quizzes/<name>.toml` as forms that a small script checks. Without a script
//! the questions and, folded, their answers are there.

use crate::html::escape;
use crate::numbers::{self, Number};
use crate::problems::{Place, Problems};
use crate::source::Source;
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    question: Vec<Spanned<Question>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// Permanent: the reader's progress is stored under it.
    id: String,
    prompt: String,
    /// Multiple choice: one right answer makes radio buttons, several make check boxes.
    #[serde(default)]
    choices: Vec<Choice>,
    /// A numeric answer that the core computes, written as in `{{#value …}}`.
    value: Option<String>,
    /// A numeric answer that only the question defines.
    answer: Option<f64>,
    /// How far off a numeric answer may be; 0 where it is not given.
    #[serde(default)]
    tolerance: f64,
    unit: Option<String>,
    explanation: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    text: String,
    #[serde(default)]
    right: bool,
    /// What to say to a reader who picks it.
    why: Option<String>,
}

/// How the Markdown of a quiz becomes HTML: text and where it stands.
pub type Inline<'a> = dyn FnMut(&str, Place) -> String + 'a;

/// The HTML of a quiz, and how many questions it has. What is wrong goes to `problems`.
pub fn render(
    name: &str,
    source: &Source,
    inline: &mut Inline,
    problems: &Problems,
) -> (String, usize) {
    let file: File = match toml::from_str(source.text()) {
        Ok(file) => file,
        Err(error) => {
            let at = error.span().map_or(0, |span| span.start);
            problems.report(source.place(at), error.message());
            return (String::new(), 0);
        }
    };
    let mut ids: Vec<&str> = Vec::new();
    let mut html = format!("<div class=\"quiz\" data-quiz=\"{}\">\n", escape(name));
    for (index, spanned) in file.question.iter().enumerate() {
        let question = spanned.as_ref();
        let place = source.place(spanned.span().start);
        if ids.contains(&question.id.as_str()) {
            problems.report(
                place.clone(),
                format!("two questions are called \"{}\"", question.id),
            );
        }
        ids.push(&question.id);
        match body(name, question, &place, inline) {
            Ok((fields, answer)) => {
                let id = escape(&format!("quiz-{name}-{}", question.id));
                let number = index + 1;
                let prompt = inline(&question.prompt, place.clone());
                let explanation = inline(&question.explanation, place.clone());
                html.push_str(&format!(
                    "<form class=\"question\" id=\"{id}\" data-hash=\"{hash:08x}\" autocomplete=\"off\">\n\
                     <fieldset>\n<legend><span class=\"question-number\">Question {number}</span> \
                     {prompt}</legend>\n{fields}\
                     <p class=\"question-actions\" hidden><button type=\"submit\">Check</button></p>\n\
                     <p class=\"verdict\" role=\"status\"></p>\n\
                     <details class=\"solution\"><summary>Answer<span class=\"visually-hidden\"> to \
                     question {number}</span></summary>\n<p><strong>{answer}</strong></p>\n\
                     <p>{explanation}</p>\n</details>\n</fieldset>\n</form>\n",
                    hash = crate::assets::fnv(format!("{prompt}{fields}").as_bytes()) as u32,
                ));
            }
            Err(message) => {
                problems.report(place, format!("question \"{}\": {message}", question.id))
            }
        }
    }
    html.push_str("</div>\n");
    (html, file.question.len())
}

/// The inputs of a question and its answer in words.
fn body(
    name: &str,
    question: &Question,
    place: &Place,
    inline: &mut Inline,
) -> Result<(String, String), String> {
    let kinds = [
        !question.choices.is_empty(),
        question.value.is_some(),
        question.answer.is_some(),
    ];
    if kinds.iter().filter(|&&given| given).count() != 1 {
        return Err("give exactly one of choices, value and answer".to_owned());
    }
    if question.choices.is_empty() {
        return numeric(name, question);
    }
    let right = question
        .choices
        .iter()
        .filter(|choice| choice.right)
        .count();
    if right == 0 {
        return Err("no choice is marked right = true".to_owned());
    }
    let kind = if right == 1 { "radio" } else { "checkbox" };
    let group = escape(&format!("{name}-{}", question.id));
    let mut fields = String::new();
    let mut answers = Vec::new();
    for choice in &question.choices {
        let text = inline(&choice.text, place.clone());
        let why = choice.why.as_ref().map(|why| inline(why, place.clone()));
        let marks = if choice.right { " data-right" } else { "" };
        fields.push_str(&format!(
            "<label class=\"choice\"><input type=\"{kind}\" name=\"{group}\"{marks}> <span>{text}</span></label>\n"
        ));
        if let Some(why) = why {
            fields.push_str(&format!("<p class=\"why\" hidden>{why}</p>\n"));
        }
        if choice.right {
            answers.push(text);
        }
    }
    Ok((fields, answers.join("; ")))
}

fn numeric(name: &str, question: &Question) -> Result<(String, String), String> {
    let (answer, printed) = match (&question.value, question.answer) {
        (Some(call), _) => {
            let (name, settings) = call_parts(call)?;
            let answer = match numbers::compute(&name, &without_digits(&settings))? {
                Number::Count(count) => count as f64,
                Number::Real(value, _) => value,
            };
            (answer, numbers::print(&name, &settings)?)
        }
        (None, Some(answer)) => (answer, answer.to_string()),
        (None, None) => return Err("a numeric question needs value or answer".to_owned()),
    };
    if !answer.is_finite() || !question.tolerance.is_finite() || question.tolerance < 0.0 {
        return Err("answer and tolerance must be finite, and tolerance not negative".to_owned());
    }
    let typed: f64 = printed
        .parse()
        .map_err(|_| "the answer is not a number".to_owned())?;
    if libm::fabs(typed - answer) > question.tolerance {
        return Err(format!(
            "the printed answer {printed} is not within the tolerance {} of {answer}",
            question.tolerance
        ));
    }
    let unit = question
        .unit
        .as_deref()
        .map(|unit| format!(" {}", escape(unit)))
        .unwrap_or_default();
    let id = escape(&format!("{name}-{}-answer", question.id));
    let tolerance = question.tolerance;
    let fields = format!(
        "<p class=\"numeric\"><label for=\"{id}\">Your answer</label> <input id=\"{id}\" \
         inputmode=\"decimal\" size=\"8\" data-answer=\"{answer}\" data-tolerance=\"{tolerance}\">{unit}</p>\n"
    );
    Ok((fields, format!("{printed}{unit}")))
}

fn call_parts(call: &str) -> Result<(String, Vec<(String, String)>), String> {
    let mut words = call.split_whitespace();
    let name = words.next().ok_or("value is empty")?.to_owned();
    let setting = |word: &str| match word.split_once('=') {
        Some((key, value)) => Ok((key.to_owned(), value.to_owned())),
        None => Err(format!("`{word}`: a setting is written key=value")),
    };
    Ok((name, words.map(setting).collect::<Result<_, _>>()?))
}

fn without_digits(settings: &[(String, String)]) -> Vec<(String, String)> {
    settings
        .iter()
        .filter(|(key, _)| key != "digits")
        .cloned()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rendered(toml: &str) -> (String, Vec<String>) {
        let problems = Problems::default();
        let source = Source::new(toml, Place::new("quiz.toml", 1));
        let (html, _) = render("q", &source, &mut |text, _| escape(text), &problems);
        (
            html,
            problems.sorted().iter().map(ToString::to_string).collect(),
        )
    }

    #[test]
    fn choices_and_numbers() {
        let (html, problems) = rendered(
            "[[question]]\nid = 'a'\nprompt = 'P?'\nexplanation = 'E.'\n\
             choices = [{ text = 'yes', right = true }, { text = 'no', why = 'W.' }]\n\
             [[question]]\nid = 'b'\nprompt = 'Q?'\nexplanation = 'E.'\nunit = 'px'\n\
             value = 'camera.project-u f=500 cu=320 x=0.1 z=2'\n",
        );
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!(html.matches("type=\"radio\"").count(), 2);
        assert_eq!(html.matches("data-right").count(), 1);
        assert!(html.contains("data-answer=\"345\""), "{html}");
        assert!(html.contains("<strong>345.0 px</strong>"), "{html}");
        assert!(html.contains("<details class=\"solution\">"));
    }

    #[test]
    fn mistakes_name_their_line() {
        let start = "[[question]]\nid = 'a'\nprompt = 'P?'\nexplanation = 'E.'\n";
        for (rest, expected) in [
            ("", "quiz.toml:1: question \"a\": give exactly one of"),
            (
                "choices = [{ text = 'x' }]",
                "quiz.toml:1: question \"a\": no choice is marked",
            ),
            (
                "value = 'nosuch'",
                "quiz.toml:1: question \"a\": unknown number \"nosuch\"",
            ),
            (
                "answer = nan",
                "quiz.toml:1: question \"a\": answer and tolerance",
            ),
            ("colour = 1", "quiz.toml:5: unknown field `colour`"),
            // 320 + 500 / 3 has no finite decimal form.
            (
                "value = 'camera.project-u f=500 cu=320 x=1 z=3'",
                "not within the tolerance 0",
            ),
        ] {
            let (_, problems) = rendered(&format!("{start}{rest}"));
            assert_eq!(problems.len(), 1, "{rest}");
            assert!(problems[0].contains(expected), "{}", problems[0]);
        }
    }
}
