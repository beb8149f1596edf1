//! The folder of a model.

/// Files in the folder of a model. A function from names to contents implements it.
///
/// ```
/// use epipole_io::model::ModelFolder;
/// let folder = |name: &str| (name == "a.pgm").then(|| b"P2 3 1 255 10 20 30".to_vec());
/// assert!(folder.file("b.pgm").is_none());
/// assert_eq!(folder.image_size("./a.pgm"), Some((3, 1)));
/// ```
pub trait ModelFolder {
    /// Returns the content of a file; `None` if it does not exist.
    fn file(&self, name: &str) -> Option<Vec<u8>>;

    /// Returns width and height of an image in the orientation of its sensor, for formats without
    /// sizes; `None` if it does not exist. Its name may lack the extension.
    fn image_size(&self, name: &str) -> Option<(u32, u32)> {
        let name = name.trim_start_matches("./");
        let endings = ["", ".png", ".jpg", ".jpeg"];
        let mut files = (endings.iter()).filter_map(|ending| self.file(&format!("{name}{ending}")));
        size_of(&files.next()?)
    }
}

impl<F: Fn(&str) -> Option<Vec<u8>>> ModelFolder for F {
    fn file(&self, name: &str) -> Option<Vec<u8>> {
        self(name)
    }
}

#[cfg(feature = "photos")]
fn size_of(image: &[u8]) -> Option<(u32, u32)> {
    crate::photo::sensor_size(image).ok()
}

/// Returns `None`, without the reader of photos.
#[cfg(not(feature = "photos"))]
fn size_of(_: &[u8]) -> Option<(u32, u32)> {
    None
}
