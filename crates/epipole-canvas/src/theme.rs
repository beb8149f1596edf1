//! Color roles: a view specifies the meaning of a mark, and the theme its color.
//!
//! Hues follow Okabe & Ito 2008 ("Color universal design"), darkened on light pages and lightened
//! on dark ones until the contrast with the surface is at least 3:1 for marks and 4.5:1 for text.
//! Color is never the only channel: views also vary shape, dash or label.

use std::str::FromStr;

/// Meaning of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Page behind the panels.
    Background,
    /// Panel.
    Surface,
    /// Border of a panel.
    Edge,
    /// Grid lines and ticks.
    Grid,
    /// Text and axes.
    Ink,
    /// Secondary text.
    Muted,
    /// Casing around marks on a photograph.
    Halo,
    /// Hypothesis being evaluated.
    Candidate,
    /// Best or current model.
    Best,
    /// Inliers.
    Inlier,
    /// Outliers.
    Outlier,
    /// Ground truth.
    Truth,
    /// Reference for comparison.
    Reference,
    /// Handle that the reader can drag.
    Grip,
    /// One of several items of the same kind, distinguished by hue and shape.
    Series(u8),
}

/// Color: red, green, blue.
pub type Rgb = [u8; 3];

/// Color theme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Theme {
    /// Dark on light.
    #[default]
    Light,
    /// Light on dark.
    Dark,
    /// Black, white and the strongest hues.
    HighContrast,
}

