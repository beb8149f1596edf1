//! What is written of a project beside its photographs.

use super::Project;
use super::document::{Anchor, Document, Measure, PhotoId, Settings, content_of};
use super::update::unique_name;
use crate::tasks::{Blob, Packed, Request, Sample, Source};
use serde::{Deserialize, Serialize};

/// The version that is written.
pub const VERSION: u32 = 1;

/// A project without its photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Saved {
    /// The version of this form.
    pub version: u32,
    /// All knobs.
    pub settings: Settings,
    /// The photographs, in order.
    pub photos: Vec<SavedPhoto>,
    /// What was measured; photographs are named by their place.
    pub measures: Vec<Measure>,
}

/// A photograph of a saved project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedPhoto {
    /// Its name, and that of its file.
    pub name: String,
    /// Which photograph of a sample it is, if it is one: such have no file.
    pub rendered: Option<(Sample, u8)>,
    /// Left out by the reader.
    pub excluded: bool,
    /// The focal length that the reader typed, pixels.
    pub focal_px: Option<f64>,
}

/// The measure with the photographs of its ends renumbered.
fn renumbered(measure: &Measure, number: impl Fn(PhotoId) -> Option<PhotoId>) -> Option<Measure> {
    let end = |anchor: &Anchor| {
        Some(Anchor {
            photo: number(anchor.photo)?,
            ..*anchor
        })
    };
    Some(Measure {
        ends: [end(&measure.ends[0])?, end(&measure.ends[1])?],
        length_m: measure.length_m,
    })
}

impl Project {
    /// The request for a zip file that [`Event::OpenProject`](super::Event::OpenProject) brings back.
    pub fn save_request(&self) -> Request {
        let photos = &self.document.photos;
        let place = |id: PhotoId| {
            let place = photos.iter().position(|photo| photo.id == id)?;
            Some(place as u32)
        };
        let measures = self.document.measures.iter();
        let project = Saved {
            version: VERSION,
            settings: self.document.settings.clone(),
            photos: (photos.iter())
                .map(|photo| SavedPhoto {
                    name: photo.name.clone(),
                    rendered: match photo.source {
                        Source::File(_) => None,
                        Source::Rendered(sample, index) => Some((sample, index)),
                    },
                    excluded: photo.excluded,
                    focal_px: photo.focal_px,
                })
                .collect(),
            measures: measures.filter_map(|m| renumbered(m, place)).collect(),
        };
        let packed = |photo: &super::Given| Packed {
            name: photo.name.clone(),
            source: photo.source.clone(),
            used: None,
        };
        Request::Save {
            photographs: photos.iter().map(packed).collect(),
            project,
        }
    }

    /// The document of a saved project. Photographs whose file is missing are left out of it.
    pub(super) fn restored(&mut self, saved: Saved, files: Vec<(String, Blob)>) -> Document {
        let mut document = Document {
            settings: saved.settings.checked(),
            ..Document::default()
        };
        let mut numbers = Vec::new();
        for photo in saved.photos {
            let file = || {
                let file = files.iter().find(|(name, _)| *name == photo.name)?;
                Some(Source::File(file.1.clone()))
            };
            let source = match photo.rendered {
                Some((sample, index)) => Some(Source::Rendered(sample, index)),
                None => file(),
            };
            let Some(source) = source else {
                numbers.push(None);
                continue;
            };
            self.next_id += 1;
            numbers.push(Some(self.next_id));
            document.photos.push(super::Given {
                id: self.next_id,
                name: unique_name(&document, &photo.name),
                content: content_of(&source),
                source,
                excluded: photo.excluded,
                focal_px: photo.focal_px.filter(|f| f.is_finite() && *f > 0.0),
            });
        }
        let number = |place: PhotoId| numbers.get(place as usize).copied().flatten();
        let measures = saved.measures.iter();
        document.measures = measures.filter_map(|m| renumbered(m, number)).collect();
        document
    }
}
