//! `<source>`s and files for the posters of a figure.

use super::writer::Writer;
use crate::html::path_to_root;
use crate::resolve::posters::{Encoded, Posters};

/// Pages of this width have a figure as narrow as on a phone, then as a column;
/// `web/theme/tokens.css` keeps the figures of the others wider.
const PHONE: &str = "(max-width: 551.98px)";
const COLUMN: &str = "(max-width: 927.98px)";
const DARK: &str = "(prefers-color-scheme: dark)";

/// Posters of a figure for all widths of a page, light and dark.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    /// A `<source>` for each, with its size, since sizes differ.
    pub(crate) sources: String,
    /// Path of the widest light one.
    pub(crate) src: String,
    /// Path in the site of the light one for a column, or for a phone if it is the only one.
    pub(crate) poster: String,
}

/// Adds the posters to the page's files.
pub(crate) fn add(page: &mut Writer, name: &str, posters: Posters) -> Pictures {
    let root = path_to_root(&page.page.path);
    let mut add = |encoded: Encoded, suffix: &str| {
        let ending = encoded.ending();
        let path = page.add_asset(&format!("figures/{name}-{suffix}"), ending, encoded.bytes);
        (format!("{root}{path}"), encoded.size)
    };
    let mut pictures = Pictures::default();
    let count = posters.0.len();
    for (index, shades) in posters.0.into_iter().enumerate() {
        let width = shades.width;
        // The widest is for all remaining pages.
        let pages = [PHONE, COLUMN].get(index).filter(|_| index + 1 < count);
        let light = add(shades.light, &format!("{width}-light"));
        pictures.src.clone_from(&light.0);
        if index < 2 {
            pictures.poster = light.0[root.len()..].to_owned();
        }
        let mut sources = vec![(light, (*pages.unwrap_or(&"all")).to_owned())];
        if let Some(dark) = shades.dark {
            let when_dark = pages.map_or(DARK.to_owned(), |pages| format!("{pages} and {DARK}"));
            sources.insert(0, (add(dark, &format!("{width}-dark")), when_dark));
        }
        for ((src, (width, height)), media) in sources {
            pictures.sources.push_str(&format!(
                "<source srcset=\"{src}\" media=\"{media}\" width=\"{width}\" height=\"{height}\">"
            ));
        }
    }
    pictures
}
