//! Conversion between a project and its saved form.

use crate::project::{
    Anchor, Blob, Computed, ControlPoint, CropBox, Document, InputPhoto, Key, KnownPoses,
    LensCamera, Measure, PhotoId, PointSet, Project, Saved, SavedPhoto, Shape, Source, VERSION,
};
use crate::tasks::{Packed, SaveProject};

/// Folder of the files of boards.
const BOARDS: &str = "boards/";

fn saved_photo(photo: &InputPhoto) -> SavedPhoto {
    SavedPhoto {
        name: photo.name.clone(),
        rendered: match photo.source {
            Source::File(_) => None,
            Source::Rendered(sample, index) => Some((sample, index)),
        },
        excluded: photo.excluded,
        focal_px: photo.focal_px,
    }
}

/// Renumbers the photographs of a measure's ends.
fn renumbered(measure: &Measure, number: impl Fn(PhotoId) -> Option<PhotoId>) -> Option<Measure> {
    Some(Measure {
        ends: all_renumbered(measure.ends, number)?,
        length_m: measure.length_m,
    })
}

/// Renumbers the photographs of a figure's points.
fn shape_renumbered(shape: &Shape, number: impl Fn(PhotoId) -> Option<PhotoId>) -> Option<Shape> {
    let points = shape.points.iter();
    Some(Shape {
        kind: shape.kind,
        points: (points.map(|point| all_renumbered([*point], &number)))
            .map(|point| point.map(|[point]| point))
            .collect::<Option<_>>()?,
    })
}

/// Renumbers the photographs of a control point.
fn control_renumbered(
    control: &ControlPoint,
    number: impl Fn(PhotoId) -> Option<PhotoId>,
) -> Option<ControlPoint> {
    let [point] = all_renumbered([control.point], number)?;
    Some(ControlPoint {
        point,
        ..control.clone()
    })
}

fn all_renumbered<const N: usize>(
    mut ends: [Anchor; N],
    number: impl Fn(PhotoId) -> Option<PhotoId>,
) -> Option<[Anchor; N]> {
    for end in &mut ends {
        end.photo = number(end.photo)?;
        if let Some(pixel) = &mut end.pixel {
            pixel.second = number(pixel.second)?;
        }
    }
    Some(ends)
}

/// Renumbers the photographs of points, without those that are gone.
fn points_renumbered(points: &PointSet, number: impl Fn(PhotoId) -> Option<PhotoId>) -> PointSet {
    let keypoints = points.keypoints.iter();
    PointSet {
        keypoints: keypoints
            .filter_map(|(photo, mask)| Some((number(*photo)?, mask.clone())))
            .collect(),
        clouds: points.clouds.clone(),
    }
}

impl Project {
    /// Returns the saved form, without the files of photographs.
    fn saved(&self) -> Saved {
        let photos = &self.document.photos;
        let place = |id: PhotoId| {
            let place = photos.iter().position(|photo| photo.id == id)?;
            Some(place as u32)
        };
        let measures = self.document.measures.iter();
        Saved {
            version: VERSION,
            settings: self.document.settings.clone(),
            photos: photos.iter().map(saved_photo).collect(),
            measures: measures.filter_map(|m| renumbered(m, place)).collect(),
            shapes: (self.document.shapes.iter())
                .filter_map(|shape| shape_renumbered(shape, place))
                .collect(),
            control_points: (self.document.control_points.iter())
                .filter_map(|control| control_renumbered(control, place))
                .collect(),
            floor: (self.document.floor).and_then(|ends| all_renumbered(ends, place)),
            dense: (self.document.dense.iter())
                .filter_map(|(a, b)| Some((place(*a)?, place(*b)?)))
                .collect(),
            all_views: self.document.all_views,
            boards: self.document.boards.iter().map(saved_photo).collect(),
            camera: self.document.camera.clone(),
            poses: self.document.poses.clone(),
            crop: self.document.crop,
            deleted: points_renumbered(&self.document.deleted, place),
        }
    }

    /// Hash of the saved form: equal projects have equal keys.
    pub fn saved_key(&self) -> Key {
        let contents = self.given_photos().map(|photo| photo.content.0);
        Key::of(&(self.saved(), contents.collect::<Vec<_>>()))
    }

