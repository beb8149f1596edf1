//! Controls that several panels use.

use super::menu;
use crate::panels::screen::Screen;
use crate::project::{Project, Settings, Step};
use crate::session::Event;
use egui::{Response, Slider, Ui};

/// Change of a value by a control.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Change {
    /// Unchanged.
    No,
    /// Being dragged; nothing is recomputed yet.
    Dragged,
    /// New value.
    Done,
}

impl From<bool> for Change {
    fn from(changed: bool) -> Self {
        if changed { Self::Done } else { Self::No }
    }
}

/// Returns the change by a field that is dragged or typed into.
pub(crate) fn change_of(response: &Response) -> Change {
    match response.dragged() {
        true => Change::Dragged,
        false => (response.drag_stopped() || response.changed()).into(),
    }
}

/// Shows controls of settings and sends their changes.
pub(crate) fn edit(screen: &mut Screen<'_>, show: impl FnOnce(&mut Settings) -> Change) {
    let now = || screen.project.document().settings.clone();
    let mut settings = screen.views.draft.take().unwrap_or_else(now);
    match show(&mut settings) {
        Change::No => {}
        Change::Dragged => screen.views.draft = Some(settings),
        Change::Done => screen.send(Event::Set(settings)),
    }
}

/// Shows a slider with its name above it.
pub(crate) fn slider(ui: &mut Ui, name: &str, slider: Slider<'_>) -> Change {
    let label = ui.label(name);
    let response = ui.add(slider).labelled_by(label.id);
    change_of(&response)
}

/// Shows a text in place of an image: centered, with a margin.
pub(crate) fn instead(ui: &mut Ui, words: &str) {
    let whole = ui.available_rect_before_wrap();
    let width = (whole.width() - 32.0).clamp(1.0, 460.0);
    let font = egui::TextStyle::Body.resolve(ui.style());
    let color = ui.visuals().text_color();
    let mut job = egui::text::LayoutJob::simple(words.to_owned(), font, color, width);
    job.halign = egui::Align::Center;
    let text = ui.painter().layout_job(job);
    let rect = egui::Rect::from_center_size(whole.center(), egui::vec2(width, text.size().y));
    // Text taller than the area starts at its top.
    let top = rect.top().max(whole.top());
    let response = ui.interact(rect, ui.scope_id().with("instead"), egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
    ui.painter_at(whole)
        .galley(egui::pos2(rect.center().x, top), text, color);
}

/// Shows a table row: a name and a value.
pub(crate) fn row(ui: &mut Ui, name: &str, value: impl Into<String>) {
    ui.horizontal_wrapped(|ui| {
        ui.weak(format!("{name}:"));
        ui.label(value.into());
    });
}

/// Shows a link to the chapter that explains the step. A window has no book.
pub(crate) fn book(ui: &mut Ui, step: Step) {
    if cfg!(target_arch = "wasm32") {
        let chapter = step.explanation();
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            ui.weak("Chapter:");
            let address = format!("../{}", chapter.page);
            let link = egui::Hyperlink::from_label_and_url(chapter.title, address);
            ui.add(link.open_in_new_tab(true));
        });
    }
}

/// Shows a drop-down list. Returns the clicked entry.
pub(crate) fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    current: T,
    entries: &[(T, &str)],
) -> Option<T> {
    let shown = entries.iter().find(|(entry, _)| *entry == current);
    let text = shown.map_or("none", |(_, text)| text);
    let mut chosen = None;
    ui.horizontal(|ui| {
        let label = ui.label(name);
        // A phone has less room than the default width.
        let combo = egui::ComboBox::from_id_salt(name)
            .selected_text(text)
            .truncate()
            .width(ui.available_width().min(190.0));
        let mut list = |ui: &mut Ui| {
            for &(entry, text) in entries {
                if menu::choice(ui, entry == current, text) {
                    chosen = Some(entry);
                }
            }
        };
        let shown = combo.show_ui(ui, |ui| menu::offer(ui, &mut list));
        menu::go_on(ui, &shown);
        shown.response.labelled_by(label.id);
    });
    chosen
}

/// Shows a drop-down list of the photographs except for one. Returns the clicked one.
pub(crate) fn choose_photograph(
    project: &Project,
    ui: &mut Ui,
    name: &str,
    current: u32,
    but: Option<u32>,
) -> Option<u32> {
    let photos = project.document().photos.iter();
    let others = photos.filter(|photo| Some(photo.id) != but);
    let entries: Vec<_> = others.map(|photo| (photo.id, &*photo.name)).collect();
    choose(ui, name, current, &entries)
}

/// Shows drop-down lists for both photographs of a pair. True if another pair was chosen.
pub(crate) fn choose_pair(screen: &mut Screen<'_>, ui: &mut Ui) -> bool {
    let project = screen.project;
    let (a, b) = project.view().pair;
    let first = choose_photograph(project, ui, "First", a, Some(b));
    let second = choose_photograph(project, ui, "Second", b, Some(a));
    let is_other = first.is_some() || second.is_some();
    if is_other {
        screen.send(Event::LookAtPair(first.unwrap_or(a), second.unwrap_or(b)));
    }
    is_other
}
