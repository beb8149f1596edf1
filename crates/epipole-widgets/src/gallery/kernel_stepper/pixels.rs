//! Two images small enough to show every gray level as a number.

use epipole::imaging::GrayImage32;
use image::Luma;

/// Columns and rows.
pub(super) const SIZE: (u32, u32) = (8, 6);

/// A bright corner. Row 2 around column 3 contains the patch that the chapter computes by hand.
const PATCH: [[u8; 8]; 6] = [
    [20, 25, 28, 45, 80, 110, 118, 120],
    [22, 26, 30, 60, 90, 125, 130, 128],
    [24, 30, 40, 90, 140, 150, 148, 146],
    [21, 28, 35, 120, 150, 152, 150, 149],
    [26, 40, 80, 140, 155, 154, 152, 150],
    [30, 60, 110, 150, 156, 155, 153, 151],
];

/// Left and top of the crop from the rendered still life of 480 × 360 pixels.
#[cfg(test)]
const FROM: (u32, u32) = (290, 212);

/// The rim of the mug in the still life.
const PHOTOGRAPH: [[u8; 8]; 6] = [
    [115, 111, 107, 106, 110, 118, 147, 174],
    [107, 105, 104, 116, 145, 173, 183, 186],
    [87, 88, 105, 166, 178, 186, 179, 167],
    [89, 85, 156, 178, 187, 169, 150, 132],
    [70, 114, 166, 179, 172, 136, 107, 78],
    [62, 155, 174, 161, 152, 93, 78, 76],
];

/// Returns the gray levels of one of the two images.
pub(super) fn image(is_photograph: bool) -> GrayImage32 {
    let levels = if is_photograph { &PHOTOGRAPH } else { &PATCH };
    GrayImage32::from_fn(SIZE.0, SIZE.1, |u, v| {
        Luma([f32::from(levels[v as usize][u as usize])])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::photograph;
    use epipole::imaging::rgb_to_gray;
    use epipole_scenes::still_life_camera;
    use std::ops::ControlFlow;

    #[test]
    fn the_photograph_is_a_part_of_the_still_life() {
        let camera = still_life_camera(480, 360);
        let go_on = &mut |_| ControlFlow::Continue(());
        let gray = rgb_to_gray(&photograph(&camera, (480, 360), go_on).unwrap());
        let row =
            |v: u32| [0, 1, 2, 3, 4, 5, 6, 7].map(|u| gray.get_pixel(FROM.0 + u, FROM.1 + v).0[0]);
        assert_eq!([0, 1, 2, 3, 4, 5].map(row), PHOTOGRAPH);
    }
}
