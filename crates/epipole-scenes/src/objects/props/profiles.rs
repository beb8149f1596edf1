//! Profiles of lathed objects.

use crate::shape::Profile;

pub(super) const MUG_RADIUS_M: f64 = 0.048;
/// Height of a mug of scale 1.
pub(crate) const MUG_HEIGHT_M: f64 = 0.118;
pub(super) const MUG_COFFEE_M: f64 = 0.088;
pub(super) const JUG_HEIGHT_M: f64 = 0.34;

pub(super) fn mug_profile() -> Profile {
    let (r, h, wall) = (MUG_RADIUS_M, MUG_HEIGHT_M, 0.0048);
    Profile::new()
        .to(0.80 * r, 0.0)
        .sharp()
        .to(0.86 * r, 0.003)
        .to(0.93 * r, 0.008)
        .to(0.975 * r, 0.016)
        .to(r, 0.030)
        .to(r, h - 0.004)
        .to(r - 0.0006, h - 0.0012)
        .to(r - 0.0018, h)
        .to(r - 0.0034, h - 0.0004)
        .to(r - wall, h - 0.003)
        .to(r - wall, MUG_COFFEE_M)
        .sharp()
        .to(0.0, MUG_COFFEE_M)
        .sharp()
}

pub(super) fn jug_profile() -> Profile {
    let outer = [
        (0.058, 0.004),
        (0.064, 0.012),
        (0.077, 0.035),
        (0.088, 0.065),
        (0.0945, 0.100),
        (0.0955, 0.130),
        (0.0915, 0.160),
        (0.082, 0.190),
        (0.068, 0.217),
        (0.054, 0.240),
        (0.045, 0.261),
        (0.0415, 0.282),
        (0.0425, 0.303),
        (0.048, 0.322),
        (0.056, 0.336),
        (0.0575, 0.340),
    ];
    let mut profile = Profile::new().to(0.055, 0.0).sharp();
    for (radius, height) in outer {
        profile = profile.to(radius, height);
    }
    for (radius, height) in [
        (0.0545, 0.3395),
        (0.0445, 0.321),
        (0.0375, 0.300),
        (0.0370, 0.282),
        (0.041, 0.262),
    ] {
        profile = profile.to(radius, height);
    }
    profile.sharp().to(0.0, 0.262).sharp()
}

/// Returns the profile of a ball stretched to `half_m` along its axis, with tips.
pub(super) fn ball_profile(radius_m: f64, half_m: f64, tip_m: f64) -> Profile {
    let num = 24;
    let point = |i: i32| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(num));
        let tip = cos * cos * cos * cos * cos * cos * cos;
        (radius_m * sin, -half_m * cos - tip_m * tip)
    };
    let mut profile = Profile::from_height(point(0).1);
    for i in 1..num {
        let (radius, height) = point(i);
        profile = profile.to(radius, height);
    }
    profile.to(0.0, point(num).1)
}
