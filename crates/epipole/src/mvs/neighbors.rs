//! Selection of neighbors and depth ranges from the points of a reconstruction.

use super::options::MvsOptions;
use crate::camera::PosedCamera;
use crate::sfm::Reconstruction;
use nalgebra::Point3;
use std::collections::BTreeMap;

/// Angle above which rays determine depth well, degrees. Goesele et al. 2007, §4.1.
const GOOD_ANGLE_DEG: f64 = 10.0;
/// Angle above which surfaces look increasingly different, degrees.
const WIDE_ANGLE_DEG: f64 = 25.0;
/// Fraction of a photo's points excluded from the depth range at either end.
const OUTSIDE: f64 = 0.005;
/// Factors on the minimum and maximum depth.
const MARGINS: [f64; 2] = [0.75, 1.5];

/// Common points of two photos.
#[derive(Debug, Clone, Copy, Default)]
struct Shared {
    /// Score of the second photo for the first, and vice versa.
    scores: [f64; 2],
    num_points: usize,
    /// Number of points seen under a sufficient angle.
    num_angled: usize,
}

/// Chooses the neighbors of each photo, best first: those with many common points at good angles
/// and of similar resolution.
///
/// Source: Goesele et al. 2007, "Multi-view stereo for community photo collections", §4.1.
pub(super) fn choose_neighbors(
    reconstruction: &Reconstruction,
    options: &MvsOptions,
) -> Vec<Vec<usize>> {
    let mut pairs: BTreeMap<(usize, usize), Shared> = BTreeMap::new();
    for point in &reconstruction.points {
        let sights: Vec<(usize, Sight)> = (point.track.iter())
            .filter_map(|element| {
                let photo = element.image as usize;
                let camera = reconstruction.cameras.get(photo)?.as_ref()?;
                Some((photo, Sight::new(camera, &point.position)?))
            })
            .collect();
        for (n, (first, a)) in sights.iter().enumerate() {
            for (second, b) in &sights[n + 1..] {
                // A track may have two keypoints of one photo.
                if first != second {
                    let key = (*first.min(second), *first.max(second));
                    let (a, b) = if first < second { (a, b) } else { (b, a) };
                    pairs
                        .entry(key)
                        .or_default()
                        .add(a, b, options.min_angle_deg);
                }
            }
        }
    }
    let mut scored = vec![Vec::new(); reconstruction.cameras.len()];
    for (&(first, second), shared) in &pairs {
        if 2 * shared.num_angled >= shared.num_points {
            scored[first].push((shared.scores[0], second));
            scored[second].push((shared.scores[1], first));
        }
    }
    let best = |mut scored: Vec<(f64, usize)>| {
        scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        scored.truncate(options.num_neighbors);
        scored.into_iter().map(|(_, photo)| photo).collect()
    };
    scored.into_iter().map(best).collect()
}

/// A point seen by a photo.
#[derive(Debug, Clone, Copy)]
struct Sight {
    direction: nalgebra::Vector3<f64>,
    /// Size of a pixel in the world.
    pixel_size: f64,
}

impl Sight {
    /// Returns `None` behind the camera.
    fn new(camera: &PosedCamera, point: &Point3<f64>) -> Option<Self> {
        let depth = (camera.cam_from_world * point).z;
        let direction = (point - camera.center_in_world()).try_normalize(0.0)?;
        (depth > 0.0).then(|| Self {
            direction,
            pixel_size: depth / camera.camera.intrinsics.fu_px(),
        })
    }
}

impl Shared {
    fn add(&mut self, a: &Sight, b: &Sight, min_angle_deg: f64) {
        let cosine = a.direction.dot(&b.direction).clamp(-1.0, 1.0);
        let angle_deg = libm::acos(cosine).to_degrees();
        self.num_points += 1;
        self.num_angled += usize::from(angle_deg >= min_angle_deg);
        let angle_ratio = (angle_deg / GOOD_ANGLE_DEG).min(1.0);
        let excess = (WIDE_ANGLE_DEG / angle_deg.max(WIDE_ANGLE_DEG)).min(1.0);
        let weight = angle_ratio * angle_ratio * excess * excess;
        let ratio = a.pixel_size / b.pixel_size;
        self.scores[0] += weight * resolution_weight(ratio);
        self.scores[1] += weight * resolution_weight(1.0 / ratio);
    }
}

/// * `ratio`: resolution of the neighbor relative to the photo
fn resolution_weight(ratio: f64) -> f64 {
    match ratio {
        2.0.. => 2.0 / ratio,
        1.0..2.0 => 1.0,
        _ => ratio,
    }
}

/// Returns the depth range of a photo's points, with a margin; `None` if it sees none.
pub(super) fn depth_range(reconstruction: &Reconstruction, photo: usize) -> Option<[f64; 2]> {
    let camera = reconstruction.cameras[photo].as_ref()?;
    let is_shared = |point: &&crate::sfm::ScenePoint| {
        point
            .track
            .iter()
            .any(|element| element.image as usize == photo)
    };
    let shared = reconstruction.points.iter().filter(is_shared);
    let mut depths: Vec<f64> = shared
        .map(|point| (camera.cam_from_world * point.position).z)
        .filter(|depth| *depth > 0.0 && depth.is_finite())
        .collect();
    depths.sort_by(f64::total_cmp);
    let outside = (OUTSIDE * depths.len() as f64) as usize;
    let (near, far) = (
        depths.get(outside)?,
        depths.get(depths.len() - 1 - outside)?,
    );
    Some([near * MARGINS[0], far * MARGINS[1]])
}
