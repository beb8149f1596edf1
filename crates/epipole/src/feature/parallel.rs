//! The same list of results, made by one thread or by several.

/// `f` of each item, in the order of the items.
pub(crate) fn map<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    #[cfg(feature = "parallel")]
    if items.len() > 1 && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        return items.par_iter().map(f).collect();
    }
    items.iter().map(f).collect()
}

/// The numbers below `count`, in pieces of `size`; the last one may be smaller.
pub(crate) fn pieces(count: usize, size: usize) -> Vec<std::ops::Range<usize>> {
    let from = (0..count).step_by(size.max(1));
    from.map(|k| k..(k + size.max(1)).min(count)).collect()
}
