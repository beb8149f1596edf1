//! Posters of a figure as `<source>`s and files of the site.

use super::writer::Writer;
use crate::html::path_to_root;
use crate::resolve::posters::{Encoded, Posters};

/// Pages of this width have no more room than a phone, or than a column: `web/theme/tokens.css`
/// keeps the figures of the others wider.
const PHONE: &str = "(max-width: 551.98px)";
const COLUMN: &str = "(max-width: 927.98px)";
const DARK: &str = "(prefers-color-scheme: dark)";

/// The posters of a figure for all widths of a page, light and dark.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    /// A `<source>` for each. They carry the sizes, since those differ.
    pub(crate) sources: String,
    /// The widest, light.
    pub(crate) src: String,
}

/// Adds the posters to the page's files.
pub(crate) fn add(page: &mut Writer, name: &str, posters: Posters) -> Pictures {
    let root = path_to_root(&page.page.path);
    let mut add = |encoded: Encoded, suffix: &str| {
        let path = page.add_asset(&format!("figures/{name}-{suffix}"), "webp", encoded.webp);
        (format!("{root}{path}"), encoded.size)
    };
    let mut pictures = Pictures::default();
    let count = posters.0.len();
    for (index, shades) in posters.0.into_iter().enumerate() {
        let width = shades.width;
        let (light, light_size) = add(shades.light, &format!("{width}-light"));
        let (dark, dark_size) = add(shades.dark, &format!("{width}-dark"));
        // The widest is for all pages that the ones before leave.
        let pages = [PHONE, COLUMN].get(index).filter(|_| index + 1 < count);
        let when_dark = pages.map_or(DARK.to_owned(), |pages| format!("{pages} and {DARK}"));
        for (src, media, (width, height)) in [
            (&dark, when_dark.as_str(), dark_size),
            (&light, pages.unwrap_or(&"all"), light_size),
        ] {
            pictures.sources.push_str(&format!(
                "<source srcset=\"{src}\" media=\"{media}\" width=\"{width}\" height=\"{height}\">"
            ));
        }
        pictures.src = light;
    }
    pictures
}
