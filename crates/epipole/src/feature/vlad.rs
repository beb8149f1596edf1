//! Global descriptors of images: their local descriptors relative to a small vocabulary.

use super::Descriptors;
use super::matching::nearest_two;
use crate::Result;
use crate::math::random::Random;
use crate::progress::{Monitor, Part};

/// Number of words of the vocabulary.
const NUM_WORDS: usize = 64;
/// Number of descriptors that the vocabulary is learned from.
const NUM_LEARNED: usize = 16_384;
const LEARNING_STEPS: usize = 8;
const SEED: u64 = 0;
/// Progress when the vocabulary is learned, measured on some hundred images.
const LEARNED: f32 = 0.1;

/// Returns a unit vector for each image: images of the same scene have large inner products. Zeros
/// for an image without descriptors.
///
/// The vocabulary is learned from the images, so vectors of different calls do not compare. The
/// only stage is [`Stage::FeatureMatching`](crate::progress::Stage::FeatureMatching).
///
/// # Errors
/// As [`nearest_two`]: all descriptors need the same length.
///
/// Source: Jégou, Douze, Schmid & Pérez 2010, "Aggregating local descriptors into a compact image
/// representation", §3; normalized within each word as in Arandjelović & Zisserman 2013, "All about
/// VLAD", §3.
pub(crate) fn global_descriptors(
    images: &[&Descriptors],
    monitor: &mut dyn Monitor,
) -> Result<Vec<Vec<f32>>> {
    let images: Vec<Descriptors> = (images.iter())
        .map(|image| Descriptors::from_floats(image.dimension(), image.to_floats()))
        .collect::<Result<_>>()?;
    let words = learn_words(&images, &mut Part::new(monitor, 0.0, LEARNED))?;
    let progress = |done: usize| LEARNED + (1.0 - LEARNED) * done as f32 / images.len() as f32;
    let mut vectors = Vec::with_capacity(images.len());
    for (done, image) in images.iter().enumerate() {
        let mut part = Part::new(monitor, progress(done), progress(done + 1));
        vectors.push(aggregate(image, &words, &mut part)?);
    }
    Ok(vectors)
}

/// Learns the words by k-means from descriptors that are evenly spread over all images.
fn learn_words(images: &[Descriptors], monitor: &mut dyn Monitor) -> Result<Descriptors> {
    let dimension = images.first().map_or(1, Descriptors::dimension);
    let total: usize = images.iter().map(Descriptors::len).sum();
    let step = total.div_ceil(NUM_LEARNED).max(1);
    let all = (images.iter()).flat_map(|image| (0..image.len()).map(move |k| (image, k)));
    let sample: Vec<f32> = (all.step_by(step))
        .filter_map(|(image, k)| image.get(k))
        .flatten()
        .collect();
    let sample = Descriptors::from_floats(dimension, sample)?;
    let mut random = Random::new(SEED);
    let mut order: Vec<usize> = (0..sample.len()).collect();
    for place in 0..order.len().min(NUM_WORDS) {
        let other = place + random.below(order.len() - place);
        order.swap(place, other);
    }
    let mut words: Vec<f32> = (order.iter().take(NUM_WORDS))
        .filter_map(|&k| sample.get(k))
        .flatten()
        .collect();
    let values = sample.to_floats();
    for iteration in 0..LEARNING_STEPS {
        let [from, to] = [iteration, iteration + 1].map(|n| n as f32 / LEARNING_STEPS as f32);
        let current = Descriptors::from_floats(dimension, words.clone())?;
        let nearest = nearest_two(&sample, &current, &mut Part::new(monitor, from, to))?;
        let mut sums = vec![0.0_f32; words.len()];
        let mut counts = vec![0_u32; words.len() / dimension];
        for (value, word) in values.chunks_exact(dimension).zip(&nearest) {
            counts[word.index] += 1;
            let sum = &mut sums[word.index * dimension..][..dimension];
            sum.iter_mut()
                .zip(value)
                .for_each(|(sum, value)| *sum += value);
        }
        for (word, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            let range = word * dimension..(word + 1) * dimension;
            for (word, sum) in words[range.clone()].iter_mut().zip(&sums[range]) {
                *word = sum / *count as f32;
            }
        }
    }
    Descriptors::from_floats(dimension, words)
}

