//! Saving of files, and the recipe for the same result elsewhere.

use super::reconstruction::space;
use super::screen::{Action, Panel, Screen};
use super::widgets::controls;
use crate::project::Step;
use crate::session::ScaleSource;
use crate::tasks::ExportFormat;
use egui::{Button, RichText, Ui};

/// Panel of the step "Export".
#[derive(Default)]
pub(super) struct Export {
    format: ExportFormat,
}

impl Panel for Export {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        space(screen, ui);
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        ui.label(project.describe());
        let ready = project.can_export();
        let formats = ExportFormat::ALL.map(|format| (format, format.programs()));
        if let Some(format) = controls::choose(ui, "For", self.format, &formats) {
            self.format = format;
        }
        if ui
            .add_enabled(ready, Button::new("Save reconstruction.zip"))
            .clicked()
        {
            screen.actions.push(Action::SaveReconstruction(self.format));
        }
        ui.label(format!(
            "Inside are images/ and {}; model.html, which shows the model in any browser; points.ply with colors; \
             reconstruction.json, as the command line prints it; and a command and a Rust program that repeat it. \
             Measures are in measures.csv, and on one page in report.pdf. Pairs with dense depth add dense.ply and \
             a PFM file each in depth/; the depth of all views adds fused.ply with normals and its surface, {}{}.",
            self.format.place(),
            self.format.mesh(),
            match self.format.has_texture() {
                true => ", with a texture of the photographs",
                false => "",
            }
        ));
        ui.weak(match (project.scale(), &project.document().poses) {
            (Some(scale), _) if scale.source == ScaleSource::ControlPoints => {
                "Coordinates are those of the control points, in meters.".to_owned()
            }
            (Some(_), _) => "Lengths are in meters, by the length you measured.".to_owned(),
            (None, Some(poses)) => {
                format!(
                    "The unit is that of {}. Measure a known length to get meters.",
                    poses.file
                )
            }
            (None, None) => {
                "The unit is arbitrary. Measure a known length to get meters.".to_owned()
            }
        });
        let words = project.edit_words();
        if !words.is_empty() {
            ui.weak(words);
        }
        if project.floor().is_some() && project.alignment().is_none() {
            ui.weak("z points up from the floor.");
        }
        ui.separator();
        if ui
            .add_enabled(ready, Button::new("Save view.png"))
            .clicked()
        {
            screen.actions.push(Action::SaveView);
        }
        ui.weak("The 3-D view as you last saw it.");
        if let Some(recipe) = project.recipe().filter(|_| ready) {
            ui.separator();
            ui.weak("The same on the command line:");
            ui.label(RichText::new(&recipe.command).small());
            if ui.button("Copy the command").clicked() {
                ui.ctx().copy_text(recipe.command.clone());
            }
            ui.weak(&recipe.photographs);
        }
        controls::book(ui, Step::Export);
    }
}
