//! What travels to and from the long computation behind `two-view-sfm`.

use epipole::camera::{Camera, Intrinsics, RigidTransform};
use image::RgbImage;
use nalgebra::{Point2, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// A photograph as it travels: width, height, RGB bytes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Picture(u32, u32, Vec<u8>);

impl From<&RgbImage> for Picture {
    fn from(image: &RgbImage) -> Self {
        Self(image.width(), image.height(), image.as_raw().clone())
    }
}

impl Picture {
    /// The photograph; `None` if its bytes are not its size.
    pub(super) fn into_image(self) -> Option<RgbImage> {
        let num_bytes = u64::from(self.0) * u64::from(self.1) * 3;
        let fits = num_bytes == self.2.len() as u64 && num_bytes > 0;
        RgbImage::from_raw(self.0, self.1, self.2).filter(|_| fits)
    }
}

/// Where the two photographs come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Source {
    /// The rendered still life, from two places.
    Step,
    /// The rendered still life, from one place in two directions.
    Turn,
    /// The reader's own.
    Own(Box<[Picture; 2]>),
}

/// Everything that the answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    pub(super) source: Source,
    /// Focal length, in units of a photograph's longer side.
    pub(super) focal: f64,
    /// Of Lowe's test.
    pub(super) max_ratio: f32,
    /// Largest distance of an inlier from its epipolar line, pixels.
    pub(super) max_error_px: f64,
}

impl Request {
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        postcard::to_allocvec(self).unwrap_or_default()
    }
}

/// What the pair turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum Verdict {
    /// A motion and a scene with depth.
    Good,
    /// A motion, but a plane explains most matches.
    Plane,
    /// A motion, but without the focal length more matches could be explained.
    Lens,
    /// Fewer matches than anything can be told from.
    TooFew,
    /// Matches that agree on nothing.
    NoConsensus,
    /// The camera only turned, by this angle in degrees.
    Turned(f64),
    /// The camera moved, but so little that rays meet at this angle in degrees.
    Narrow(f64),
}

/// A point of the cloud.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct CloudPoint {
    /// The match that it comes from.
    pub(super) index: u32,
    position: [f64; 3],
    pub(super) color: [u8; 3],
}

impl CloudPoint {
    pub(super) fn new(index: usize, position: &Point3<f64>, color: [u8; 3]) -> Self {
        Self {
            index: index as u32,
            position: position.coords.into(),
            color,
        }
    }

    /// Where it is in the frame of camera 1; the baseline has length 1.
    pub(super) fn position(&self) -> Point3<f64> {
        Point3::from(self.position)
    }
}

/// A motion and what follows from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Motion {
    rotation: [f64; 4],
    translation: [f64; 3],
    /// How many inliers each of the four poses of E puts in front of both cameras, most first.
    pub(super) num_in_front: [usize; 4],
    /// Root mean square of the distances of projections from their features, pixels, before and
    /// after the adjustment of all.
    pub(super) error_px: [f64; 2],
    /// The cloud.
    pub(super) points: Vec<CloudPoint>,
}

impl Motion {
    pub(super) fn new(
        cam2_from_cam1: &RigidTransform,
        num_in_front: [usize; 4],
        error_px: [f64; 2],
        points: Vec<CloudPoint>,
    ) -> Self {
        Self {
            rotation: cam2_from_cam1.rotation.coords.into(),
            translation: cam2_from_cam1.translation.vector.into(),
            num_in_front,
            error_px,
            points,
        }
    }

    /// Camera 2 in the frame of camera 1.
    pub(super) fn cam2_from_cam1(&self) -> RigidTransform {
        let rotation = Quaternion::from_vector(self.rotation.into());
        RigidTransform::from_parts(
            Translation3::from(Vector3::from(self.translation)),
            UnitQuaternion::new_normalize(rotation),
        )
    }

