//! What is saved, and how to do the same elsewhere.

use super::host::Wish;
use super::knobs;
use crate::project::Project;
use egui::{Button, RichText, Ui};

/// What can be saved. Returns what was asked for.
pub(super) fn knobs(project: &Project, ui: &mut Ui) -> Option<Wish> {
    let mut wish = None;
    ui.label(project.describe());
    let ready = project.component().is_some();
    if ui
        .add_enabled(ready, Button::new("Save reconstruction.zip"))
        .clicked()
    {
        wish = Some(Wish::Export);
    }
    ui.label(
        "It holds images/ and sparse/0/ as COLMAP's text model, which other programs open; points.ply, the points with \
         their colors; reconstruction.json, as the command line prints it; and a command and a Rust program that do the \
         same. With the depth of pairs also dense.ply and depth/, a PFM file each.",
    );
    ui.weak(match project.scale() {
        Some(_) => "Lengths are meters, by the length that you measured.",
        None => "The unit is arbitrary: measure a length to have meters.",
    });
    ui.separator();
    if ui
        .add_enabled(ready, Button::new("Save view.png"))
        .clicked()
    {
        wish = Some(Wish::SaveView);
    }
    ui.weak("The space as you have turned it.");
    if let Some(recipe) = project.recipe().filter(|_| ready) {
        ui.separator();
        ui.weak("The same by the command line:");
        ui.label(RichText::new(&recipe.command).small());
        if ui.button("Copy the command").clicked() {
            ui.ctx().copy_text(recipe.command.clone());
        }
        ui.weak(&recipe.photographs);
    }
    knobs::book(ui, "Where this leads", "connections.html");
    wish
}
