//! Photos given by name or by folder: their order, and their names in results.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use clap::Args;
use std::cmp::Ordering;
use std::path::{Component, Path, PathBuf};

/// Extensions of supported formats.
const READ: [&str; 10] = [
    "png", "jpg", "jpeg", "webp", "tif", "tiff", "bmp", "pgm", "ppm", "pnm",
];

/// Extensions of unsupported photos.
const UNREAD: [&str; 14] = [
    "heic", "heif", "avif", "gif", "jxl", "jp2", "dng", "nef", "cr2", "cr3", "arw", "raf", "orf",
    "rw2",
];

/// Folders of photos.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Images")]
pub(crate) struct ListingArguments {
    /// Include images in subfolders. Names in results are relative to the common folder.
    #[arg(long)]
    recursive: bool,
}

/// A listed photo.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Listed {
    pub(crate) path: PathBuf,
    /// Path relative to the folder that all photos share, with slashes.
    pub(crate) name: String,
}

impl ListingArguments {
    /// Returns the given files, with folders replaced by their photos: frame2 before frame10, files
    /// before subfolders. Warns of photos skipped for their format.
    ///
    /// # Errors
    /// For files and folders that cannot be read, folders without photos, and a file that is given
    /// twice.
    pub(crate) fn photos(
        self,
        inputs: &[PathBuf],
        context: &Context,
    ) -> Result<Vec<Listed>, Failure> {
        let mut paths = Vec::new();
        for path in inputs {
            if path.is_dir() {
                let mut found = Found::default();
                found.look(path, self.recursive)?;
                if found.photos.is_empty() {
                    return Err(Failure::new("read", found.nothing()).about(path));
                }
                if let Some(unread) = found.unread_words() {
                    context.warn(&format!("{}: left out are {unread}", path.display()));
                }
                paths.append(&mut found.photos);
            } else {
                // Checked first, because a wrong name should not be reported as too few files.
                path.metadata()
                    .map_err(|error| files::unreadable(path, &error))?;
                paths.push(path.clone());
            }
        }
        with_common_folder(paths)
    }
}

/// Contents of a folder.
#[derive(Default)]
struct Found {
    photos: Vec<PathBuf>,
    unread: Vec<PathBuf>,
    num_folders: usize,
}

impl Found {
    fn look(&mut self, folder: &Path, recursive: bool) -> Result<(), Failure> {
        let unreadable = |error: std::io::Error| {
            Failure::new("read", format!("the folder cannot be read: {error}")).about(folder)
        };
        let (mut here, mut folders) = (Vec::new(), Vec::new());
        for entry in std::fs::read_dir(folder).map_err(unreadable)? {
            let entry = entry.map_err(unreadable)?;
            let path = entry.path();
            // A link to a folder may lead back to this one.
            if entry.file_type().map_err(unreadable)?.is_dir() {
                folders.push(path);
                continue;
            }
            let extension = path.extension().and_then(|extension| extension.to_str());
            let extension = extension.map(str::to_lowercase).unwrap_or_default();
            // Some systems add a hidden file beside each file, with a leading dot.
            let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
            if is_hidden || path.is_dir() {
                continue;
            }
            if READ.contains(&&*extension) {
                here.push(path);
            } else if UNREAD.contains(&&*extension) {
                self.unread.push(path);
            }
        }
        here.sort_by(|a, b| natural(a, b));
        folders.sort_by(|a, b| natural(a, b));
        self.photos.append(&mut here);
        self.num_folders += folders.len();
        if recursive {
            folders.iter().try_for_each(|one| self.look(one, true))?;
        }
        Ok(())
    }

    /// Describes the photos of unsupported formats.
    fn unread_words(&self) -> Option<String> {
        let first = file_name(self.unread.first()?);
        let count = self.unread.len();
        Some(format!(
            "images of a format that is not read ({count}, such as {first}): convert them to JPEG or PNG"
        ))
    }

    /// Explains why there are no photos.
    fn nothing(&self) -> String {
        if let Some(unread) = self.unread_words() {
            return format!("there are only {unread}");
        }
        let nothing = "there are no images in this folder";
        match self.num_folders {
            0 => nothing.to_owned(),
            count => format!("{nothing}, but {count} of its own: give --recursive to look there"),
        }
    }
}

/// Compares paths, runs of digits as numbers.
pub(crate) fn natural(a: &Path, b: &Path) -> Ordering {
    let (a, b) = (a.to_string_lossy(), b.to_string_lossy());
    let order = parts(&a).cmp(parts(&b));
    // 1 and 01.
    order.then_with(|| a.cmp(&b))
}