/// Sums the differences of an image's descriptors from their nearest words.
fn aggregate(
    image: &Descriptors,
    words: &Descriptors,
    monitor: &mut dyn Monitor,
) -> Result<Vec<f32>> {
    let (dimension, centers) = (words.dimension(), words.to_floats());
    let nearest = nearest_two(image, words, monitor)?;
    let mut vector = vec![0.0_f32; centers.len()];
    for (value, word) in image.to_floats().chunks_exact(dimension).zip(&nearest) {
        let range = word.index * dimension..(word.index + 1) * dimension;
        let differences = value.iter().zip(&centers[range.clone()]);
        for (sum, (value, center)) in vector[range].iter_mut().zip(differences) {
            *sum += value - center;
        }
    }
    // Repeated structures, such as windows, would outweigh all other words.
    vector.chunks_exact_mut(dimension).for_each(normalize);
    normalize(&mut vector);
    Ok(vector)
}

/// Scales a vector to unit length; zeros stay.
fn normalize(vector: &mut [f32]) {
    let norm_sq: f64 = vector.iter().map(|x| f64::from(*x) * f64::from(*x)).sum();
    if norm_sq > 0.0 {
        let scale = (1.0 / libm::sqrt(norm_sq)) as f32;
        vector.iter_mut().for_each(|x| *x *= scale);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Descriptors of one of two kinds of objects, with noise.
    fn image(kind: u64, seed: u64, count: usize) -> Descriptors {
        let mut random = Random::new(seed);
        let values = (0..count).flat_map(|_| {
            let mut object = Random::new(100 * kind + random.below(40) as u64);
            let values: Vec<f32> = (0..16)
                .map(|_| (object.normal() + 0.2 * random.normal()) as f32)
                .collect();
            values
        });
        Descriptors::from_floats(16, values.collect()).unwrap()
    }

    fn similarity(a: &[f32], b: &[f32]) -> f32 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn images_of_the_same_objects_are_similar() {
        let images = [(1, 1), (1, 2), (2, 3), (2, 4)].map(|(kind, seed)| image(kind, seed, 300));
        let vectors = global_descriptors(&images.each_ref(), &mut ()).unwrap();
        for (a, same, others) in [(0, 1, [2, 3]), (2, 3, [0, 1])] {
            let with = |b: usize| similarity(&vectors[a], &vectors[b]);
            assert!((with(a) - 1.0).abs() < 1e-5);
            for other in others {
                assert!(
                    with(same) > 2.0 * with(other),
                    "{} {}",
                    with(same),
                    with(other)
                );
            }
        }
    }

    #[test]
    fn few_descriptors_and_none_are_accepted() {
        let empty = Descriptors::from_floats(16, Vec::new()).unwrap();
        let vectors = global_descriptors(&[&empty, &empty], &mut ()).unwrap();
        assert!(vectors.iter().flatten().all(|x| *x == 0.0));
        let vectors = global_descriptors(&[&empty, &image(1, 1, 3)], &mut ()).unwrap();
        assert!(vectors.iter().flatten().all(|x| x.is_finite()));
        assert_eq!(
            global_descriptors(&[], &mut ()).unwrap(),
            Vec::<Vec<f32>>::new()
        );
    }

    #[test]
    fn bits_are_accepted() {
        let bits = |seed: u64| {
            let mut random = Random::new(seed);
            let words = (0..50).map(|_| core::array::from_fn(|_| random.below(usize::MAX) as u64));
            Descriptors::from_bits(words.collect())
        };
        let (first, second) = (bits(1), bits(2));
        let vectors = global_descriptors(&[&first, &second, &first], &mut ()).unwrap();
        assert!(similarity(&vectors[0], &vectors[2]) > similarity(&vectors[0], &vectors[1]));
    }
}
