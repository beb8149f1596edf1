//! Photographs downscaled for the depth of all views, so that all of them fit into memory.

use super::photograph::{Photograph, PhotographOf};
#[cfg(feature = "vision")]
use super::task::{Monitor, Run, report};
use super::task::{Query, Task};
use crate::project::{Blob, Key, PhotoId, Project, Step};
use serde::{Deserialize, Serialize};

/// Pixels of a downscaled photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Width and height of the photograph, pixels.
    pub from: (u32, u32),
    /// Red, green, blue, row by row.
    pub rgb: Blob,
}

/// Downscales a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReducePhotograph {
    /// The photograph with its pixels.
    pub photograph: Photograph,
    /// Maximum number of pixels.
    pub max_pixels: u32,
}

impl Task for ReducePhotograph {
    type Output = Reduced;

    fn is_whole(output: &Reduced) -> bool {
        let pixels = u64::from(output.width) * u64::from(output.height);
        pixels.checked_mul(3) == Some(output.rgb.len() as u64)
    }
}

#[cfg(feature = "vision")]
impl Run for ReducePhotograph {
    fn run(self, monitor: Monitor<'_>) -> Result<Reduced, String> {
        use image::imageops::{FilterType, resize};
        report(monitor, 0.0, "downscaling")?;
        let image = self.photograph.to_image()?;
        let from = image.dimensions();
        let pixels = f64::from(from.0) * f64::from(from.1);
        let share = libm::sqrt(f64::from(self.max_pixels) / pixels).min(1.0);
        let side = |side: u32| ((f64::from(side) * share).round() as u32).max(1);
        let small = match share < 1.0 {
            true => resize(&image, side(from.0), side(from.1), FilterType::Triangle),
            false => image,
        };
        Ok(Reduced {
            width: small.width(),
            height: small.height(),
            from,
            rgb: small.into_raw().into(),
        })
    }
}

/// Query for the downscaled photograph with this number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReducedOf(pub PhotoId);

impl Query for ReducedOf {
    type Task = ReducePhotograph;
    const STEP: Step = Step::Depth;

    /// Returns the registered photographs, until the depth of all views is available.
    fn all(project: &Project) -> Vec<Self> {
        match project.awaits_views() {
            true => project.registered().into_iter().map(Self).collect(),
            false => Vec::new(),
        }
    }

    fn key(self, project: &Project) -> Option<Key> {
        let photograph = PhotographOf(self.0).key(project)?;
        let max_pixels = project.max_view_pixels()?;
        Some(Key::of(&("reduced", photograph.0, max_pixels)))
    }

    fn is_ready(self, project: &Project, _is_imported: bool) -> bool {
        let photo = project.document.photo(self.0);
        photo.is_some_and(|photo| project.photograph(photo).is_some())
    }

    fn priority(self, _project: &Project) -> u8 {
        75
    }

    fn task(self, project: &Project) -> Option<ReducePhotograph> {
        Some(ReducePhotograph {
            photograph: project.photograph(project.document.photo(self.0)?)?.clone(),
            max_pixels: project.max_view_pixels()?,
        })
    }

    fn label(self, project: &Project) -> String {
        format!("Downscaling {}", project.document.name_of(self.0))
    }
}
