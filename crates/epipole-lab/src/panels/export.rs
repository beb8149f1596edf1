//! Saving, and the recipe for the same result elsewhere.

use super::reconstruction::space;
use super::screen::{Action, Panel, Screen};
use super::widgets::controls;
use crate::project::Step;
use egui::{Button, RichText, Ui};

/// Panel of the step "Export".
pub(super) struct Export;

impl Panel for Export {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        space(screen, ui);
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        ui.label(project.describe());
        let ready = project.can_export();
        if ui
            .add_enabled(ready, Button::new("Save reconstruction.zip"))
            .clicked()
        {
            screen.actions.push(Action::SaveReconstruction);
        }
        ui.label(
        "Inside are images/ and sparse/0/ in COLMAP's text format, which other programs open; points.ply with colors; \
         reconstruction.json, as the command line prints it; and a command and a Rust program that repeat it. Measures are \
         in measures.csv. Pairs with dense depth add dense.ply and a PFM file each in depth/; the depth of all views \
         adds fused.ply with normals.",
    );
        ui.weak(match project.scale() {
            Some(_) => "Lengths are in meters, by the length you measured.",
            None => "The unit is arbitrary. Measure a known length to get meters.",
        });
        if project.floor().is_some() {
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
