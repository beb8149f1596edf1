//! Loops that run on several threads with the feature `parallel` and give the same bits without.
//!
//! Every item is computed by one thread from the same inputs in the same order, and sums over
//! items are made afterwards in the order of the items.

/// Calls `f(index, item)` for every item.
pub(crate) fn for_each<T: Send>(items: &mut [T], f: impl Fn(usize, &mut T) + Sync + Send) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        // Tiny jobs cost more to hand out than to do.
        let count = items.len();
        if count >= 8 {
            items
                .par_iter_mut()
                .enumerate()
                .with_min_len(count.div_ceil(256))
                .for_each(|(i, item)| f(i, item));
            return;
        }
    }
    for (i, item) in items.iter_mut().enumerate() {
        f(i, item);
    }
}

/// Calls `f(index of the first item, chunk)` for consecutive chunks of `chunk_len` items.
pub(crate) fn for_each_chunk<T: Send>(
    items: &mut [T],
    chunk_len: usize,
    f: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        items
            .par_chunks_mut(chunk_len)
            .enumerate()
            .for_each(|(i, chunk)| f(i * chunk_len, chunk));
    }
    #[cfg(not(feature = "parallel"))]
    for (i, chunk) in items.chunks_mut(chunk_len).enumerate() {
        f(i * chunk_len, chunk);
    }
}

/// Sums `f(i)` over `0..count`, in blocks of fixed size so that the order of additions does not
/// depend on the threads.
pub(crate) fn sum(count: usize, f: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    const BLOCK: usize = 256;
    let mut partial = vec![0.0; count.div_ceil(BLOCK)];
    for_each(&mut partial, |block, total| {
        for i in block * BLOCK..((block + 1) * BLOCK).min(count) {
            *total += f(i);
        }
    });
    partial.iter().sum()
}
