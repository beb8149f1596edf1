//! What the builder asks of the figures: which exist, what a chapter's parameters mean, the poster.
//!
//! The rest of the builder knows only the two traits here, so its tests can bring their own
//! figures.

use epipole_widgets::POSTER_WIDTH;
use epipole_widgets::gallery::FIGURES;
use epipole_widgets::theme::Theme;

/// The page that a poster is for: figures lay themselves out for its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Room {
    /// A page with room beside the text.
    Wide,
    /// A phone.
    Narrow,
}

impl Room {
    /// CSS pixels from the left to the right edge of a poster.
    pub fn width(self) -> u32 {
        match self {
            Room::Wide => POSTER_WIDTH as u32,
            Room::Narrow => 340,
        }
    }
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
        let mut figure = open(name, settings)?;
        // The poster shows what is there after the computation, so its words must say that too.
        figure.finish_job();
        Ok(Box::new(Widget {
            name: name.to_owned(),
            settings: settings.to_vec(),
            description: figure.describe(),
        }))
    }
}

/// A figure's name and state; the figure itself is made where it is drawn, as it cannot be sent
/// between threads.
struct Widget {
    name: String,
    settings: Vec<(String, String)>,
    description: String,
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

    fn posters(&self, room: Room, scale: u32) -> Result<[Poster; 2], String> {
        let mut figure = open(&self.name, &self.settings)?;
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

    #[test]
    fn every_figure_has_a_poster_in_both_shades() {
        for name in Widgets.names() {
            let figure = Widgets.open(&name, &[]).unwrap();
            assert!(!figure.description().is_empty());
            for room in [Room::Wide, Room::Narrow] {
                let posters = figure.posters(room, 1).unwrap();
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
