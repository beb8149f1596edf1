//! Pyramids, and the size and sharpness of images.

use crate::fault::Fault;
use crate::functions::functions;
use crate::images::{Field, Gray, require_size};
use crate::options::Setting;
use epipole::imaging::{self, Border, GrayImage32};

functions! {
    /// Image of another size: means over the area of each new pixel where it shrinks, interpolated
    /// where it grows.
    fn resize(image: Field, width: u32, height: u32) -> GrayImage32 {
        require_size("the result", width, height)?;
        imaging::resize(&image.0, width, height)?
    }

    /// Image smoothed and reduced to half its size, rounded up.
    fn pyramid_down(image: Field, border: Option<Setting<Border>>) -> GrayImage32 {
        imaging::pyramid_down(&image.0, super::border(border))
    }

    /// Image enlarged to a size that `pyramidDown` would halve to its own.
    fn pyramid_up(image: Field, width: u32, height: u32) -> GrayImage32 {
        require_size("the result", width, height)?;
        imaging::pyramid_up(&image.0, width, height)
    }

    /// Image and its halves, at most `numLevels`, down to one pixel.
    fn gaussian_pyramid(image: Field, num_levels: u32) -> Vec<GrayImage32> {
        imaging::gaussian_pyramid(&image.0, num_levels as usize)
    }

    /// Differences between the levels of a Gaussian pyramid, and its last level.
    fn laplacian_pyramid(image: Field, num_levels: u32) -> Vec<GrayImage32> {
        imaging::laplacian_pyramid(&image.0, num_levels as usize)
    }

    /// Image of a Laplacian pyramid.
    fn from_laplacian_pyramid(levels: Vec<Field>) -> GrayImage32 {
        if levels.is_empty() {
            return Err(Fault::of_range("levels must have at least one image".to_owned()));
        }
        let levels: Vec<GrayImage32> = levels.into_iter().map(|level| level.0).collect();
        imaging::from_laplacian_pyramid(&levels)
    }

    /// Amount of detail of a few pixels, which blur removes: for photos of one scene and size.
    fn sharpness(image: Gray) -> f64 {
        imaging::sharpness(&image.0)
    }
}
