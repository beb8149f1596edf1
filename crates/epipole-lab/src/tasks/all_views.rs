//! Depth of all views: one cloud from all registered photographs.

use super::dense_cloud::DenseCloud;
use super::reconstruction::Component;
use super::reduced::{Reduced, ReducedOf};
use super::task::{Destination, Query, Task};
use crate::project::{Key, Project, Step};
use serde::{Deserialize, Serialize};

/// Estimates a depth map for each photograph and fuses them into one cloud.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FuseViews {
    /// The photographs that take part; `None` for those without a camera.
    pub photographs: Vec<Option<Reduced>>,
    /// Cameras, in pixels of the photographs before downscaling, and points.
    pub component: Component,
}

impl Task for FuseViews {
    type Output = DenseCloud;

    fn is_whole(output: &DenseCloud) -> bool {
        output.is_whole()
    }
}

/// Query for the depth of all views of the current component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AllViews;

impl Query for AllViews {
    type Task = FuseViews;
    const STEP: Step = Step::Depth;

    fn all(project: &Project) -> Vec<Self> {
        match project.document.all_views {
            true => vec![Self],
            false => Vec::new(),
        }
    }

    fn key(self, project: &Project) -> Option<Key> {
        project.key_of_views()
    }

    fn is_ready(self, project: &Project, is_imported: bool) -> bool {
        let mut photos = project.registered().into_iter();
        is_imported || photos.all(|id| project.get(ReducedOf(id)).is_some())
    }

    fn priority(self, _project: &Project) -> u8 {
        80
    }

    fn task(self, project: &Project) -> Option<FuseViews> {
        let component = project.component()?;
        let photos = project.taking_part().into_iter().zip(&component.cameras);
        let photographs = photos.map(|(photo, camera)| match camera {
            Some(_) => Some(Some(project.get(ReducedOf(photo.id))?.clone())),
            None => Some(None),
        });
        Some(FuseViews {
            photographs: photographs.collect::<Option<_>>()?,
            component: component.clone(),
        })
    }

    fn label(self, _project: &Project) -> String {
        "Computing depth of all views".to_owned()
    }

    fn stored(output: &DenseCloud, destination: Destination) -> Option<DenseCloud> {
        (destination == Destination::Project).then(|| output.clone())
    }

    fn fits(self, project: &Project, output: &DenseCloud) -> bool {
        let component = project.component();
        let num_registered = component.map_or(0, Component::num_registered);
        output.num_registered as usize == num_registered && output.is_valid()
    }
}

impl Project {
    /// Returns the depth of all views with its key, if it is available and part of the cloud.
    pub fn all_views(&self) -> Option<(Key, &DenseCloud)> {
        let cloud = self.get(AllViews).filter(|_| self.document.all_views)?;
        Some((AllViews.key(self)?, cloud))
    }
}
