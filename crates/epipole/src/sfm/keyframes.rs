//! Which frames of a path give new points.

use super::builder::Builder;

/// Frames that were chosen to give points, in order of time.
///
/// A camera that stands still, or takes many pictures along a short way, adds nothing by most of
/// its frames; points from them would be seen under hardly any angle, and the window of frames that
/// are refined together would cover no length.
#[derive(Debug, Default)]
pub(super) struct Keyframes {
    frames: Vec<usize>,
}

/// Share of a keyframe's points that may be out of sight before the next keyframe is due.
const MAX_LOST_SHARE: f64 = 0.3;

impl Keyframes {
    pub(super) fn insert(&mut self, frame: usize) {
        if let Err(place) = self.frames.binary_search(&frame) {
            self.frames.insert(place, frame);
        }
    }

    /// All that are left after those that lost their camera are taken out.
    pub(super) fn into_frames(mut self, has_camera: impl Fn(usize) -> bool) -> Vec<usize> {
        self.frames.retain(|frame| has_camera(*frame));
        self.frames
    }

    /// The `count` keyframes that are nearest to a frame in time, with the frame itself.
    pub(super) fn window(&self, frame: usize, count: usize) -> Vec<usize> {
        let mut near: Vec<usize> = self.frames.clone();
        near.retain(|other| *other != frame);
        near.sort_by_key(|other| other.abs_diff(frame));
        near.truncate(count);
        near.push(frame);
        near
    }

    /// Whether a frame with a camera shows enough that is new: it is far from the nearest
    /// keyframe, judged by the median angle between their rays to common points, or much of what
    /// that one sees is out of sight.
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
            let is_seen_in = |image: usize| {
                let found = point
                    .seen
                    .binary_search_by_key(&image, |element| element.image as usize);
                found.is_ok()
            };
            if is_seen_in(key) {
                num_of_key += 1;
                if is_seen_in(frame) {
                    let rays = centers.map(|center| (point.position - center).normalize());
                    angles.push(libm::acos(rays[0].dot(&rays[1]).clamp(-1.0, 1.0)));
                }
            }
        }
        if (angles.len() as f64) < (1.0 - MAX_LOST_SHARE) * f64::from(num_of_key) {
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
