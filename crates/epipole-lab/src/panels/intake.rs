//! Handling of arrivals: photographs (of a board during that step), projects, videos, links.

use super::host::{Arrival, Host};
use super::work::{Errand, Work};
use crate::project::{Computed, Event, Given, Project, Step};
use crate::tasks::{Blob, Request, Source};

/// Handles an arrival.
pub(super) fn take(arrival: Arrival, project: &mut Project, work: &mut Work, host: &mut impl Host) {
    match arrival {
        Arrival::Photographs(files) => photographs(project, files),
        Arrival::Project(archive) => work.run(Errand::Open, &Request::Open { archive }, host),
        Arrival::Link(parameters) => {
            let problems = project.open_link(&parameters);
            if !problems.is_empty() {
                work.news = Some(problems.join(" "));
            }
        }
        Arrival::Video(video) => {
            let num_parts = project.document().settings.num_frames;
            work.videos.add(video, num_parts, host);
        }
        Arrival::Frames(video, name, frames) => {
            if let Some(part) = work.videos.part_of(video) {
                let request = Request::Frames { name, part, frames };
                work.run(Errand::Frames(video), &request, host);
            }
        }
        Arrival::NoFrames(video, sentence) => {
            work.videos.give_up(video, host);
            work.news = Some(sentence);
        }
        Arrival::Kept(kept) => work.hear_of_kept(kept, host),
        Arrival::Solved(bytes) => {
            work.waits_for_sample = false;
            project.bring(Computed::from_bytes(&bytes));
        }
        Arrival::News(sentence) => work.news = Some(sentence),
    }
}

/// Whether a photograph is of a sample.
pub(super) fn is_sample(photo: &Given) -> bool {
    matches!(photo.source, Source::Rendered(..))
}

/// Takes photographs, which take the place of a sample.
pub(super) fn photographs(project: &mut Project, files: Vec<(String, Blob)>) {
    let document = project.document();
    if project.view().step == Step::Calibrate {
        if document.boards.iter().all(is_sample) {
            project.update(Event::ClearBoards);
        }
        project.update(Event::AddBoards(files));
        return;
    }
    // One change: one step back.
    project.update(match document.photos.iter().all(is_sample) {
        true => Event::Begin(files),
        false => Event::Add(files),
    });
    project.update(Event::Show(Step::Photographs));
}
