//! Files of the site that pages require.

use crate::parse::content::Content;
use crate::render::page::Page;
use std::collections::BTreeMap;

/// Returns files generated for the pages, files of the content folder that they refer to, and the
/// data of their notebooks.
pub(crate) fn files(pages: &mut [Page], content: &Content) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut copy = |from: &str, to: &str| {
        if let Ok(bytes) = std::fs::read(content.path(from)) {
            files.insert(to.to_owned(), bytes);
        }
    };
    for wanted in pages.iter().flat_map(|page| &page.wanted_files) {
        copy(&wanted.path, &wanted.path);
    }
    if pages.iter().any(|page| !page.cells.is_empty()) {
        for data in content.files_in("listings/data") {
            copy(
                &format!("listings/data/{data}"),
                &format!("notebooks/{data}"),
            );
        }
    }
    for page in pages {
        files.append(&mut page.files);
    }
    files
}
