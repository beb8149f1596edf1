//! Actions of assistive technology reach the widgets of the page. The file under test belongs to
//! the page, but needs no browser.

#[path = "../../src/web/mirror.rs"]
mod mirror;

use egui::{Context, RawInput};
use mirror::{Mirror, Operation};

/// Lines of text above two buttons: the toolkit counts widgets, so the lines shift the numbers of
/// the buttons.
struct Page {
    context: Context,
    mirror: Mirror,
    lines: usize,
    undone: usize,
    redone: usize,
}

impl Page {
    fn new() -> Page {
        let mut page = Page {
            context: Context::default(),
            mirror: Mirror::default(),
            lines: 1,
            undone: 0,
            redone: 0,
        };
        page.context.add_plugin(page.mirror.clone());
        page.frame();
        page.frame();
        page
    }

    fn frame(&mut self) {
        let (lines, undone, redone) = (self.lines, &mut self.undone, &mut self.redone);
        let mut output = self.context.run_ui(RawInput::default(), |ui| {
            for _ in 0..lines {
                ui.label("a line");
            }
            *undone += usize::from(ui.button("Undo").clicked());
            *redone += usize::from(ui.button("Redo").clicked());
            let more = ui.menu_button("More", |ui| ui.button("Deep"));
            let is_open = more.inner.is_some();
            let tell = |node: &mut egui::accesskit::Node| node.set_expanded(is_open);
            ui.ctx().accesskit_node_builder(more.response.id, tell);
        });
        // Nothing is drawn.
        output.textures_delta.clear();
    }

    /// Presses a button by the page's latest mirror.
    fn press(&self, told: &str, name: &str) {
        let line = told.lines().find(|line| {
            let fields: Vec<&str> = line.split('\t').collect();
            fields[1] == "button" && fields[2] == name
        });
        let widget = line.unwrap().split('\t').next().unwrap().parse().unwrap();
        self.mirror.operate(Operation {
            widget,
            role: "button".to_owned(),
            name: name.to_owned(),
            value: None,
            missed: 0,
        });
    }
}

#[test]
fn a_button_is_pressed_once() {
    let mut page = Page::new();
    let told = page.mirror.changed_widgets().unwrap();
    page.press(&told, "Undo");
    for _ in 0..9 {
        page.frame();
    }
    assert_eq!((page.undone, page.redone), (1, 0));
    assert!(
        page.mirror.changed_widgets().is_none(),
        "nothing has changed"
    );
}

#[test]
fn a_button_that_gets_another_number_meanwhile_is_pressed_once_all_the_same() {
    let mut page = Page::new();
    let told = page.mirror.changed_widgets().unwrap();
    page.press(&told, "Redo");
    // In the frame of the action, its number is another one, and its former number is that of a
    // line.
    page.lines = 7;
    for _ in 0..9 {
        page.frame();
    }
    assert_eq!((page.undone, page.redone), (0, 1));
}

#[test]
fn what_is_gone_is_not_pressed_later() {
    let mut page = Page::new();
    let told = page.mirror.changed_widgets().unwrap();
    page.press(&told, "Undo");
    page.press(&told, "Redo");
    // Numbers that change with each frame are not found for ever.
    for lines in (3..60).step_by(3) {
        page.lines = lines;
        page.frame();
    }
    page.lines = 1;
    for _ in 0..9 {
        page.frame();
    }
    assert_eq!((page.undone, page.redone), (0, 0));
}

#[test]
fn what_stands_in_an_open_menu_names_what_opened_it() {
    let mut page = Page::new();
    let field = |told: &str, name: &str, field: usize| {
        let mut lines = told
            .lines()
            .map(|line| line.split('\t').collect::<Vec<_>>());
        let line = lines.find(|fields| fields[2] == name)?;
        assert_eq!(line.len(), 11, "{line:?}");
        Some(line[field].to_owned())
    };
    let told = page.mirror.changed_widgets().unwrap();
    assert_eq!(field(&told, "More", 8).unwrap(), "closed");
    assert_eq!(field(&told, "Undo", 8).unwrap(), "");
    assert_eq!(field(&told, "Deep", 10), None);
    page.press(&told, "More");
    for _ in 0..9 {
        page.frame();
    }
    let told = page.mirror.changed_widgets().unwrap();
    assert_eq!(field(&told, "More", 8).unwrap(), "open");
    assert_eq!(field(&told, "Deep", 10), field(&told, "More", 0));
    assert_eq!(field(&told, "Undo", 10).unwrap(), "");
}
