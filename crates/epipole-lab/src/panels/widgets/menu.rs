//! Menus that close once something is chosen, however it was chosen: the toolkit by itself closes
//! them for a mouse, but not for a key or for assistive technology, whose next press on the menu
//! would then close it instead of opening it.

use egui::{Button, Checkbox, InnerResponse, Ui, Widget};

/// A button that opens a menu of what [`item`] and [`toggle`] show.
pub(crate) fn menu(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    let shown = ui.menu_button(title, |ui| offer(ui, content));
    go_on(ui, &shown);
}

/// Shows what can be chosen. True if a key has chosen.
pub(crate) fn offer(ui: &mut Ui, content: impl FnOnce(&mut Ui)) -> bool {
    let focused = ui.memory(|memory| memory.focused());
    let focused = focused.and_then(|id| ui.ctx().read_response(id));
    let is_within = focused.is_some_and(|widget| widget.layer_id == ui.layer_id());
    content(ui);
    is_within && ui.will_parent_close()
}

/// Tells whether the menu is open. After a key has chosen, keys go on at the button of the menu,
/// not at the begin of everything.
pub(crate) fn go_on(ui: &Ui, shown: &InnerResponse<Option<bool>>) {
    let is_open = shown.inner.is_some();
    let tell = |node: &mut egui::accesskit::Node| node.set_expanded(is_open);
    ui.ctx().accesskit_node_builder(shown.response.id, tell);
    if shown.inner == Some(true) {
        shown.response.request_focus();
    }
}

/// Something to choose. True in the frame in which it is chosen, which closes the menu.
pub(crate) fn item(ui: &mut Ui, words: &str) -> bool {
    chosen(ui, Button::new(words))
}

/// The same for something that is on or off.
pub(crate) fn toggle(ui: &mut Ui, is_on: &mut bool, words: &str) -> bool {
    chosen(ui, Checkbox::new(is_on, words))
}

/// The same for one of several, of which one is current.
pub(crate) fn choice(ui: &mut Ui, is_current: bool, words: &str) -> bool {
    chosen(ui, Button::selectable(is_current, words))
}

fn chosen(ui: &mut Ui, widget: impl Widget) -> bool {
    let is_chosen = ui.add(widget).clicked();
    if is_chosen {
        ui.close();
    }
    is_chosen
}
