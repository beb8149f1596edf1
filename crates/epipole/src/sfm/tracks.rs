//! Tracks: keypoints of several images that show the same scene point.

use crate::feature::Match;
use crate::math::UnionFind;
use crate::{Error, Result};

/// A keypoint of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TrackElement {
    /// Index of the image.
    pub image: u32,
    /// Index of the keypoint in that image.
    pub keypoint: u32,
}

/// Matches between the keypoints of two images.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PairMatches {
    /// Index of the first image.
    pub image1: usize,
    /// Index of the second image.
    pub image2: usize,
    /// Matching keypoints.
    pub matches: Vec<Match>,
}

/// Joins matches into tracks: lists of keypoints, at most one per image, sorted by image.
///
/// * `num_keypoints`: number of keypoints of each image
/// * `pairs`: geometrically verified matches. Pairs with many matches take precedence: a match that
///   would give a track two keypoints of one image is dropped, so that a wrong match does not
///   corrupt the two tracks that it touches.
///
/// Tracks are sorted by their first element; keypoints without a match are in no track.
///
/// # Errors
/// [`Error::OutOfRange`] if a match refers to a missing image or keypoint, or joins an image with
/// itself.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::Match;
/// use epipole::sfm::{PairMatches, build_tracks};
/// let pair = |image1, image2, index1, index2| PairMatches {
///     image1,
///     image2,
///     matches: vec![Match::new(index1, index2)],
/// };
/// // Keypoint 0 of image 0 is keypoint 1 of image 1, and that is keypoint 2 of image 2.
/// let tracks = build_tracks(&[3, 3, 3], &[pair(0, 1, 0, 1), pair(1, 2, 1, 2)])?;
/// assert_eq!(tracks.len(), 1);
/// assert_eq!(tracks[0].len(), 3);
/// # Ok(()) }
/// ```
pub fn build_tracks(
    num_keypoints: &[usize],
    pairs: &[PairMatches],
) -> Result<Vec<Vec<TrackElement>>> {
    let mut starts = vec![0; num_keypoints.len() + 1];
    for (i, count) in num_keypoints.iter().enumerate() {
        starts[i + 1] = starts[i] + count;
    }
    let refuse = |value: usize| {
        Err(Error::OutOfRange {
            what: "an image or keypoint of a match",
            requirement: "the index of an existing one, of two different images",
            value: value as f64,
        })
    };
    for pair in pairs {
        let (a, b) = (pair.image1, pair.image2);
        if a >= num_keypoints.len() || b >= num_keypoints.len() || a == b {
            return refuse(a.max(b));
        }
        for found in &pair.matches {
            if found.index1 >= num_keypoints[a] || found.index2 >= num_keypoints[b] {
                return refuse(found.index1.max(found.index2));
            }
        }
    }
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    order.sort_by_key(|&p| (std::cmp::Reverse(pairs[p].matches.len()), p));

    let total = starts[num_keypoints.len()];
    let mut sets = UnionFind::new(total);
    // Sorted images of each set, at its root; empty for a single keypoint.
    let mut images: Vec<Vec<u32>> = vec![Vec::new(); total];
    for &p in &order {
        let pair = &pairs[p];
        for found in &pair.matches {
            let (a, b) = (
                starts[pair.image1] + found.index1,
                starts[pair.image2] + found.index2,
            );
            let (root_a, root_b) = (sets.root(a), sets.root(b));
            if root_a == root_b {
                continue;
            }
            let own = |list: &mut Vec<u32>, image: usize| {
                let mut list = std::mem::take(list);
                if list.is_empty() {
                    list.push(image as u32);
                }
                list
            };
            let of_a = own(&mut images[root_a], pair.image1);
            let of_b = own(&mut images[root_b], pair.image2);
            if have_common_member(&of_a, &of_b) {
                images[root_a] = of_a;
                images[root_b] = of_b;
                continue;
            }
            sets.join(root_a, root_b);
            let mut both = of_a;
            both.extend(of_b);
            both.sort_unstable();
            images[sets.root(root_a)] = both;
        }
    }
    let mut track_of_root = vec![usize::MAX; total];
    let mut tracks: Vec<Vec<TrackElement>> = Vec::new();
    for (image, count) in num_keypoints.iter().enumerate() {
        for keypoint in 0..*count {
            let root = sets.root(starts[image] + keypoint);
            if images[root].len() < 2 {
                continue;
            }
            if track_of_root[root] == usize::MAX {
                track_of_root[root] = tracks.len();
                tracks.push(Vec::new());
            }
            tracks[track_of_root[root]].push(TrackElement {
                image: image as u32,
                keypoint: keypoint as u32,
            });
        }
    }
    Ok(tracks)
}

/// Returns whether two ascending lists have a member in common.
fn have_common_member(a: &[u32], b: &[u32]) -> bool {
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].cmp(&b[j]) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => return true,
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn pair(image1: usize, image2: usize, matches: &[(u32, u32)]) -> PairMatches {
        PairMatches {
            image1,
            image2,
            matches: (matches.iter())
                .map(|&(i, j)| Match::new(i as usize, j as usize))
                .collect(),
        }
    }

    #[test]
    fn a_wrong_match_costs_only_itself() {
        // Points 0 and 1 are seen in three images; a match of the weakest pair mixes them.
        let pairs = [
            pair(0, 1, &[(0, 0), (1, 1), (2, 2)]),
            pair(1, 2, &[(0, 0), (1, 1), (2, 2)]),
            pair(0, 2, &[(0, 1)]),
        ];
        let tracks = build_tracks(&[3, 3, 3], &pairs).unwrap();
        assert_eq!(tracks.len(), 3);
        for (p, track) in tracks.iter().enumerate() {
            let expected: Vec<_> = (0..3)
                .map(|image| TrackElement {
                    image,
                    keypoint: p as u32,
                })
                .collect();
            assert_eq!(track, &expected);
        }
    }

    #[test]
    fn no_track_has_two_keypoints_of_one_image() {
        let mut random = Random::new(51);
        let counts = [40, 40, 40, 40, 40];
        let mut pairs = Vec::new();
        for a in 0..5 {
            for b in a + 1..5 {
                let matches: Vec<_> = (0..30)
                    .map(|_| (random.below(40) as u32, random.below(40) as u32))
                    .collect();
                pairs.push(pair(a, b, &matches));
            }
        }
        let tracks = build_tracks(&counts, &pairs).unwrap();
        let mut seen = std::collections::BTreeSet::new();
        for track in &tracks {
            assert!(track.len() >= 2);
            assert!(track.windows(2).all(|pair| pair[0].image < pair[1].image));
            assert!(track.iter().all(|element| seen.insert(*element)));
        }
    }

    #[test]
    fn bad_indices_are_refused() {
        assert!(build_tracks(&[3, 3], &[pair(0, 2, &[])]).is_err());
        assert!(build_tracks(&[3, 3], &[pair(1, 1, &[(0, 1)])]).is_err());
        assert!(build_tracks(&[3, 3], &[pair(0, 1, &[(0, 3)])]).is_err());
        assert_eq!(build_tracks(&[3, 3], &[]).unwrap().len(), 0);
        assert_eq!(build_tracks(&[], &[]).unwrap().len(), 0);
    }
}
