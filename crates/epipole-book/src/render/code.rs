//! Helpers shared by listings and tasks.

use super::insert::Fence;
use super::listing::shown_lines;
use super::writer::Writer;
use crate::problems::Place;

/// Maximum length of a visible line of code, characters; longer lines make even a wide page scroll.
pub(crate) const LONGEST_LINE: usize = 66;

/// Button that copies the visible code; a script activates it.
pub(crate) const COPY: &str = "<button type=\"button\" class=\"copy\" hidden>Copy</button>";

/// Returns a button that runs JavaScript; a script activates it.
pub(crate) fn run_button(label: &str, hint: &str) -> String {
    format!(
        "<button type=\"button\" class=\"run\" data-label=\"{label}\" hidden>\
         <span class=\"run-label\">{label}</span>{hint}</button>"
    )
}

/// Name and title of a listing or a task.
pub(crate) struct Heading {
    pub(crate) name: String,
    /// The title as Markdown.
    pub(crate) title: String,
    /// The title as HTML.
    pub(crate) html: String,
}

/// Registers the name of a listing or a task on the page. False, with a problem, if it is invalid
/// or already used.
pub(crate) fn take_name(page: &mut Writer, name: &str, place: &Place) -> bool {
    let is_name =
        |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
    let known = &mut page.page.listings;
    if known.iter().any(|known| known == name) || !name.chars().all(is_name) {
        let message =
            format!("\"{name}\": a listing needs a name of its own, of small letters and hyphens");
        page.report(place.clone(), message);
        return false;
    }
    known.push(name.to_owned());
    true
}

/// Returns the visible lines of a fence; lines that are too long are reported.
pub(crate) fn shown(fence: &Fence, page: &Writer) -> String {
    let mut shown = String::new();
    for (number, line) in shown_lines(&fence.code, &fence.language) {
        let length = line.chars().count();
        if length > LONGEST_LINE {
            let mut place = fence.place.clone();
            place.line += number + 1;
            let message =
                format!("{length} characters: a line of a listing has at most {LONGEST_LINE}");
            page.report(place, message);
        }
        shown.push_str(line);
        shown.push('\n');
    }
    shown
}
