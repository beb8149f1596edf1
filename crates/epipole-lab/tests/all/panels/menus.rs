//! Menus and lists, by every way to choose.

use crate::common::desk::{Bench, open};
use egui::accesskit::Role;
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};

/// Ways to choose.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Mouse,
    Key,
    AssistiveTechnology,
}

impl Way {
    /// Presses the first thing of this name that is no mere word, and draws frames until that has
    /// done all it does.
    fn press(self, bench: &mut Bench<'_>, name: &str) {
        let is_word = |node: &Node<'_>| node.accesskit_node().role() == Role::Label;
        let named: Vec<Node<'_>> = bench.get_all_by_label(name).collect();
        let widget = named.into_iter().find(|node| !is_word(node)).unwrap();
        match self {
            Way::Mouse => widget.click(),
            Way::AssistiveTechnology => widget.click_accesskit(),
            Way::Key => {
                widget.focus();
                bench.run_steps(2);
                bench.key_press(egui::Key::Enter);
            }
        }
        bench.run_steps(4);
    }
}

#[test]
fn a_menu_closes_with_what_is_chosen_and_opens_again() {
    for way in [Way::Mouse, Way::Key, Way::AssistiveTechnology] {
        let mut bench = open(1280.0, 720.0);
        let num_photos = |bench: &Bench<'_>| bench.state().project().document().photos.len();
        for round in 0..3 {
            assert_eq!(num_photos(&bench), 9, "{way:?}, round {round}");
            way.press(&mut bench, "Project");
            way.press(&mut bench, "Remove all photographs");
            assert_eq!(num_photos(&bench), 0, "{way:?}, round {round}");
            let item = bench.query_by_label("Remove all photographs");
            assert!(item.is_none(), "{way:?}: the menu of round {round} is open");
            if way == Way::Key {
                assert!(bench.get_by_label("Project").is_focused());
            }
            way.press(&mut bench, "Undo");
        }
        way.press(&mut bench, "Samples");
        way.press(&mut bench, "A camera that only turned");
        let item = bench.query_by_label("A camera that only turned");
        assert!(item.is_none(), "{way:?}: the menu is open");
        way.press(&mut bench, "Undo");

        // The photographs of a pair are chosen from a list.
        way.press(&mut bench, "Two views");
        for name in ["table-5.png", "table-7.png"] {
            way.press(&mut bench, "First");
            way.press(&mut bench, name);
            assert!(
                bench.query_by_label(name).is_none(),
                "{way:?}: the list is open"
            );
            let (a, b) = bench.state().project().view().pair;
            let document = bench.state().project().document();
            let names = [a, b].map(|id| document.photo(id).unwrap().name.as_str());
            assert!(names.contains(&name), "{way:?}: {names:?}");
            if way == Way::Key {
                assert!(
                    bench
                        .get_by_role_and_label(Role::ComboBox, "First")
                        .is_focused()
                );
            }
        }
    }
}

#[test]
fn what_opens_a_list_tells_whether_it_is_open() {
    let mut bench = open(1280.0, 720.0);
    let is_open = |bench: &Bench<'_>, role: Role, name: &str| {
        let node = bench.get_by_role_and_label(role, name);
        node.accesskit_node().data().is_expanded()
    };
    let way = Way::AssistiveTechnology;
    way.press(&mut bench, "Two views");
    for (role, name) in [(Role::Button, "Project"), (Role::ComboBox, "First")] {
        assert_eq!(is_open(&bench, role, name), Some(false), "{name}");
        way.press(&mut bench, name);
        assert_eq!(is_open(&bench, role, name), Some(true), "{name}");
        way.press(&mut bench, name);
        assert_eq!(is_open(&bench, role, name), Some(false), "{name}");
    }
    // A plain button has no expanded state.
    let undo = bench.get_by_role_and_label(Role::Button, "Undo");
    assert_eq!(undo.accesskit_node().data().is_expanded(), None);
}
