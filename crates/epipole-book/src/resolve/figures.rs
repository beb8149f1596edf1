//! The builder's interface to the figures: their names, the check of a chapter's parameters, the
//! poster.
//!
//! The rest of the builder knows only the two traits here, so its tests can bring their own
//! figures.

pub use epipole_widgets::contract::Aspect;
use epipole_widgets::contract::WIDTHS;
use epipole_widgets::gallery::{self, FIGURES};
use epipole_widgets::theme::Theme;
use epipole_widgets::{Answers, Snapshot};

/// Cache of the figures' computations while the builder runs.
static ANSWERS: Answers = Answers::new();

/// The room that a page has for a picture: figures lay themselves out for its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Room {
    /// A phone.
    Phone,
    /// A column.
    Column,
    /// A broad page.
    Broad,
}

impl Room {
    /// The rooms that a page of the book can have for pictures of this shape. A tall one has its
    /// controls beside it on a broad page, so it never gets more than a column.
    pub fn all_for(aspect: Aspect) -> &'static [Room] {
        match aspect {
            Aspect::Broad => &[Room::Phone, Room::Column, Room::Broad],
            Aspect::Tall => &[Room::Phone, Room::Column],
        }
    }

    /// CSS pixels from the left to the right edge of a poster.
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

/// The page of a figure for frames, from the root of the site.
pub fn frame_path(name: &str) -> String {
    format!("embed/{name}.html")
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

    /// Title and help of a figure.
    fn about(&self, name: &str) -> (String, String);

    /// A figure in the state that the settings describe.
    ///
    /// # Errors
    /// A sentence: an unknown parameter with those that exist, or a value outside its range.
    fn open(&self, name: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String>;
}

/// One figure in one state.
pub trait Figure: Send + Sync {
    /// JSON of everything beside the picture, after all computations, as in a browser.
    ///
    /// # Errors
    /// A sentence.
    fn snapshot(&self) -> Result<String, String>;

    /// The drawing, [`Room::width`] CSS pixels wide with `scale` device pixels to each: light and
    /// dark, since the photographs in it are the same.
    ///
    /// # Errors
    /// A sentence.
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

/// A figure's name and state; the figure itself is made on each use, as it cannot be sent between
/// threads.
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
