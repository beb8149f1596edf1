//! Loops over independent items, on several threads with the feature `parallel`.
//!
//! Each item is computed by one thread, from the same inputs in the same order, and results keep
//! the order of the items. So the bits do not depend on the number of threads.

use std::ops::Range;
use std::sync::Mutex;

/// Maximum number of jobs of a loop; more do not improve the load balance.
const MAX_JOBS: usize = 256;
/// Minimum number of items for which [`for_each`] uses several threads.
const MIN_ITEMS: usize = 8;

fn num_threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    return 1;
}

/// Calls `job(n)` for each n below `count`. Compiled once, since Rayon's loops are large.
fn run(count: usize, job: &(dyn Fn(usize) + Sync)) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().for_each(job);
    }
    #[cfg(not(feature = "parallel"))]
    (0..count).for_each(job);
}

/// Returns the number of items per job of a loop over `count` items.
fn job_len(count: usize) -> usize {
    let jobs = if num_threads() > 1 { MAX_JOBS } else { 1 };
    count.div_ceil(jobs).max(1)
}

/// Calls `f(index of the first item, chunk)` for consecutive chunks of `chunk_len` items.
pub(crate) fn for_each_chunk<T: Send>(
    items: &mut [T],
    chunk_len: usize,
    f: impl Fn(usize, &mut [T]) + Sync,
) {
    if num_threads() == 1 || items.len() <= chunk_len {
        for (n, chunk) in items.chunks_mut(chunk_len).enumerate() {
            f(n * chunk_len, chunk);
        }
        return;
    }
    let chunks: Vec<Mutex<&mut [T]>> = items.chunks_mut(chunk_len).map(Mutex::new).collect();
    run(chunks.len(), &|n| {
        // Never blocks: each chunk is locked once.
        if let Ok(mut chunk) = chunks[n].lock() {
            f(n * chunk_len, &mut chunk);
        }
    });
}

/// Calls `f(index, item)` for every item.
pub(crate) fn for_each<T: Send>(items: &mut [T], f: impl Fn(usize, &mut T) + Sync) {
    let count = items.len();
    let len = match count < MIN_ITEMS {
        true => count.max(1),
        false => job_len(count),
    };
    for_each_chunk(items, len, |first, chunk| {
        for (k, item) in chunk.iter_mut().enumerate() {
            f(first + k, item);
        }
    });
}

/// Sums `f(i)` over `0..count`, in blocks of fixed size, so that the order of additions does not
/// depend on the threads.
pub(crate) fn sum(count: usize, f: impl Fn(usize) -> f64 + Sync) -> f64 {
    const BLOCK: usize = 256;
    let mut partial = vec![0.0; count.div_ceil(BLOCK)];
    for_each(&mut partial, |block, total| {
        for i in block * BLOCK..((block + 1) * BLOCK).min(count) {
            *total += f(i);
        }
    });
    partial.iter().sum()
}

/// Returns `f` of each item, in the order of the items, with memory that calls reuse; results must
/// not depend on its content.
pub(crate) fn map_with<T: Sync, U: Send, S>(
    items: &[T],
    memory: impl Fn() -> S + Sync,
    f: impl Fn(&mut S, &T) -> U + Sync,
) -> Vec<U> {
    let mut results: Vec<Option<U>> = Vec::new();
    results.resize_with(items.len(), || None);
    for_each_chunk(&mut results, job_len(items.len()), |first, results| {
        let mut memory = memory();
        for (result, item) in results.iter_mut().zip(&items[first..]) {
            *result = Some(f(&mut memory, item));
        }
    });
    results.into_iter().flatten().collect()
}

/// Splits the numbers below `count` into ranges of `size`; the last one may be smaller.
pub(crate) fn pieces(count: usize, size: usize) -> Vec<Range<usize>> {
    let from = (0..count).step_by(size.max(1));
    from.map(|k| k..(k + size.max(1)).min(count)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_visited_once_and_in_place() {
        for count in [0, 1, 7, 8, 255, 256, 257, 1000] {
            let mut items = vec![0; count];
            for_each(&mut items, |index, item| *item += index + 1);
            assert!(items.iter().enumerate().all(|(n, item)| *item == n + 1));
            let indices: Vec<usize> = (0..count).collect();
            assert_eq!(map_with(&indices, || (), |(), &n| n + 1), items);
            let mut firsts = vec![0; count];
            for_each_chunk(&mut firsts, 3, |first, chunk| chunk.fill(first));
            assert!(
                firsts
                    .iter()
                    .enumerate()
                    .all(|(n, first)| *first == n - n % 3)
            );
            assert_eq!(sum(count, |n| n as f64), (0..count).sum::<usize>() as f64);
        }
    }
}
