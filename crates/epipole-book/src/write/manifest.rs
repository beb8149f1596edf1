//! `manifest.webmanifest`: name, colors and icons of the book as an installed application.

use super::assets::Assets;
use mdbook_driver::config::Config;
use serde_json::{Value, json};

/// Path of the manifest, as in `web/theme/index.hbs`.
pub(crate) const MANIFEST: &str = "manifest.webmanifest";

/// Returns the manifest. Its addresses are relative to its own.
pub(crate) fn manifest(config: &Config, assets: &Assets) -> Value {
    let title = config.book.title.as_deref().unwrap_or("Book");
    let icons: Vec<Value> = assets
        .app_icons
        .iter()
        .map(|icon| json!({"src": icon.path, "sizes": icon.sizes, "type": icon.kind, "purpose": icon.purpose}))
        .collect();
    json!({
        "name": title,
        "short_name": title,
        "description": config.book.description,
        "lang": config.book.language,
        "id": "index.html",
        "start_url": "index.html",
        "scope": "./",
        "display": "minimal-ui",
        "theme_color": "#00558c",
        "background_color": "#ffffff",
        "icons": icons,
    })
}
