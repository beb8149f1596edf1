//! Choice of the pairs of images to match.

use crate::Result;
use crate::feature::{Descriptors, global_descriptors};
use crate::progress::Monitor;
use std::collections::BTreeSet;

/// Number of similar images unless another one is given: with fewer images all pairs are matched.
const MOST_SIMILAR: usize = 40;

/// Returns the pairs to match, the earlier image first, in order.
///
/// * `descriptors`: those of each image
/// * `neighbors`, `similar`: as in [`PhotoOptions`](super::PhotoOptions)
///
/// # Errors
/// As [`nearest_two`](crate::feature::nearest_two).
pub(super) fn select_pairs(
    descriptors: &[&Descriptors],
    neighbors: usize,
    similar: Option<usize>,
    monitor: &mut dyn Monitor,
) -> Result<Vec<(usize, usize)>> {
    let count = descriptors.len();
    let similar = match (similar, neighbors) {
        (None, 0) => MOST_SIMILAR,
        (None, _) => 0,
        (Some(0), 0) => count,
        (Some(similar), _) => similar,
    };
    if similar.saturating_add(1) >= count {
        return Ok(close_in_order(count, count).collect());
    }
    let mut pairs: BTreeSet<_> = close_in_order(count, neighbors).collect();
    if similar > 0 {
        pairs.extend(most_similar(descriptors, similar, monitor)?);
    }
    Ok(pairs.into_iter().collect())
}

fn close_in_order(count: usize, reach: usize) -> impl Iterator<Item = (usize, usize)> {
    let after = move |image: usize| image + 1..count.min(image.saturating_add(reach + 1));
    (0..count).flat_map(move |image| after(image).map(move |other| (image, other)))
}

/// Returns the pairs of each image with those that look most like it.
fn most_similar(
    descriptors: &[&Descriptors],
    per_image: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<(usize, usize)>> {
    let vectors = global_descriptors(descriptors, monitor)?;
    let similarity = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
    let mut pairs = Vec::with_capacity(vectors.len() * per_image);
    for (image, vector) in vectors.iter().enumerate() {
        let mut others: Vec<(f32, usize)> = (vectors.iter().enumerate())
            .filter(|(other, _)| *other != image)
            .map(|(other, its)| (similarity(vector, its), other))
            .collect();
        others.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let nearest = others.iter().take(per_image);
        pairs.extend(nearest.map(|(_, other)| (image.min(*other), image.max(*other))));
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Images of `scenes`, whose descriptors repeat with noise within a scene.
    fn images(scenes: &[u64]) -> Vec<Descriptors> {
        let image = |(seed, scene): (usize, &u64)| {
            let mut random = Random::new(seed as u64);
            let mut values = Vec::new();
            for _ in 0..200 {
                let mut object = Random::new(1000 * scene + random.below(50) as u64);
                values.extend((0..8).map(|_| (object.normal() + 0.1 * random.normal()) as f32));
            }
            Descriptors::from_floats(8, values).unwrap()
        };
        scenes.iter().enumerate().map(image).collect()
    }

    fn pairs(count: usize, neighbors: usize, similar: Option<usize>) -> Vec<(usize, usize)> {
        let scenes: Vec<u64> = (0..count as u64).map(|k| k % 3).collect();
        let images = images(&scenes);
        let images: Vec<&Descriptors> = images.iter().collect();
        select_pairs(&images, neighbors, similar, &mut ()).unwrap()
    }

    #[test]
    fn similar_images_are_of_the_same_scene() {
        let found = pairs(12, 0, Some(3));
        let mut expected = Vec::new();
        for first in 0..12 {
            expected.extend((first + 3..12).step_by(3).map(|second| (first, second)));
        }
        assert_eq!(found, expected);
    }

    #[test]
    fn similar_images_join_those_close_in_order() {
        let following = pairs(12, 1, None);
        assert_eq!(following, (0..11).map(|k| (k, k + 1)).collect::<Vec<_>>());
        let both = pairs(12, 1, Some(3));
        assert_eq!(both.len(), following.len() + pairs(12, 0, Some(3)).len());
        assert!(both.is_sorted() && both.contains(&(4, 5)) && both.contains(&(2, 11)));
    }

    #[test]
    fn few_images_are_compared_with_all_others() {
        let all = 12 * 11 / 2;
        for similar in [None, Some(0), Some(11), Some(usize::MAX)] {
            assert_eq!(pairs(12, 0, similar).len(), all, "{similar:?}");
        }
        assert!(pairs(45, 0, None).len() < 45 * 44 / 2);
        assert_eq!((pairs(0, 0, None), pairs(1, 0, Some(1))), (vec![], vec![]));
    }
}
