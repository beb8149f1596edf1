//! Texts on angles, areas, volumes and control points.

use crate::project::Project;

impl Project {
    /// Describes all figures and control points, each with a space before it.
    pub(super) fn figure_words(&self) -> String {
        let mut words = String::new();
        for index in 0..self.document.shapes.len() {
            let (name, value) = (self.shape_name(index), self.shape_words(index));
            words.push_str(&format!(" {name}: {value}."));
        }
        for (index, control) in self.document.control_points.iter().enumerate() {
            words.push_str(&format!(
                " {}: {}.",
                control.name,
                self.control_words(index)
            ));
        }
        let alignment = self.alignment_words();
        if !alignment.is_empty() {
            words.push_str(&format!(" {alignment}"));
        }
        words
    }

    /// Returns the name of a figure: its quantity and its number.
    pub fn shape_name(&self, index: usize) -> String {
        let shape = self.document.shapes.get(index);
        let name = shape.map_or("", |shape| shape.kind.name());
        let mut letters = name.chars();
        let first: String = letters
            .next()
            .into_iter()
            .flat_map(char::to_uppercase)
            .collect();
        format!("{first}{} {}", letters.as_str(), index + 1)
    }
}
