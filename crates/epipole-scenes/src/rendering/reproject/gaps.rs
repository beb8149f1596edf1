//! A reprojected picture and the filling of its gaps.

use image::RgbImage;
use std::ops::Range;

/// A photograph reprojected to another camera.
#[derive(Debug, Default)]
pub struct Reprojected {
    pub(super) image: RgbImage,
    /// Red, green, blue and 255 for each pixel; 0 if no pixel was projected to it.
    pub(super) pixels: Vec<u32>,
    /// Gaps: runs of neighboring pixels in a row.
    pub(super) missing: Vec<Range<u32>>,
}

impl Reprojected {
    /// Returns the picture. Gaps are black until they are filled.
    pub fn image(&self) -> &RgbImage {
        &self.image
    }

    /// Returns the number of missing pixels.
    pub fn num_missing(&self) -> usize {
        self.missing.iter().map(Range::len).sum()
    }

    /// Returns the mask, row by row, of the pixels that [`Reprojected::fill`] uses from a draft of
    /// `size` of the same view; in a larger draft, also of those between them.
    pub fn wanted(&self, (width, height): (u32, u32)) -> Vec<bool> {
        let (own_width, own_height) = self.image.dimensions();
        let mut wanted = vec![false; width as usize * height as usize];
        let columns: Vec<_> = (0..own_width)
            .map(|u| between(u, own_width, width))
            .collect();
        if wanted.is_empty() {
            return wanted;
        }
        for runs in by_rows(&self.missing, own_width) {
            let start = runs[0].start / own_width * own_width;
            let (above, below, _) = between(runs[0].start / own_width, own_height, height);
            for run in runs {
                let (left, ..) = columns[(run.start - start) as usize];
                let (_, right, _) = columns[(run.end - 1 - start) as usize];
                for row in [above, below] {
                    let place = row * width as usize;
                    wanted[place + left..=place + right].fill(true);
                }
            }
        }
        wanted
    }

    /// Fills the gaps by interpolation from a picture of the same view, of any size.
    pub fn fill(&mut self, draft: &RgbImage) {
        let (width, height) = self.image.dimensions();
        let (draft_width, draft_height) = draft.dimensions();
        if draft_width == 0 || draft_height == 0 {
            return;
        }
        let columns: Vec<_> = (0..width).map(|u| between(u, width, draft_width)).collect();
        let draft = draft.as_raw().as_chunks::<3>().0;
        let draft: Vec<&[[u8; 3]]> = draft.chunks_exact(draft_width as usize).collect();
        // Stretches the two draft rows around a row to its width and keeps them while needed, so
        // that mixing accesses memory in order.
        let mut stretched = [(); 2].map(|()| (usize::MAX, vec![0; 3 * width as usize]));
        let image: &mut [u8] = &mut self.image;
        for runs in by_rows(&self.missing, width) {
            let start = runs[0].start / width * width;
            let (above, below, down) = between(runs[0].start / width, height, draft_height);
            if stretched[1].0 == above {
                stretched.swap(0, 1);
            }
            for ((known, row), wanted) in stretched.iter_mut().zip([above, below]) {
                if *known != wanted {
                    stretch(draft[wanted], &columns, row);
                    *known = wanted;
                }
            }
            let rows = [&stretched[0].1, &stretched[1].1];
            for run in runs {
                let places = [run.start, run.end].map(|place| 3 * (place - start) as usize);
                let pixels = &mut image[3 * run.start as usize..3 * run.end as usize];
                mix(rows.map(|row| &row[places[0]..places[1]]), down, pixels);
            }
        }
    }

    /// Resets to a picture of this size with all pixels missing.
    pub fn clear(&mut self, (width, height): (u32, u32)) {
        self.begin_image((width, height));
        self.pixels.clear();
        self.image.fill(0);
        let rows = (0..height).map(|row| row * width..(row + 1) * width);
        self.missing.extend(rows.filter(|row| !row.is_empty()));
    }

    pub(super) fn begin(&mut self, (width, height): (u32, u32)) {
        self.begin_image((width, height));
        self.pixels.clear();
        self.pixels.resize(width as usize * height as usize, 0);
    }

    fn begin_image(&mut self, (width, height): (u32, u32)) {
        if self.image.dimensions() != (width, height) {
            self.image = RgbImage::new(width, height);
        }
        self.missing.clear();
    }

    /// Builds the picture from the projected pixels. A gap one pixel wide takes its neighbor's
    /// color.
    pub(super) fn finish(&mut self) {
        let width = self.image.width() as usize;
        let (fours, rest) = self.pixels.as_chunks::<4>();
        let targets = self.image.as_chunks_mut::<3>().0;
        let (target_fours, target_rest) = targets.as_chunks_mut::<4>();
        let mut missing = Missing {
            width: width as u32,
            runs: &mut self.missing,
        };
        for (index, (four, target)) in fours.iter().zip(target_fours).enumerate() {
            // Fast path: projected pixels are opaque, and most of a picture is projected.
            if (four[0] & four[1] & four[2] & four[3]) >> 24 != 0 {
                for i in 0..4 {
                    target[i] = rgb(four[i]);
                }
            } else if is_amid_nothing(&self.pixels, width, 4 * index) {
                *target = [[0; 3]; 4];
                missing.push(4 * index..4 * index + 4);
            } else {
                for i in 0..4 {
                    target[i] = match four[i] {
                        0 => close_gap(&self.pixels, width, 4 * index + i, &mut missing),
                        pixel => rgb(pixel),
                    };
                }
            }
        }
        let start = self.pixels.len() - rest.len();
        for (offset, target) in target_rest.iter_mut().enumerate() {
            *target = close_gap(&self.pixels, width, start + offset, &mut missing);
        }
    }
}