/// Splits a name into characters and numbers. A number is `'0'` with the count of its digits and
/// the digits, without leading zeros.
fn parts(text: &str) -> impl Iterator<Item = (char, usize, &str)> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let end = rest.find(|c: char| !c.is_ascii_digit());
        let (digits, behind) = rest.split_at(end.unwrap_or(rest.len()));
        if digits.is_empty() {
            rest = &rest[first.len_utf8()..];
            return Some((first, 0, ""));
        }
        rest = behind;
        let digits = digits.trim_start_matches('0');
        Some(('0', digits.len(), digits))
    })
}

/// Names each file relative to the folder that all share.
fn with_common_folder(paths: Vec<PathBuf>) -> Result<Vec<Listed>, Failure> {
    let mut whole = Vec::with_capacity(paths.len());
    for path in &paths {
        let parent = match path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let folder = (parent.canonicalize()).map_err(|error| files::unreadable(path, &error))?;
        whole.push((folder, file_name(path)));
    }
    let mut common = whole.first().map(|(folder, _)| folder.clone());
    for (folder, _) in &whole {
        while common.as_ref().is_some_and(|all| !folder.starts_with(all)) {
            common = common.and_then(|all| all.parent().map(Path::to_owned));
        }
    }
    let common = common.unwrap_or_default();
    let mut listed: Vec<Listed> = Vec::with_capacity(paths.len());
    let mut taken = std::collections::BTreeSet::new();
    for (path, (folder, file)) in paths.into_iter().zip(whole) {
        let folders = folder.strip_prefix(&common).unwrap_or(&folder).components();
        let mut parts: Vec<String> = folders
            .filter_map(|part| match part {
                Component::Normal(part) => Some(part.to_string_lossy().into_owned()),
                _ => None,
            })
            .collect();
        parts.push(file);
        let name = parts.join("/");
        if !taken.insert(name.clone()) {
            return Err(Failure::usage(format!("{} is given twice", path.display())));
        }
        listed.push(Listed { path, name });
    }
    Ok(listed)
}

/// Returns the name of a file without its folder.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn numbers_in_names_are_ordered_as_numbers() {
        let ordered = [
            "01.png",
            "1.png",
            "2.png",
            "10.png",
            "a",
            "a1b2",
            "a1b10",
            "a2",
            "a10",
            "b",
            "frame",
            "frame.jpg",
            "frame2.jpg",
            "frame10.jpg",
            "frame10a.jpg",
            "é1",
            "é9",
            "é18446744073709551616",
            "é18446744073709551617",
        ];
        let mut shuffled: Vec<&str> = ordered.iter().rev().copied().collect();
        shuffled.sort_by(|a, b| natural(Path::new(a), Path::new(b)));
        assert_eq!(shuffled, ordered);
    }

    #[test]
    fn names_are_relative_to_the_common_folder() {
        let root = std::env::temp_dir().join(format!("epipole-listing-{}", std::process::id()));
        for (folder, files) in [
            ("x/A", ["2.JPG", "10.jpg"]),
            ("x/B", ["2.jpg", "._2.jpg"]),
            ("x/C", ["1.heic", "t.txt"]),
        ] {
            std::fs::create_dir_all(root.join(folder)).unwrap();
            files
                .iter()
                .for_each(|file| std::fs::write(root.join(folder).join(file), "").unwrap());
        }
        let names = |inputs: &[&str], recursive| {
            let inputs: Vec<PathBuf> = inputs.iter().map(|one| root.join(one)).collect();
            let listed = ListingArguments { recursive }.photos(
                &inputs,
                &Context {
                    quiet: true,
                    seed: 0,
                },
            );
            listed.map(|listed| listed.into_iter().map(|one| one.name).collect::<Vec<_>>())
        };
        let all = ["A/2.JPG", "A/10.jpg", "B/2.jpg"];
        assert_eq!(names(&["x"], true).unwrap(), all);
        assert_eq!(names(&["x/A", "x/B"], false).unwrap(), all);
        assert_eq!(names(&["x/A"], false).unwrap(), ["2.JPG", "10.jpg"]);
        assert_eq!(
            names(&["x/B/2.jpg", "x/A/10.jpg"], false).unwrap(),
            ["B/2.jpg", "A/10.jpg"]
        );
        let error_of = |inputs: &[&str], recursive| names(inputs, recursive).unwrap_err().message;
        assert!(error_of(&["x"], false).contains("--recursive"));
        assert!(error_of(&["x/C"], false).contains("such as 1.heic"));
        assert!(error_of(&["x/B", "x/B/../B/2.jpg"], false).contains("is given twice"));
        assert!(error_of(&["x/D"], false).contains("there is no such file"));
        std::fs::remove_dir_all(&root).unwrap();
    }
}
