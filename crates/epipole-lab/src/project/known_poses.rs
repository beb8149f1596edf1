//! Cameras and poses of photographs from a model of another program.

use super::board_options::LensCamera;
use serde::{Deserialize, Serialize};

/// A pose, camera from world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Rotation, as a quaternion i, j, k, w of any norm.
    pub rotation: [f64; 4],
    /// Translation.
    pub translation: [f64; 3],
}

impl Pose {
    /// Returns the pose of the same camera after its photograph is rotated clockwise by quarter
    /// turns.
    pub fn turned(&self, quarters: u8) -> Self {
        let ([mut i, mut j, mut k, mut w], [mut x, mut y, z]) = (self.rotation, self.translation);
        for _ in 0..quarters % 4 {
            // The rotation times (k + 1) / √2, unnormalized; u becomes v.
            (i, j, k, w) = (i - j, i + j, k + w, w - k);
            (x, y) = (-y, x);
        }
        Self {
            rotation: [i, j, k, w],
            translation: [x, y, z],
        }
    }
}

/// An image of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KnownImage {
    /// Name of its file, without folders.
    pub name: String,
    /// Its camera.
    pub camera: LensCamera,
    /// Its pose.
    pub pose: Pose,
}

impl KnownImage {
    fn is_finite(&self) -> bool {
        let Pose {
            rotation,
            translation,
        } = &self.pose;
        let mut numbers = rotation.iter().chain(translation);
        self.camera.is_finite()
            && numbers.all(|x| x.is_finite())
            && rotation.iter().any(|x| *x != 0.0)
    }
}

/// Returns the name of a photograph without its extension, in lower case.
pub fn file_stem(name: &str) -> String {
    let name = name.rsplit_once('.').map_or(name, |(name, _)| name);
    name.to_lowercase()
}

/// The images of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KnownPoses {
    /// Name of the file, or of one of the files.
    pub file: String,
    /// The images.
    pub images: Vec<KnownImage>,
}

impl KnownPoses {
    /// Returns the image of a photograph; `None` also if several images have its name. Extensions
    /// are ignored, as an exported photograph may have another one.
    pub fn image_of(&self, name: &str) -> Option<&KnownImage> {
        let own = file_stem(name);
        let mut images = (self.images.iter()).filter(|image| file_stem(&image.name) == own);
        images.next().filter(|_| images.next().is_none())
    }

    /// Removes images whose numbers are not finite.
    pub fn checked(mut self) -> Self {
        self.images.retain(KnownImage::is_finite);
        self
    }
}
