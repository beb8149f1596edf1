//! All measures for the zip file.

use crate::project::{Anchor, Project, Shape};
use crate::tasks::{Aligned, Mark, Measured, MeasuredControl, MeasuredShape, Measures};

impl Project {
    /// Collects all measures whose points exist.
    pub(super) fn measures(&self) -> Measures {
        let document = &self.document;
        if !document.has_measures() {
            return Measures::default();
        }
        let mut findings = vec![self.scale_words()];
        findings.push(self.alignment_words());
        findings.retain(|sentence| !sentence.is_empty());
        Measures {
            lengths: (0..document.measures.len())
                .filter_map(|index| self.measured(index))
                .collect(),
            shapes: (document.shapes.iter().enumerate())
                .filter_map(|(index, shape)| self.measured_shape(index, shape))
                .collect(),
            control_points: (0..document.control_points.len())
                .filter_map(|index| self.measured_control(index))
                .collect(),
            aligned: self.alignment().map(|alignment| {
                let isometry = alignment.control_from_world.isometry;
                Aligned {
                    rotation: isometry.rotation.coords.into(),
                    translation: isometry.translation.vector.into(),
                    scale: alignment.control_from_world.scaling(),
                }
            }),
            findings,
            marks: self.marks(),
        }
    }

    fn measured(&self, index: usize) -> Option<Measured> {
        let measure = self.document.measures.get(index)?;
        let [first, second] = &measure.ends;
        if !(self.is_remaining(first) && self.is_remaining(second)) {
            return None;
        }
        let length = match self.scale() {
            Some(_) => self.length_in_meters(index)?,
            None => self.length_in_units(measure)?,
        };
        let mut words = self.length_words(index);
        if let Some(residual) = self.residual_words(index) {
            words.push_str(&format!(", {residual}"));
        }
        Some(Measured {
            ends: [self.anchored(first)?.into(), self.anchored(second)?.into()],
            length: length.value,
            sigma: length.sigma,
            typed_m: measure.length_m,
            words,
        })
    }

    fn measured_shape(&self, index: usize, shape: &Shape) -> Option<MeasuredShape> {
        if !shape.points.iter().all(|point| self.is_remaining(point)) {
            return None;
        }
        let found = self.shape_value(shape).ok()?;
        let places = shape.points.iter().map(|point| self.anchored(point));
        Some(MeasuredShape {
            kind: shape.kind.name().to_owned(),
            name: self.shape_name(index),
            points: places
                .map(|place| Some(place?.into()))
                .collect::<Option<_>>()?,
            value: found.value,
            sigma: found.sigma,
            unit: self.shape_unit(shape.kind).to_owned(),
            words: self.shape_words(index),
        })
    }

    fn measured_control(&self, index: usize) -> Option<MeasuredControl> {
        let control = self.document.control_points.get(index)?;
        let alignment = self.alignment();
        let mut residuals = alignment.iter().flat_map(|found| &found.residuals);
        let residual = residuals.find(|(other, _)| *other == index);
        Some(MeasuredControl {
            name: control.name.clone(),
            place: self.anchored(&control.point)?.into(),
            position_m: control.position_m,
            residual_m: residual.map(|(_, by)| by.norm()),
            words: self.control_words(index),
        })
    }

    /// Returns a mark for each measured point; the first measure of a point names it.
    fn marks(&self) -> Vec<Mark> {
        let document = &self.document;
        let lengths = document.measures.iter().enumerate();
        let lengths = lengths.flat_map(|(index, measure)| {
            let label = move |letter: char| format!("{}{letter}", index + 1);
            measure.ends.iter().zip([label('a'), label('b')])
        });
        let shapes = document
            .shapes
            .iter()
            .enumerate()
            .flat_map(|(index, shape)| {
                let letter = shape.kind.name().chars().next().unwrap_or(' ');
                let letter = letter.to_ascii_uppercase();
                let label = move |n: usize| format!("{letter}{}.{}", index + 1, n + 1);
                shape.points.iter().zip((0..).map(label))
            });
        let control = document.control_points.iter();
        let control = control.map(|control| (&control.point, control.name.clone()));
        let mut seen: Vec<&Anchor> = Vec::new();
        let mut marks = Vec::new();
        for (anchor, label) in control.chain(lengths).chain(shapes) {
            if !seen.contains(&anchor)
                && let (Some(place), Some(images)) = (self.anchored(anchor), self.observers(anchor))
            {
                seen.push(anchor);
                let place = place.into();
                marks.push(Mark {
                    label,
                    place,
                    images,
                });
            }
        }
        marks
    }
}
