//! Placeholders for the reader's progress, which the script of a page fills in.

use super::page::{Page, Solvable};
use crate::html::escape;

/// Returns a placeholder below a small picture for the solved fraction of its page's quiz, filled
/// in by the page's script.
pub(super) fn solved_mark(page: &Page) -> String {
    let quiz = page.quizzes.first();
    quiz.map_or_else(String::new, |quiz| {
        format!(
            "<span class=\"solved\" data-quiz=\"{}\" data-questions=\"{}\" data-goals=\"{}\" hidden></span>",
            escape(&quiz.name),
            quiz.questions.len(),
            escape(&page.goal_list())
        )
    })
}

/// Returns a table of all quizzes, with tasks and goals of figures; the page's script fills in the
/// results.
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
                escape(&page.goal_list())
            ),
        };
        let tasks = match page.tasks.is_empty() {
            true => "<td>no tasks</td>".to_owned(),
            false => solved_cell("tasks", &page.tasks),
        };
        html.push_str(&format!(
            "<tr data-quiz=\"{}\"><td><a href=\"{}\">{}</a></td>\
             {}{tasks}{reached}</tr>\n",
            escape(&quiz.name),
            page.path,
            escape(&page.title),
            solved_cell("solved", &quiz.questions),
        ));
    }
    html.push_str(
        "</tbody>\n</table></div>\n<p class=\"progress-actions\" hidden>\
         <button type=\"button\" class=\"save-progress\">Save as a file</button> \
         <button type=\"button\" class=\"open-progress\">Open a file</button> \
         <button type=\"button\" class=\"reset-progress\">Forget my progress</button></p>\n\
         <p class=\"progress-said\" role=\"status\"></p>\n</div>\n",
    );
    html
}

/// Returns a cell that counts solved questions or tasks, with the hashes of their wordings.
fn solved_cell(class: &str, all: &[Solvable]) -> String {
    let wordings: Vec<String> = all
        .iter()
        .map(|Solvable { id, hash }| format!("{id}:{hash}"))
        .collect();
    format!(
        "<td class=\"{class}\" data-wordings=\"{}\">– of {}</td>",
        escape(&wordings.join(" ")),
        all.len()
    )
}
