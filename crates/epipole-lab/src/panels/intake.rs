//! What a reader brings: photographs, of a board while that step is open, projects, videos, links.

use super::host::{Arrival, Host};
use super::work::{Errand, Work};
use crate::project::{Event, Given, Project, Step};
use crate::tasks::{Blob, Request, Source};

/// Takes what has come.
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
        Arrival::News(sentence) => work.news = Some(sentence),
    }
}

/// Takes photographs, which take the place of a sample.
pub(super) fn photographs(project: &mut Project, files: Vec<(String, Blob)>) {
    let is_sample = |photo: &Given| matches!(photo.source, Source::Rendered(..));
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