/// Stretches a row to the width of another picture; values are times 256.
#[inline(never)]
fn stretch(row: &[[u8; 3]], columns: &[(usize, usize, u32)], target: &mut [u16]) {
    let pixels = target.as_chunks_mut::<3>().0;
    for (pixel, &(left, right, across)) in pixels.iter_mut().zip(columns) {
        let (a, b, across) = (row[left], row[right], across as u16);
        for i in 0..3 {
            pixel[i] = u16::from(a[i]) * (256 - across) + u16::from(b[i]) * across;
        }
    }
}

/// Mixes two stretched rows; `down` is the weight of the second one, of 256.
// Inlined into views, which are compiled for size, it would lose vectorization.
#[inline(never)]
fn mix([above, below]: [&[u16]; 2], down: u32, target: &mut [u8]) {
    // Sixteen at a time for vector instructions, then the remainder.
    const AT_ONCE: usize = 16;
    let mixed =
        |a: u16, b: u16| ((u32::from(a) * (256 - down) + u32::from(b) * down + 32_768) >> 16) as u8;
    let (targets, last) = target.as_chunks_mut::<AT_ONCE>();
    let (above, last_above) = above.as_chunks::<AT_ONCE>();
    let (below, last_below) = below.as_chunks::<AT_ONCE>();
    for ((target, above), below) in targets.iter_mut().zip(above).zip(below) {
        // A local buffer, which cannot alias the rows.
        let mut here = [0; AT_ONCE];
        for i in 0..AT_ONCE {
            here[i] = mixed(above[i], below[i]);
        }
        *target = here;
    }
    for ((target, &above), &below) in last.iter_mut().zip(last_above).zip(last_below) {
        *target = mixed(above, below);
    }
}

/// Groups sorted runs by row.
fn by_rows(runs: &[Range<u32>], width: u32) -> impl Iterator<Item = &[Range<u32>]> {
    runs.chunk_by(move |a, b| a.start / width == b.start / width)
}

/// Collects the gaps in order.
struct Missing<'a> {
    width: u32,
    runs: &'a mut Vec<Range<u32>>,
}

impl Missing<'_> {
    /// Appends pixels of one row; they must follow all earlier ones.
    fn push(&mut self, places: Range<usize>) {
        let [start, end] = [places.start, places.end].map(|place| place as u32);
        match self.runs.last_mut() {
            Some(run) if run.end == start && !start.is_multiple_of(self.width) => run.end = end,
            _ => self.runs.push(start..end),
        }
    }
}

#[inline(always)]
fn rgb(pixel: u32) -> [u8; 3] {
    let [r, g, b, _] = pixel.to_le_bytes();
    [r, g, b]
}

/// Returns whether four pixels of a row, and those above, are all missing: then none is a one-pixel
/// gap.
fn is_amid_nothing(pixels: &[u32], width: usize, start: usize) -> bool {
    let is_empty = |start: usize| pixels[start..start + 4] == [0; 4];
    start % width + 4 <= width && is_empty(start) && (start < width || is_empty(start - width))
}

/// Returns the color of a pixel, or its neighbor's if it is a one-pixel gap; black if missing.
#[inline]
fn close_gap(pixels: &[u32], width: usize, index: usize, missing: &mut Missing<'_>) -> [u8; 3] {
    let at = |index: usize| pixels.get(index).copied().unwrap_or(0);
    let mut pixel = at(index);
    if pixel == 0 {
        let [left, above] = [1, width].map(|step| at(index.wrapping_sub(step)));
        let [right, below] = [1, width].map(|step| at(index + step));
        pixel = match (left != 0 && right != 0, above != 0 && below != 0) {
            (true, _) => left,
            (false, true) => above,
            (false, false) => {
                missing.push(index..index + 1);
                0
            }
        };
    }
    rgb(pixel)
}

/// Returns the two rows or columns of another picture around one of this picture, and the weight of
/// the second, of 256.
fn between(at: u32, size: u32, other_size: u32) -> (usize, usize, u32) {
    let place = (at as f32 + 0.5) * other_size as f32 / size as f32 - 0.5;
    let place = place.clamp(0.0, (other_size as f32 - 1.0).max(0.0));
    let first = place as usize;
    let weight = ((place - first as f32) * 256.0) as u32;
    (
        first,
        (first + 1).min(other_size.max(1) as usize - 1),
        weight,
    )
}
