//! Relative links and pictures of a text. Their targets are checked when all pages are known.

use super::page::{Link, WantedFile};
use super::writer::Writer;
use crate::html::escape;
use crate::problems::Place;

/// Folder of the Lab in the site.
pub(crate) const LAB_FOLDER: &str = "lab";

/// Converts a link for the page. Links between chapters name the Markdown file, and the anchor of a
/// section or a figure.
pub(crate) fn rewrite(writer: &mut Writer, written: &str, place: Place) -> String {
    if is_external(written) {
        return written.to_owned();
    }
    if written.starts_with('/') {
        let message =
            format!("the link \"{written}\" starts with /: write it relative to this file");
        writer.report(place, message);
        return written.to_owned();
    }
    let (path, fragment) = match written.split_once('#') {
        Some((path, fragment)) => (path, Some(fragment.to_owned())),
        None => (written, None),
    };
    let own = writer.page.path.clone();
    let link = |page: String, fragment: &Option<String>| Link {
        page,
        fragment: fragment.clone(),
        written: written.to_owned(),
        place: place.clone(),
    };
    if path.is_empty() {
        let own = link(own, &fragment);
        writer.page.links.push(own);
        return written.to_owned();
    }
    if let Some(link) = to_the_lab(&own, path) {
        return link;
    }
    let target = resolve_path(&own, path);
    if let Some(stem) = target.strip_suffix(".md") {
        let page = format!("{stem}.html");
        let shown = path.trim_end_matches(".md");
        let href = match &fragment {
            Some(fragment) => format!("{shown}.html#{fragment}"),
            None => format!("{shown}.html"),
        };
        let link = link(page, &fragment);
        writer.page.links.push(link);
        return href;
    }
    let missing = format!("the link \"{written}\" leads nowhere: there is no {target}");
    writer.page.wanted_files.push(WantedFile {
        path: target,
        place,
        missing,
    });
    written.to_owned()
}

/// Renders a picture of the content folder.
pub(crate) fn image(
    writer: &mut Writer,
    written: &str,
    title: &str,
    alternative: &str,
    place: Place,
) -> String {
    if is_external(written) || written.starts_with('/') {
        let message = format!("the picture \"{written}\" must be a file of the content folder");
        writer.report(place, message);
        return String::new();
    }
    if alternative.is_empty() {
        let message = format!("the picture \"{written}\" needs words for those who cannot see it");
        writer.report(place.clone(), message);
    }
    let target = resolve_path(&writer.page.path, written);
    let missing = format!("there is no picture {target}");
    writer.page.wanted_files.push(WantedFile {
        path: target,
        place,
        missing,
    });
    let title = if title.is_empty() {
        String::new()
    } else {
        format!(" title=\"{}\"", escape(title))
    };
    format!(
        "<img src=\"{}\" alt=\"{}\"{title} loading=\"lazy\" decoding=\"async\">",
        escape(written),
        escape(alternative)
    )
}

/// Converts a link to the Lab, `lab/` with or without parameters, or to its placeholder page until
/// the Lab is built. Names the page explicitly, so that servers need not resolve a folder.
fn to_the_lab(own: &str, written: &str) -> Option<String> {
    let (path, parameters) = match written.find('?') {
        Some(at) => written.split_at(at),
        None => (written, ""),
    };
    let is_the_lab = resolve_path(own, path) == LAB_FOLDER && path.ends_with('/');
    is_the_lab.then(|| format!("{path}index.html{parameters}"))
}

/// Whether a link starts with `https:`, `mailto:` or another scheme.
pub(crate) fn is_external(written: &str) -> bool {
    let scheme = written.split(['/', '#', '?']).next().unwrap_or("");
    scheme.contains(':') || written.starts_with("//")
}

/// Resolves the path `written` relative to the page at `own`.
pub(crate) fn resolve_path(own: &str, written: &str) -> String {
    let mut parts: Vec<&str> = own.split('/').collect();
    parts.pop();
    for part in written.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_resolved() {
        assert_eq!(resolve_path("a.html", "b.md"), "b.md");
        assert_eq!(resolve_path("part/a.html", "../b.md"), "b.md");
        assert_eq!(resolve_path("part/a.html", "./c/d.md"), "part/c/d.md");
    }

    #[test]
    fn links_to_the_lab_name_its_page() {
        let link = |own, written| to_the_lab(own, written);
        assert_eq!(link("a.html", "lab/"), Some("lab/index.html".to_owned()));
        assert_eq!(
            link("part/a.html", "../lab/?step=matches&ratio=0.8"),
            Some("../lab/index.html?step=matches&ratio=0.8".to_owned())
        );
        for other in [
            "lab",
            "lab.md",
            "lab/picture.png",
            "part/lab/",
            "?step=lab/",
        ] {
            assert_eq!(link("a.html", other), None, "{other}");
        }
    }

    #[test]
    fn external_links() {
        for (link, external) in [
            ("https://a.b/c", true),
            ("mailto:a@b", true),
            ("//a.b", true),
            ("a.md#b:c", false),
            ("#x", false),
        ] {
            assert_eq!(is_external(link), external, "{link}");
        }
    }
}
