//! Options of the 3D view: layers, point size, cameras to look through.

use super::screen::Screen;
use super::widgets::{controls, has_dense};
use crate::project::{PhotoId, Project};
use crate::session::Event;
use egui::{Slider, Ui};

/// Draws the options.
pub(super) fn controls(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let cloud = &mut screen.views.cloud;
    ui.checkbox(&mut cloud.photographs, "Show photographs");
    ui.checkbox(&mut cloud.cameras, "Show cameras");
    if has_dense(project) {
        ui.checkbox(&mut cloud.sparse, "Show sparse points");
        ui.checkbox(&mut cloud.dense, "Show dense points or surface");
    }
    if project.floor().is_some() {
        ui.checkbox(&mut cloud.grid, "Show grid on the floor");
    }
    let size = Slider::new(&mut cloud.point_size, 0.5..=3.0);
    controls::slider(ui, "Point size", size.max_decimals(1));
    if project.component().is_some() {
        through(screen, ui);
    }
    if ui.button("Reset view").clicked() {
        screen.views.cloud.look_at_all();
    }
}

/// Chooses a camera to look through, and leaves its photograph out.
fn through(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let cloud = &mut screen.views.cloud;
    let now = cloud.through.as_ref().map(|through| through.photo);
    let cameras = cameras(project);
    let none = [(None, "no camera")].into_iter();
    let entries: Vec<_> = none
        .chain(cameras.into_iter().map(|(id, name)| (Some(id), name)))
        .collect();
    match controls::choose(ui, "Look through", now, &entries) {
        Some(Some(photo)) => cloud.look_through(project, photo),
        Some(None) => cloud.look_back(),
        None => {}
    }
    let Some(photo) = now else { return };
    ui.horizontal_wrapped(|ui| {
        if ui.button("Return to the view before").clicked() {
            cloud.look_back();
        }
        if ui.button("Leave this photograph out").clicked() {
            screen
                .actions
                .push(super::Action::Send(Event::Exclude(photo, true)));
        }
    });
}

/// Returns the photographs with a camera.
fn cameras(project: &Project) -> Vec<(PhotoId, &str)> {
    let photos = project.taking_part().into_iter();
    let cameras = project
        .component()
        .map_or(&[][..], |component| &component.cameras);
    let registered = photos.zip(cameras).filter(|(_, camera)| camera.is_some());
    registered
        .map(|(photo, _)| (photo.id, &*photo.name))
        .collect()
}
