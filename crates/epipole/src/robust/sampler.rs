//! Samplers of unique data.

use super::SamplerKind;
use crate::math::random::Random;

/// Sampler of `size` different indices below `num_data`.
#[derive(Debug, Clone)]
pub(super) struct Sampler {
    num_data: usize,
    size: usize,
    growth: Option<Growth>,
    /// Maximum size of PROSAC's pool.
    limit: usize,
}

/// State of PROSAC: samples come from the `pool` best data, which grows.
#[derive(Debug, Clone)]
struct Growth {
    pool: usize,
    drawn: f64,
    /// T_n: the average number of samples from the pool among T_N uniform ones.
    expected: f64,
    /// T'_n: the number of samples after which the pool grows.
    until: f64,
}

/// T_N: number of samples after which PROSAC becomes uniform sampling. The paper's value; the code
/// uses half the maximum number of samples, if that is less, so that a misleading order costs time
/// but does not change the result.
const TOTAL: f64 = 200_000.0;

impl Sampler {
    pub(super) fn new(
        kind: SamplerKind,
        num_data: usize,
        size: usize,
        max_iterations: usize,
    ) -> Self {
        let growth = match kind {
            SamplerKind::Uniform => None,
            SamplerKind::Prosac => {
                let total = TOTAL.min((0.5 * max_iterations as f64).max(1.0));
                let expected =
                    (0..size).fold(total, |t, i| t * (size - i) as f64 / (num_data - i) as f64);
                Some(Growth {
                    pool: size,
                    drawn: 0.0,
                    expected,
                    until: 1.0,
                })
            }
        };
        Self {
            num_data,
            size,
            growth,
            limit: num_data,
        }
    }

    /// Returns whether samples come from the best data first.
    pub(super) fn is_ordered(&self) -> bool {
        self.growth.is_some()
    }

    /// Draws from the best `limit` data from now on, or from the current pool if it is larger.
    pub(super) fn keep_to(&mut self, limit: usize) {
        self.limit = limit.max(self.size);
    }

    /// Fills `sample` with different indices.
    pub(super) fn draw(&mut self, random: &mut Random, sample: &mut Vec<usize>) {
        sample.clear();
        let size = self.size;
        let Some(growth) = &mut self.growth else {
            fill(random, self.num_data, size, sample);
            return;
        };
        growth.drawn += 1.0;
        while growth.drawn > growth.until && growth.pool < self.limit {
            let n = growth.pool as f64;
            let next = growth.expected * (n + 1.0) / (n + 1.0 - size as f64);
            growth.until += (next - growth.expected).ceil().max(1.0);
            growth.expected = next;
            growth.pool += 1;
        }
        if growth.drawn > growth.until || growth.pool == size {
            // The whole set was sampled enough, or the pool is one sample.
            fill(random, growth.pool, size, sample);
        } else {
            // The newest data point of the pool and better ones.
            fill(random, growth.pool - 1, size - 1, sample);
            sample.push(growth.pool - 1);
        }
    }
}

/// Adds `count` different indices below `bound`, by rejection: samples are small.
fn fill(random: &mut Random, bound: usize, count: usize, sample: &mut Vec<usize>) {
    while sample.len() < count {
        let index = random.below(bound);
        if !sample.contains(&index) {
            sample.push(index);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_samples_are_different_and_cover_all() {
        let mut sampler = Sampler::new(SamplerKind::Uniform, 9, 4, 9000);
        let (mut random, mut sample) = (Random::new(1), Vec::new());
        let mut counts = [0; 9];
        for _ in 0..9000 {
            sampler.draw(&mut random, &mut sample);
            assert_eq!(sample.len(), 4);
            for (place, &index) in sample.iter().enumerate() {
                assert!(!sample[..place].contains(&index));
                counts[index] += 1;
            }
        }
        // Each index is expected 4000 times, with a standard deviation of 47.
        assert!(
            counts.iter().all(|&n| (3700..4300).contains(&n)),
            "{counts:?}"
        );
    }

    #[test]
    fn prosac_begins_with_the_best_and_ends_uniform() {
        let mut sampler = Sampler::new(SamplerKind::Prosac, 100, 4, usize::MAX);
        let (mut random, mut sample) = (Random::new(1), Vec::new());
        sampler.draw(&mut random, &mut sample);
        sample.sort_unstable();
        assert_eq!(sample, [0, 1, 2, 3]);
        let mut largest = 0;
        for _ in 0..100 {
            sampler.draw(&mut random, &mut sample);
            let newest = *sample.iter().max().unwrap();
            assert!(newest >= largest);
            largest = newest;
            assert!(sample.len() == 4);
        }
        assert!(largest < 40, "{largest}");
        for _ in 0..200_000 {
            sampler.draw(&mut random, &mut sample);
        }
        let mut last_is_drawn = 0;
        for _ in 0..1000 {
            sampler.draw(&mut random, &mut sample);
            last_is_drawn += usize::from(sample.contains(&99));
        }
        assert!((20..70).contains(&last_is_drawn), "{last_is_drawn}");
    }

    #[test]
    fn a_sample_of_all_data() {
        for kind in [SamplerKind::Uniform, SamplerKind::Prosac] {
            let mut sampler = Sampler::new(kind, 3, 3, 10);
            let (mut random, mut sample) = (Random::new(1), Vec::new());
            for _ in 0..10 {
                sampler.draw(&mut random, &mut sample);
                sample.sort_unstable();
                assert_eq!(sample, [0, 1, 2]);
            }
        }
    }
}
