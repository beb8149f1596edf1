//! A pair of cameras between its initial poses and the rectified ones: first made parallel, then
//! aligned with the baseline.

use crate::kit::scenes::{PHOTO_SIZE, PHOTO_WIDTH, still_life_pair};
use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, relative_motion};
use epipole::homography::transfer;
use epipole::stereo::{PixelRect, Rectification, RectifyOptions, rectify_calibrated};
use nalgebra::{Isometry3, Matrix3, Point2, UnitQuaternion, Vector2, Vector3};

/// Distance of camera 2 to the right of camera 1, meters.
pub(super) const RIGHT_M: f64 = 0.4;

/// Progress of the rotation, and the crop of the photographs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    /// Fraction of each camera's rotation toward the other's heading, 0 to 1.
    pub(super) parallel: f64,
    /// Fraction of the common rotation toward the baseline, 0 to 1.
    pub(super) along: f64,
    /// Whether the rectified pair shows both photographs entirely, or only the pixels common to
    /// both.
    pub(super) shows_all: bool,
}

/// The pair as photographed, and as rotated.
pub(super) struct Turned {
    pub(super) taken: [PosedCamera; 2],
    /// Rotated cameras.
    pub(super) shown: [PosedCamera; 2],
    /// Homographies from pixels of the photographs to displayed pixels.
    pub(super) shown_from_taken: [Matrix3<f64>; 2],
    /// Valid rectangle of each rectified image.
    pub(super) valid: [PixelRect; 2],
}

impl Turned {
    /// * `forward_m`, `left_deg`: distance of camera 2 ahead of camera 1, and its rotation to the
    ///   left
    ///
    /// # Errors
    /// As [`rectify_calibrated`].
    pub(super) fn new(forward_m: f64, left_deg: f64, way: Way) -> Result<Self, Error> {
        let taken = still_life_pair(PHOTO_SIZE, RIGHT_M, forward_m, left_deg);
        let motion = relative_motion(&taken[0].cam_from_world, &taken[1].cam_from_world);
        let (width, height) = PHOTO_SIZE;
        let cameras = taken.map(|camera| Camera::pinhole(camera.camera.intrinsics, width, height));
        let options = RectifyOptions::default();
        let rectified = rectify_calibrated(&cameras, &motion, &options)?;
        let frames = match way.shows_all {
            true => frames_of_all(&rectified),
            false => [Frame::SAME; 2],
        };
        // Each camera rotates by half of the relative rotation; the remaining rotation is the same
        // for both.
        let half = motion.rotation.powf(0.5);
        let whole = UnitQuaternion::from_rotation_matrix(&rectified.rect_from_cam[0]);
        let together = (whole * half.inverse()).powf(way.along);
        let turns = [
            together * half.powf(way.parallel),
            together * half.inverse().powf(way.parallel),
        ];
        let share = (way.parallel + way.along) / 2.0;
        let mut shown = taken;
        for index in 0..2 {
            let turn = Isometry3::from_parts(Default::default(), turns[index]);
            let end = frames[index].intrinsics(&rectified.intrinsics[index])?;
            shown[index] = PosedCamera {
                camera: Camera {
                    intrinsics: between([taken[index].camera.intrinsics, end], share)?,
                    ..taken[index].camera
                },
                cam_from_world: turn * taken[index].cam_from_world,
            };
        }
        let homography = |index: usize| {
            let turn = turns[index].to_rotation_matrix();
            let inverse = taken[index].camera.intrinsics.inverse_matrix();
            shown[index].camera.intrinsics.matrix() * turn.matrix() * inverse
        };
        Ok(Self {
            taken,
            shown,
            shown_from_taken: [homography(0), homography(1)],
            valid: [0, 1].map(|index| frames[index].rect(&valid_part(&rectified, index))),
        })
    }

    /// Returns the angle between the two headings, degrees.
    pub(super) fn apart_deg(&self) -> f64 {
        let [one, two] = self.shown.map(|camera| camera.cam_from_world.rotation);
        (one * two.inverse()).angle().to_degrees()
    }

    /// Returns the maximum angle between the baseline and the rows of an image, degrees.
    pub(super) fn off_baseline_deg(&self) -> f64 {
        let [one, two] = self.shown.map(|camera| camera.center_in_world());
        let angles = self.shown.map(|camera| {
            let baseline = camera.cam_from_world.rotation * (two - one);
            libm::atan2(libm::hypot(baseline.y, baseline.z), baseline.x.abs()).to_degrees()
        });
        angles[0].max(angles[1])
    }

