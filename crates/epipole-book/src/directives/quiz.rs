//! `{{#quiz ransac}}`: the quiz `quizzes/ransac.toml`, as forms that a small script checks. Without
//! a script, the page shows the questions and, folded, their answers.

mod file;
mod form;
mod numeric;

use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::Insert;
use crate::render::page::QuizEntry;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use file::Question;

/// A quiz. `T` is the stage of its texts.
pub(super) struct Quiz<T> {
    name: String,
    /// The questions without problems.
    questions: Vec<Question<T>>,
}

impl Directive for Quiz<ParsedText> {
    const NAME: &'static str = "quiz";
    type Resolved = Quiz<Text>;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let name = request.one_word("name")?;
        if !name
            .chars()
            .all(|letter| letter.is_ascii_alphanumeric() || letter == '-')
        {
            return Err(format!("\"{name}\" is not the name of a quiz"));
        }
        let Some(source) = parser.content.read(&format!("quizzes/{name}.toml")) else {
            return Err(format!("there is no quizzes/{name}.toml"));
        };
        let mut text = |written: &str, place: &Place| parser.verbatim(written, place);
        Ok(Quiz {
            name: name.to_owned(),
            questions: file::parse(&source, &mut text, parser.problems),
        })
    }

    fn resolve(self, book: &Book) -> Result<Quiz<Text>, String> {
        let questions = self.questions.into_iter();
        let questions = questions
            .filter_map(|question| question.resolve(|text| text.resolve(book), book.problems));
        Ok(Quiz {
            name: self.name,
            questions: questions.collect(),
        })
    }

    fn render(quiz: Quiz<Text>, page: &mut Writer) -> Insert {
        let (html, questions) = form::quiz(&quiz.name, quiz.questions, &mut |text: Text| {
            text.inline(page)
        });
        page.page.quizzes.push(QuizEntry {
            name: quiz.name,
            questions,
        });
        Insert::Block { html }
    }
}
