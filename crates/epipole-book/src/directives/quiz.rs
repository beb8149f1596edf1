//! Quizzes: `content/quizzes/<name>.toml` as forms that a small script checks. Without a script
//! the questions and, folded, their answers are there.

use crate::html::escape;
use crate::parse::source::Source;
use crate::problems::{Place, Problems};
use crate::resolve::numbers::{self, Number};
use epipole::math::random::Random;
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
    /// Multiple choice: one right answer makes radio buttons, several make check boxes. A choice can be a picture:
    /// `{{#small figure … | words}}`.
    #[serde(default)]
    choices: Vec<Choice>,
    /// Put in order: what comes first stands first; readers see them shuffled.
    #[serde(default)]
    steps: Vec<String>,
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
                    hash = crate::write::assets::fnv(format!("{prompt}{fields}").as_bytes()) as u32,
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
        !question.steps.is_empty(),
        question.value.is_some(),
        question.answer.is_some(),
    ];
    if kinds.iter().filter(|&&given| given).count() != 1 {
        return Err("give exactly one of choices, steps, value and answer".to_owned());
    }
    if !question.steps.is_empty() {
        return ordering(name, question, place, inline);
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
    for index in order(&format!("{name}/{}", question.id), question.choices.len()) {
        let choice = &question.choices[index];
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

/// Steps to put in order: a list of places beside each, which needs neither a mouse nor a steady hand.
fn ordering(
    name: &str,
    question: &Question,
    place: &Place,
    inline: &mut Inline,
) -> Result<(String, String), String> {
    let steps: Vec<String> = (question.steps.iter())
        .map(|step| inline(step, place.clone()))
        .collect();
    if steps.len() < 3 {
        return Err("two steps have only one other order: give three or more".to_owned());
    }
    let places: String = (1..=steps.len())
        .map(|place| format!("<option>{place}</option>"))
        .collect();
    let mut shuffled = order(&format!("{name}/{}", question.id), steps.len());
    if shuffled.is_sorted() {
        shuffled.reverse();
    }
    let field = |index: usize| {
        let (place, step) = (index + 1, &steps[index]);
        format!(
            "<label class=\"step\"><select data-place=\"{place}\"><option value=\"\">–</option>{places}</select> \
             <span>{step}</span></label>\n"
        )
    };
    let answers: Vec<String> = (1..)
        .zip(&steps)
        .map(|(k, step)| format!("{k}. {step}"))
        .collect();
    Ok((
        shuffled.into_iter().map(field).collect(),
        answers.join("; "),
    ))
}

/// The order in which the choices of a question stand, the same in every build: authors write the right
/// one first, and a reader must not find it there.
fn order(question: &str, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut random = Random::new(crate::write::assets::fnv(question.as_bytes()));
    for last in (1..count).rev() {
        order.swap(last, random.below(last + 1));
    }
    order
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
    fn steps_stand_in_another_order_and_the_answer_tells_the_right_one() {
        let start = "[[question]]\nid = 'a'\nprompt = 'P?'\nexplanation = 'E.'\n";
        let (html, problems) = rendered(&format!("{start}steps = ['one', 'two', 'three']"));
        assert_eq!(problems, Vec::<String>::new());
        assert!(
            html.contains("<strong>1. one; 2. two; 3. three</strong>"),
            "{html}"
        );
        let places: Vec<usize> = ["data-place=\"1\"", "data-place=\"2\"", "data-place=\"3\""]
            .map(|mark| html.find(mark).unwrap())
            .into();
        assert!(!places.is_sorted(), "{html}");
        assert_eq!(html.matches("<option>3</option>").count(), 3);
        let (_, problems) = rendered(&format!("{start}steps = ['one', 'two']"));
        assert!(problems[0].contains("three or more"), "{problems:?}");
    }

    #[test]
    fn the_place_of_a_right_answer_tells_nothing() {
        // Of many questions with four choices, whose first is the right one.
        let places: Vec<usize> = (0..400)
            .map(|index| {
                let order = order(&format!("quiz question-{index}"), 4);
                let mut sorted = order.clone();
                sorted.sort_unstable();
                assert_eq!(sorted, [0, 1, 2, 3]);
                order.iter().position(|&choice| choice == 0).unwrap_or(4)
            })
            .collect();
        for place in 0..4 {
            let count = places.iter().filter(|&&other| other == place).count();
            // 100 expected, with a standard deviation of 8.7.
            assert!((70..=130).contains(&count), "{place}: {count}");
            for step in 1..=4 {
                let pairs = places.windows(step + 1);
                let again = pairs.filter(|pair| pair[0] == place && pair[step] == place);
                // 25 expected, with a standard deviation of 4.8.
                assert!(again.count() <= 42, "{place} after {step}");
            }
        }
    }

    #[test]
    fn no_place_in_the_book_is_the_right_one_half_of_the_time() {
        let quizzes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../content/quizzes");
        let mut places = Vec::new();
        for file in std::fs::read_dir(quizzes).unwrap() {
            let path = file.unwrap().path();
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            let file: File = toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
            for question in file.question.iter().map(Spanned::as_ref) {
                let rights = question.choices.iter().filter(|choice| choice.right);
                if rights.count() == 1 {
                    let order = order(&format!("{name}/{}", question.id), question.choices.len());
                    places.push(
                        order
                            .iter()
                            .position(|&index| question.choices[index].right),
                    );
                }
            }
        }
        assert!(places.len() >= 15, "{places:?}");
        for place in 0..4 {
            let count = places.iter().filter(|&&other| other == Some(place)).count();
            assert!(2 * count < places.len(), "{place}: {places:?}");
        }
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
