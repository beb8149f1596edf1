//! Font and colors, the same as in the figures.

use egui::{Color32, FontData, FontDefinitions, FontFamily, FontId, Stroke, TextStyle, Visuals};
use epipole_canvas::theme::{Role, Theme};
use std::sync::Arc;

/// Sets font, sizes and colors. Called once.
pub(crate) fn set(context: &egui::Context) {
    let mut fonts = FontDefinitions::empty();
    let name = "Epipole Figure Sans".to_owned();
    let bytes: &'static [u8] = epipole_canvas::FONT;
    fonts
        .font_data
        .insert(name.clone(), Arc::new(FontData::from_static(bytes)));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec![name.clone()]);
    }
    context.set_fonts(fonts);
    for (theme, of_egui) in [
        (Theme::Light, egui::Theme::Light),
        (Theme::Dark, egui::Theme::Dark),
    ] {
        context.set_visuals_of(of_egui, visuals(theme));
    }
    context.all_styles_mut(|style| {
        for (text, size) in [
            (TextStyle::Small, 13.0),
            (TextStyle::Body, 15.0),
            (TextStyle::Button, 15.0),
            (TextStyle::Heading, 19.0),
            (TextStyle::Monospace, 14.0),
        ] {
            style
                .text_styles
                .insert(text, FontId::new(size, FontFamily::Proportional));
        }
        style.spacing.item_spacing = egui::vec2(8.0, 7.0);
        style.spacing.button_padding = egui::vec2(9.0, 5.0);
        style.spacing.interact_size.y = 28.0;
        style.spacing.slider_width = 130.0;
    });
}

fn visuals(theme: Theme) -> Visuals {
    let mut visuals = match theme {
        Theme::Light => Visuals::light(),
        _ => Visuals::dark(),
    };
    let role = |role| of(theme, role);
    visuals.panel_fill = role(Role::Background);
    visuals.window_fill = role(Role::Background);
    visuals.extreme_bg_color = role(Role::Surface);
    visuals.faint_bg_color = role(Role::Surface);
    visuals.hyperlink_color = role(Role::Best);
    visuals.warn_fg_color = role(Role::Outlier);
    visuals.error_fg_color = role(Role::Outlier);
    visuals.weak_text_color = Some(role(Role::Muted));
    visuals.selection.bg_fill = role(Role::Series(0));
    visuals.selection.stroke = Stroke::new(1.0, role(Role::Background));
    for widget in [
        &mut visuals.widgets.noninteractive,
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
        &mut visuals.widgets.open,
    ] {
        widget.fg_stroke.color = role(Role::Ink);
    }
    visuals.widgets.noninteractive.bg_stroke.color = role(Role::Edge);
    // An outline marks clickable items; without it, an empty box would not be visible. All have the
    // same width, so that nothing moves under the pointer.
    visuals.widgets.inactive.bg_stroke = Stroke::new(1.0, role(Role::Muted));
    visuals.widgets.hovered.bg_stroke = Stroke::new(1.0, role(Role::Ink));
    visuals.widgets.active.bg_stroke = Stroke::new(1.0, role(Role::Best));
    visuals
}

/// Key of the context's high-contrast flag.
fn is_high() -> egui::Id {
    egui::Id::unique("high contrast")
}

/// Applies a theme by its name; any unknown name is the theme of the system.
pub(crate) fn set_theme(context: &egui::Context, name: &str) {
    let known = Theme::ALL.into_iter().find(|(_, other)| *other == name);
    let theme = known.map(|(theme, _)| theme);
    let is_dark = match theme {
        Some(Theme::HighContrast) => Theme::HighContrast,
        _ => Theme::Dark,
    };
    // The toolkit knows only a light and a dark theme; high contrast replaces the dark one.
    context.set_visuals_of(egui::Theme::Dark, visuals(is_dark));
    context.set_theme(match theme {
        Some(Theme::Light) => egui::ThemePreference::Light,
        Some(_) => egui::ThemePreference::Dark,
        None => egui::ThemePreference::System,
    });
    context.data_mut(|data| data.insert_temp(is_high(), theme == Some(Theme::HighContrast)));
}

/// Returns the current theme.
pub(crate) fn theme(ui: &egui::Ui) -> Theme {
    let is_high = ui
        .ctx()
        .data(|data| data.get_temp(is_high()).unwrap_or(false));
    match (ui.visuals().dark_mode, is_high) {
        (true, true) => Theme::HighContrast,
        (true, false) => Theme::Dark,
        (false, _) => Theme::Light,
    }
}

/// Returns the color of a role in a theme.
pub(crate) fn of(theme: Theme, role: Role) -> Color32 {
    let [r, g, b] = theme.color(role);
    Color32::from_rgb(r, g, b)
}

/// Returns the color of a role in the current theme.
pub(crate) fn color(ui: &egui::Ui, role: Role) -> Color32 {
    of(theme(ui), role)
}
