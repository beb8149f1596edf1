//! Sentences on oddities of a model.

use super::Model;
use crate::{Error, Result};
use std::collections::{BTreeMap, BTreeSet};

/// Unsupported cameras: the reason, and the names of their images.
#[derive(Default)]
pub(super) struct LeftOut(BTreeMap<String, Vec<String>>);

impl LeftOut {
    /// Adds a camera, or one of its images.
    pub(super) fn add(&mut self, why: &str, image: Option<&str>) {
        let images = self.0.entry(why.to_owned()).or_default();
        images.extend(image.map(str::to_owned));
    }

    /// Returns a sentence for each camera.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if no image remains.
    pub(super) fn notes(&self, num_remaining: usize) -> Result<Vec<String>> {
        if let (0, Some((why, _))) = (num_remaining, self.0.first_key_value()) {
            return Err(Error::unsupported(why));
        }
        let sentence = |(why, images): (&String, &Vec<String>)| match images.len() {
            0 => format!("{why}; left out"),
            1 => format!("{why}; left out with its image {}", some(images)),
            count => format!("{why}; left out with its {count} images: {}", some(images)),
        };
        Ok(self.0.iter().map(sentence).collect())
    }
}

/// Lists the first three names.
fn some(names: &[impl AsRef<str>]) -> String {
    let first: Vec<String> = names
        .iter()
        .take(3)
        .map(|name| format!("\"{}\"", name.as_ref()))
        .collect();
    match names.len() {
        0..=3 => first.join(", "),
        more => format!("{} and {} more", first.join(", "), more - 3),
    }
}

impl Model {
    /// Returns the number of observations of all points.
    pub fn num_observations(&self) -> usize {
        self.points.iter().map(|point| point.track.len()).sum()
    }

    /// Returns the mean length of all reprojection errors, pixels; `None` without observations in
    /// front of their cameras.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an index of the model is wrong.
    pub fn mean_reprojection_px(&self) -> Result<Option<f64>> {
        self.check()?;
        let (mut sum, mut count) = (0.0, 0.0);
        for (image, keypoint, point) in self.observations() {
            let image = &self.images[image];
            let x_in_cam = image.cam_from_world * self.points[point].position;
            if let Ok(pixel) = self.cameras[image.camera].project(&x_in_cam) {
                sum += (pixel - image.keypoints[keypoint]).norm();
                count += 1.0;
            }
        }
        Ok((count > 0.0).then(|| sum / count))
    }

    /// Returns image, keypoint and point of each observation.
    fn observations(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let points = self.points.iter().enumerate();
        points.flat_map(|(index, point)| point.track.iter().map(move |&(i, k)| (i, k, index)))
    }

    /// Describes oddities of the model, a sentence each: names that are difficult for programs,
    /// images without points, points behind cameras, keypoints outside their images.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an index of the model is wrong.
    pub fn oddities(&self) -> Result<Vec<String>> {
        self.check()?;
        let mut notes = Vec::new();
        let names = self.images.iter().map(|image| image.name.as_str());
        let blank: Vec<&str> = names.clone().filter(|name| has_blank(name)).collect();
        if !blank.is_empty() {
            notes.push(format!(
                "{} of {} names have blanks ({}): COLMAP cuts them in text files, not in binary ones",
                blank.len(),
                self.images.len(),
                some(&blank)
            ));
        }
        let mut seen = BTreeSet::new();
        let twice: BTreeSet<&str> = names.filter(|name| !seen.insert(*name)).collect();
        let twice: Vec<&str> = twice.into_iter().collect();
        if !twice.is_empty() {
            notes.push(format!(
                "several images have the same name: {}",
                some(&twice)
            ));
        }
        let mut num_points = vec![0_usize; self.images.len()];
        let (mut behind, mut outside) = (0_usize, 0_usize);
        for (image, keypoint, point) in self.observations() {
            num_points[image] += 1;
            let image = &self.images[image];
            let camera = &self.cameras[image.camera];
            let x_in_cam = image.cam_from_world * self.points[point].position;
            behind += usize::from(camera.project(&x_in_cam).is_err());
            let pixel = image.keypoints[keypoint];
            let is_inside = |value: f64, side: u32| value >= -0.5 && value <= f64::from(side) - 0.5;
            outside += usize::from(
                !(is_inside(pixel.x, camera.width) && is_inside(pixel.y, camera.height)),
            );
        }
        if !self.points.is_empty() {
            let images = self.images.iter().zip(&num_points);
            let without = images.filter(|(_, count)| **count == 0);
            let without: Vec<&str> = without.map(|(image, _)| image.name.as_str()).collect();
            if !without.is_empty() {
                notes.push(format!(
                    "{} of {} images see no point: {}",
                    without.len(),
                    self.images.len(),
                    some(&without)
                ));
            }
        }
        // Only models with images are expected to have observations.
        let short = self.points.iter().filter(|point| point.track.len() < 2);
        let short = short.take(match self.images.is_empty() {
            true => 0,
            false => usize::MAX,
        });
        for (count, sentence) in [
            (behind, "observations are of points behind their cameras"),
            (outside, "observed keypoints are outside their images"),
            (
                short.count(),
                "points are observed by fewer than two images",
            ),
            (
                self.cameras.len() - self.used_cameras(),
                "cameras have no image",
            ),
        ] {
            if count > 0 {
                notes.push(format!("{count} {sentence}"));
            }
        }
        Ok(notes)
    }

    fn used_cameras(&self) -> usize {
        let used: BTreeSet<usize> = self.images.iter().map(|image| image.camera).collect();
        used.len()
    }
}

/// Returns whether COLMAP's text reader cuts a name.
pub(super) fn has_blank(name: &str) -> bool {
    name.contains(|c: char| c.is_ascii_whitespace())
}
