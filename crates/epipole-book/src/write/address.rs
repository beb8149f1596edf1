//! Address of the published book, `[output.epipole] address`, and files for search engines.

use crate::html::escape;
use mdbook_driver::config::Config;

/// Returns the address with a trailing slash, if it is configured.
pub(crate) fn address(config: &Config) -> Option<String> {
    let written = config.get::<String>("output.epipole.address").ok()??;
    Some(format!("{}/", written.trim_end_matches('/')))
}

/// Returns the canonical address of a page below `root`; for an index, that of its folder.
pub(crate) fn of_page(root: &str, path: &str) -> String {
    let path = match path.strip_suffix("index.html") {
        Some(folder) if folder.is_empty() || folder.ends_with('/') => folder,
        _ => path,
    };
    format!("{root}{path}")
}

/// Returns `sitemap.xml`, with all pages.
pub(crate) fn sitemap<'a>(root: &str, paths: impl Iterator<Item = &'a str>) -> String {
    let urls: String = paths
        .map(|path| format!("<url><loc>{}</loc></url>\n", escape(&of_page(root, path))))
        .collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <urlset xmlns=\"http://www.sitemaps.org/schemas/sitemap/0.9\">\n{urls}</urlset>\n"
    )
}

/// Returns `robots.txt`. It names the sitemap, whose address must be absolute.
pub(crate) fn robots(root: Option<&str>) -> String {
    let sitemap = root.map(|root| format!("Sitemap: {root}sitemap.xml\n"));
    format!("User-agent: *\nAllow: /\n{}", sitemap.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_page_is_the_folder_itself() {
        let root = "https://a.example/book/";
        assert_eq!(of_page(root, "index.html"), root);
        assert_eq!(of_page(root, "a/index.html"), format!("{root}a/"));
        assert_eq!(of_page(root, "myindex.html"), format!("{root}myindex.html"));
    }
}
