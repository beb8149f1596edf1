//! Reading and writing files, with clear errors and without partial output.

use crate::failure::Failure;
use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

/// Prints a text and a newline on standard output.
///
/// # Errors
/// If standard output is closed.
pub(crate) fn print(text: &str) -> io::Result<()> {
    print_bytes(format!("{text}\n").as_bytes())
}

/// Prints the content of a file on standard output.
///
/// # Errors
/// If standard output is closed.
pub(crate) fn print_bytes(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

/// Returns whether a path is `-`, standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Writes a temporary file and renames it, so that readers never see a partial file. Links are
/// followed. A pipe or a device such as `/dev/null` is written directly.
///
/// # Errors
/// A failure naming the file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failure =
        |error: io::Error| Failure::new("write", format!("cannot be written: {error}")).about(path);
    let known = fs::metadata(path).ok();
    if known.is_some_and(|known| !known.is_file() && !known.is_dir()) {
        return fs::write(path, bytes).map_err(failure);
    }
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut aside = target.as_os_str().to_owned();
    aside.push(format!(".{}.part", std::process::id()));
    let aside = Path::new(&aside);
    fs::write(aside, bytes)
        .and_then(|()| fs::rename(aside, &target))
        .map_err(|error| {
            // The temporary file may not exist; only the first error matters.
            let _ = fs::remove_file(aside);
            failure(error)
        })
}

/// Reads a text file, or standard input if the path is `-`, without a byte order mark.
///
/// # Errors
/// A failure naming the file.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let text = String::from_utf8(read_bytes(path)?)
        .map_err(|_| Failure::new("read", "this is not a text file").about(path))?;
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}

/// Reads a file, or standard input if the path is `-`.
///
/// # Errors
/// A failure naming the file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = match is_standard(path) {
        true => {
            let mut bytes = Vec::new();
            let read = io::stdin().lock().read_to_end(&mut bytes);
            read.map_err(|error| unreadable(Path::new("standard input"), &error))?;
            bytes
        }
        false => fs::read(path).map_err(|error| unreadable(path, &error))?,
    };
    let packed = COMPRESSED
        .iter()
        .find(|(_, start)| bytes.starts_with(start));
    match packed {
        Some((name, _)) => {
            let message = format!("this file is compressed ({name}): unpack it");
            Err(Failure::new("read", message).about(path))
        }
        None => Ok(bytes),
    }
}

/// First bytes of compressed files.
const COMPRESSED: [(&str, &[u8]); 5] = [
    ("gzip", b"\x1f\x8b"),
    ("bzip2", b"BZh"),
    ("xz", b"\xfd7zXZ"),
    ("zstd", b"\x28\xb5\x2f\xfd"),
    ("zip", b"PK\x03\x04"),
];

/// Returns the error for a file that cannot be read.
pub(crate) fn unreadable(path: &Path, error: &io::Error) -> Failure {
    let why = match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::IsADirectory => "this is a folder, where a file is expected".to_owned(),
        _ => format!("cannot be read: {error}"),
    };
    Failure::new("read", why).about(path)
}

/// Makes a folder, with those above it.
///
/// # Errors
/// A failure naming the folder.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        Failure::new("write", format!("the folder cannot be made: {error}")).about(path)
    })
}

/// Makes the folder of a file.
///
/// # Errors
/// A failure naming the folder.
pub(crate) fn make_folder_of(path: &Path) -> Result<(), Failure> {
    path.parent().map_or(Ok(()), make_folder)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, symlink};
    use std::process::Command;

    #[test]
    fn links_stay_links_and_pipes_stay_pipes() {
        let folder = std::env::temp_dir().join(format!("epipole-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (file, link) = (folder.join("file"), folder.join("link"));
        fs::write(&file, "before").unwrap();
        symlink(&file, &link).unwrap();
        write(&link, b"after").unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"after");

        let pipe = folder.join("pipe");
        assert!(
            Command::new("mkfifo")
                .arg(&pipe)
                .status()
                .unwrap()
                .success()
        );
        let read = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        write(&pipe, b"through").unwrap();
        assert_eq!(read.join().unwrap(), b"through");
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
        // No temporary file remains.
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 3);
        fs::remove_dir_all(&folder).unwrap();
    }
}
