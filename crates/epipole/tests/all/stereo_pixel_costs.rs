//! The costs of single pixels against whole images of semi-global matching.

use epipole::Error;
use epipole::math::random::Random;
use epipole::stereo::{DisparityFilter, PATH_STEPS, StereoPaths, StereoSgm};
use image::{GrayImage, Luma};

const SIZE: (u32, u32) = (72, 40);

/// Two surfaces of random texture, the nearer one in the middle, with noise.
fn pair() -> [GrayImage; 2] {
    let mut random = Random::new(5);
    let mut image = |shift: u32| {
        GrayImage::from_fn(SIZE.0, SIZE.1, |u, v| {
            let d = if (24..50).contains(&u) { 9 } else { 4 };
            let at = u + d * shift;
            let texture = (at * at * 7 + v * v * 5 + at * v * 3) % 151;
            Luma([(texture as f64 + random.uniform(0.0, 60.0)) as u8])
        })
    };
    [image(0), image(1)]
}

fn unfiltered() -> DisparityFilter {
    DisparityFilter::default()
        .with_left_right_max_px(None)
        .with_uniqueness_percent(0)
        .with_speckle_size(0)
        .with_max_gap_px(0)
}

#[test]
fn the_sum_of_its_paths_has_the_minimum_that_the_whole_image_has() {
    let [left, right] = pair();
    for (paths, indices) in [
        (StereoPaths::Four, &[0, 1, 2, 3][..]),
        (StereoPaths::Five, &[0, 1, 2, 4, 6]),
        (StereoPaths::Eight, &[0, 1, 2, 3, 4, 5, 6, 7]),
    ] {
        for (min_disparity, count) in [(0, 16), (-3, 21), (2, 10)] {
            let matcher = StereoSgm::default()
                .with_min_disparity_px(min_disparity)
                .with_num_disparities(count)
                .with_paths(paths)
                .with_filter(unfiltered());
            let whole = matcher.compute(&left, &right, &mut ()).unwrap();
            let mut compared = 0;
            for (u, v) in (0..SIZE.0)
                .step_by(4)
                .flat_map(|u| (0..SIZE.1).map(move |v| (u, v)))
            {
                let costs = matcher.pixel_costs(&left, &right, u, v).unwrap();
                let sum = |d: usize| -> u32 {
                    let costs = indices.iter().map(|&k| u32::from(costs.paths[k].costs[d]));
                    costs.sum()
                };
                let sums: Vec<u32> = (0..count as usize).map(sum).collect();
                let winner = (0..sums.len()).min_by_key(|&d| sums[d]).unwrap();
                let rivals = (0..sums.len()).filter(|&d| d != winner).map(|d| sums[d]);
                // The whole image rounds the mean of half of the paths.
                let is_clear = rivals.min().unwrap() > sums[winner] + indices.len() as u32;
                if let Some(found) = whole.get(u, v).filter(|_| is_clear) {
                    let own = (min_disparity + winner as i32) as f32;
                    assert!((found - own).abs() <= 0.5, "({u}, {v}): {found} {own}");
                    compared += 1;
                }
            }
            assert!(compared > 350, "{paths:?}, {min_disparity}: {compared}");
        }
    }
}

#[test]
fn without_penalties_every_path_is_the_matching_cost() {
    let [left, right] = pair();
    let matcher = StereoSgm::default()
        .with_num_disparities(16)
        .with_small_step_penalty(0)
        .with_large_step_penalty(0);
    let costs = matcher.pixel_costs(&left, &right, 40, 20).unwrap();
    for path in &costs.paths {
        assert_eq!(path.costs, costs.matching);
    }
    let smooth = StereoSgm::default().with_num_disparities(16);
    let smooth = smooth.pixel_costs(&left, &right, 40, 20).unwrap();
    assert_eq!(smooth.matching, costs.matching);
    assert_ne!(smooth.paths, costs.paths);
}

#[test]
fn paths_reach_from_the_border_to_the_pixel() {
    let [left, right] = pair();
    let matcher = StereoSgm::default().with_num_disparities(16);
    let (u, v) = (10, 30);
    let costs = matcher.pixel_costs(&left, &right, u, v).unwrap();
    let lengths = costs.paths.each_ref().map(|path| path.winners_px.len());
    assert_eq!(lengths, [11, 62, 31, 10, 11, 10, 31, 10]);
    for (path, [du, dv]) in costs.paths.iter().zip(PATH_STEPS) {
        let lowest = (0..16).min_by_key(|&d| path.costs[d]).unwrap();
        assert_eq!(path.winners_px.last(), Some(&(lowest as i32)));
        // A pixel before the last has the same path but for its end.
        let before = [u as i32 - du, v as i32 - dv].map(|at| at as u32);
        let before = matcher.pixel_costs(&left, &right, before[0], before[1]);
        let index = PATH_STEPS
            .iter()
            .position(|step| *step == [du, dv])
            .unwrap();
        let before = before.unwrap().paths[index].winners_px.clone();
        assert_eq!(path.winners_px[..before.len()], before);
    }
}

#[test]
fn a_pixel_outside_is_refused_in_a_sentence() {
    let [left, right] = pair();
    let matcher = StereoSgm::default();
    for (u, v) in [(SIZE.0, 0), (0, SIZE.1)] {
        let error = matcher.pixel_costs(&left, &right, u, v).unwrap_err();
        assert!(matches!(error, Error::OutOfRange { .. }));
    }
}