    /// Returns the total size of its files, bytes.
    pub fn num_file_bytes(&self) -> usize {
        let bytes = |photo: &InputPhoto| match &photo.source {
            Source::File(bytes) => bytes.len(),
            Source::Rendered(..) => 0,
        };
        self.given_photos().map(bytes).sum()
    }

    /// Returns all photographs, then those of boards.
    fn given_photos(&self) -> impl Iterator<Item = &InputPhoto> {
        self.document.photos.iter().chain(&self.document.boards)
    }

    /// Returns the task that writes a zip file. [`Event::OpenProject`](super::Event::OpenProject)
    /// restores the project from it, and [`Project::import`] its results.
    pub fn save_request(&self) -> SaveProject {
        self.save_request_with(self.computed())
    }

    /// Returns the same task without results, for a small file that is quickly written; results are
    /// computed again.
    pub fn keep_request(&self) -> SaveProject {
        self.save_request_with(Computed::default())
    }

    fn save_request_with(&self, computed: Computed) -> SaveProject {
        let photos = &self.document.photos;
        let packed = |photo: &InputPhoto, folder: &str| Packed {
            name: format!("{folder}{}", photo.name),
            source: photo.source.clone(),
            used: None,
            camera: None,
        };
        let boards = self.document.boards.iter();
        SaveProject {
            photographs: (photos.iter().map(|photo| packed(photo, "")))
                .chain(boards.map(|photo| packed(photo, BOARDS)))
                .collect(),
            project: self.saved(),
            computed,
        }
    }

    /// Restores the document of a saved project, without photographs whose file is missing.
    pub(super) fn restored(&mut self, saved: Saved, files: Vec<(String, Blob)>) -> Document {
        let mut document = Document {
            settings: saved.settings.checked(),
            all_views: saved.all_views,
            ..Document::default()
        };
        let mut numbers = Vec::new();
        for photo in saved.photos {
            let given = self.restored_photo(&document.photos, photo, &files, "");
            numbers.push(given.as_ref().map(|given| given.id));
            document.photos.extend(given);
        }
        for photo in saved.boards {
            let given = self.restored_photo(&document.boards, photo, &files, BOARDS);
            document.boards.extend(given);
        }
        document.camera = saved.camera.filter(LensCamera::is_finite);
        document.poses = saved.poses.map(KnownPoses::checked);
        let number = |place: PhotoId| numbers.get(place as usize).copied().flatten();
        let measures = saved.measures.iter();
        document.measures = measures.filter_map(|m| renumbered(m, number)).collect();
        document.shapes = (saved.shapes.iter())
            .filter_map(|shape| shape_renumbered(shape, number))
            .filter(Shape::is_valid)
            .collect();
        document.control_points = (saved.control_points.iter())
            .filter_map(|control| control_renumbered(control, number))
            .filter(ControlPoint::is_valid)
            .collect();
        document.floor = saved.floor.and_then(|ends| all_renumbered(ends, number));
        document.crop = saved.crop.filter(CropBox::is_valid);
        document.deleted = points_renumbered(&saved.deleted, number);
        for (a, b) in saved.dense {
            if let (Some(a), Some(b)) = (number(a), number(b))
                && a != b
                && !document.is_dense((a, b))
            {
                document.dense.push((a, b));
            }
        }
        document
    }

    /// Restores a photograph with a new number; `None` if its file is missing.
    fn restored_photo(
        &mut self,
        list: &[InputPhoto],
        photo: SavedPhoto,
        files: &[(String, Blob)],
        folder: &str,
    ) -> Option<InputPhoto> {
        let source = match photo.rendered {
            Some((sample, index)) => Source::Rendered(sample, index),
            None => {
                let is_its = |name: &str| name.strip_prefix(folder) == Some(&photo.name);
                let file = files.iter().find(|(name, _)| is_its(name))?;
                Source::File(file.1.clone())
            }
        };
        let given = self.given(list, &photo.name, source);
        self.next_id = given.id;
        Some(InputPhoto {
            excluded: photo.excluded,
            focal_px: photo.focal_px.filter(|f| f.is_finite() && *f > 0.0),
            ..given
        })
    }
}
