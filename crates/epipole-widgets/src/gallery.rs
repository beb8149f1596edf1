//! The list of all figures. A new figure is a folder here and a line in the list.

use crate::contract::{JobResult, Model, Problem, Progress, View};
use crate::stage::{self, Stage};

mod bundle_adjustment;
mod disparity_map;
pub mod eight_point;
mod epipolar_click;
mod four_poses;
pub mod harris;
pub mod ransac_budget;
pub mod ransac_epipolar;
pub mod ransac_race;
mod stereo_slider;
mod two_view_sfm;
pub mod window_shift;

/// A figure's entry in the list.
pub struct Entry {
    /// Permanent name.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// What a reader can do with it.
    pub help: &'static str,
    pub(crate) make: fn() -> Box<dyn Stage>,
    pub(crate) compute: fn(&[u8], Progress<'_>) -> JobResult,
}

/// Every figure, in the order of the book.
pub static FIGURES: &[Entry] = &[
    entry::<window_shift::View>(),
    entry::<harris::View>(),
    entry::<epipolar_click::EpipolarClickView>(),
    entry::<eight_point::View>(),
    entry::<ransac_budget::View>(),
    entry::<ransac_epipolar::View>(),
    entry::<stereo_slider::StereoSliderView>(),
    entry::<disparity_map::View>(),
    entry::<four_poses::View>(),
    entry::<two_view_sfm::View>(),
    entry::<bundle_adjustment::View>(),
    entry::<ransac_race::View>(),
];

const fn entry<V: View>() -> Entry {
    Entry {
        name: V::Model::NAME,
        title: V::Model::TITLE,
        help: V::Model::HELP,
        make: stage::set_up::<V>,
        compute: stage::compute::<V>,
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

/// The template of `make new-figure`, compiled so that it cannot rot.
#[cfg(test)]
#[path = "../scaffold/mod.rs"]
pub mod new_figure;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Event;

    #[test]
    fn the_template_is_a_working_figure() {
        let mut stage = stage::set_up::<new_figure::View>();
        assert!(stage.challenges().iter().all(|challenge| !challenge.solved));
        for event in stage.solution("inside").unwrap() {
            stage.update(&event).unwrap();
        }
        assert!(stage.challenges().iter().all(|challenge| challenge.solved));
        assert!(stage.update(&Event::Reset).is_ok());
    }

    #[test]
    fn an_unknown_figure_is_named_with_the_known_ones() {
        let Err(problem) = find("ransac-rase") else {
            panic!("it was found")
        };
        assert!(problem.to_string().contains("ransac-race"), "{problem}");
    }
}
