//! Facts of a published page for search engines, in the vocabulary of schema.org.

use super::address::{address, of_page};
use super::cards::Card;
use crate::render::page::Page;
use crate::render::terms::name_of;
use mdbook_driver::config::Config;
use serde_json::{Value, json};

/// A book with a known address.
pub(crate) struct Published {
    /// Address with a trailing slash.
    root: String,
    title: String,
    language: String,
    authors: Vec<String>,
    /// Addresses of the licenses, `[output.epipole] licenses`.
    licenses: Vec<String>,
}

impl Published {
    /// Returns `None` without an address.
    pub(super) fn of(config: &Config) -> Option<Published> {
        let book = &config.book;
        let licenses = config.get::<Vec<String>>("output.epipole.licenses");
        Some(Published {
            root: address(config)?,
            title: book.title.clone().unwrap_or_else(|| "Book".to_owned()),
            language: book.language.clone().unwrap_or_else(|| "en".to_owned()),
            authors: book.authors.clone(),
            licenses: licenses.ok().flatten().unwrap_or_default(),
        })
    }

    /// Returns the path of the book on its server, with slashes at both ends.
    pub(super) fn folder(&self) -> &str {
        let rest = self.root.split_once("://").map_or("", |(_, rest)| rest);
        rest.find('/').map_or("/", |start| &rest[start..])
    }

    pub(super) fn address_of(&self, page: &Page) -> String {
        of_page(&self.root, &page.path)
    }

    /// Returns a card with its absolute address.
    pub(super) fn with_address(&self, card: &Card) -> Card {
        Card {
            path: format!("{}{}", self.root, card.path),
            alt: card.alt.clone(),
        }
    }

    /// Describes a chapter as a learning resource, in JSON for a script element. `None` for other
    /// pages.
    pub(super) fn facts(&self, page: &Page, description: &str) -> Option<String> {
        let number = page.number.as_ref()?;
        let authors = self.authors.iter();
        let authors = authors.map(|name| json!({ "@type": "Organization", "name": name }));
        let authors: Vec<Value> = authors.collect();
        let terms = page.definitions.iter().map(|(key, _)| name_of(key));
        let facts = json!({
            "@context": "https://schema.org",
            "@type": "LearningResource",
            "url": self.address_of(page),
            "name": page.title,
            "description": description,
            "inLanguage": self.language,
            "learningResourceType": "chapter",
            "position": number,
            "isPartOf": { "@type": "Book", "name": self.title, "url": self.root },
            "author": authors,
            "license": self.licenses,
            "isAccessibleForFree": true,
            "timeRequired": page.reading_time_min.map(|minutes| format!("PT{minutes}M")),
            "teaches": terms.collect::<Vec<_>>(),
        });
        Some(facts.to_string().replace('<', "\\u003c"))
    }
}
