//! Menus that close after a choice by mouse, key or assistive technology. The toolkit closes them
//! for a mouse only; the next activation of the button would then close the menu instead of opening
//! it.

use egui::{Button, Checkbox, InnerResponse, Ui, Widget};

/// Shows a button that opens a menu of [`item`] and [`toggle`].
pub(crate) fn menu(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    let shown = ui.menu_button(title, |ui| offer(ui, content));
    go_on(ui, &shown);
}

/// Shows the entries. True if one was chosen by a key.
pub(crate) fn offer(ui: &mut Ui, content: impl FnOnce(&mut Ui)) -> bool {
    let focused = ui.memory(|memory| memory.focused());
    let focused = focused.and_then(|id| ui.ctx().read_response(id));
    let is_within = focused.is_some_and(|widget| widget.layer_id == ui.layer_id());
    content(ui);
    is_within && ui.will_parent_close()
}

/// Reports to assistive technology whether the menu is open. After a choice by key, returns the
/// focus to the menu's button.
pub(crate) fn go_on(ui: &Ui, shown: &InnerResponse<Option<bool>>) {
    let is_open = shown.inner.is_some();
    let tell = |node: &mut egui::accesskit::Node| node.set_expanded(is_open);
    ui.ctx().accesskit_node_builder(shown.response.id, tell);
    if shown.inner == Some(true) {
        shown.response.request_focus();
    }
}

/// Shows an entry. True in the frame in which it is chosen, which closes the menu.
pub(crate) fn item(ui: &mut Ui, words: &str) -> bool {
    chosen(ui, Button::new(words))
}

/// Shows an entry with a check box.
pub(crate) fn toggle(ui: &mut Ui, is_on: &mut bool, words: &str) -> bool {
    chosen(ui, Checkbox::new(is_on, words))
}

/// Shows an entry of a group, one of which is current.
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
