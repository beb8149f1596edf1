//! `embed/`: files for other sites. `epipole.js` is always the newest; `<version>/epipole.js` is
//! fixed to a version, with the hashes of all its files; `widget.js` is self-contained, for pages
//! with anywidgets.

use super::files::Assets;
use crate::tools::{Tools, read};
use anyhow::{Context, Result};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Map, json};
use sha2::{Digest, Sha384};

/// Version, which names its folder.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Paths of the figures' files, from the root of the site.
pub(super) struct Parts<'a> {
    pub(super) elements: &'a str,
    /// Worker; tests have none.
    pub(super) worker: Option<&'a str>,
    pub(super) figures: &'a str,
    pub(super) jobs: &'a str,
}

/// Adds the scripts for other sites.
///
/// # Errors
/// If a part is missing, or the glue for widgets is unreadable.
pub(super) fn add(tools: &Tools, parts: &Parts<'_>, assets: &mut Assets) -> Result<()> {
    let newest = format!("export * from \"../{}\";\n", parts.elements);
    let fixed = format!("export * from \"../../{}\";\n", parts.elements);
    let entry = format!("embed/{VERSION}/epipole.js");
    assets
        .files
        .insert("embed/epipole.js".to_owned(), newest.into_bytes());
    assets.files.insert(entry.clone(), fixed.into_bytes());
    let Some(worker) = parts.worker else {
        return Ok(());
    };
    let all = [
        ("code", parts.elements),
        ("worker", worker),
        ("figures", parts.figures),
        ("jobs", parts.jobs),
    ];
    let content = |path: &str| {
        let bytes = assets.files.get(path);
        bytes.with_context(|| format!("{path} was not made"))
    };
    let mut hashes = Map::new();
    for path in all.map(|(_, path)| path).into_iter().chain([&*entry]) {
        hashes.insert(path.to_owned(), json!(integrity(content(path)?)));
    }
    let mut inside = Map::new();
    for (name, path) in all {
        let text = BASE64_STANDARD.encode(content(path)?);
        inside.insert(name.to_owned(), json!(text));
    }
    let glue = read(
        &tools
            .project
            .join("crates/epipole-python/python/epipole/figures/glue.js"),
    )?;
    let mut widget = format!("const INSIDE = {};\n", json!(inside)).into_bytes();
    widget.extend(glue);
    let manifest = json!({"version": VERSION, "integrity": hashes});
    let manifest = serde_json::to_vec_pretty(&manifest)?;
    let files = [
        (format!("embed/{VERSION}/integrity.json"), manifest),
        ("embed/widget.js".to_owned(), widget),
    ];
    assets.files.extend(files);
    Ok(())
}

/// Formats a hash for the attribute `integrity` and import maps.
fn integrity(bytes: &[u8]) -> String {
    format!("sha384-{}", BASE64_STANDARD.encode(Sha384::digest(bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_that_browsers_expect() {
        // From `printf abc | openssl dgst -sha384 -binary | base64`.
        assert_eq!(
            integrity(b"abc"),
            "sha384-ywB1P0WjXou1oD1pmsZQBycsMqsO3tFjGotgWkP/W+2AhgcroefMI1i67KE0yCWn"
        );
    }
}
