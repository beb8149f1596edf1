//! Saving, and the recipe for the same result elsewhere.

use super::host::Wish;
use super::knobs;
use crate::project::{Project, Step};
use egui::{Button, RichText, Ui};

/// Draws the save buttons. Returns the requested one.
pub(super) fn knobs(project: &Project, ui: &mut Ui) -> Option<Wish> {
    let mut wish = None;
    ui.label(project.describe());
    let ready = project.can_export();
    if ui
        .add_enabled(ready, Button::new("Save reconstruction.zip"))
        .clicked()
    {
        wish = Some(Wish::Export);
    }
    ui.label(
        "Inside are images/ and sparse/0/ in COLMAP's text format, which other programs open; points.ply with colors; \
         reconstruction.json, as the command line prints it; and a command and a Rust program that repeat it. Pairs with \
         dense depth add dense.ply and a PFM file each in depth/.",
    );
    ui.weak(match project.scale() {
        Some(_) => "Lengths are in meters, by the length you measured.",
        None => "The unit is arbitrary. Measure a known length to get meters.",
    });
    ui.separator();
    if ui
        .add_enabled(ready, Button::new("Save view.png"))
        .clicked()
    {
        wish = Some(Wish::SaveView);
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
    knobs::book(ui, Step::Export);
    wish
}
