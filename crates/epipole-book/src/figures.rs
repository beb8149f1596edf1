//! What the builder asks of the figures: which exist, what a chapter's parameters mean, the poster.
//!
//! The rest of the builder knows only the two traits here, so its tests can bring their own
//! figures.

use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;
use epipole_widgets::POSTER_WIDTH;

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

/// The figures of `epipole-widgets`.
pub struct Widgets;

impl Gallery for Widgets {
    fn names(&self) -> Vec<String> {
        FIGURES.iter().map(|entry| entry.name.to_owned()).collect()
    }

    fn open(&self, name: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String> {
        let figure = open(name, settings)?;
        let height = figure.layout(POSTER_WIDTH).height;
        Ok(Box::new(Widget {
            name: name.to_owned(),
            settings: settings.to_vec(),
            description: figure.describe(),
            size: (POSTER_WIDTH as u32, height as u32),
        }))
    }
}

/// A figure's name and state; the figure itself is made where it is drawn, as it cannot be sent
/// between threads.
struct Widget {
    name: String,
    settings: Vec<(String, String)>,
    description: String,
    size: (u32, u32),
}

fn open(name: &str, settings: &[(String, String)]) -> Result<epipole_widgets::Figure, String> {
    let mut figure = epipole_widgets::Figure::new(name).map_err(|problem| problem.to_string())?;
    let problems = figure.apply(settings);
    match problems.is_empty() {
        true => Ok(figure),
        false => {
            let sentences: Vec<String> = problems.iter().map(ToString::to_string).collect();
            Err(sentences.join("; "))
        }
    }
}

impl Figure for Widget {
    fn description(&self) -> String {
        self.description.clone()
    }

    fn size(&self) -> (u32, u32) {
        self.size
    }

    fn poster(&self, shade: Shade, scale: u32) -> Result<Poster, String> {
        let theme = match shade {
            Shade::Light => Theme::Light,
            Shade::Dark => Theme::Dark,
        };
        let mut figure = open(&self.name, &self.settings)?;
        let picture = figure
            .draw_settled(POSTER_WIDTH, f64::from(scale), theme)
            .map_err(|problem| problem.to_string())?;
        let (width, height) = (picture.width(), picture.height());
        Ok(Poster { width, height, rgba: picture.rgba().to_vec() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_a_poster_in_both_shades() {
        for name in Widgets.names() {
            let figure = Widgets.open(&name, &[]).unwrap();
            assert!(!figure.description().is_empty());
            let (width, height) = figure.size();
            for shade in [Shade::Light, Shade::Dark] {
                let poster = figure.poster(shade, 1).unwrap();
                assert_eq!((poster.width, poster.height), (width, height), "{name}");
                assert_eq!(poster.rgba.len(), (width * height * 4) as usize, "{name}");
            }
        }
    }

    #[test]
    fn mistakes_are_sentences() {
        let nonsense = [("nonsense".to_owned(), "1".to_owned())];
        let message = Widgets.open("ransac-race", &nonsense).err().unwrap();
        assert!(message.contains("no parameter \"nonsense\""), "{message}");
        assert!(Widgets.open("nonsense", &[]).is_err());
    }
}