impl Theme {
    /// All themes with their permanent names.
    pub const ALL: [(Self, &'static str); 3] = [
        (Self::Light, "light"),
        (Self::Dark, "dark"),
        (Self::HighContrast, "high-contrast"),
    ];

    /// Returns the color of a role.
    pub fn color(self, role: Role) -> Rgb {
        let [light, dark, contrast] = match role {
            Role::Background => [0xffffff, 0x16181c, 0x000000],
            Role::Surface => [0xf7f6f3, 0x1f2228, 0x000000],
            Role::Edge => [0xc9c6be, 0x454a54, 0xffffff],
            Role::Grid => [0xe4e1da, 0x2f333b, 0x5a5a5a],
            Role::Ink => [0x1d1f23, 0xeceae4, 0xffffff],
            Role::Muted => [0x5d6068, 0xa9acb4, 0xe6e6e6],
            Role::Halo => [0xffffff, 0x0e0f12, 0x000000],
            Role::Candidate => [0x1c86c7, 0x56b4e9, 0x7fd0ff],
            Role::Best => [0x00558c, 0xd9efff, 0xffffff],
            Role::Inlier => [0x00795a, 0x2fc79b, 0x4dffc8],
            Role::Outlier => [0xc24a00, 0xf08a45, 0xff9d4d],
            Role::Truth => [0xa2487b, 0xe39ac2, 0xffb0e0],
            Role::Reference => [0x75777d, 0x9b9ea6, 0xbdbdbd],
            Role::Grip => [0xb35a00, 0xf5b335, 0xffd500],
            Role::Series(index) => match index % 6 {
                0 => [0x0069a8, 0x6cbdf0, 0x7fd0ff],
                1 => [0xc24a00, 0xf08a45, 0xff9d4d],
                2 => [0x00795a, 0x2fc79b, 0x4dffc8],
                3 => [0xa2487b, 0xe39ac2, 0xffb0e0],
                4 => [0x8a6a00, 0xf0e442, 0xffff66],
                _ => [0x4b4e55, 0xc4c7cf, 0xffffff],
            },
        };
        let hex: u32 = match self {
            Self::Light => light,
            Self::Dark => dark,
            Self::HighContrast => contrast,
        };
        [(hex >> 16) as u8, (hex >> 8) as u8, hex as u8]
    }
}

/// Color map from dark blue to yellow, with even steps of brightness, suitable for red-green color
/// blindness.
///
/// Source: the map "viridis" by van der Walt & Smith 2015, at nine positions.
const SCALE: [Rgb; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

impl Theme {
    /// Returns ink or paper, whichever is easier to read on a color.
    ///
    /// ```
    /// use epipole_canvas::theme::{Role, Theme};
    /// assert_eq!(Theme::Light.readable_on([255, 240, 200]), Role::Ink);
    /// assert_eq!(Theme::Light.readable_on([40, 30, 20]), Role::Background);
    /// ```
    pub fn readable_on(self, color: Rgb) -> Role {
        let light = |color: Rgb| {
            let channels = color.map(|channel| libm::pow(f64::from(channel) / 255.0, 2.2));
            0.05 + channels.iter().sum::<f64>() / 3.0
        };
        let contrast = |role| libm::log(light(self.color(role)) / light(color)).abs();
        if contrast(Role::Ink) >= contrast(Role::Background) {
            Role::Ink
        } else {
            Role::Background
        }
    }

    /// Returns the color of a value from 0 to 1: larger is brighter, in every theme.
    pub fn scale(self, fraction: f64) -> Rgb {
        let fraction = if fraction.is_nan() { 0.0 } else { fraction };
        let at = fraction.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
        let first = (at as usize).min(SCALE.len() - 2);
        mix(SCALE[first], SCALE[first + 1], (at - first as f64) as f32)
    }
}

/// Interpolates between two colors; `fraction` is that of `to`, 0 to 1.
pub fn mix(from: Rgb, to: Rgb, fraction: f32) -> Rgb {
    std::array::from_fn(|channel| {
        let (a, b) = (f32::from(from[channel]), f32::from(to[channel]));
        // The cast truncates after adding 0.5; `round` is a call in WebAssembly.
        (a + (b - a) * fraction + 0.5) as u8
    })
}

impl FromStr for Theme {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|(_, known)| *known == name);
        found.map(|(theme, _)| *theme).ok_or_else(|| {
            format!("there is no theme \"{name}\"; the themes are light, dark, high-contrast")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance and contrast ratio of WCAG 2.2.
    fn contrast(a: Rgb, b: Rgb) -> f64 {
        let luminance = |rgb: Rgb| {
            let [r, g, b] = rgb.map(|channel| {
                let c = f64::from(channel) / 255.0;
                if c <= 0.04045 {
                    c / 12.92
                } else {
                    libm::pow((c + 0.055) / 1.055, 2.4)
                }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn the_scale_becomes_brighter_and_survives_any_number() {
        let gray = |rgb: Rgb| contrast(rgb, [0, 0, 0]);
        let steps: Vec<f64> = (0..=20)
            .map(|step| gray(Theme::Light.scale(f64::from(step) / 20.0)))
            .collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
        for invalid in [f64::NAN, f64::NEG_INFINITY, -1.0] {
            assert_eq!(Theme::Dark.scale(invalid), SCALE[0]);
        }
        assert_eq!(Theme::Dark.scale(f64::INFINITY), SCALE[8]);
    }

    #[test]
    fn text_and_marks_stand_out_on_every_surface() {
        for (theme, name) in Theme::ALL {
            for surface in [Role::Background, Role::Surface] {
                let behind = theme.color(surface);
                for text in [Role::Ink, Role::Muted] {
                    let ratio = contrast(theme.color(text), behind);
                    assert!(
                        ratio >= 4.5,
                        "{text:?} on {surface:?} in {name}: {ratio:.2}"
                    );
                }
                let series = (0..6).map(Role::Series);
                let marks = [
                    Role::Candidate,
                    Role::Best,
                    Role::Inlier,
                    Role::Outlier,
                    Role::Truth,
                    Role::Reference,
                    Role::Grip,
                ];
                for mark in marks.into_iter().chain(series) {
                    let ratio = contrast(theme.color(mark), behind);
                    assert!(
                        ratio >= 3.0,
                        "{mark:?} on {surface:?} in {name}: {ratio:.2}"
                    );
                }
            }
        }
    }
}
