//! The list of all figures. A new figure is a folder here and a line in the list.

mod epipolar_click;
mod stereo_slider;

use crate::contract::{Model, Problem, View};
use crate::stage::{self, Stage};

/// A figure's entry in the list.
pub struct Entry {
    /// Permanent name.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// What a reader can do with it.
    pub help: &'static str,
    pub(crate) make: fn() -> Box<dyn Stage>,
}

/// Every figure, in the order of the book.
pub static FIGURES: &[Entry] = &[
    entry::<epipolar_click::EpipolarClickView>(),
    entry::<stereo_slider::StereoSliderView>(),
];

const fn entry<V: View>() -> Entry {
    Entry {
        name: V::Model::NAME,
        title: V::Model::TITLE,
        help: V::Model::HELP,
        make: stage::set_up::<V>,
    }
}

/// The figure of this name.
///
/// # Errors
/// [`Problem::UnknownFigure`], with the names that exist.
pub fn find(name: &str) -> Result<&'static Entry, Problem> {
    FIGURES
        .iter()
        .find(|entry| entry.name == name)
        .ok_or_else(|| {
            let known: Vec<&str> = FIGURES.iter().map(|entry| entry.name).collect();
            Problem::UnknownFigure {
                name: name.to_owned(),
                known: known.join(", "),
            }
        })
}
