//! Sorting with little code. The standard library's sorts are compiled for every type and
//! comparison, at 5 or 8 KB each; for short lists, an indirect comparison has no measurable cost.

use std::cmp::Ordering;

/// Sorts indices by `compare`; equal ones are in ascending order.
pub(crate) fn sort_indices(
    indices: &mut [usize],
    compare: &mut dyn FnMut(usize, usize) -> Ordering,
) {
    indices.sort_unstable_by(|&a, &b| compare(a, b).then(a.cmp(&b)));
}

/// Returns the indices of `len` items sorted by `compare`; the sort is stable.
pub(crate) fn order_by(
    len: usize,
    compare: &mut dyn FnMut(usize, usize) -> Ordering,
) -> Vec<usize> {
    let mut order: Vec<usize> = (0..len).collect();
    sort_indices(&mut order, compare);
    order
}

/// Returns the value at a rank in ascending order, NaN last. Partitions the values around it.
pub(crate) fn at_rank(values: &mut [f64], rank: usize) -> f64 {
    *values.select_nth_unstable_by(rank, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn equal_items_keep_their_order() {
        let mut random = Random::new(3);
        for len in [0, 1, 2, 19, 21, 500] {
            let items: Vec<usize> = (0..len).map(|_| random.below(7)).collect();
            let order = order_by(len, &mut |a, b| items[b].cmp(&items[a]));
            let mut known: Vec<usize> = (0..len).collect();
            known.sort_by_key(|&i| std::cmp::Reverse(items[i]));
            assert_eq!(order, known);
        }
    }

    #[test]
    fn a_rank_is_a_place_in_the_order() {
        let mut random = Random::new(4);
        let values: Vec<f64> = (0..200).map(|_| random.uniform(-1.0, 1.0)).collect();
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        for rank in [0, 1, 99, 100, 198, 199] {
            let mut values = values.clone();
            assert_eq!(at_rank(&mut values, rank), sorted[rank]);
            assert!(values[..rank].iter().all(|&value| value <= sorted[rank]));
            assert!(values[rank..].iter().all(|&value| value >= sorted[rank]));
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
