//! The same list of results, made by one thread or by several.

/// `f` of each item, in the order of the items.
pub(crate) fn map<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    map_with(items, || (), |(), item| f(item))
}

/// [`map`] whose calls use memory of the calls before them; results must not depend on what is in
/// it.
pub(crate) fn map_with<T: Sync, U: Send, S>(
    items: &[T],
    memory: impl Fn() -> S + Sync + Send,
    f: impl Fn(&mut S, &T) -> U + Sync + Send,
) -> Vec<U> {
    #[cfg(feature = "parallel")]
    if items.len() > 1 && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        return items.par_iter().map_init(memory, f).collect();
    }
    let mut memory = memory();
    items.iter().map(|item| f(&mut memory, item)).collect()
}

/// The numbers below `count`, in pieces of `size`; the last one may be smaller.
pub(crate) fn pieces(count: usize, size: usize) -> Vec<std::ops::Range<usize>> {
    let from = (0..count).step_by(size.max(1));
    from.map(|k| k..(k + size.max(1)).min(count)).collect()
}
