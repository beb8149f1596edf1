//! Cameras and points from all photographs.

use super::are_finite;
use super::camera_found::CameraFound;
use super::features::FeaturesOf;
use super::matches::MatchesOf;
use super::photograph::{Calibrated, FocalOrigin};
use super::task::{Destination, Query, Task};
#[cfg(feature = "vision")]
use super::task::{Monitor, Progress, Run};
use crate::project::{Given, Key, Project, RefineFocal, SfmOptions, pairs};
use epipole::camera::Lens;
use serde::{Deserialize, Serialize};

/// A point that was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointFound {
    /// Position in the world.
    pub position: [f64; 3],
    /// Its color.
    pub color: [u8; 3],
    /// Image and keypoint of each place where it was seen.
    pub track: Vec<(u32, u32)>,
    /// Root mean square of its reprojection errors, pixels.
    pub error_px: f64,
}

/// Cameras and points in one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Component {
    /// The camera of each image, or none.
    pub cameras: Vec<Option<CameraFound>>,
    /// The lens of all.
    #[serde(rename = "distortion", with = "super::radial_lens")]
    pub lens: Lens,
    /// The points.
    pub points: Vec<PointFound>,
}

impl Component {
    /// Number of registered photographs.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }
}

/// Reason why a photograph is in no component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum UnregisteredReason {
    /// Too few features; their number.
    FewFeatures(u32),
    /// No other photograph shares enough matches that agree on one motion of the camera.
    NoOverlap,
    /// Taken from nearly the same place as those that match it.
    NoBaseline,
    /// None of the pairs with it could start a reconstruction.
    NoStart,
    /// Too few visible points; their number.
    FewPoints(u32),
    /// Number of visible points, which do not agree on a pose.
    NoPose(u32),
}

/// The reconstruction from all photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Reconstructed {
    /// Largest first.
    pub components: Vec<Component>,
    /// Cost after each adjustment, square pixels.
    pub costs: Vec<f64>,
    /// Mean length of all reprojection errors of each component, pixels.
    pub mean_error_px: Vec<f64>,
    /// For each image why it is in no component; `None` for those that are in one.
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

/// Matches of two photographs, by their places in a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairOf {
    /// Place of the first.
    pub first: u32,
    /// Place of the second.
    pub second: u32,
    /// Indices of keypoints, first photograph first.
    pub matches: Vec<(u32, u32)>,
}

#[cfg(any(feature = "vision", feature = "files"))]
impl ImagePoints {
    /// The photograph as the core has it.
    pub(super) fn sfm_image(&self) -> epipole::sfm::SfmImage {
        epipole::sfm::SfmImage {
            name: self.name.clone(),
            keypoints: self.points.iter().map(|p| (*p).into()).collect(),
            colors: self.colors.clone(),
            ..epipole::sfm::SfmImage::default()
        }
    }
}

/// Finds cameras and points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reconstruct {
    /// The photographs.
    pub images: Vec<ImagePoints>,
    /// Matches between them.
    pub pairs: Vec<PairOf>,
    /// Reconstruction settings.
    pub options: SfmOptions,
}

impl Task for Reconstruct {
    type Output = Reconstructed;
}

/// The reconstruction from all photographs that take part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReconstructionOfAll;

impl Query for ReconstructionOfAll {
    type Task = Reconstruct;

    fn all(_project: &Project) -> Vec<Self> {
        vec![Self]
    }

    /// Known once the cameras of all photographs are.
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
    /// Whether sizes, indices and numbers agree.
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
            && self.reasons.len() == counts.len()
            && are_finite(&self.mean_error_px)
            && are_finite(&self.costs)
    }
}

impl Project {
    /// Options of the reconstruction, with "when guessed" resolved.
    pub fn sfm_options(&self) -> SfmOptions {
        let guessed = || {
            let mut photos = self.taking_part().into_iter();
            photos.any(|photo| self.focal_origin(photo) == Some(FocalOrigin::Guessed))
        };
        let refine_focal = match self.document.settings.refine_focal {
            RefineFocal::Always => true,
            RefineFocal::Never => false,
            RefineFocal::WhenGuessed => guessed(),
        };
        SfmOptions {
            refine_focal,
            ..self.document.settings.sfm
        }
    }

