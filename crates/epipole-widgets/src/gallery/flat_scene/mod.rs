//! `flat-scene`: points flattened to a plane, the singular values, and every F that fits.

mod fit;
mod model;
mod scene;
mod view;
mod words;

pub(super) use view::FlatSceneView as View;
