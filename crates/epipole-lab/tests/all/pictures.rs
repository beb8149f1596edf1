//! Screenshots of every step, on a desktop and on a phone, light and dark: no control is cut off or
//! covered by another one, text has enough contrast, and images are drawn.
//! `EPIPOLE_PICTURES=FOLDER` writes them.

#![cfg(all(feature = "panels", feature = "compute"))]

use crate::common::desk::{Bench, rest};
use crate::common::raster::{Raster, open};
use egui::Rect;
use egui_kittest::kittest::{NodeT, Queryable};
use epipole_lab::app::set_theme;
use epipole_lab::project::Step;
use image::RgbImage;
use std::collections::BTreeSet;

/// All controls, with names and rectangles.
fn controls(bench: &Bench<'_>) -> Vec<(String, Rect)> {
    use egui::accesskit::Role;
    let is_control = |role| {
        matches!(
            role,
            Role::Button
                | Role::CheckBox
                | Role::RadioButton
                | Role::Slider
                | Role::SpinButton
                | Role::ComboBox
                | Role::Link
        )
    };
    let nodes = bench.query_all_by(move |node| is_control(node.role()));
    nodes
        .map(|node| {
            let name = node.accesskit_node().label().unwrap_or_default();
            (name, node.rect())
        })
        .collect()
}

/// Controls overlap by at most a hair, and none extends beyond the left or right of the screen; the
/// rest can be reached by scrolling.
fn check_places(bench: &Bench<'_>, what: &str, width: f32) {
    let mut all = controls(bench);
    // Small photographs are under the panel of knobs where they scroll away.
    let is_card = |name: &str| name.starts_with("table-") || name.starts_with("board-");
    all.retain(|(name, _)| !is_card(name));
    assert!(all.len() > 8, "{what}: {all:?}");
    let mut in_row = false;
    for (name, place) in &all {
        // On a phone the steps are one row that scrolls.
        let is_step = Step::ALL.iter().any(|step| step.title() == name);
        in_row |= is_step;
        if !is_step {
            let inside = place.left() >= -0.5 && place.right() <= width + 0.5;
            assert!(inside, "{what}: {name} reaches from {place}");
        }
    }
    assert!(in_row);
    for (n, (name, place)) in all.iter().enumerate() {
        for (other, theirs) in &all[n + 1..] {
            let common = place.shrink(1.0).intersect(theirs.shrink(1.0));
            // A slider holds the field that shows its number.
            let is_one = name == other || name.is_empty() || other.is_empty();
            assert!(
                is_one || !common.is_positive(),
                "{what}: {name} {place} covers {other} {theirs}"
            );
        }
    }
}

/// Number of colors in the left half of the image area.
fn num_colors(picture: &RgbImage) -> usize {
    let colors: BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    colors.len()
}

fn go_through(width: f32, height: f32, scale: f32, screen: &str) {
    let (mut bench, raster) = open(width, height, scale);
    let link = vec![("all-views-megapixels".to_owned(), "0.05".to_owned())];
    let host_event = epipole_lab::session::HostEvent::Link(link);
    bench.state_mut().host().host_events.push(host_event);
    rest(&mut bench);
    for theme in ["light", "dark"] {
        set_theme(&bench.ctx, theme);
        for step in Step::ALL {
            let name = format!("{screen}-{theme}-{}", step.name());
            // One that is out of sight is pressed, too.
            let button = bench.get_all_by_label(step.title()).next().unwrap();
            button.click_accesskit();
            bench.run_steps(3);
            if step == Step::Calibrate && bench.query_by_label("Open the sample").is_some() {
                bench.get_by_label("Open the sample").click();
                bench.run_steps(3);
            }
            rest(&mut bench);
            check(&bench, &raster, &name, width);
            if step == Step::Reconstruction {
                tools(&mut bench, &raster, &name, width);
            }
            if step == Step::Depth {
                all_views(&mut bench);
                check(&bench, &raster, &format!("{name}-all-views"), width);
                bench.get_by_label("surface").click_accesskit();
                rest(&mut bench);
                check(&bench, &raster, &format!("{name}-surface"), width);
                bench.get_by_label("points").click_accesskit();
                bench.get_by_label("One pair").click_accesskit();
            }
        }
    }
}

/// The box, a selection, and the view through a camera.
fn tools(bench: &mut Bench<'_>, raster: &Raster, name: &str, width: f32) {
    let press = |bench: &mut Bench<'_>, label: &str| {
        let is_word = |node: &egui_kittest::Node<'_>| {
            node.accesskit_node().role() == egui::accesskit::Role::Label
        };
        {
            let mut named = bench.get_all_by_label(label);
            let button = named.find(|node| !is_word(node)).unwrap();
            button.scroll_to_me();
            button.click_accesskit();
        }
        rest(bench);
    };
    press(bench, "box");
    press(bench, "Fit to the model");
    check(bench, raster, &format!("{name}-box"), width);
    press(bench, "select");
    press(bench, "Select points seen by fewer than");
    check(bench, raster, &format!("{name}-selection"), width);
    press(bench, "Clear");
    press(bench, "look");
    press(bench, "Undo");
    press(bench, "Look through");
    press(bench, "table-4.png");
    // Controls that are scrolled under the steps would cover them.
    bench.get_by_label("Measure a length").scroll_to_me();
    rest(bench);
    check(bench, raster, &format!("{name}-through"), width);
    press(bench, "Return to the view before");
    bench.get_by_label("Measure a length").scroll_to_me();
    rest(bench);
}

fn check(bench: &Bench<'_>, raster: &Raster, name: &str, width: f32) {
    let picture = raster.picture(bench);
    save(&picture, name);
    check_places(bench, name, width);
    let num_colors = num_colors(&picture);
    assert!(num_colors > 500, "{name}: {num_colors}");
}

/// Asks for the depth of all views, or shows it once more.
fn all_views(bench: &mut Bench<'_>) {
    bench.get_by_label("All views").click_accesskit();
    bench.run_steps(3);
    if let Some(button) = bench.query_by_label("Depth of all views") {
        button.click_accesskit();
        bench.run_steps(3);
    }
    rest(bench);
}

fn save(picture: &RgbImage, name: &str) {
    if let Some(folder) = std::env::var_os("EPIPOLE_PICTURES") {
        let folder = std::path::PathBuf::from(folder);
        std::fs::create_dir_all(&folder).unwrap();
        picture.save(folder.join(format!("{name}.png"))).unwrap();
    }
}

#[test]
fn on_a_desktop() {
    go_through(1280.0, 720.0, 1.0, "desktop");
}

#[test]
fn on_a_phone() {
    go_through(390.0, 760.0, 2.0, "phone");
}

#[test]
fn triangles_are_filled_once_and_to_the_last_pixel() {
    // Two triangles make a square, half transparent: no seam between them, nothing beyond it.
    let square = Rect::from_min_max(egui::pos2(5.0, 4.0), egui::pos2(35.0, 26.0));
    let mut mesh = egui::Mesh::default();
    mesh.add_colored_rect(square, egui::Color32::from_black_alpha(128));
    let picture = crate::common::raster::of(&mesh, 40, 30);
    for (u, v, pixel) in picture.enumerate_pixels() {
        let inside = (5..35).contains(&u) && (4..26).contains(&v);
        let expected = if inside { 127 } else { 255 };
        assert_eq!(pixel.0, [expected; 3], "({u}, {v})");
    }
}
