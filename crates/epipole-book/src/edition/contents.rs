//! The table of contents of an edition.

use crate::parse::book::Entry;
use crate::render::page::{Heading, Page};
use serde::Serialize;

/// Pages below a heading of the table of contents.
#[derive(Serialize, Default)]
pub(crate) struct Part {
    /// Heading; `None` for pages outside of parts.
    pub(crate) title: Option<String>,
    pub(crate) pages: Vec<Listed>,
}

#[derive(Serialize)]
pub(crate) struct Listed {
    pub(crate) path: String,
    pub(crate) number: Option<String>,
    pub(crate) title: String,
    pub(crate) sections: Vec<Section>,
}

#[derive(Serialize)]
pub(crate) struct Section {
    pub(crate) path: String,
    pub(crate) title: String,
    pub(crate) html: String,
}

/// Returns the contents without pages that the edition omits. Pages missing in the contents of the
/// site follow at the end.
pub(crate) fn parts(contents: &[Entry], pages: &[Page]) -> Vec<Part> {
    let mut parts = vec![Part::default()];
    let mut rest: Vec<&Page> = pages.iter().collect();
    for entry in contents {
        match entry {
            Entry::Separator => parts.push(Part::default()),
            Entry::Part(title) => parts.push(Part {
                title: Some(title.clone()),
                pages: Vec::new(),
            }),
            Entry::Chapter { path, .. } => {
                let index = rest
                    .iter()
                    .position(|page| Some(&page.path) == path.as_ref());
                if let (Some(index), Some(part)) = (index, parts.last_mut()) {
                    part.pages.push(listed(rest.remove(index)));
                }
            }
        }
    }
    parts.push(Part {
        title: None,
        pages: rest.into_iter().map(listed).collect(),
    });
    parts.retain(|part| !part.pages.is_empty());
    parts
}

fn listed(page: &Page) -> Listed {
    let second = page.headings.iter().filter(|heading| heading.level == 2);
    let section = |heading: &Heading| Section {
        path: format!("{}#{}", page.path, heading.id),
        title: heading.title.clone(),
        html: heading.html.clone(),
    };
    Listed {
        path: page.path.clone(),
        number: page.number.clone(),
        title: page.title.clone(),
        sections: match page.number {
            Some(_) => second.map(section).collect(),
            None => Vec::new(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_leave_out_pages_that_the_edition_leaves_out() {
        let entry = |path: &str| Entry::Chapter {
            number: None,
            title: String::new(),
            path: Some(path.to_owned()),
        };
        let page = |path: &str, title: &str| Page {
            path: path.to_owned(),
            title: title.to_owned(),
            ..Page::default()
        };
        let contents = [
            Entry::Part("Empty".to_owned()),
            entry("gallery.html"),
            Entry::Part("Optics".to_owned()),
            entry("rays.html"),
        ];
        let pages = [page("rays.html", "Rays"), page("answers.html", "Answers")];
        let parts = parts(&contents, &pages);
        let titles = parts.iter().map(|part| part.title.as_deref());
        assert_eq!(titles.collect::<Vec<_>>(), [Some("Optics"), None]);
        let pages = parts.iter().map(|part| part.pages[0].title.as_str());
        assert_eq!(pages.collect::<Vec<_>>(), ["Rays", "Answers"]);
    }
}
