//! Cameras and points from all photographs.

use super::are_finite;
use super::camera_found::CameraFound;
use super::features::FeaturesOf;
use super::matches::MatchesOf;
use super::photograph::Calibrated;
use super::task::{Destination, Query, Task};
use crate::project::{InputPhoto, Key, Pose, Project, SfmOptions, Step, pairs};
use epipole::camera::Lens;
use serde::{Deserialize, Serialize};

/// Reconstructed point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointFound {
    /// Position in the world.
    pub position: [f64; 3],
    /// Color.
    pub color: [u8; 3],
    /// Image and keypoint of each observation.
    pub track: Vec<(u32, u32)>,
    /// Root mean square of its reprojection errors, pixels.
    pub error_px: f64,
}

/// Cameras and points in one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Component {
    /// Camera of each image, if registered.
    pub cameras: Vec<Option<CameraFound>>,
    /// Lens of all cameras.
    #[serde(rename = "distortion", with = "super::radial_lens")]
    pub lens: Lens,
    /// The points.
    pub points: Vec<PointFound>,
}

impl Component {
    /// Returns the number of registered photographs.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }
}

#[cfg(any(feature = "vision", feature = "files"))]
impl Component {
    /// Converts a component of the core; inverse of [`to_core`](Self::to_core).
    #[cfg(feature = "vision")]
    pub(super) fn from_core(found: &epipole::sfm::Reconstruction) -> Self {
        use epipole::camera::PosedCamera;
        use epipole::sfm::ScenePoint;
        let camera = |camera: &PosedCamera| {
            let (k, center) = (
                camera.camera.intrinsics,
                camera.camera.intrinsics.principal_point(),
            );
            CameraFound {
                intrinsics: [k.fu_px(), k.fv_px(), center.x, center.y],
                rotation: camera.cam_from_world.rotation.coords.into(),
                translation: camera.cam_from_world.translation.vector.into(),
            }
        };
        let point = |point: &ScenePoint| PointFound {
            position: point.position.coords.into(),
            color: point.color,
            track: point.track.iter().map(|e| (e.image, e.keypoint)).collect(),
            error_px: point.error_px,
        };
        // All photographs share one lens.
        let lens = (found.cameras.iter().flatten().next()).map_or(Lens::NONE, |c| c.camera.lens);
        Self {
            cameras: (found.cameras.iter())
                .map(|c| c.as_ref().map(camera))
                .collect(),
            lens,
            points: found.points.iter().map(point).collect(),
        }
    }

    /// Converts the component to a type of the core.
    ///
    /// * `sizes`: width and height of each image, pixels
    ///
    /// # Errors
    /// A message for invalid numbers.
    pub(super) fn to_core(
        &self,
        sizes: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<epipole::sfm::Reconstruction, String> {
        use epipole::sfm::{Reconstruction, ScenePoint, TrackElement};
        let camera = |(camera, size): (&Option<CameraFound>, (u32, u32))| {
            // All photographs share one lens.
            let camera = (camera.as_ref()).map(|camera| camera.posed(size, self.lens));
            camera.transpose()
        };
        let element = |&(image, keypoint): &(u32, u32)| TrackElement { image, keypoint };
        let point = |point: &PointFound| ScenePoint {
            position: point.position.into(),
            color: point.color,
            track: point.track.iter().map(element).collect(),
            error_px: point.error_px,
        };
        Ok(Reconstruction {
            cameras: (self.cameras.iter().zip(sizes))
                .map(camera)
                .collect::<Result<_, _>>()?,
            points: self.points.iter().map(point).collect(),
            is_placed: false,
        })
    }
}

/// Reason why a photograph is in no component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum UnregisteredReason {
    /// Too few features, with their number.
    FewFeatures(u32),
    /// No other photograph shares enough matches that agree on one motion.
    NoOverlap,
    /// Too short a baseline to the overlapping photographs.
    NoBaseline,
    /// None of its pairs could start a reconstruction.
    NoStart,
    /// Too few visible points, with their number.
    FewPoints(u32),
    /// Visible points that do not agree on a pose, with their number.
    NoPose(u32),
    /// No pose in the opened model.
    NoKnownPose,
}

/// Reconstruction from all photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Reconstructed {
    /// Components, largest first.
    pub components: Vec<Component>,
    /// Cost after each adjustment, square pixels.
    pub costs: Vec<f64>,
    /// Mean length of all reprojection errors of each component, pixels.
    pub mean_error_px: Vec<f64>,
    /// Mean error of each component before its lens was corrected, pixels; `None` if it was not.
    pub before_correction_px: Vec<Option<f64>>,
    /// Whether the photographs of each component determine its refined focal length; true if it is
    /// not refined.
    pub determines_focal: Vec<bool>,
    /// Reason why each image is in no component; `None` for registered ones.
    pub reasons: Vec<Option<UnregisteredReason>>,
}

/// A photograph reduced to its keypoints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImagePoints {
    /// Its name.
    pub name: String,
    /// Its size and intrinsics.
    pub camera: Calibrated,
    /// Keypoints, pixels.
    pub points: Vec<[f64; 2]>,
    /// Their colors.
    pub colors: Vec<[u8; 3]>,
}

/// Matches of two photographs, by indices in a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairOf {
    /// Index of the first photograph.
    pub first: u32,
    /// Index of the second photograph.
    pub second: u32,
    /// Indices of keypoints, first photograph first.
    pub matches: Vec<(u32, u32)>,
}

#[cfg(any(feature = "vision", feature = "files"))]
impl ImagePoints {
    /// Converts the photograph to a type of the core.
    pub(super) fn sfm_image(&self) -> epipole::sfm::SfmImage {
        epipole::sfm::SfmImage {
            name: self.name.clone(),
            keypoints: self.points.iter().map(|p| (*p).into()).collect(),
            colors: self.colors.clone(),
            ..epipole::sfm::SfmImage::default()
        }
    }
}

