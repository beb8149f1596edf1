//! The tools of the 3D view: box, selection, deletion, layers, and cameras to look through.

use super::measuring::space;
use crate::common::desk::{Bench, open, rest};
use egui::accesskit::Role;
use egui::{Pos2, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};
use epipole_lab::project::Project;

fn num_kept(project: &Project) -> usize {
    let kept = project.remaining();
    let points = project.component().unwrap().points.iter();
    points.filter(|point| kept.has_point(point)).count()
}

/// Returns the first thing of this name that is no mere word.
fn widget<'b>(bench: &'b Bench<'_>, name: &'b str) -> Node<'b> {
    let mut named = bench.get_all_by_label(name);
    let is_word = |node: &Node<'_>| node.accesskit_node().role() == Role::Label;
    named.find(|node| !is_word(node)).unwrap()
}

/// Presses it, also where it is out of sight.
fn press(bench: &mut Bench<'_>, name: &str) {
    widget(bench, name).click_accesskit();
    bench.run_steps(4);
}

/// Drags along a line.
fn drag(bench: &mut Bench<'_>, line: &[Pos2]) {
    bench.drag_at(line[0]);
    bench.step();
    for at in &line[1..] {
        bench.hover_at(*at);
        bench.step();
    }
    bench.drop_at(line[line.len() - 1]);
    bench.run_steps(3);
}

/// Whether the first thing of this name is there.
fn has(bench: &Bench<'_>, name: &str) -> bool {
    bench.query_by_label_contains(name).is_some()
}

#[test]
fn a_box_is_fitted_changed_by_keys_and_removed() {
    let mut bench = open(1280.0, 720.0);
    let num_jobs = bench.state_mut().host().num_started;
    press(&mut bench, "box");
    press(&mut bench, "Fit to the model");
    let fitted = *bench.state().project().crop().unwrap();
    let before = num_kept(bench.state().project());
    // The field takes arrow keys.
    widget(&bench, "x to").focus();
    bench.run_steps(2);
    for _ in 0..60 {
        bench.key_press(egui::Key::ArrowDown);
        bench.run_steps(1);
    }
    bench.run_steps(3);
    let crop = *bench.state().project().crop().unwrap();
    assert!(crop.high[0] < fitted.high[0] && crop.high[0] > crop.low[0]);
    assert_eq!((crop.low, crop.high[1]), (fitted.low, fitted.high[1]));
    let after = num_kept(bench.state().project());
    assert!(after < before, "{after} of {before}");
    assert!(has(&bench, "Points outside the box are left out."));
    press(&mut bench, "Remove the box");
    assert_eq!(bench.state().project().crop(), None);
    press(&mut bench, "Undo");
    assert_eq!(bench.state().project().crop(), Some(&crop));
    assert_eq!(
        bench.state_mut().host().num_started,
        num_jobs,
        "nothing is computed"
    );
}

#[test]
fn a_line_around_points_selects_them() {
    let mut bench = open(900.0, 700.0);
    let rect = space(&bench).shrink(8.0);
    let (left, right) = (rect.left_top(), rect.right_top());
    let (below_left, below_right) = (rect.left_bottom(), rect.right_bottom());
    let whole = [left, right, below_right, below_left, left + vec2(0.0, 4.0)];
    // Without the tool, a drag turns the view.
    drag(&mut bench, &whole);
    press(&mut bench, "Reset view");
    press(&mut bench, "select");
    bench.get_by_label("0 points selected");
    let middle = [rect.center_top(), rect.center_bottom()];
    drag(
        &mut bench,
        &[
            left,
            middle[0],
            middle[1],
            below_left,
            left + vec2(0.0, 4.0),
        ],
    );
    let num_all = bench.state().project().component().unwrap().points.len();
    let selected = |bench: &Bench<'_>| -> usize {
        let mut all = (0..=num_all).filter(|n| {
            let word = if *n == 1 { "point" } else { "points" };
            bench
                .query_by_label(&format!("{n} {word} selected"))
                .is_some()
        });
        all.next().unwrap()
    };
    let of_left = selected(&bench);
    assert!(
        (num_all / 20..num_all * 19 / 20).contains(&of_left),
        "{of_left} of {num_all}"
    );
    // The other half adds the rest, but for what is beyond the edges.
    press(&mut bench, "Invert");
    assert_eq!(selected(&bench), num_all - of_left);
    drag(&mut bench, &whole);
    let of_whole = selected(&bench);
    assert!(of_whole > num_all * 9 / 10, "{of_whole} of {num_all}");
    press(&mut bench, "Clear");
    press(&mut bench, "Select points seen by fewer than");
    let few = selected(&bench);
    let points = bench.state().project().component().unwrap().points.clone();
    assert_eq!(
        few,
        points.iter().filter(|point| point.track.len() < 3).count()
    );
    bench.key_press(egui::Key::Delete);
    bench.run_steps(3);
    assert_eq!(num_kept(bench.state().project()), num_all - few);
    bench.get_by_label("0 points selected");
    assert!(has(&bench, "Deleted points are left out."));
    press(&mut bench, "Undo");
    assert_eq!(num_kept(bench.state().project()), num_all);
    // In a step without the tools, a drag turns the view again.
    press(&mut bench, "Export");
    drag(&mut bench, &whole);
    press(&mut bench, "Reconstruction");
    bench.get_by_label("0 points selected");
}

#[test]
fn the_view_looks_through_a_camera_and_returns() {
    let mut bench = open(900.0, 700.0);
    let save = |bench: &mut Bench<'_>| {
        press(bench, "Export");
        press(bench, "Save view.png");
        rest(bench);
        press(bench, "Reconstruction");
        bench.state_mut().host().saved.pop().unwrap().1
    };
    let before = save(&mut bench);
    let bar = bench.get_by_label_contains("Scale bar at the center: ");
    assert!(bar.rect().width() > 30.0);
    press(&mut bench, "Look through");
    press(&mut bench, "table-4.png");
    let through = save(&mut bench);
    assert_ne!(before, through);
    press(&mut bench, "Return to the view before");
    assert_eq!(save(&mut bench), before);
    for layer in ["Show cameras", "Show photographs"] {
        press(&mut bench, layer);
        let without = save(&mut bench);
        assert_ne!(without, before, "{layer}");
        press(&mut bench, layer);
        assert_eq!(save(&mut bench), before, "{layer}");
    }
}

#[test]
fn a_photograph_is_left_out_and_the_change_is_shown() {
    let mut bench = open(900.0, 700.0);
    press(&mut bench, "Look through");
    press(&mut bench, "table-9.png");
    press(&mut bench, "Leave this photograph out");
    rest(&mut bench);
    assert!(bench.state().project().document().photos[8].excluded);
    assert!(has(
        &bench,
        "Change since the last result: 9 to 8 registered"
    ));
}
