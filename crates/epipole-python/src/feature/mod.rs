//! Features: corners, scale-invariant keypoints, their descriptors, matching and tracking.

mod corners;
mod descriptors;
mod detect;
mod keypoints;
mod matching;
mod scale_space;
mod tensor;
mod track;
mod window;

pub(crate) use descriptors::{descriptors, give_descriptors};
pub(crate) use keypoints::{Keypoints, keypoints};

use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::feature::StructureTensorOptions::default())?;
    crate::options::declare(module, &epipole::feature::SiftOptions::default())?;
    crate::options::declare(module, &epipole::feature::FeatureOptions::default())?;
    crate::options::declare(module, &epipole::feature::OrbOptions::default())?;
    crate::options::declare(module, &epipole::feature::GoodFeaturesOptions::default())?;
    crate::options::declare(module, &epipole::feature::RefineOptions::default())?;
    crate::options::declare(module, &epipole::feature::MatchOptions::default())?;
    crate::options::declare(module, &epipole::feature::TrackOptions::default())?;
    module.add_class::<keypoints::Keypoints>()?;
    module.add_class::<descriptors::Features>()?;
    module.add_class::<matching::Matches>()?;
    module.add_class::<matching::Neighbors>()?;
    module.add_class::<scale_space::ScaleOctave>()?;
    module.add_class::<scale_space::ScaleSpace>()?;
    module.add_class::<tensor::StructureTensor>()?;
    module.add_class::<window::ShiftSurface>()?;
    module.add_class::<window::WindowTensor>()?;
    module.add_class::<track::Tracks>()?;
    module.add_function(wrap_pyfunction!(detect::photo_to_gray, module)?)?;
    module.add_function(wrap_pyfunction!(detect::detect_features, module)?)?;
    module.add_function(wrap_pyfunction!(detect::detect_sift, module)?)?;
    module.add_function(wrap_pyfunction!(detect::detect_orb, module)?)?;
    module.add_function(wrap_pyfunction!(detect::describe_sift, module)?)?;
    module.add_function(wrap_pyfunction!(detect::sift_directions, module)?)?;
    module.add_function(wrap_pyfunction!(detect::describe_patches, module)?)?;
    module.add_function(wrap_pyfunction!(scale_space::scale_space, module)?)?;
    module.add_function(wrap_pyfunction!(corners::harris_response, module)?)?;
    module.add_function(wrap_pyfunction!(corners::min_eigenvalue_response, module)?)?;
    module.add_function(wrap_pyfunction!(corners::good_features_to_track, module)?)?;
    module.add_function(wrap_pyfunction!(corners::non_maximum_suppression, module)?)?;
    module.add_function(wrap_pyfunction!(corners::refine_corners, module)?)?;
    module.add_function(wrap_pyfunction!(tensor::structure_tensor, module)?)?;
    module.add_function(wrap_pyfunction!(window::shift_surface, module)?)?;
    module.add_function(wrap_pyfunction!(matching::match_descriptors, module)?)?;
    module.add_function(wrap_pyfunction!(matching::nearest_two, module)?)?;
    module.add_function(wrap_pyfunction!(matching::nearest_few, module)?)?;
    module.add_function(wrap_pyfunction!(track::track_lucas_kanade, module)?)
}
