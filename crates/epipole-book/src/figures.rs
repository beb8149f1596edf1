//! What the builder asks of the figures: which exist, what a chapter's parameters mean, the poster.
//!
//! The rest of the builder knows only the two traits here, so its tests can bring their own
//! figures.

/// The look of a poster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shade {
    /// Dark marks on paper.
    Light,
    /// Light marks on a dark ground.
    Dark,
}

/// A picture of a figure, drawn without a browser.
pub struct Poster {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Four bytes a pixel, not premultiplied.
    pub rgba: Vec<u8>,
}

/// The figures that chapters may show.
pub trait Gallery: Send + Sync {
    /// Their names, for messages.
    fn names(&self) -> Vec<String>;

    /// A figure in the state that the settings describe.
    ///
    /// # Errors
    /// A sentence: an unknown parameter with those that exist, or a value outside its range.
    fn open(&self, name: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String>;
}

/// One figure in one state.
pub trait Figure: Send + Sync {
    /// What it shows now, in one or two sentences: the alternative text of the poster.
    fn description(&self) -> String;

    /// Its size on the page, CSS pixels.
    fn size(&self) -> (u32, u32);

    /// The drawing, `scale` device pixels to a CSS pixel.
    ///
    /// # Errors
    /// A sentence.
    fn poster(&self, shade: Shade, scale: u32) -> Result<Poster, String>;
}

/// A gallery without figures.
pub struct NoFigures;

impl Gallery for NoFigures {
    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    fn open(&self, name: &str, _: &[(String, String)]) -> Result<Box<dyn Figure>, String> {
        Err(format!("there is no figure \"{name}\""))
    }
}