    fn is_sound(&self, num_matches: usize) -> bool {
        let numbers = (self.rotation.iter())
            .chain(&self.translation)
            .chain(&self.error_px)
            .chain(self.points.iter().flat_map(|point| &point.position));
        let turn: f64 = self.rotation.iter().map(|x| x * x).sum();
        numbers.into_iter().all(|x| x.is_finite() && x.abs() < 1e12)
            && turn > 0.5
            && (self.points.iter()).all(|point| (point.index as usize) < num_matches)
    }
}

/// What the computation finds, as it travels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Wire {
    pub(super) pictures: [Picture; 2],
    pub(super) keypoints: [Vec<(f64, f64)>; 2],
    pub(super) matches: Vec<(u32, u32)>,
    /// For each match, whether it agrees with what was found.
    pub(super) inliers: Vec<bool>,
    pub(super) verdict: Verdict,
    pub(super) motion: Option<Motion>,
}

/// What the computation finds.
pub(super) struct Answer {
    pub(super) pictures: [RgbImage; 2],
    /// Places of all features, pixels.
    pub(super) keypoints: [Vec<(f64, f64)>; 2],
    /// Places of the two features of each match, pixels.
    pub(super) matches: Vec<[(f64, f64); 2]>,
    /// For each match, whether it agrees with what was found.
    pub(super) inliers: Vec<bool>,
    pub(super) verdict: Verdict,
    /// There for the verdicts that have a cloud.
    pub(super) motion: Option<Motion>,
    /// Intrinsics that were assumed.
    pub(super) intrinsics: [Intrinsics; 2],
}

impl Answer {
    /// Reads the answer to `request`; `None` if it is no answer.
    pub(super) fn from_bytes(bytes: &[u8], request: &Request) -> Option<Self> {
        let wire: Wire = postcard::from_bytes(bytes).ok()?;
        let [first, second] = wire.pictures;
        let pictures = [first.into_image()?, second.into_image()?];
        let at = |list: &[(f64, f64)], index: u32| list.get(index as usize).copied();
        let pair =
            |&(i, j): &(u32, u32)| Some([at(&wire.keypoints[0], i)?, at(&wire.keypoints[1], j)?]);
        let matches: Vec<_> = wire.matches.iter().map(pair).collect::<Option<_>>()?;
        let finite = |list: &Vec<(f64, f64)>| {
            list.iter()
                .all(|(u, v)| u.abs().max(v.abs()) < 1e6 && !u.is_nan() && !v.is_nan())
        };
        let sound = wire.keypoints.iter().all(finite)
            && wire.inliers.len() == matches.len()
            && (wire.motion.iter()).all(|motion| motion.is_sound(matches.len()));
        let intrinsics = [
            intrinsics(request.focal, &pictures[0])?,
            intrinsics(request.focal, &pictures[1])?,
        ];
        sound.then_some(Self {
            pictures,
            keypoints: wire.keypoints,
            matches,
            inliers: wire.inliers,
            verdict: wire.verdict,
            motion: wire.motion,
            intrinsics,
        })
    }

    pub(super) fn num_inliers(&self) -> usize {
        self.inliers.iter().filter(|is_inlier| **is_inlier).count()
    }

    /// Camera 1, and camera 2 once its motion is known.
    pub(super) fn cameras(&self) -> [Option<Camera>; 2] {
        let camera = |index: usize, cam_from_world| Camera {
            intrinsics: self.intrinsics[index],
            cam_from_world,
        };
        let motion = self.motion.as_ref().map(Motion::cam2_from_cam1);
        [
            Some(camera(0, RigidTransform::identity())),
            motion.map(|cam2_from_cam1| camera(1, cam2_from_cam1)),
        ]
    }
}

/// Intrinsics of a photograph with a focal length in units of its longer side.
pub(super) fn intrinsics(focal: f64, picture: &RgbImage) -> Option<Intrinsics> {
    let (width, height) = picture.dimensions();
    Intrinsics::centered(focal * f64::from(width.max(height)), width, height).ok()
}

pub(super) fn pixel((u, v): (f64, f64)) -> Point2<f64> {
    Point2::new(u, v)
}
