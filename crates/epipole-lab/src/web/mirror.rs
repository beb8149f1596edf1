//! Mirror of the toolkit's widgets, which the page exposes to assistive technology, as a canvas has
//! no accessible content.
//!
//! One line per widget, separated by tabs: number, role, name, value, state, minimum, maximum,
//! step, "open" or "closed" for a button that opens a list, description, and for an item of a list
//! the number of its button.

use egui::accesskit::{
    Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId, TreeUpdate,
};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Messages between page and toolkit.
#[derive(Default)]
pub(super) struct State {
    widgets: String,
    is_new: bool,
    operations: Vec<Operation>,
    /// Actions sent in this pass, and their targets.
    sent: Vec<(NodeId, Operation)>,
}

/// Number of passes in which an operation is tried, since numbers change between passes while a
/// panel fills.
const PATIENCE: u8 = 5;

/// Operation of a widget, identified as the page last saw it.
#[derive(Clone)]
pub(super) struct Operation {
    pub(super) widget: u64,
    pub(super) role: String,
    pub(super) name: String,
    /// New value; without one, the widget is clicked.
    pub(super) value: Option<f64>,
    /// Number of passes that missed it.
    pub(super) missed: u8,
}

impl Operation {
    /// Finds the widget's current number. The toolkit numbers widgets in order, so the page's
    /// number may now belong to another one, such as the widget in the former place of "Undo".
    fn find(&self, widgets: &str) -> Option<NodeId> {
        let alike = || {
            widgets.lines().filter_map(|line| {
                let mut fields = line.split('\t');
                let number: u64 = fields.next()?.parse().ok()?;
                let is_alike = fields.next()? == self.role;
                is_alike.then_some((number, fields.next()?))
            })
        };
        let is_same = |&(number, _): &(u64, &str)| number == self.widget;
        let is_named = |&(_, name): &(u64, &str)| name == self.name;
        // The name of a widget that includes its state may have changed.
        let found = (alike().find(|widget| is_same(widget) && is_named(widget)))
            .or_else(|| alike().find(is_named))
            .or_else(|| alike().find(is_same));
        found.map(|(number, _)| NodeId(number))
    }
}

/// Shared end of the connection between page and toolkit.
#[derive(Clone, Default)]
pub(super) struct Mirror(Arc<Mutex<State>>);

impl Mirror {
    fn with_state<R>(&self, with: impl FnOnce(&mut State) -> R) -> R {
        with(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns all widgets, if they have changed since the last call.
    pub(super) fn changed_widgets(&self) -> Option<String> {
        self.with_state(|state| std::mem::take(&mut state.is_new).then(|| state.widgets.clone()))
    }

    /// Operates a widget in the next frame.
    pub(super) fn operate(&self, operation: Operation) {
        self.with_state(|state| state.operations.push(operation));
    }
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn setup(&mut self, context: &egui::Context) {
        context.enable_accesskit();
    }

    fn input_hook(&mut self, _context: &egui::Context, input: &mut egui::RawInput) {
        let sent = self.with_state(|state| {
            let operations = std::mem::take(&mut state.operations);
            let found = |operation: Operation| Some((operation.find(&state.widgets)?, operation));
            state.sent = operations.into_iter().filter_map(found).collect();
            state.sent.clone()
        });
        for (target_node, Operation { value, .. }) in sent {
            let request = ActionRequest {
                action: value.map_or(Action::Click, |_| Action::SetValue),
                target_tree: TreeId::ROOT,
                target_node,
                data: value.map(ActionData::NumericValue),
            };
            input
                .events
                .push(egui::Event::AccessKitActionRequest(request));
        }
    }

    fn output_hook(&mut self, context: &egui::Context, output: &mut egui::FullOutput) {
        if let Some(update) = output.platform_output.accesskit_update.take() {
            let widgets = lines(&update);
            let again = self.with_state(|state| {
                // A widget whose number changed in this pass did not get the action.
                let has_heard = |id: NodeId, role: &str| {
                    let known = format!("{}\t{role}\t", id.0);
                    widgets.lines().any(|line| line.starts_with(&known))
                };
                let sent = std::mem::take(&mut state.sent).into_iter();
                let missed = sent.filter(|(id, operation)| {
                    !has_heard(*id, &operation.role) && operation.missed < PATIENCE
                });
                let missed = missed.map(|(_, mut operation)| {
                    operation.missed += 1;
                    operation
                });
                state.operations.extend(missed);
                if state.widgets != widgets {
                    state.widgets = widgets;
                    state.is_new = true;
                }
                !state.operations.is_empty()
            });
            if again {
                context.request_repaint();
            }
        }
    }
}

fn lines(update: &TreeUpdate) -> String {
    let nodes: BTreeMap<NodeId, &Node> =
        update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let mut text = String::new();
    let Some(root) = update.tree.as_ref().map(|tree| tree.root) else {
        return text;
    };
    // Each node with the button that opened its list, if any.
    let mut open = vec![(root, None)];
    while let Some((id, opener)) = open.pop() {
        let Some(node) = nodes.get(&id) else { continue };
        if let Some(line) = line(id, node, &nodes) {
            let opener = opener.map_or(String::new(), |NodeId(number)| number.to_string());
            text.push_str(&format!("{line}\t{opener}\n"));
        }
        // Children of labels are text runs. Those of a button may be its open menu.
        if !matches!(node.role(), Role::Label | Role::TextInput) {
            let opener = node.is_expanded().map(|_| id).or(opener);
            open.extend(node.children().iter().rev().map(|child| (*child, opener)));
        }
    }
    text
}

fn line(id: NodeId, node: &Node, nodes: &BTreeMap<NodeId, &Node>) -> Option<String> {
    let role = match node.role() {
        Role::Button => "button",
        Role::CheckBox => "checkbox",
        Role::RadioButton => "radio",
        Role::Slider => "slider",
        Role::SpinButton => "number",
        Role::ComboBox => "combobox",
        Role::Link => "link",
        Role::Label => "text",
        Role::Image => "img",
        _ => return None,
    };
    let of_label = || {
        let label = nodes.get(node.labelled_by().first()?)?;
        label.value().or(label.label())
    };
    let value = node.value().unwrap_or_default();
    let (name, value) = match role {
        "text" => (node.label().unwrap_or(value), ""),
        _ => (node.label().or_else(of_label).unwrap_or_default(), value),
    };
    let state = match node.toggled() {
        _ if node.is_disabled() => "disabled",
        Some(Toggled::True) => "on",
        Some(_) => "off",
        None => "",
    };
    let number = |number: Option<f64>| number.map_or(String::new(), |n| n.to_string());
    let value = match node.numeric_value() {
        Some(value) => value.to_string(),
        None => plain(value),
    };
    let fields = [
        id.0.to_string(),
        role.to_owned(),
        plain(name),
        value,
        state.to_owned(),
        number(node.min_numeric_value()),
        number(node.max_numeric_value()),
        number(node.numeric_value_step()),
        match node.is_expanded() {
            Some(true) => "open".to_owned(),
            Some(false) => "closed".to_owned(),
            None => String::new(),
        },
        plain(node.description().unwrap_or_default()),
    ];
    Some(fields.join("\t"))
}

/// Joins a text into one line.
fn plain(words: &str) -> String {
    let space = |c: char| if c.is_control() { ' ' } else { c };
    words.chars().map(space).collect()
}
