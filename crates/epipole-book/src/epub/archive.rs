//! The ZIP archive, which begins with its MIME type.

use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Packs the files. Equal files give equal bytes.
pub(super) fn pack(files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let kind = ("mimetype", &b"application/epub+zip"[..]);
    let files = files
        .iter()
        .map(|(path, bytes)| (path.as_str(), &bytes[..]));
    for (path, bytes) in [kind].into_iter().chain(files) {
        let is_stored = path == "mimetype" || path.ends_with(".jpg") || path.ends_with(".png");
        let method = match is_stored {
            true => CompressionMethod::Stored,
            false => CompressionMethod::Deflated,
        };
        let options = SimpleFileOptions::default()
            .compression_method(method)
            .last_modified_time(DateTime::default());
        let failed = || format!("cannot pack {path}");
        archive.start_file(path, options).with_context(failed)?;
        archive.write_all(bytes).with_context(failed)?;
    }
    let written = archive.finish().context("cannot finish the archive")?;
    Ok(written.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kind_is_at_a_fixed_place() {
        let files = BTreeMap::from([("a.txt".to_owned(), b"a".repeat(1000))]);
        let bytes = pack(&files).unwrap();
        assert_eq!(&bytes[30..58], b"mimetypeapplication/epub+zip");
        assert!(bytes.len() < 500, "{} bytes", bytes.len());
        assert_eq!(bytes, pack(&files).unwrap());
    }
}
