//! Selection of the keyframes that provide new points.

use super::builder::Builder;

/// Frames chosen to provide points, in order of time.
///
/// Most frames of a slow or resting camera add nothing: their points would have tiny triangulation
/// angles, and the window of jointly refined frames would cover no distance.
#[derive(Debug, Default)]
pub(super) struct Keyframes {
    frames: Vec<usize>,
}

/// Fraction of a keyframe's points that may be out of sight before the next keyframe is due.
const MAX_LOST_FRACTION: f64 = 0.3;

impl Keyframes {
    pub(super) fn insert(&mut self, frame: usize) {
        if let Err(place) = self.frames.binary_search(&frame) {
            self.frames.insert(place, frame);
        }
    }

    /// Returns the keyframes that still have a camera.
    pub(super) fn into_frames(mut self, has_camera: impl Fn(usize) -> bool) -> Vec<usize> {
        self.frames.retain(|frame| has_camera(*frame));
        self.frames
    }

    /// Returns the `count` keyframes nearest to a frame in time, including the frame itself.
    pub(super) fn window(&self, frame: usize, count: usize) -> Vec<usize> {
        let mut near: Vec<usize> = self.frames.clone();
        near.retain(|other| *other != frame);
        near.sort_by_key(|other| other.abs_diff(frame));
        near.truncate(count);
        near.push(frame);
        near
    }

    /// Returns whether a frame should be a keyframe: it is far from the nearest keyframe, by the
    /// median angle between their rays to common points, or many of that keyframe's points are out
    /// of sight.
    pub(super) fn is_due(&self, builder: &Builder, frame: usize, min_angle_rad: f64) -> bool {
        let nearest = self.frames.iter().min_by_key(|key| key.abs_diff(frame));
        let Some(&key) = nearest else {
            return true;
        };
        let (Some(of_key), Some(of_frame)) = (builder.cameras[key], builder.cameras[frame]) else {
            return true;
        };
        let centers = [of_key.center_in_world(), of_frame.center_in_world()];
        let mut num_of_key = 0;
        let mut angles = Vec::new();
        for point in builder.points.iter().flatten() {
            let is_visible_in = |image: usize| {
                let found = point
                    .elements
                    .binary_search_by_key(&image, |element| element.image as usize);
                found.is_ok()
            };
            if is_visible_in(key) {
                num_of_key += 1;
                if is_visible_in(frame) {
                    let rays = centers.map(|center| (point.position - center).normalize());
                    angles.push(libm::acos(rays[0].dot(&rays[1]).clamp(-1.0, 1.0)));
                }
            }
        }
        if (angles.len() as f64) < (1.0 - MAX_LOST_FRACTION) * f64::from(num_of_key) {
            return true;
        }
        angles.sort_by(f64::total_cmp);
        let median = angles.get(angles.len() / 2);
        median.is_none_or(|angle| *angle >= min_angle_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_hold_the_nearest_keyframes_and_the_frame() {
        let mut keyframes = Keyframes::default();
        for frame in [9, 0, 3, 3, 20] {
            keyframes.insert(frame);
        }
        assert_eq!(keyframes.window(10, 2), [9, 3, 10]);
        assert_eq!(keyframes.window(3, 9), [0, 9, 20, 3]);
        assert_eq!(keyframes.into_frames(|frame| frame != 9), [0, 3, 20]);
    }
}
