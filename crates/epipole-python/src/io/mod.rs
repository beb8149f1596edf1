//! Files of cameras, photos, models, disparities, clouds, pose graphs, matches and trajectories.
//!
//! Readers take a path, or the content as bytes; writers take a path.

mod cameras;
mod clouds;
mod matches;
mod meshes;
mod models;
mod photos;
mod rig;
mod source;
mod trajectories;

pub(crate) use clouds::give_cloud;
pub(crate) use meshes::take_mesh;
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    cameras::register(module)?;
    photos::register(module)?;
    models::register(module)?;
    clouds::register(module)?;
    meshes::register(module)?;
    matches::register(module)?;
    trajectories::register(module)
}