    /// Returns the fraction of a rectified image that its photograph fills, the smaller of the two,
    /// 0 to 1.
    pub(super) fn valid_ratio(&self) -> f64 {
        let (right, bottom) = (f64::from(PHOTO_SIZE.0 - 1), f64::from(PHOTO_SIZE.1 - 1));
        let all = right * bottom;
        let area = |rect: &PixelRect| (rect.u_max - rect.u_min) * (rect.v_max - rect.v_min);
        area(&self.valid[0]).min(area(&self.valid[1])) / all
    }

    /// Returns center (x, z) and heading in radians in a top view, in the initial frame of camera
    /// 1.
    pub(super) fn seen_from_above(&self, index: usize) -> (Point2<f64>, f64) {
        let frame = self.taken[0].cam_from_world;
        let center = frame * self.shown[index].center_in_world();
        let ahead = self.shown[index].cam_from_world.inverse() * Vector3::z();
        let ahead = frame * ahead;
        (
            Point2::new(center.x, center.z),
            libm::atan2(ahead.x, ahead.z),
        )
    }
}

/// Scaling and shift of a rectified image.
#[derive(Debug, Clone, Copy)]
struct Frame {
    scale: f64,
    shift: Vector2<f64>,
}

impl Frame {
    const SAME: Self = Self {
        scale: 1.0,
        shift: Vector2::new(0.0, 0.0),
    };

    fn intrinsics(&self, k: &Intrinsics) -> Result<Intrinsics, Error> {
        let center = k.principal_point() * self.scale + self.shift;
        Intrinsics::new(
            k.fu_px() * self.scale,
            k.fv_px() * self.scale,
            center.x,
            center.y,
        )
    }

    /// Transforms a rectangle and clips it to the image.
    fn rect(&self, rect: &PixelRect) -> PixelRect {
        let (right, bottom) = (f64::from(PHOTO_SIZE.0 - 1), f64::from(PHOTO_SIZE.1 - 1));
        let u = |u: f64| (self.scale * u + self.shift.x).clamp(0.0, right);
        let v = |v: f64| (self.scale * v + self.shift.y).clamp(0.0, bottom);
        PixelRect {
            u_min: u(rect.u_min),
            v_min: v(rect.v_min),
            u_max: u(rect.u_max),
            v_max: v(rect.v_max),
        }
    }
}

/// Returns the corners of a photograph in its rectified image, in order from the upper left.
fn corners(rectified: &Rectification, index: usize) -> [Point2<f64>; 4] {
    let (right, bottom) = (f64::from(PHOTO_SIZE.0 - 1), f64::from(PHOTO_SIZE.1 - 1));
    [(0.0, 0.0), (right, 0.0), (right, bottom), (0.0, bottom)].map(|(u, v)| {
        let pixel = transfer(&rectified.homographies[index], &Point2::new(u, v));
        pixel.unwrap_or_else(Point2::origin)
    })
}

/// Returns frames that show both photographs entirely and as large as possible, with equal rows.
fn frames_of_all(rectified: &Rectification) -> [Frame; 2] {
    let bounds = |index: usize, axis: usize| {
        let values = corners(rectified, index).map(|corner| corner[axis]);
        values
            .into_iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            })
    };
    let [across1, across2] = [bounds(0, 0), bounds(1, 0)];
    let [down1, down2] = [bounds(0, 1), bounds(1, 1)];
    let down = [down1[0].min(down2[0]), down1[1].max(down2[1])];
    let length = |[low, high]: [f64; 2]| (high - low).max(1.0);
    let (width, height) = (f64::from(PHOTO_SIZE.0 - 1), f64::from(PHOTO_SIZE.1 - 1));
    let scale = (width / length(across1).max(length(across2))).min(height / length(down));
    let centered = |[low, high]: [f64; 2], room: f64| (room - scale * (low + high)) / 2.0;
    [across1, across2].map(|across| Frame {
        scale,
        shift: Vector2::new(centered(across, width), centered(down, height)),
    })
}

/// Returns a rectangle that the photograph fills in its rectified image: between the inner corners.
fn valid_part(rectified: &Rectification, index: usize) -> PixelRect {
    let [a, b, c, d] = corners(rectified, index);
    PixelRect {
        u_min: a.x.max(d.x),
        v_min: a.y.max(b.y),
        u_max: b.x.min(c.x),
        v_max: c.y.min(d.y),
    }
}

/// Interpolates between the intrinsics of two cameras.
fn between([from, to]: [Intrinsics; 2], share: f64) -> Result<Intrinsics, Error> {
    let mix = |from: f64, to: f64| from + share * (to - from);
    let (start, end) = (from.principal_point(), to.principal_point());
    Intrinsics::new(
        mix(from.fu_px(), to.fu_px()),
        mix(from.fv_px(), to.fv_px()),
        mix(start.x, end.x),
        mix(start.y, end.y),
    )
}

