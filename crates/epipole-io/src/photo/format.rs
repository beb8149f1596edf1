//! Recognition of formats by the first bytes of a file.

use crate::Error;
use image::ImageFormat;

/// A supported format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Jpeg,
    Tiff,
    Pnm,
    /// PNG, WebP or BMP.
    Other(ImageFormat),
}

/// Unsupported formats: name, offset and bytes of the signature.
const UNSUPPORTED: [(&str, usize, &[u8]); 36] = [
    ("HEIC", 4, b"ftyphei"),
    ("HEIC", 4, b"ftyphev"),
    ("HEIF", 4, b"ftypmif1"),
    ("HEIF", 4, b"ftypmsf1"),
    ("AVIF", 4, b"ftypavi"),
    ("camera raw (CR3)", 4, b"ftypcrx"),
    ("camera raw (CR2)", 8, b"CR\x02"),
    ("camera raw (RAF)", 0, b"FUJIFILMCCD-RAW"),
    ("camera raw (ORF)", 0, b"IIRO"),
    ("camera raw (ORF)", 0, b"IIRS"),
    ("camera raw (ORF)", 0, b"MMOR"),
    ("camera raw (RW2)", 0, b"IIU\0"),
    ("camera raw (X3F)", 0, b"FOVb"),
    ("GIF", 0, b"GIF8"),
    ("JPEG XL", 0, b"\xFF\x0A"),
    ("JPEG XL", 4, b"JXL \r\n\x87\n"),
    ("JPEG 2000", 4, b"jP  \r\n\x87\n"),
    ("JPEG 2000", 0, b"\xFF\x4F\xFF\x51"),
    ("Photoshop", 0, b"8BPS"),
    ("OpenEXR", 0, b"\x76\x2F\x31\x01"),
    ("Radiance HDR", 0, b"#?RADIANCE"),
    ("PFM", 0, b"PF\n"),
    ("PFM", 0, b"Pf\n"),
    ("QOI", 0, b"qoif"),
    ("DDS", 0, b"DDS "),
    ("ICO", 0, b"\0\0\x01\0"),
    ("PDF", 0, b"%PDF"),
    ("SVG", 0, b"<svg"),
    (VIDEO, 8, b"AVI "),
    (VIDEO, 0, b"\x1A\x45\xDF\xA3"),
    (VIDEO, 4, b"ftyp"),
    ("ZIP", 0, b"PK\x03\x04"),
    (POINTER, 0, b"version https://git-lfs"),
    (PAGE, 0, b"<!DOCTYPE html"),
    (PAGE, 0, b"<!doctype html"),
    (PAGE, 0, b"<html"),
];

const VIDEO: &str = "video";
const POINTER: &str = "pointer (Git LFS)";
const PAGE: &str = "web page (HTML)";

/// Supported formats, in words.
const READ: &str = "PNG, JPEG, WebP, TIFF, BMP or PNM";

/// # Errors
/// [`Error::BadImage`] with the name of the other format, if it is known.
pub(super) fn recognize(bytes: &[u8]) -> Result<Format, Error> {
    if bytes.is_empty() {
        return Err(bad("the file is empty"));
    }
    let starts =
        |at: usize, with: &[u8]| bytes.get(at..).is_some_and(|rest| rest.starts_with(with));
    let other = UNSUPPORTED.iter().find(|(_, at, with)| starts(*at, with));
    if let Some((name, ..)) = other {
        return Err(unsupported(name));
    }
    match image::guess_format(bytes) {
        Ok(ImageFormat::Jpeg) => Ok(Format::Jpeg),
        Ok(ImageFormat::Pnm) => Ok(Format::Pnm),
        Ok(format @ (ImageFormat::Png | ImageFormat::WebP | ImageFormat::Bmp)) => {
            Ok(Format::Other(format))
        }
        // BigTIFF, for files beyond 4 GB, has another version number.
        Ok(ImageFormat::Tiff) => Ok(Format::Tiff),
        _ if starts(0, b"II\x2B\0") || starts(0, b"MM\0\x2B") => Ok(Format::Tiff),
        _ => Err(bad(format!("it is no {READ} file"))),
    }
}

/// Returns the error for a file of another format.
pub(super) fn unsupported(name: &str) -> Error {
    let advice = match name {
        VIDEO => "take single frames out of it, as JPEG or PNG files",
        name if name.starts_with("camera raw") => "develop it to TIFF, JPEG or PNG",
        "ZIP" => "unpack it",
        POINTER => "fetch the image by git lfs pull",
        PAGE => "download the image itself",
        _ => "convert it to JPEG or PNG",
    };
    let article = match ["AVIF", "ICO", "OpenEXR", "SVG"].contains(&name) {
        true => "an",
        false => "a",
    };
    bad(format!(
        "it is {article} {name} file, which is not supported; {advice}"
    ))
}

pub(super) fn bad(why: impl Into<String>) -> Error {
    Error::BadImage { why: why.into() }
}

/// # Errors
/// Without pixels, and beyond the limit.
pub(super) fn check_size(width: u32, height: u32, max_pixels: u64) -> Result<(), Error> {
    match u64::from(width) * u64::from(height) {
        0 => Err(bad("it has no pixels")),
        got if got > max_pixels => Err(Error::TooManyPixels {
            got,
            limit: max_pixels,
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error_of(bytes: &[u8]) -> String {
        recognize(bytes).unwrap_err().to_string()
    }

    #[test]
    fn other_formats_are_named_with_advice() {
        let heic = error_of(b"\0\0\0\x18ftypheic\0\0\0\0mif1heic");
        let expected = "it is a HEIC file, which is not supported; convert it to JPEG or PNG";
        assert!(heic.ends_with(expected), "{heic}");
        let avif = error_of(b"\0\0\0\x1cftypavif\0\0\0\0");
        assert!(avif.contains("it is an AVIF file"), "{avif}");
        let gif = error_of(b"GIF89a\x01\0\x01\0\0\0\0");
        assert!(gif.contains("a GIF file"), "{gif}");
        let raw = error_of(b"II\x2a\0\x10\0\0\0CR\x02\0");
        assert!(raw.ends_with("develop it to TIFF, JPEG or PNG"), "{raw}");
        let video = error_of(b"\0\0\0\x20ftypisom\0\0\x02\0");
        assert!(video.contains("a video file"), "{video}");
        let pointer = error_of(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
        assert!(
            pointer.ends_with("fetch the image by git lfs pull"),
            "{pointer}"
        );
        assert!(error_of(b"<!DOCTYPE html><html>").contains("a web page (HTML) file"));
        assert!(
            error_of(b"Dear reader").ends_with("it is no PNG, JPEG, WebP, TIFF, BMP or PNM file")
        );
        assert!(error_of(b"").ends_with("the file is empty"));
    }

    #[test]
    fn formats_that_are_read_are_recognized() {
        assert_eq!(recognize(b"\xFF\xD8\xFF\xE0"), Ok(Format::Jpeg));
        for start in [b"II\x2a\0", b"MM\0\x2a", b"II\x2b\0", b"MM\0\x2b"] {
            assert_eq!(recognize(start), Ok(Format::Tiff));
        }
        assert_eq!(recognize(b"P5 4 4 255\n"), Ok(Format::Pnm));
        let bmp = Format::Other(ImageFormat::Bmp);
        assert_eq!(recognize(b"BM\x36\0\0\0"), Ok(bmp));
    }
}
