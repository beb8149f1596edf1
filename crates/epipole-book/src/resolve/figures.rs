//! The builder's interface to the figures: names, parameters and posters.
//!
//! The rest of the builder uses only the two traits here, so its tests can provide their own
//! figures.

pub use epipole_widgets::contract::Aspect;
use epipole_widgets::contract::WIDTHS;
use epipole_widgets::gallery::{self, FIGURES};
use epipole_widgets::theme::Theme;
use epipole_widgets::{Answers, Snapshot};

/// Cache of the figures' computations while the builder runs.
static ANSWERS: Answers = Answers::new();

/// Width that a page has for a picture, which determines a figure's layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Room {
    /// A phone.
    Phone,
    /// A column.
    Column,
    /// A wide page.
    Broad,
}

impl Room {
    /// Returns the widths that pages can have for pictures of this shape. A tall picture has its
    /// controls beside it on a wide page, so it never gets more than a column.
    pub fn all_for(aspect: Aspect) -> &'static [Room] {
        match aspect {
            Aspect::Broad => &[Room::Phone, Room::Column, Room::Broad],
            Aspect::Tall => &[Room::Phone, Room::Column],
        }
    }

    /// Width of a poster, CSS pixels.
    pub fn width(self) -> u32 {
        let [phone, column, broad] = WIDTHS;
        let width = match self {
            Room::Phone => phone,
            Room::Column => column,
            Room::Broad => broad,
        };
        width as u32
    }
}

/// Returns the path of a figure's page for frames, from the root of the site.
pub fn frame_path(name: &str) -> String {
    format!("embed/{name}.html")
}

/// A picture of a figure, drawn without a browser.
pub struct Poster {
    /// Width, device pixels.
    pub width: u32,
    /// Height, device pixels.
    pub height: u32,
    /// Four bytes per pixel, not premultiplied.
    pub rgba: Vec<u8>,
}

/// Figures available to chapters.
pub trait Gallery: Send + Sync {
    /// Returns their names, for messages.
    fn names(&self) -> Vec<String>;

    /// Returns title and help of a figure.
    fn about(&self, name: &str) -> (String, String);

    /// Creates a figure in the state given by the settings.
    ///
    /// # Errors
    /// A message for an unknown parameter, with those that exist, or for a value outside
    /// its range.
    fn open(&self, name: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String>;
}

/// One figure in one state.
pub trait Figure: Send + Sync {
    /// Returns JSON of everything but the picture, after all computations, as in a browser.
    ///
    /// # Errors
    /// A message.
    fn snapshot(&self) -> Result<String, String>;

    /// Draws light and dark posters, [`Room::width`] CSS pixels wide with `scale` device pixels per
    /// CSS pixel. Both are drawn together, as they contain the same photographs.
    ///
    /// # Errors
    /// A message.
    fn posters(&self, room: Room, scale: u32) -> Result<[Poster; 2], String>;
}

/// A gallery without figures.
pub struct NoFigures;

impl Gallery for NoFigures {
    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    fn about(&self, _: &str) -> (String, String) {
        Default::default()
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

    fn about(&self, name: &str) -> (String, String) {
        let text = |entry: &gallery::Entry| (entry.title.to_owned(), entry.help.to_owned());
        gallery::find(name).map(text).unwrap_or_default()
    }

    fn open(&self, name: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String> {
        open(name, settings)?;
        Ok(Box::new(Widget {
            name: name.to_owned(),
            settings: settings.to_vec(),
        }))
    }
}

/// A figure's name and state; the figure itself is created on each use, as it cannot be sent
/// between threads.
struct Widget {
    name: String,
    settings: Vec<(String, String)>,
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
    fn snapshot(&self) -> Result<String, String> {
        let mut figure = open(&self.name, &self.settings)?;
        ANSWERS.finish(&mut figure);
        let width = f64::from(Room::Column.width());
        serde_json::to_string(&Snapshot::of(&mut figure, width)).map_err(|error| error.to_string())
    }

    fn posters(&self, room: Room, scale: u32) -> Result<[Poster; 2], String> {
        let mut figure = open(&self.name, &self.settings)?;
        ANSWERS.finish(&mut figure);
        let mut draw = |theme| {
            let picture = figure
                .draw_settled(f64::from(room.width()), f64::from(scale), theme)
                .map_err(|problem| problem.to_string())?;
            let (width, height) = (picture.width(), picture.height());
            Ok::<_, String>(Poster {
                width,
                height,
                rgba: picture.rgba().to_vec(),
            })
        };
        Ok([draw(Theme::Light)?, draw(Theme::Dark)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::facts::Facts;

    #[test]
    fn every_figure_has_a_poster_in_both_shades() {
        for name in Widgets.names() {
            let figure = Widgets.open(&name, &[]).unwrap();
            let facts = Facts::parse(&figure.snapshot().unwrap()).unwrap();
            assert!(!facts.description().is_empty());
            for room in Room::all_for(facts.aspect()) {
                let posters = figure.posters(*room, 1).unwrap();
                let heights = posters.map(|poster| {
                    assert_eq!(poster.width, room.width(), "{name}");
                    let pixels = poster.width * poster.height;
                    assert_eq!(poster.rgba.len(), pixels as usize * 4, "{name}");
                    poster.height
                });
                assert!(heights[0] > 0 && heights[0] == heights[1], "{name}");
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
