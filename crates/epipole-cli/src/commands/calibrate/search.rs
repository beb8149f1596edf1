//! Boards in photos.

use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::listing::Listed;
use crate::photo::Photo;
use crate::progress::Progress;
use crate::reading::ReadArguments;
use epipole::calibration::{Board, BoardView, find_board};
use epipole::feature::photo_to_gray;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Boards found in the photos of one camera, in their order.
pub(super) struct SearchedPhotos {
    pub(super) names: Vec<String>,
    pub(super) views: Vec<Option<BoardView>>,
    /// Reason for a missing view, with the name of the file.
    pub(super) problems: Vec<Option<String>>,
    pub(super) size: (u32, u32),
}

/// Searches every photo for the board.
pub(super) fn search(
    photos: &[Listed],
    reading: ReadArguments,
    board: &Board,
    context: &Context,
) -> Result<SearchedPhotos, Failure> {
    let progress = Progress::new(context, "looking for boards");
    let num_done = AtomicUsize::new(0);
    let searched: Result<Vec<_>, Failure> = photos
        .par_iter()
        .map(|photo| {
            if interrupt::requested() {
                return Err(epipole::Error::Canceled.into());
            }
            let gray = photo_to_gray(&Photo::of_sensor(&photo.path, reading, context)?);
            let found = find_board(&gray, board, &mut interrupt::watch)?;
            let done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.set(done as f64 / photos.len() as f64);
            Ok((gray.dimensions(), found))
        })
        .collect();
    drop(progress);
    let names: Vec<String> = photos.iter().map(|photo| photo.name.clone()).collect();
    let mut found_in = SearchedPhotos {
        names,
        views: Vec::new(),
        problems: Vec::new(),
        size: (0, 0),
    };
    for (index, (size, found)) in searched?.into_iter().enumerate() {
        let name = &found_in.names[index];
        if index == 0 {
            found_in.size = size;
        } else if size != found_in.size {
            let (width, height) = found_in.size;
            return Err(Failure::new(
                "size-mismatch",
                format!(
                    "all images of a camera must have the same size, but {name} is {} × {} and {} {width} × {height}",
                    size.0, size.1, found_in.names[0]
                ),
            ));
        }
        let problem = found.problem(board);
        found_in
            .problems
            .push(problem.map(|problem| format!("{name}: {problem}")));
        found_in.views.push(found.view());
    }
    Ok(found_in)
}
