//! The package document and its parts: metadata, manifest, reading order.

use crate::edition::{Edition, Part};
use anyhow::{Result, bail};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

/// Folder of the book inside the file.
pub(super) const FOLDER: &str = "book";

/// Property of a page, declared in the manifest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Property {
    Mathml,
    Svg,
}

/// A file of the manifest.
#[derive(Serialize)]
pub(super) struct Item {
    path: String,
    media_type: &'static str,
    /// Properties, separated by spaces, if any.
    properties: Option<String>,
}

impl Item {
    pub(super) fn page(path: String, properties: BTreeSet<Property>) -> Item {
        let names = properties.iter().map(|property| match property {
            Property::Mathml => "mathml",
            Property::Svg => "svg",
        });
        let names: Vec<&str> = names.collect();
        Item {
            path,
            media_type: "application/xhtml+xml",
            properties: (!names.is_empty()).then(|| names.join(" ")),
        }
    }
}

/// Variables of `package.hbs` and `contents.hbs`.
#[derive(Serialize)]
pub(super) struct Package<'a> {
    identifier: String,
    language: &'a str,
    title: &'a str,
    description: &'a str,
    authors: &'a [String],
    address: Option<&'a str>,
    modified: &'a str,
    parts: Vec<Part>,
    /// Pages in reading order.
    pages: Vec<Item>,
    /// Pictures and fonts.
    others: Vec<Item>,
}

impl<'a> Package<'a> {
    pub(super) fn new(
        edition: &'a Edition,
        modified: &'a str,
        parts: Vec<Part>,
        pages: Vec<Item>,
    ) -> Package<'a> {
        let book = &edition.config.book;
        Package {
            identifier: identifier(edition.title()),
            language: edition.language(),
            title: edition.title(),
            description: book.description.as_deref().unwrap_or_default(),
            authors: &book.authors,
            address: edition.address.as_deref(),
            modified,
            parts,
            pages,
            others: Vec::new(),
        }
    }

    /// * `cover`: path of one of the pictures
    ///
    /// # Errors
    /// A picture in a format that EPUB does not support.
    pub(super) fn add_pictures(
        &mut self,
        paths: &BTreeSet<String>,
        cover: Option<&str>,
    ) -> Result<()> {
        for path in paths {
            let is_cover = cover == Some(path);
            let properties = is_cover.then(|| "cover-image".to_owned());
            self.others.push(picture(path, properties)?);
        }
        Ok(())
    }

    pub(super) fn add_font(&mut self, path: &str) {
        self.others.push(Item {
            path: path.to_owned(),
            media_type: "font/woff2",
            properties: None,
        });
    }
}

fn picture(path: &str, properties: Option<String>) -> Result<Item> {
    let ending = path.rsplit('.').next().unwrap_or_default();
    let media_type = match ending {
        "jpg" | "jpeg" => "image/jpeg",
        "png" => "image/png",
        "gif" => "image/gif",
        "svg" => "image/svg+xml",
        _ => bail!("{path} is no picture for reading systems: those know JPEG, PNG, GIF and SVG"),
    };
    Ok(Item {
        path: path.to_owned(),
        media_type,
        properties,
    })
}

/// Derives a UUID from a book's title: the same for all its releases.
fn identifier(title: &str) -> String {
    let hash = Sha256::digest(title);
    let mut bytes: Vec<u8> = hash[..16].to_vec();
    // Version 8: a UUID with custom content.
    bytes[6] = bytes[6] & 0x0f | 0x80;
    bytes[8] = bytes[8] & 0x3f | 0x80;
    let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    let groups = [0..8, 8..12, 12..16, 16..20, 20..32].map(|group| &hex[group]);
    format!("urn:uuid:{}", groups.join("-"))
}

/// Whether a text is a time such as `2026-01-31T12:00:00Z`.
pub(super) fn is_time(text: &str) -> bool {
    let pattern = "0000-00-00T00:00:00Z";
    let fits = |(letter, wanted): (char, char)| match wanted {
        '0' => letter.is_ascii_digit(),
        _ => letter == wanted,
    };
    text.len() == pattern.len() && text.chars().zip(pattern.chars()).all(fits)
}

/// Returns the file that names the package document.
pub(super) fn container() -> Vec<u8> {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <container version=\"1.0\" xmlns=\"urn:oasis:names:tc:opendocument:xmlns:container\">\n\
         <rootfiles><rootfile full-path=\"{FOLDER}/package.opf\" \
         media-type=\"application/oebps-package+xml\"/></rootfiles>\n</container>\n"
    )
    .into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_uuids() {
        let identifier = identifier("Tiny");
        assert_eq!(identifier.len(), "urn:uuid:".len() + 36);
        assert_eq!(&identifier[23..24], "8", "{identifier}");
        assert_ne!(identifier, super::identifier("Other"));
    }

    #[test]
    fn times_are_in_utc() {
        assert!(is_time("2026-01-31T12:00:00Z"));
        for other in ["2026-01-31", "2026-01-31T12:00:00+", "2026-01-31 12:00:00Z"] {
            assert!(!is_time(other), "{other}");
        }
    }

    #[test]
    fn pictures_are_of_known_kinds() {
        assert_eq!(picture("a.jpg", None).unwrap().media_type, "image/jpeg");
        assert!(picture("a.webp", None).is_err());
    }
}