    /// The photographs reduced to their keypoints, once all of them have features.
    pub(crate) fn image_points(&self) -> Option<Vec<ImagePoints>> {
        let image = |photo: &&Given| {
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

    /// Cameras and points so far of the reconstruction that is running.
    pub fn growing(&self) -> Option<&Component> {
        let key = ReconstructionOfAll.key(self)?;
        let found: &Reconstructed = self.cache.partial(key)?;
        let is_running = self.get(ReconstructionOfAll).is_none();
        found.components.first().filter(|_| is_running)
    }

    /// The component that is looked at.
    pub fn component(&self) -> Option<&Component> {
        let found = self.get(ReconstructionOfAll)?;
        found.components.get(self.view.component)
    }
}

#[cfg(feature = "vision")]
impl Run for Reconstruct {
    /// Reconstructs just as `epipole sfm` does, with an intermediate output after each photograph.
    fn run(self, monitor: Monitor<'_>) -> Result<Reconstructed, String> {
        use super::convert::sentence;
        use epipole::camera::Camera;
        use epipole::feature::Match;
        use epipole::progress::Status;
        use epipole::sfm::{
            IncrementalReconstruction, PairMatches, SfmInput, SfmStep, why_unregistered,
        };
        let Self {
            images,
            pairs,
            options,
        } = self;
        let plain = |pair: &PairOf| PairMatches {
            image1: pair.first as usize,
            image2: pair.second as usize,
            matches: (pair.matches.iter())
                .map(|&(first, second)| Match::new(first as usize, second as usize))
                .collect(),
        };
        let input = SfmInput {
            images: images.iter().map(ImagePoints::sfm_image).collect(),
            cameras: (images.iter())
                .map(|image| {
                    let Calibrated { width, height, .. } = image.camera;
                    Ok(Camera::pinhole(image.camera.intrinsics()?, width, height))
                })
                .collect::<Result<_, String>>()?,
            pairs: pairs.iter().map(plain).collect(),
        };
        let how = epipole::sfm::SfmOptions::default()
            .with_min_num_inliers(options.min_num_inliers as usize)
            .with_refine_focal(options.refine_focal)
            .with_refine_distortion(options.refine_distortion)
            .with_seed(options.seed);
        let mut share = 0.0;
        let mut run = IncrementalReconstruction::new(&input, &how, &mut |status: Status| {
            share = status.share;
            monitor(Progress::Share(share, status.stage.words()))
        })
        .map_err(sentence)?;
        let mut words = String::new();
        loop {
            // Within a step there is nothing new to say, only to ask.
            let step = run.step(&mut |status: Status| {
                share = status.share;
                monitor(Progress::Share(share, &words))
            });
            words = match step.map_err(sentence)? {
                None => break,
                Some(SfmStep::Started { num_points, .. }) => {
                    format!("started with two, {num_points} points")
                }
                Some(SfmStep::Registered {
                    num_registered,
                    num_points,
                    ..
                }) => format!("{num_registered} photographs, {num_points} points"),
                Some(_) => continue,
            };
            let so_far = run.current().unwrap_or_default();
            let partial = Reconstructed {
                mean_error_px: vec![so_far.mean_reprojection_px(&input.images)],
                components: vec![component(&so_far)],
                ..Reconstructed::default()
            };
            if monitor(Progress::Share(share, &words)).is_break()
                || monitor(Progress::Partial(Self::write(&partial))).is_break()
            {
                return Err("stopped".to_owned());
            }
        }
        let found = run.finish();
        let mut watch =
            |_: Status| monitor(Progress::Share(share, "finding the reasons of the rest"));
        let why = why_unregistered(&input, &how, &found, &mut watch).map_err(sentence)?;
        let mut reasons = vec![None; images.len()];
        for (image, why) in found.unregistered.iter().zip(&why) {
            reasons[*image] = Some(reason(why));
        }
        let mean_error_px = (found.components.iter())
            .map(|component| component.mean_reprojection_px(&input.images))
            .collect();
        Ok(Reconstructed {
            components: found.components.iter().map(component).collect(),
            costs: found.steps.iter().filter_map(SfmStep::cost).collect(),
            mean_error_px,
            reasons,
        })
    }
}

#[cfg(feature = "vision")]
fn reason(why: &epipole::sfm::WhyUnregistered) -> UnregisteredReason {
    use epipole::sfm::WhyUnregistered as Why;
    match *why {
        Why::FewFeatures { num_keypoints, .. } => {
            UnregisteredReason::FewFeatures(num_keypoints as u32)
        }
        Why::FewMatches { .. } | Why::NoMotion => UnregisteredReason::NoOverlap,
        Why::NoBaseline => UnregisteredReason::NoBaseline,
        Why::FewPoints { visible, .. } => UnregisteredReason::FewPoints(visible as u32),
        Why::NoPose { visible } => UnregisteredReason::NoPose(visible as u32),
        // Nothing ends a task early but cancellation, so `NotTried` does not occur.
        _ => UnregisteredReason::NoStart,
    }
}

#[cfg(feature = "vision")]
fn component(found: &epipole::sfm::Reconstruction) -> Component {
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
    // One lens took them all.
    let lens = (found.cameras.iter().flatten().next()).map_or(Lens::NONE, |c| c.camera.lens);
    Component {
        cameras: (found.cameras.iter())
            .map(|c| c.as_ref().map(camera))
            .collect(),
        lens,
        points: found.points.iter().map(point).collect(),
    }
}
