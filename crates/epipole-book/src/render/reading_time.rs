//! Reading time of a chapter, beside its number.

use super::page::Page;

/// Reading speed for prose, captions and quizzes, words per minute.
const WORDS_PER_MINUTE: usize = 200;

/// Minutes per figure: looking, moving its controls, reaching a goal.
const MINUTES_PER_FIGURE: usize = 2;

/// Rounding of estimates of at least twice this, minutes.
const STEP_MIN: usize = 5;

/// Estimates the reading time of a chapter, minutes; `None` for other pages.
pub(super) fn reading_time_min(page: &Page) -> Option<usize> {
    page.number.as_ref()?;
    let words = page.sections.iter().map(|section| &section.words);
    let count = words.map(|words| words.split_whitespace().count()).sum();
    Some(minutes(count, page.figures.len()))
}

/// Returns the line below the title with the reading time.
pub(super) fn reading_time(minutes: Option<usize>) -> String {
    minutes.map_or_else(String::new, |minutes| {
        format!("<div class=\"reading-time\">About {minutes} min</div>\n")
    })
}

fn minutes(words: usize, figures: usize) -> usize {
    let exact = (words.div_ceil(WORDS_PER_MINUTE) + figures * MINUTES_PER_FIGURE).max(1);
    match exact < 2 * STEP_MIN {
        true => exact,
        false => (exact + STEP_MIN / 2) / STEP_MIN * STEP_MIN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_figures_take_time() {
        assert_eq!(minutes(0, 0), 1);
        assert_eq!(minutes(201, 0), 2);
        assert_eq!(minutes(600, 3), 9);
        assert_eq!(minutes(4000, 1), 20);
        assert_eq!(minutes(4000, 2), 25);
    }

    #[test]
    fn only_chapters_have_a_reading_time() {
        let mut page = Page::default();
        assert_eq!(reading_time(reading_time_min(&page)), "");
        page.number = Some("4".to_owned());
        page.start_section("a", "A");
        page.words = "word ".repeat(500);
        page.end_section();
        assert_eq!(
            reading_time(reading_time_min(&page)),
            "<div class=\"reading-time\">About 3 min</div>\n"
        );
    }
}
