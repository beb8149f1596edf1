//! A quiz as forms.

use super::file::{Choice, Kind, Question};
use super::numeric::Answer;
use crate::hash::fnv;
use crate::html::escape;
use crate::render::page::Solvable;
use epipole::math::random::Random;

/// Renders a text inside a paragraph.
type Inline<'a, T> = dyn FnMut(T) -> String + 'a;

/// Renders a quiz as HTML. Returns it with its questions.
pub(super) fn quiz<T>(
    name: &str,
    questions: Vec<Question<T>>,
    inline: &mut Inline<T>,
) -> (String, Vec<Solvable>) {
    let mut html = format!("<div class=\"quiz\" data-quiz=\"{}\">\n", escape(name));
    let mut solvable = Vec::new();
    for question in questions {
        let (form, entry) = form(name, question, inline);
        html.push_str(&form);
        solvable.push(entry);
    }
    html.push_str("</div>\n");
    (html, solvable)
}

fn form<T>(name: &str, question: Question<T>, inline: &mut Inline<T>) -> (String, Solvable) {
    let key = format!("{name}/{}", question.id);
    let group = escape(&format!("{name}-{}", question.id));
    let (fields, answer) = match question.kind {
        Kind::Choices(choices) => multiple_choice(&key, &group, choices, inline),
        Kind::Steps(steps) => ordering(&key, steps, inline),
        Kind::Answer(answer) => numeric(&group, &answer),
        // Resolved questions have their answers.
        Kind::Number(_) => (String::new(), String::new()),
    };
    let id = format!("quiz-{name}-{}", question.id);
    let number = question.number;
    let prompt = inline(question.prompt);
    let explanation = inline(question.explanation);
    let hash = fnv(format!("{prompt}{fields}").as_bytes()) as u32;
    let hash = format!("{hash:08x}");
    let html = format!(
        "<form class=\"question\" id=\"{anchor}\" data-hash=\"{hash}\" autocomplete=\"off\">\n\
         <fieldset>\n<legend><span class=\"question-number\">Question {number}</span> \
         {prompt}</legend>\n{fields}\
         <p class=\"question-actions\" hidden><button type=\"submit\">Check</button></p>\n\
         <p class=\"verdict\" role=\"status\"></p>\n\
         <details class=\"solution\"><summary>Answer<span class=\"visually-hidden\"> to \
         question {number}</span></summary>\n<p><strong>{answer}</strong></p>\n\
         <p>{explanation}</p>\n</details>\n</fieldset>\n</form>\n",
        anchor = escape(&id),
    );
    (html, Solvable { id, hash })
}

/// Renders radio buttons or check boxes. Returns them with the answer as text.
fn multiple_choice<T>(
    key: &str,
    group: &str,
    choices: Vec<Choice<T>>,
    inline: &mut Inline<T>,
) -> (String, String) {
    let rights = choices.iter().filter(|choice| choice.right).count();
    let kind = if rights == 1 { "radio" } else { "checkbox" };
    let order = order(key, choices.len());
    let mut choices: Vec<Option<Choice<T>>> = choices.into_iter().map(Some).collect();
    let mut fields = String::new();
    let mut answers = Vec::new();
    for choice in order.into_iter().filter_map(|index| choices[index].take()) {
        let text = inline(choice.text);
        let why = choice.why.map(&mut *inline);
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
    (fields, answers.join("; "))
}

/// Renders steps to put in order. Each has a list of positions, which needs neither a mouse nor a
/// steady hand. Returns them with the answer as text.
fn ordering<T>(key: &str, steps: Vec<T>, inline: &mut Inline<T>) -> (String, String) {
    let steps: Vec<String> = steps.into_iter().map(inline).collect();
    let places: String = (1..=steps.len())
        .map(|place| format!("<option>{place}</option>"))
        .collect();
    let mut shuffled = order(key, steps.len());
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
    (
        shuffled.into_iter().map(field).collect(),
        answers.join("; "),
    )
}

/// Renders a field for a number. Returns it with the answer as text.
fn numeric(group: &str, answer: &Answer) -> (String, String) {
    let Answer {
        value,
        printed,
        tolerance,
        unit,
    } = answer;
    let unit = unit.as_deref().map(|unit| format!(" {}", escape(unit)));
    let unit = unit.unwrap_or_default();
    let fields = format!(
        "<p class=\"numeric\"><label for=\"{group}-answer\">Your answer</label> <input id=\"{group}-answer\" \
         inputmode=\"decimal\" size=\"8\" data-answer=\"{value}\" data-tolerance=\"{tolerance}\">{unit}</p>\n"
    );
    (fields, format!("{printed}{unit}"))
}

/// Returns the order of a question's choices, the same in every build. It is shuffled, since
/// authors write the correct choice first.
fn order(question: &str, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut random = Random::new(fnv(question.as_bytes()));
    for last in (1..count).rev() {
        order.swap(last, random.below(last + 1));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::directives::quiz::file;
    use crate::parse::source::Source;
    use crate::problems::{Place, Problems};

    fn rendered(toml: &str) -> (String, Vec<String>) {
        let problems = Problems::default();
        let source = Source::new(toml, Place::new("quiz.toml", 1));
        let mut text = |written: &str, _: &Place| written.to_owned();
        let questions = file::parse(&source, &mut text, &problems);
        let questions = questions.into_iter();
        let questions = questions.filter_map(|question| question.resolve(|text| text, &problems));
        let (html, _) = quiz("q", questions.collect(), &mut |text: String| escape(&text));
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
    fn steps_are_shuffled_and_the_answer_has_the_right_order() {
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
    fn the_place_of_a_right_answer_is_unpredictable() {
        // Many questions with four choices, the first of which is correct.
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
            let source = Source::new(
                std::fs::read_to_string(&path).unwrap(),
                Place::new(&path, 1),
            );
            let mut text = |written: &str, _: &Place| written.to_owned();
            let questions = file::parse(&source, &mut text, &Problems::default());
            for question in questions {
                let Kind::Choices(choices) = &question.kind else {
                    continue;
                };
                if choices.iter().filter(|choice| choice.right).count() == 1 {
                    let order = order(&format!("{name}/{}", question.id), choices.len());
                    places.push(order.iter().position(|&index| choices[index].right));
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
