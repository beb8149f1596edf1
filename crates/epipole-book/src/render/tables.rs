//! Tables in scrollable boxes.

use crate::html::escape;
use crate::parse::events::{Located, end_of};
use pulldown_cmark::{Alignment, Event, Tag, TagEnd};

/// Renders a table. `cell` returns HTML and plain text of a cell. If the corner cell is empty, the
/// first column contains row headers.
pub(super) fn table(
    inner: &[Located],
    alignments: &[Alignment],
    cell: &mut dyn FnMut(&[Located]) -> (String, String),
) -> String {
    let mut html = String::from("<div class=\"table\"><table>\n");
    let (mut in_head, mut names_rows, mut column) = (false, false, 0);
    let mut at = 0;
    while at < inner.len() {
        let mut next = at + 1;
        match &inner[at].0 {
            Event::Start(Tag::TableHead) => {
                (in_head, column) = (true, 0);
                html.push_str("<thead><tr>");
            }
            Event::End(TagEnd::TableHead) => {
                in_head = false;
                html.push_str("</tr></thead>\n<tbody>\n");
            }
            Event::Start(Tag::TableRow) => {
                column = 0;
                html.push_str("<tr>");
            }
            Event::End(TagEnd::TableRow) => html.push_str("</tr>\n"),
            Event::Start(Tag::TableCell) => {
                next = end_of(inner, at);
                let (content, words) = cell(&inner[at + 1..next - 1]);
                names_rows |= in_head && column == 0 && words.is_empty();
                let class = match alignments.get(column) {
                    Some(Alignment::Right) => " class=\"right\"",
                    Some(Alignment::Center) => " class=\"center\"",
                    _ => "",
                };
                // Not every tool accepts a formula as a name, so its LaTeX is used.
                let name = if content.starts_with("<math") {
                    let words = escape(&words);
                    format!(
                        "<span class=\"visually-hidden\">{words}</span>\
                         <span aria-hidden=\"true\">{content}</span>"
                    )
                } else {
                    content.clone()
                };
                html.push_str(&match (in_head, column == 0 && names_rows) {
                    (true, true) => "<td></td>".to_owned(),
                    (true, false) => format!("<th scope=\"col\"{class}>{name}</th>"),
                    (false, true) => format!("<th scope=\"row\"{class}>{name}</th>"),
                    (false, false) => format!("<td{class}>{content}</td>"),
                });
                column += 1;
            }
            _ => {}
        }
        at = next;
    }
    html.push_str("</tbody>\n</table></div>\n");
    html
}
