//! List of all figures. A new figure is a folder here and a line in the list.

use crate::contract::{Compute, Declared, JobResult, Problem, Progress, View};
use crate::stage::{self, Stage};

mod bundle_adjustment;
mod calibrate;
mod column_sizes;
mod cover;
mod coverage;
mod disparity_map;
pub mod eight_point;
mod epipolar_click;
mod epipolar_plane;
mod flat_scene;
mod flow_window;
mod four_poses;
mod fundamental_entries;
mod gradient_field;
pub mod harris;
mod homography_drag;
mod incremental_sfm;
mod kernel_stepper;
mod keypoint_orientation;
mod lens_bend;
mod odometry;
mod optimal_plane;
mod outlier_drag;
mod panorama;
mod patch_match;
mod path_costs;
mod plane_or_not;
pub mod ransac_budget;
pub mod ransac_epipolar;
mod ransac_line;
pub mod ransac_race;
mod ratio_test;
mod rectify;
mod same_picture;
mod scale_ambiguity;
mod scale_drift;
mod scale_space;
mod schur;
mod sift_descriptor;
mod stereo_slider;
mod sub_pixel;
mod three_rays;
mod tournament;
mod track;
mod triangulate;
mod two_cameras;
mod two_view_sfm;
mod vanishing_points;
mod window_search;
pub mod window_shift;

/// A figure's entry in the list.
pub struct Entry {
    /// Permanent name.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Instructions for the reader.
    pub help: &'static str,
    pub(crate) make: fn() -> Box<dyn Stage>,
}

/// Entry point of a figure's long computations.
struct Worker {
    name: &'static str,
    compute: Compute,
}

/// Defines separate lists of figures and of computations, so that a wasm module without one of them
/// does not contain its code.
macro_rules! figures {
    ($($view:ty),* $(,)?) => {
        /// All figures, in the order of the book.
        pub static FIGURES: &[Entry] = &[$(entry::<$view>()),*];

        static WORKERS: &[Worker] = &[$(worker::<$view>()),*];
    };
}

figures![
    cover::View,
    two_cameras::View,
    three_rays::View,
    same_picture::View,
    gradient_field::View,
    kernel_stepper::View,
    window_shift::View,
    harris::View,
    sub_pixel::View,
    patch_match::View,
    ratio_test::View,
    keypoint_orientation::View,
    sift_descriptor::View,
    scale_space::View,
    epipolar_click::View,
    epipolar_plane::View,
    eight_point::View,
    fundamental_entries::View,
    flat_scene::View,
    column_sizes::View,
    outlier_drag::View,
    ransac_line::View,
    ransac_budget::View,
    ransac_epipolar::View,
    triangulate::View,
    optimal_plane::View,
    scale_ambiguity::View,
    stereo_slider::View,
    rectify::View,
    window_search::View,
    disparity_map::View,
    path_costs::View,
    four_poses::View,
    two_view_sfm::View,
    incremental_sfm::View,
    bundle_adjustment::View,
    schur::View,
    scale_drift::View,
    ransac_race::View,
    tournament::View,
    homography_drag::View,
    vanishing_points::View,
    panorama::View,
    plane_or_not::View,
    lens_bend::View,
    calibrate::View,
    coverage::View,
    flow_window::View,
    track::View,
    odometry::View,
];

const fn entry<V: View>() -> Entry {
    Entry {
        name: V::Model::NAME,
        title: V::Model::TITLE,
        help: V::Model::HELP,
        make: stage::set_up::<V>,
    }
}

const fn worker<V: View>() -> Worker {
    Worker {
        name: V::Model::NAME,
        compute: V::Model::COMPUTE,
    }
}

/// Returns the figure with this name.
///
/// # Errors
/// [`Problem::UnknownFigure`], with the existing names.
pub fn find(name: &str) -> Result<&'static Entry, Problem> {
    let mut figures = FIGURES.iter();
    figures
        .find(|entry| entry.name == name)
        .ok_or_else(|| unknown(name, FIGURES.iter().map(|entry| entry.name)))
}

/// Runs a job of the figure `name`. It needs no figure, so a worker can run it.
///
/// # Errors
/// [`Problem::UnknownFigure`], or a message about the data.
pub fn compute(name: &str, request: &[u8], progress: Progress<'_>) -> JobResult {
    let worker = WORKERS.iter().find(|worker| worker.name == name);
    let worker = worker.ok_or_else(|| unknown(name, WORKERS.iter().map(|worker| worker.name)))?;
    (worker.compute)(request, progress)
}

fn unknown(name: &str, known: impl Iterator<Item = &'static str>) -> Problem {
    Problem::UnknownFigure {
        name: name.to_owned(),
        known: known.collect::<Vec<_>>().join(", "),
    }
}

/// Template of `make new-figure`, compiled to keep it valid.
#[cfg(test)]
#[path = "../scaffold/mod.rs"]
mod new_figure;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Event;

    #[test]
    fn the_template_is_a_working_figure() {
        let mut stage = stage::set_up::<new_figure::View>();
        assert!(stage.challenges().iter().all(|challenge| !challenge.solved));
        for event in stage.solution("inside").unwrap() {
            stage.model_mut().update(&event).unwrap();
        }
        assert!(stage.challenges().iter().all(|challenge| challenge.solved));
        assert!(stage.model_mut().update(&Event::Reset).is_ok());
    }

    #[test]
    fn an_unknown_figure_is_named_with_the_known_ones() {
        let Err(problem) = find("ransac-rase") else {
            panic!("it was found")
        };
        assert!(problem.to_string().contains("ransac-race"), "{problem}");
    }
}