/// Returns the horizontal ends of an image on the image plane at distance 1, relative to the axis.
pub(super) fn image_ends(camera: &PosedCamera) -> [f64; 2] {
    let k = &camera.camera.intrinsics;
    let at = |u: f64| (u - k.principal_point().x) / k.fu_px();
    [at(-0.5), at(f64::from(PHOTO_WIDTH) - 0.5)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole_scenes::Scene;

    const RAW: Way = Way {
        parallel: 0.0,
        along: 0.0,
        shows_all: true,
    };
    const DONE: Way = Way {
        parallel: 1.0,
        along: 1.0,
        shows_all: true,
    };

    #[test]
    fn the_way_begins_at_the_photographs_and_ends_at_the_rectified_pair() {
        for (forward_m, left_deg) in [(-0.05, 10.0), (0.1, 0.0), (0.0, 16.0)] {
            let raw = Turned::new(forward_m, left_deg, RAW).unwrap();
            assert!((raw.shown_from_taken[1] - Matrix3::identity()).norm() < 1e-9);
            for shows_all in [true, false] {
                let done = Way { shows_all, ..DONE };
                let done = Turned::new(forward_m, left_deg, done).unwrap();
                let [one, two] = done.taken.map(|camera| camera.cam_from_world);
                let cameras = done.taken.map(|posed| posed.camera);
                let options = RectifyOptions::default();
                let motion = relative_motion(&one, &two);
                let core = rectify_calibrated(&cameras, &motion, &options).unwrap();
                for index in 0..2 {
                    if !shows_all {
                        let apart = done.shown_from_taken[index] - core.homographies[index];
                        assert!(apart.amax() < 1e-6, "{apart}");
                        continue;
                    }
                    // Every corner of the photograph is in the frame, and the valid part is inside.
                    for (u, v) in [(0.0, 0.0), (639.0, 0.0), (0.0, 479.0), (639.0, 479.0)] {
                        let corner = Point2::new(u, v);
                        let corner = transfer(&done.shown_from_taken[index], &corner).unwrap();
                        assert!((-1e-6..=639.0 + 1e-6).contains(&corner.x), "{corner}");
                        assert!((-1e-6..=479.0 + 1e-6).contains(&corner.y), "{corner}");
                    }
                    let valid = &done.valid[index];
                    assert!(valid.u_min >= -1e-6 && valid.v_max <= 479.0 + 1e-6);
                    assert!(done.valid_ratio() > 0.4, "{}", done.valid_ratio());
                }
                assert!(done.apart_deg() < 1e-6 && done.off_baseline_deg() < 1e-6);
            }
        }
    }

    #[test]
    fn turned_pictures_show_what_turned_cameras_see_and_rows_agree_in_the_end() {
        let scene = Scene::still_life();
        let pixel = Point2::new(250.0, 300.0);
        let rows = |way: Way| {
            let turned = Turned::new(-0.05, 10.0, way).unwrap();
            let center = turned.taken[0].center_in_world();
            let hit = scene
                .cast(&center, &turned.taken[0].ray_in_world(&pixel))
                .unwrap();
            let [one, two] = turned
                .shown
                .map(|camera| camera.project(&hit.point).unwrap());
            let warped = transfer(&turned.shown_from_taken[0], &pixel).unwrap();
            assert!((warped - one).norm() < 1e-6);
            (one.y - two.y).abs()
        };
        let half = Way { along: 0.0, ..DONE };
        assert!(
            rows(RAW) > 1.0 && rows(half) > 1.0,
            "{} {}",
            rows(RAW),
            rows(half)
        );
        assert!(rows(DONE) < 1e-6);
        let parallel = Turned::new(-0.05, 10.0, half).unwrap();
        assert!(parallel.apart_deg() < 1e-6 && parallel.off_baseline_deg() > 5.0);
    }

    #[test]
    fn from_above_the_centers_stay_where_they_are() {
        for way in [RAW, DONE] {
            let turned = Turned::new(-0.05, 10.0, way).unwrap();
            let (center, heading) = turned.seen_from_above(1);
            assert!((center - Point2::new(RIGHT_M, -0.05)).norm() < 1e-9);
            // Perpendicular to the baseline at the end, rotated by 10° to the left at the start.
            let expected = match way == DONE {
                true => libm::atan2(0.05, RIGHT_M),
                false => -10.0_f64.to_radians(),
            };
            assert!((heading - expected).abs() < 1e-9, "{heading}");
        }
    }
}