/// Estimates cameras and points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reconstruct {
    /// The photographs.
    pub images: Vec<ImagePoints>,
    /// Matches between them.
    pub pairs: Vec<PairOf>,
    /// Reconstruction settings.
    pub options: SfmOptions,
    /// Known pose of each photograph, so that only points are estimated. Empty if none is known.
    pub poses: Vec<Option<Pose>>,
}

impl Task for Reconstruct {
    type Output = Reconstructed;
}

/// Query for the reconstruction from all photographs that take part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReconstructionOfAll;

impl Query for ReconstructionOfAll {
    type Task = Reconstruct;
    const STEP: Step = Step::Reconstruction;

    fn all(_project: &Project) -> Vec<Self> {
        vec![Self]
    }

    /// Returns a key once the cameras of all photographs are known.
    fn key(self, project: &Project) -> Option<Key> {
        let photos = project.taking_part();
        if photos.len() < 2 {
            return None;
        }
        let mut inputs = Vec::new();
        for photo in &photos {
            let features = FeaturesOf(photo.id).key(project)?;
            inputs.push((features.0, project.camera(photo)?.k));
        }
        let matching = project.document.settings.matching;
        Some(Key::of(&(
            "reconstruction",
            inputs,
            matching,
            project.sfm_options(),
            project.known_poses(),
        )))
    }

    fn is_ready(self, project: &Project, _is_imported: bool) -> bool {
        let photos = project.taking_part();
        let mut pairs = pairs(&photos);
        photos.len() >= 2
            && pairs.all(|(first, second)| project.get(MatchesOf(first.id, second.id)).is_some())
    }

    fn priority(self, _project: &Project) -> u8 {
        60
    }

    fn task(self, project: &Project) -> Option<Reconstruct> {
        let photos = project.taking_part();
        let mut pairs = Vec::new();
        for (i, first) in photos.iter().enumerate() {
            for (j, second) in photos.iter().enumerate().skip(i + 1) {
                let matches = project.get(MatchesOf(first.id, second.id))?;
                pairs.push(PairOf {
                    first: i as u32,
                    second: j as u32,
                    matches: matches.iter().map(|m| (m.first, m.second)).collect(),
                });
            }
        }
        Some(Reconstruct {
            images: project.image_points()?,
            pairs,
            options: project.sfm_options(),
            poses: project.known_poses(),
        })
    }

    fn label(self, _project: &Project) -> String {
        "Reconstructing".to_owned()
    }

    fn stored(output: &Reconstructed, _destination: Destination) -> Option<Reconstructed> {
        Some(output.clone())
    }

    fn fits(self, project: &Project, output: &Reconstructed) -> bool {
        let photos = project.taking_part().into_iter();
        let counts: Option<Vec<usize>> =
            photos.map(|photo| project.num_features(photo.id)).collect();
        counts.is_some_and(|counts| output.is_valid(&counts))
    }
}

impl Reconstructed {
    /// Whether sizes, indices and counts agree.
    ///
    /// * `counts`: number of features of each photograph
    fn is_valid(&self, counts: &[usize]) -> bool {
        let is_camera = |camera: &CameraFound| {
            are_finite(&camera.intrinsics)
                && are_finite(&camera.rotation)
                && camera.rotation.iter().any(|x| *x != 0.0)
                && are_finite(&camera.translation)
        };
        let is_seen = |component: &Component, (image, keypoint): (u32, u32)| {
            let image = image as usize;
            let has_camera = component.cameras.get(image).is_some_and(Option::is_some);
            has_camera && counts.get(image).is_some_and(|n| (keypoint as usize) < *n)
        };
        let is_component = |component: &Component| {
            component.cameras.len() == counts.len()
                && component.cameras.iter().flatten().all(is_camera)
                && are_finite(&component.lens.coefficients())
                && (component.points.iter()).all(|point| {
                    are_finite(&point.position)
                        && point.error_px.is_finite()
                        && point.track.iter().all(|place| is_seen(component, *place))
                })
        };
        self.components.iter().all(is_component)
            && self.mean_error_px.len() == self.components.len()
            && self.determines_focal.len() == self.components.len()
            && self.before_correction_px.len() == self.components.len()
            && (self.before_correction_px.iter().flatten()).all(|px| px.is_finite())
            && self.reasons.len() == counts.len()
            && are_finite(&self.mean_error_px)
            && are_finite(&self.costs)
    }
}

impl Project {
    /// Returns the photographs reduced to their keypoints, once all of them have features.
    pub(crate) fn image_points(&self) -> Option<Vec<ImagePoints>> {
        let image = |photo: &&InputPhoto| {
            let features = self.get(FeaturesOf(photo.id))?;
            Some(ImagePoints {
                name: photo.name.clone(),
                camera: self.camera(photo)?,
                points: features.list.iter().map(|f| [f.u, f.v]).collect(),
                colors: features.list.iter().map(|f| f.color).collect(),
            })
        };
        self.taking_part().iter().map(image).collect()
    }

    /// Returns the cameras and points so far of a running reconstruction.
    pub fn growing(&self) -> Option<&Component> {
        let key = ReconstructionOfAll.key(self)?;
        let found: &Reconstructed = self.cache.partial(key)?;
        let is_running = self.get(ReconstructionOfAll).is_none();
        found.components.first().filter(|_| is_running)
    }

    /// Returns the current component.
    pub fn component(&self) -> Option<&Component> {
        let found = self.get(ReconstructionOfAll)?;
        found.components.get(self.view.component)
    }
}
