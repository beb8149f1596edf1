//! Placeholders for the reader's progress, which the script of a page fills in.

use super::page::Page;
use crate::html::escape;

/// Placeholder below a small picture for the solved share of its page's quiz, filled in by the
/// page's script.
pub(super) fn solved_mark(page: &Page) -> String {
    let quiz = page.quizzes.first();
    quiz.map_or_else(String::new, |quiz| {
        format!(
            "<span class=\"solved\" data-quiz=\"{}\" data-questions=\"{}\" data-goals=\"{}\" hidden></span>",
            escape(&quiz.name),
            quiz.questions,
            escape(&goals(page))
        )
    })
}

/// A table of all quizzes, and of the tasks and the goals of the figures beside them; the script of
/// the page fills in the results.
pub(super) fn progress_table(pages: &[Page]) -> String {
    let mut html = String::from(
        "<div class=\"progress\">\n<div class=\"table\"><table>\n<thead><tr><th scope=\"col\">Chapter\
         </th><th scope=\"col\">Questions solved</th><th scope=\"col\">Tasks solved</th><th scope=\"col\">Goals reached</th></tr></thead>\n<tbody>\n",
    );
    let quizzes = pages
        .iter()
        .flat_map(|page| page.quizzes.iter().map(move |quiz| (page, quiz)));
    for (page, quiz) in quizzes {
        let reached = match page.goals.len() {
            0 => "<td>no goals</td>".to_owned(),
            count => format!(
                "<td class=\"reached\" data-goals=\"{}\">– of {count}</td>",
                escape(&goals(page))
            ),
        };
        let tasks = match page.tasks {
            0 => "<td>no tasks</td>".to_owned(),
            count => format!("<td class=\"tasks\" data-tasks=\"{count}\">– of {count}</td>"),
        };
        html.push_str(&format!(
            "<tr data-quiz=\"{}\"><td><a href=\"{}\">{}</a></td>\
             <td class=\"solved\" data-questions=\"{}\">– of {}</td>{tasks}{reached}</tr>\n",
            escape(&quiz.name),
            page.path,
            escape(&page.title),
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

fn goals(page: &Page) -> String {
    let goals: Vec<&str> = page.goals.iter().map(String::as_str).collect();
    goals.join(" ")
}
