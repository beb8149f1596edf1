//! Dense depth of a pair whose cameras are known.

use super::camera_found::CameraFound;
use super::dense::Dense;
use super::photograph::{Photograph, PhotographOf};
use super::reconstruction::ReconstructionOfAll;
use super::task::{Query, Task};
use crate::project::{DepthOptions, InputPhoto, Key, PhotoId, Project, Step};
use epipole::camera::Lens;
use serde::{Deserialize, Serialize};

/// Estimates the dense depth of a pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FindDepth {
    /// Photographs of the pair.
    pub photographs: [Photograph; 2],
    /// Their cameras.
    pub cameras: [CameraFound; 2],
    /// The lens of both.
    #[serde(rename = "distortion", with = "super::radial_lens")]
    pub lens: Lens,
    /// Points visible in both.
    pub points: Vec<[f64; 3]>,
    /// Dense depth settings.
    pub options: DepthOptions,
}

impl Task for FindDepth {
    type Output = Dense;

    fn is_whole(output: &Dense) -> bool {
        output.is_whole()
    }
}

/// Query for the depth of a pair, in the order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthOf(pub PhotoId, pub PhotoId);

impl DepthOf {
    /// Whether it is part of the cloud, or selected in the step "Depth".
    pub(crate) fn is_asked(self, project: &Project) -> bool {
        let pair = (self.0, self.1);
        project.document.is_dense(pair)
            || (project.view.step == Step::Depth && project.view.pair == pair)
    }

    /// Returns the cameras of both photographs in the current component.
    fn cameras(self, project: &Project) -> Option<[CameraFound; 2]> {
        let cameras = &project.component()?.cameras;
        let camera = |id| *cameras.get(project.place(id)?)?;
        Some([camera(self.0)?, camera(self.1)?])
    }
}

impl Query for DepthOf {
    type Task = FindDepth;
    const STEP: Step = Step::Depth;

    /// Returns the pairs whose depth is part of the cloud, and the selected one.
    fn all(project: &Project) -> Vec<Self> {
        let pairs = [&project.view.pair]
            .into_iter()
            .chain(&project.document.dense);
        let ordered = pairs.filter_map(|pair| project.document.pair(*pair));
        ordered
            .map(|(first, second)| Self(first.id, second.id))
            .collect()
    }

    /// Returns a key if both photographs have a camera in the current component.
    fn key(self, project: &Project) -> Option<Key> {
        self.cameras(project)?;
        let first = PhotographOf(self.0).key(project)?;
        let second = PhotographOf(self.1).key(project)?;
        let (reconstruction, part) = (ReconstructionOfAll.key(project)?.0, project.view.component);
        let options = project.document.settings.depth;
        Some(Key::of(&(
            "depth",
            (first.0, second.0),
            reconstruction,
            part,
            options,
        )))
    }

    fn is_ready(self, project: &Project, _is_imported: bool) -> bool {
        let has_pixels = |id| {
            let photo = project.document.photo(id);
            photo.is_some_and(|photo| project.photograph(photo).is_some())
        };
        self.is_asked(project) && has_pixels(self.0) && has_pixels(self.1)
    }

    fn priority(self, _project: &Project) -> u8 {
        70
    }

    fn task(self, project: &Project) -> Option<FindDepth> {
        let component = project.component()?;
        let places = [project.place(self.0)? as u32, project.place(self.1)? as u32];
        let sees =
            |track: &[(u32, u32)], place: u32| track.iter().any(|(image, _)| *image == place);
        let shared = (component.points.iter())
            .filter(|point| places.iter().all(|place| sees(&point.track, *place)));
        let pixels = |id| project.photograph(project.document.photo(id)?).cloned();
        Some(FindDepth {
            photographs: [pixels(self.0)?, pixels(self.1)?],
            cameras: self.cameras(project)?,
            lens: component.lens,
            points: shared.map(|point| point.position).collect(),
            options: project.document.settings.depth,
        })
    }

    fn label(self, _project: &Project) -> String {
        "Computing depth".to_owned()
    }
}

impl Project {
    /// Returns the pairs whose depth is available and part of the cloud, with its key.
    pub fn dense_pairs(&self) -> Vec<(Key, &InputPhoto, &InputPhoto, &Dense)> {
        let pairs = self.document.dense.iter();
        let ready = |pair: &(PhotoId, PhotoId)| {
            let (first, second) = self.document.pair(*pair)?;
            let query = DepthOf(first.id, second.id);
            Some((query.key(self)?, first, second, self.get(query)?))
        };
        pairs.filter_map(ready).collect()
    }
}
