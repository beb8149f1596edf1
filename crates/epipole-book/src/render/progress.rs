//! Where the script of a page tells what the reader has solved and reached.

use crate::html::escape;
use crate::resolve::shared::Shared;
use std::path::Path;

/// Room below a small picture for how much of its page's quiz is solved; the script of the page fills it in.
pub(crate) fn solved_mark(shared: &Shared, file: &str) -> String {
    let path = Path::new(file).with_extension("html");
    let mut quizzes = shared.quizzes().into_iter();
    let quiz = quizzes.find(|quiz| Path::new(&quiz.page) == path);
    quiz.map_or_else(String::new, |quiz| {
        format!(
            "<span class=\"solved\" data-quiz=\"{}\" data-questions=\"{}\" data-goals=\"{}\" hidden></span>",
            escape(&quiz.name),
            quiz.questions,
            escape(&shared.goals_of(&quiz.page).join(" "))
        )
    })
}

/// A table of all quizzes, and of the goals of the figures beside them; the script of the page fills in the results.
pub(crate) fn progress_table(shared: &Shared) -> String {
    let mut html = String::from(
        "<div class=\"progress\">\n<div class=\"table\"><table>\n<thead><tr><th scope=\"col\">Chapter\
         </th><th scope=\"col\">Questions solved</th><th scope=\"col\">Goals reached</th></tr></thead>\n<tbody>\n",
    );
    for quiz in shared.quizzes() {
        let goals = shared.goals_of(&quiz.page);
        let reached = match goals.len() {
            0 => "<td>no goals</td>".to_owned(),
            count => format!(
                "<td class=\"reached\" data-goals=\"{}\">– of {count}</td>",
                escape(&goals.join(" "))
            ),
        };
        html.push_str(&format!(
            "<tr data-quiz=\"{}\"><td><a href=\"{}\">{}</a></td>\
             <td class=\"solved\" data-questions=\"{}\">– of {}</td>{reached}</tr>\n",
            escape(&quiz.name),
            quiz.page,
            escape(&quiz.title),
            quiz.questions,
            quiz.questions
        ));
    }
    html.push_str(
        "</tbody>\n</table></div>\n<p><button type=\"button\" class=\"reset-progress\" hidden>\
         Forget my progress</button></p>\n</div>\n",
    );
    html
}
