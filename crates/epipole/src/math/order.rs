//! Orders of things, found by one sort for all of them. The standard library's sorts are compiled anew for every type
//! and every comparison, to 5 or 8 KB each; where few things are sorted, asking the comparison through a pointer costs
//! nothing that could be measured.

use std::cmp::Ordering;

/// Puts indices in the order that `compare` says; those that it calls equal are in ascending order.
pub(crate) fn sort_indices(
    indices: &mut [usize],
    compare: &mut dyn FnMut(usize, usize) -> Ordering,
) {
    indices.sort_unstable_by(|&a, &b| compare(a, b).then(a.cmp(&b)));
}

/// The indices of `len` things in the order that `compare` says; equal things stay as they are.
pub(crate) fn order_by(
    len: usize,
    compare: &mut dyn FnMut(usize, usize) -> Ordering,
) -> Vec<usize> {
    let mut order: Vec<usize> = (0..len).collect();
    sort_indices(&mut order, compare);
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn equal_things_stay_as_they_are() {
        let mut random = Random::new(3);
        for len in [0, 1, 2, 19, 21, 500] {
            let things: Vec<usize> = (0..len).map(|_| random.below(7)).collect();
            let order = order_by(len, &mut |a, b| things[b].cmp(&things[a]));
            let mut known: Vec<usize> = (0..len).collect();
            known.sort_by_key(|&i| std::cmp::Reverse(things[i]));
            assert_eq!(order, known);
        }
    }

    #[test]
    fn indices_need_not_be_all() {
        let sizes = [3.0_f64, 1.0, 2.0, 1.0];
        let mut indices = [3, 0, 1];
        sort_indices(&mut indices, &mut |a, b| sizes[a].total_cmp(&sizes[b]));
        assert_eq!(indices, [1, 3, 0]);
    }
}
