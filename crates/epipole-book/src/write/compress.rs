//! Compressed copies (`.br`, `.gz`) of all compressible files, for static servers.

use anyhow::Result;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;

const TEXTUAL: &[&str] = &[
    "css",
    "html",
    "ipynb",
    "js",
    "json",
    "svg",
    "txt",
    "wasm",
    "webmanifest",
    "xml",
];

/// Adds the compressed copies.
///
/// # Errors
/// If a compressor fails, which does not happen in memory.
pub fn add(files: &mut BTreeMap<String, Vec<u8>>) -> Result<()> {
    let compressed: Vec<(String, Vec<u8>)> = files
        .par_iter()
        .filter(|(path, bytes)| {
            bytes.len() > 256 && TEXTUAL.iter().any(|end| path.ends_with(&format!(".{end}")))
        })
        .map(|(path, bytes)| {
            let brotli = (format!("{path}.br"), brotli(bytes)?);
            let gzip = (format!("{path}.gz"), gzip(bytes)?);
            Ok([brotli, gzip])
        })
        .collect::<Result<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect();
    files.extend(compressed);
    Ok(())
}

/// Compresses bytes with Brotli, at the site's settings.
///
/// # Errors
/// As [`add`].
pub fn brotli(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut compressed = Vec::new();
    let mut writer = brotli::CompressorWriter::new(&mut compressed, 1 << 16, 11, 22);
    writer.write_all(bytes)?;
    drop(writer);
    Ok(compressed)
}

/// Compresses bytes with gzip.
///
/// # Errors
/// As [`add`].
pub fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut writer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    writer.write_all(bytes)?;
    Ok(writer.finish()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn copies_decompress_to_the_original() {
        let text = "all the same ".repeat(100).into_bytes();
        let mut files = BTreeMap::from([
            ("a.html".to_owned(), text.clone()),
            ("a.webp".to_owned(), text.clone()),
        ]);
        add(&mut files).unwrap();
        assert_eq!(
            files.keys().collect::<Vec<_>>(),
            ["a.html", "a.html.br", "a.html.gz", "a.webp"]
        );
        let mut unpacked = Vec::new();
        brotli::Decompressor::new(&files["a.html.br"][..], 4096)
            .read_to_end(&mut unpacked)
            .unwrap();
        assert_eq!(unpacked, text);
        unpacked.clear();
        flate2::read::GzDecoder::new(&files["a.html.gz"][..])
            .read_to_end(&mut unpacked)
            .unwrap();
        assert_eq!(unpacked, text);
    }
}
